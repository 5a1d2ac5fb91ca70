"""Whole runs of the program behind `tabor report`: the files, their sizes, the page."""

import contextlib
import io
import os
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
from html.parser import HTMLParser
from pathlib import Path

import h5py
import numpy as np

import synthetic_study
from synthetic_single import write_single
from synthetic_study import Recipe
from tabor.report import build, cli

PACKAGE = Path(__file__).resolve().parents[2] / "python"
ODD = Recipe(
    groups=("vor dem Gleiten – Ö/µ", "vor dem Gleiten – Ö/µ", "после <b>$x$</b>"),
    shape=(80, 96),
    pressures=(2e6, 8e6),
    not_converged=((2, 0),),
    missing_cases=((1, 1),),
    warnings={0: "heights are quantised at 10 nm"},
)


def run(*arguments):
    """What the program does, in this process: starting Python and its libraries takes longer than most pages."""
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = cli.main([*map(str, arguments)])
    return subprocess.CompletedProcess(arguments, code, out.getvalue(), err.getvalue())


def run_alone(*arguments):
    """The program itself, by its former name."""
    return subprocess.run(
        [sys.executable, "-m", "tabor_report", *map(str, arguments)],
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": str(PACKAGE), "PYTHONDONTWRITEBYTECODE": "1"},
        timeout=240,
    )


class Links(HTMLParser):
    """Everything a browser would fetch or follow, the ids and the text."""

    def __init__(self, text):
        super().__init__()
        self.fetched, self.followed, self.ids, self.words = [], [], set(), []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.ids.add(values.get("id"))
        self.fetched += [values[name] for name in ("src", "srcset", "data") if name in values]
        if "href" in values:
            (self.followed if tag == "a" else self.fetched).append(values["href"])

    def handle_data(self, data):
        self.words.append(data)


def png_size(path):
    head = path.read_bytes()[:24]
    assert head[:8] == b"\x89PNG\r\n\x1a\n", path
    return int.from_bytes(head[16:20], "big"), int.from_bytes(head[20:24], "big")


