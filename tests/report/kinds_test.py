"""A page of every kind of result, as the libraries of this interpreter draw it: CMakeLists.txt runs it with the oldest and the newest."""

import tempfile
import unittest
from pathlib import Path

import ehl_test
import parameters_test
import spectra_test
import synthetic_study
from synthetic_single import write_single
from synthetic_study import Recipe
from tabor.report import cli


def params(path):
    path.write_text(parameters_test.TABLE, encoding="utf-8")


def groups(path):
    path.write_text(parameters_test.GROUPS, encoding="utf-8")


def combination(path):
    write_single(path)
    with ehl_test.h5py.File(path, "r+") as file:
        del file["states"]
        file["surface"].attrs["source"] = "before/a.x3p - after/b.x3p"
        file.create_group("combination").attrs.update({"mode": "wear", "worn_volume_m3": 3.8e-15, "worn_uncertainty_m3": 1.7e-17})


def contact(path):
    write_single(path, film=False)


def film(path):
    write_single(path, contact=False)


KINDS = {
    "impact.h5": ehl_test.impact_file, "line.h5": ehl_test.line_file, "point.h5": ehl_test.point_file,
    "sweep.h5": ehl_test.sweep_file, "many.h5": ehl_test.many_file, "stribeck.h5": ehl_test.stribeck_file, "friction.h5": write_single,
    "contact.h5": contact, "film.h5": film, "combination.h5": combination, "psd.h5": spectra_test.write, "params.csv": params,
    "groups.csv": groups,
}  # fmt: skip


class Kinds(unittest.TestCase):
    def test_every_kind_of_result_has_a_page(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, make in KINDS.items():
                with self.subTest(name):
                    path = Path(folder) / name
                    make(path)
                    self.drawn(path, Path(folder) / f"{path.stem}_page")

    def test_a_study_has_a_page(self):
        with tempfile.TemporaryDirectory() as folder:
            synthetic_study.write(Path(folder), Recipe())
            self.drawn(Path(folder), Path(folder) / "page")

    def drawn(self, result, output):
        files = cli.make(result, output)
        (page,) = [Path(file) for file in files if Path(file).suffix == ".html"]
        text = page.read_text(encoding="utf-8")
        self.assertIn("</html>", text)
        self.assertIn("<h2", text)


if __name__ == "__main__":
    unittest.main()
