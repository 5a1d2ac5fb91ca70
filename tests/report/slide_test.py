"""The page of a file of `tabor slide`."""

import csv
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np
from matplotlib import pyplot

from report_test import run
from tabor.report import build

SCAN = Path(__file__).resolve().parents[2] / "surfaces/edt_before.x3p"
WORDS = ["--level", "plane", "--crop", "0,0,48,48", "--mirror", "--material", "aluminium-6016", "--tool", "ground:Sa=0.1um,length=200um", "--pressure",
         "10MPa", "--distance", "10.72um", "--step", "1.34um", "--every", "2.68um", "--density", "0.9g/m^2", "--maps-at", "5.36um", "--quiet"]  # fmt: skip


class Slide(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = Path(cls.folder.name) / "slide.h5"
        subprocess.run([os.environ["TABOR"], "slide", SCAN, *WORDS, "-o", cls.path], check=True, capture_output=True)
        cls.out = cls.path.parent / "page"
        cls.done = run(cls.path, "-o", cls.out, "--static", "--figures", "svg")
        cls.page = (cls.out / "report.html").read_text(encoding="utf-8")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_the_file_has_maps_of_both_ends_and_where_they_were_asked_for(self):
        with h5py.File(self.path) as file:
            states = [file["states"][key] for key in sorted(file["states"])]
            self.assertEqual(len(states), 5)
            self.assertEqual([number for number, state in enumerate(states) if "sheet" in state], [0, 2, 4])
            last = states[-1]
            self.assertEqual({"sheet", "pressure", "gap", "state", "film_thickness", "squeezed_film", "x", "y"}, set(last))
            height, sheet = file["surface/height"][()], last["sheet"][()]
            self.assertAlmostEqual(float(np.mean(height, dtype=float)) * 1e6, float(np.mean(sheet, dtype=float)) * 1e6, places=6)
            self.assertGreater(np.abs(sheet - height).max(), 1e-9)
            self.assertEqual(set(file["spectra"]), {"before", *(f"{number:04d}" for number in range(5))})

    def test_the_page_shows_the_way_and_the_sheet(self):
        self.assertEqual((self.done.returncode, self.done.stderr), (0, ""))
        for words in ("slid 10.72 µm", "Along the way, under 10 MPa", "pressed", "after 5.36 µm", "friction, oil is squeezed out", "of it ploughing",
                      "Spectra of the sheet before and after", "Change of the sheet: after 10.72 µm", "10 MPa, before sliding", "10 MPa, after 10.72 µm", "Section of the sheet before and after"):  # fmt: skip
            self.assertIn(words, self.page)
        self.assertIn("0 m³/m²", re.search(r"<td[^>]*>lost volume</td>.*?</tr>", self.page)[0])
        names = {path.stem for path in (self.out / "figures").glob("*.svg")}
        self.assertLessEqual({"along_the_way", "slide_spectra", "change_after10.72um", "section_before_and_after", "sheet_after10.72um"}, names)
        # The heights of the page are those of the first contact alone.
        self.assertEqual(sorted(name for name in names if name.startswith("section_")), ["section_before_and_after", "section_pressed"])

    def test_the_table_of_the_curves_is_that_of_the_states(self):
        source = build.open_result(self.path)
        self.addCleanup(source.file.close)
        with open(self.out / "figures/along_the_way.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        for row, state in zip(rows, source.states, strict=True):
            self.assertAlmostEqual(float(row["friction_lubricated_squeezed"]), state.facts["friction_lubricated_squeezed"], places=8)

    def test_the_answer_agrees_with_the_file(self):
        with h5py.File(self.path) as file:
            value = file["states/0004"].attrs["friction_dry"]
        answer = re.search(r'(?s)<table class="answer">.*?</table>', self.page)[0]
        self.assertIn(f"{value:.4g}", answer)

    def names_of_figures(self, path, draw, with_maps):
        source = build.open_result(path)
        self.addCleanup(source.file.close)
        names = [figure.name for figure in draw(source, with_maps)]
        pyplot.close("all")
        return names

    def check_interactive_page(self, path, draw, beside_the_viewer):
        """The viewer shows pressure, gap and film in the place of figures."""
        interactive, static = (self.names_of_figures(path, draw, with_maps) for with_maps in (False, True))
        for what in beside_the_viewer:
            self.assertTrue(any(name.startswith(f"{what}_") for name in interactive), f"{what}: {interactive}")
        for what in ("pressure", "gap", "film"):
            self.assertFalse(any(name.startswith(f"{what}_") for name in interactive), f"{what}: {interactive}")
            self.assertTrue(any(name.startswith(f"{what}_") for name in static), f"{what}: {static}")

    def test_interactive_pages_have_the_maps_that_their_viewers_do_not_hold(self):
        hardened = self.path.parent / "hardened.h5"
        subprocess.run([os.environ["TABOR"], "slide", SCAN, *WORDS, "--hardening", "100MPa/um", "-o", hardened], check=True, capture_output=True)
        self.check_interactive_page(hardened, build.slide_figures, ["sheet", "change", "saturation_pressure"])
        pressed = self.path.parent / "pressed.h5"
        words = [*WORDS[: WORDS.index("--distance")], "--density", "0.9g/m^2", "--trapped", "--quiet"]
        subprocess.run([os.environ["TABOR"], "friction", SCAN, *words, "-o", pressed], check=True, capture_output=True)
        self.check_interactive_page(pressed, build.single_figures, ["tool", "liquid_pressure"])

    def test_options_of_studies_are_rejected(self):
        done = run(self.path, "--pressure", "7MPa")
        self.assertEqual(done.returncode, 2)
        self.assertIn("whose way is drawn as a whole", done.stderr)


STUDY = f"""
[material]
name = "aluminium-6016"
[treatment]
steps = ["level=plane", "crop=0,0,48,48"]
[contact]
edges = "cut"
tool = "ground:Sa=0.1um,length=200um"
[sweep]
mean_pressure = ["5 MPa", "10 MPa"]
lubricant_density = ["0 g/m^2", "0.45 g/m^2"]
[slide]
distance = "4 um"
step = "1.34 um"
[[scan]]
file = "{SCAN}"
group = "before"
"""


class SlidesOfAStudy(unittest.TestCase):
    def test_the_page_draws_them_beside_the_friction_of_one_pressing(self):
        with tempfile.TemporaryDirectory() as folder:
            file, results = Path(folder) / "study.toml", Path(folder) / "results"
            file.write_text(STUDY, encoding="utf-8")
            subprocess.run([os.environ["TABOR"], "sweep", file, "-o", results, "--quiet"], check=True, capture_output=True)
            done = run(results, "--static", "--figures", "svg")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertIn("Friction while sliding", (results / "report.html").read_text(encoding="utf-8"))
            with open(results / "slides.csv", encoding="utf-8") as stored, open(results / "figures/slides.csv", encoding="utf-8") as drawn:
                for row, shown in zip(csv.DictReader(stored), csv.DictReader(drawn), strict=True):
                    self.assertAlmostEqual(float(row["friction_dry"]), float(shown["friction_dry"]), places=8)


if __name__ == "__main__":
    unittest.main()