class StudyReport(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.temporary.name) / "study – Ö"
        synthetic_study.write(cls.folder, ODD)
        cls.done = run_alone(cls.folder, "--figures", "png,svg")
        cls.page = (
            (cls.folder / "report.html").read_text(encoding="utf-8") if cls.done.returncode == 0 else ""
        )
        cls.links = Links(cls.page)
        cls.text = " ".join(cls.links.words)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def test_it_ends_well_and_silently(self):
        self.assertEqual((self.done.returncode, self.done.stderr), (0, ""))

    def test_every_figure_exists_as_png_svg_and_csv_and_is_listed(self):
        names = [
            "topography",
            "psd",
            "contact_map",
            "dry_friction",
            "lubricant_map",
            "contact_clusters",
            "lubricated_friction",
            "contact_area",
        ]
        for name in names:
            for ending in ("png", "svg", "csv"):
                path = self.folder / "figures" / f"{name}.{ending}"
                self.assertGreater(path.stat().st_size, 100, path)
                self.assertIn(str(path), self.done.stdout)

    def test_pngs_are_wide_enough_to_print(self):
        for path in (self.folder / "figures").glob("*.png"):
            width, height = png_size(path)
            self.assertTrue(600 < width < 1600 and 300 < height < 2400, (path.name, width, height))

    def test_svgs_are_xml_without_a_date(self):
        for path in (self.folder / "figures").glob("*.svg"):
            text = path.read_text(encoding="utf-8")
            xml.etree.ElementTree.fromstring(text)
            self.assertNotIn("dc:date", text)

    def test_no_temporary_file_is_left(self):
        self.assertEqual([path for path in self.folder.rglob(".*") if path.is_file()], [])

    def test_the_page_fetches_nothing(self):
        self.assertTrue(self.links.fetched)
        self.assertTrue(
            all(source.startswith("data:image/") for source in self.links.fetched), self.links.fetched
        )
        self.assertNotRegex(self.page, r"@import|url\(|<script|<link|<iframe")

    def test_every_entry_of_the_contents_leads_somewhere(self):
        for target in self.links.followed:
            is_inside = target.startswith("#") and target[1:] in self.links.ids
            self.assertTrue(is_inside or target.startswith("data:text/csv;base64,"), target[:80])

    def test_names_of_the_user_appear_as_written_and_not_as_markup(self):
        self.assertIn("vor dem Gleiten – Ö/µ", self.text)
        self.assertIn("после <b>$x$</b>", self.text)
        self.assertNotIn("<b>$x$</b>", self.page)

    def test_rows_that_did_not_converge_are_marked_and_warned_about(self):
        self.assertEqual(len(re.findall(r'<tr class="loose">', self.page)), 2)
        self.assertIn("2 of 10 rows did not converge", self.text)

    def test_an_incomplete_study_and_warnings_are_warned_about(self):
        self.assertIn("10 of 12 cases are done", self.text)
        self.assertIn("heights are quantised at 10 nm", self.text)

    def test_the_page_names_scans_material_origin_and_sources(self):
        for words in (
            "before_1.x3p",
            "lowpass=hann:512/L",
            "78.55 GPa",
            "240 MPa",
            "tabor sweep study.toml",
            "polonsky1999",
            "almqvist2007",
            "costagliola2021",
            "barnes2021",
            "@software{tabor",
        ):
            self.assertIn(words, self.text)
        self.assertRegex(self.text, r"SHA-256 [0-9a-f]{64}")

    def test_scans_are_named_without_folder_and_extension(self):
        table = self.page[self.page.index('<section id="results">') : self.page.index('<section id="origin">')]
        self.assertEqual(set(re.findall(r'<tr[^>]*><td class="text">([^<]*)</td>', table)), {"before_1", "before_2", "before_3"})
        self.assertRegex(self.text, "(Topography|Maps): before_1 ")
        for caption in re.findall(r"<figcaption>.*?<span", self.page, re.S):
            self.assertNotIn(".x3p", caption)

    def test_no_index_stands_on_the_line(self):
        seen = re.sub(r"<(style|pre|script).*?</\1>|<[^>]*>", "", self.page, flags=re.S)
        self.assertNotRegex(seen, r"(A|p|τ|tau)_(real|lub|sat|y)\b|C[12]D")
        self.assertIn("p<sub>sat</sub>", self.page)

    def test_the_same_study_gives_the_same_bytes(self):
        before = {
            path: path.read_bytes() for path in [*self.folder.glob("figures/*"), self.folder / "report.html"]
        }
        self.assertEqual(run_alone(self.folder, "--figures", "png,svg").returncode, 0)
        self.assertEqual([path.name for path, data in before.items() if path.read_bytes() != data], [])


class TwoPressuresAndDensities(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as temporary:
            folder = Path(temporary)
            write_single(folder / "one.h5", Recipe(shape=(70, 90), pressures=(5e6, 10e6), densities=(0.45, 0.9)))
            cls.done = run(folder / "one.h5", "--figures", "png")
            figures = folder / "one_report" / "figures"
            cls.names = {path.stem for path in figures.glob("*.png")}
            cls.curves = (figures / "against_pressure.csv").read_text(encoding="utf-8").splitlines()
            cls.page = (folder / "one_report" / "report.html").read_text(encoding="utf-8")

    def test_it_ends_well_and_silently(self):
        self.assertEqual((self.done.returncode, self.done.stderr), (0, ""))

    def test_a_contact_is_drawn_once_per_pressure_and_a_film_once_per_density(self):
        contact = {f"{what}_{pressure}MPa" for pressure in (5, 10) for what in ("pressure", "contact", "gap")}
        films = {"film_0.45g_per_m2", "film_0.9g_per_m2"}
        sections = {f"section_{p}MPa_{d}g_per_m2" for p in (5, 10) for d in (0.45, 0.9)}
        self.assertEqual(self.names, {"topography", "heights", "against_pressure"} | contact | films | sections)
        self.assertIn("Film map: 0.45 g/m²", self.page)

    def test_the_curves_are_the_states(self):
        with_text = [row.split(",") for row in self.curves if not row.startswith("#")]
        column = with_text[0].index("friction_lubricated")
        values = [float(row[column]) for row in with_text[1:]]
        expected = [0.3 - 1e-8 * p * d for p in (5e6, 10e6) for d in (0.45, 0.9)]
        self.assertEqual(values, expected)

    def test_the_answer_stands_first_one_line_per_question_and_each_warning_once(self):
        answer = self.page[self.page.index('<table class="answer">') : self.page.index("</table>")]
        for words in ("5 MPa", "10 MPa", ">contact area<", "friction dry", "friction, 0.45 g/m²", "friction, 0.9 g/m²"):
            self.assertEqual(answer.count(words), 1, words)
        self.assertLess(self.page.index('<table class="answer">'), self.page.index('<section id="figures">'))


class SingleReport(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def report(self, pressures=(5e6,), densities=(0.9,), change=None, **parts):
        recipe = Recipe(shape=(70, 90), pressures=pressures, densities=densities)
        write_single(self.folder / "one.h5", recipe, **parts)
        if change:
            with h5py.File(self.folder / "one.h5", "a") as file:
                change(file["states/0000"])
        done = run(self.folder / "one.h5", "--figures", "png")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        names = {path.stem for path in (self.folder / "one_report" / "figures").glob("*.png")}
        return names, (self.folder / "one_report" / "report.html").read_text(encoding="utf-8")

    def test_a_friction_file_shows_every_map_it_holds(self):
        names, page = self.report()
        self.assertEqual(
            names,
            {
                "topography",
                "heights",
                *(f"{what}_5MPa" for what in ("pressure", "contact", "gap")),
                "film_0.9g_per_m2",
                "section_5MPa_0.9g_per_m2",
            },
        )
        self.assertIn("one.x3p", page)
        self.assertIn("contact area (perimeter-corrected)", page)

    def test_oil_that_flows_shows_its_pressure_and_its_fill(self):
        def flow(state):
            gap = state["gap"][()]
            state["fluid_pressure"], state["fluid_fill"] = 1e6 * (gap > 0), 0.5 + 0 * gap
            state.attrs.update({"friction_mixed": 0.123, "sliding_speed_m_per_s": 0.005})

        names, page = self.report(change=flow)
        self.assertTrue({f"fluid_{what}_5MPa_0.9g_per_m2_5mm_per_s" for what in ("pressure", "fill")} <= names)
        self.assertIn("Fluid pressure map: P = 5 MPa, 0.9 g/m², 5 mm/s", page)
        self.assertIn("friction while oil flows", page)

    def test_what_saturates_is_as_the_file_says_else_told_from_pressures(self):
        write_single(self.folder / "one.h5", Recipe(shape=(20, 24), pressures=(5e6,)), film=False)

        def found():
            source = build.open_result(self.folder / "one.h5")
            with source.file:
                return source.states[0].state()

        told = found()
        self.assertEqual(set(np.unique(told)), {0, 1, 2})
        with h5py.File(self.folder / "one.h5", "a") as file:
            file["states/0000/state"] = np.minimum(told, 1)
        np.testing.assert_array_equal(found(), np.minimum(told, 1))

    def test_oil_that_flows_at_one_speed_has_it_from_the_settings(self):
        write_single(self.folder / "one.h5", Recipe(shape=(70, 90), pressures=(5e6,), densities=(0.9,)))
        with h5py.File(self.folder / "one.h5", "a") as file:
            file["states/0000"].attrs.update({"friction_mixed": 0.123, "fluid_load_share": 0.2})
            file.attrs["config_toml"] = "sliding_speed_m_per_s = 0.05\n"
        self.assertEqual(run(self.folder / "one.h5", "--static").returncode, 0)
        page = (self.folder / "one_report/report.html").read_text(encoding="utf-8")
        self.assertIn("friction while oil flows, 0.9 g/m², 50 mm/s", page)

    def test_a_path_of_loads_that_comes_back_to_a_pressure_shows_it_again(self):
        names, page = self.report(pressures=(2e6, 7e6, 2e6), film=False)
        self.assertTrue({f"{what}_{at}" for what in ("pressure", "contact", "gap") for at in ("2MPa", "7MPa", "2MPa_2nd")} <= names)
        answer, results = (page[page.index(begin) : page.index("</thead>", page.index(begin))] for begin in ('<table class="answer">', 'id="results"'))
        for head in (answer, results):
            self.assertEqual(re.findall(r"<th[^>]*>([^<]+)</th>", head), ["2 MPa", "7 MPa", "2 MPa (2nd)"])
        rows = (self.folder / "one_report/figures/against_pressure.csv").read_text(encoding="utf-8").splitlines()
        self.assertEqual(len(rows), 4)

    def test_a_film_alone_has_no_certificate(self):
        _, page = self.report(contact=False)
        self.assertNotIn("The certificate is", page)

    def test_a_film_alone_is_shown_without_contact(self):
        names, _ = self.report(contact=False)
        self.assertEqual(names, {"topography", "heights", "film_0.9g_per_m2", "section_0.9g_per_m2"})

    def test_a_folder_that_cannot_be_written_ends_with_5(self):
        write_single(self.folder / "one.h5", Recipe(shape=(20, 20), pressures=(5e6,)))
        (self.folder / "taken").write_text("a file where a folder should be")
        done = run(self.folder / "one.h5", "-o", self.folder / "taken")
        self.assertEqual(done.returncode, 5)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)

    def test_the_page_comes_alone_and_figures_in_the_formats_asked_for(self):
        write_single(self.folder / "one.h5", Recipe(shape=(20, 20), pressures=(5e6,)), film=False)
        made = self.folder / "one_report"
        self.assertEqual(run(self.folder / "one.h5").returncode, 0)
        self.assertEqual([path.name for path in made.iterdir()], ["report.html"])
        self.assertEqual(run(self.folder / "one.h5", "--figures", "pdf,png").returncode, 0)
        self.assertEqual({path.suffix for path in (made / "figures").iterdir()}, {".pdf", ".png", ".csv"})
        self.assertTrue((made / "figures/topography.pdf").read_bytes().startswith(b"%PDF"))

    def test_an_unknown_format_of_figures_is_a_usage_error(self):
        for words in ("jpeg", "png,", ",", ""):
            done = run(self.folder / "one.h5", f"--figures={words}")
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), (words, done.stderr))
            self.assertIn("png, svg, pdf", done.stderr)

    def test_more_states_than_fit_beside_each_other_make_more_tables(self):
        _, page = self.report(pressures=(2e6, 5e6, 10e6, 15e6), densities=(0.45, 0.9))
        results = page[page.index('<section id="results">') : page.index('<section id="origin">')]
        heads = [re.findall(r"<th[ >]", head) for head in re.findall(r"<thead>.*?</thead>", results, re.S)]
        self.assertEqual([len(head) - 1 for head in heads], [6, 2])

    def test_no_html_makes_figures_only(self):
        write_single(self.folder / "one.h5", Recipe(shape=(20, 20), pressures=(5e6,)), film=False)
        self.assertEqual(run(self.folder / "one.h5", "--no-html").returncode, 0)
        self.assertFalse((self.folder / "one_report" / "report.html").exists())


if __name__ == "__main__":
    unittest.main()
