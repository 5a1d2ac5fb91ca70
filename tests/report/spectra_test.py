"""The page of a file of `tabor psd`."""

import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

from report_test import run
from synthetic_file import new_file
from study_case import rows_of
from tabor.report import build, chart, page_spectra, spectra
from tabor.report.figures import spectra as figure

SIDE, N = 1e-4, 128


def write(path, axes=("x", "y", "radial"), power=-2.6):
    """A spectrum q^power of a scan of N pixels over SIDE."""
    with new_file(path) as file:
        file.attrs["command"] = "tabor psd 'my scan.x3p' --level plane -o psd.h5"
        q = 2 * np.pi / SIDE * np.arange(1, N // 2 + 1)
        for axis in axes:
            unit = spectra.UNITS[axis]
            file[f"curves/q_{axis}_rad_per_m"], file[f"curves/psd_{axis}_{unit}"] = q, 1e-20 * (q / q[0]) ** power


class Spectra(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.path = Path(temporary.name) / "psd.h5"

    def source(self, **keywords):
        write(self.path, **keywords)
        source = build.open_result(self.path)
        self.addCleanup(source.file.close)
        return source

    def test_the_range_to_be_trusted_is_four_pixels_to_a_quarter_of_the_side(self):
        low, high = self.source().trusted
        np.testing.assert_allclose([2 * np.pi / low, 2 * np.pi / high], [SIDE / 4, 4 * SIDE / N])

    def test_what_is_drawn_is_what_the_file_holds(self):
        source = self.source()
        (drawn,) = figure.draw(source)
        curves = [item for panel in drawn.figure.panels for item in panel.items if isinstance(item, chart.Curve)]
        self.assertEqual(len(curves), 3)
        for curve, (q, density) in zip(curves, source.sets[0].curves.values()):
            np.testing.assert_allclose(curve.x, q * 1e-6)
            np.testing.assert_allclose(curve.y, density * (1e24 if curve.label == "radial" else 1e18))
        self.assertEqual(len(rows_of(drawn.data[""])), 3 * N // 2)

    def test_treatment_convention_and_window_stand_on_the_page(self):
        scan = [("my scan", "my scan.x3p")]
        source = self.source()
        self.assertEqual(page_spectra.sections(source)["settings"], scan)
        source.file.close()  # it is written anew
        with h5py.File(self.path, "a") as file:
            file["curves"].attrs.update({"convention": "jacobs", "window": "hann", "treatment": ["level=plane", "crop=0,0,9,9"]})
        source = build.open_result(self.path)
        self.addCleanup(source.file.close)
        said = [("treatment", "level=plane, crop=0,0,9,9"), ("convention", "jacobs"), ("window", "hann")]
        self.assertEqual(page_spectra.sections(source)["settings"], said + scan)

    def test_exponents_of_the_file_stand_on_the_page(self):
        write(self.path)
        with h5py.File(self.path, "a") as file:
            for axis, hurst in (("x", 0.78), ("radial", 0.81)):
                file[f"curves/psd_{axis}_{spectra.UNITS[axis]}"].attrs.update({"hurst": hurst, "hurst_standard_error": 0.03})
        source = build.open_result(self.path)
        self.addCleanup(source.file.close)
        rows = dict(page_spectra.sections(source)["answer"]["rows"])
        self.assertEqual(rows["Hurst exponent"], ["0.78 ± 0.03", "–", "0.81 ± 0.03"])
        source.file.close()  # it is written anew
        self.assertNotIn("Hurst exponent", dict(page_spectra.sections(self.source())["answer"]["rows"]))

    def test_one_direction_alone_is_drawn_too(self):
        source = self.source(axes=("y",))
        self.assertEqual(list(source.sets[0].curves), ["y"])
        self.assertEqual(len(next(figure.draw(source)).figure.panels), 1)

    def test_values_that_no_logarithm_has_are_left_out(self):
        source = self.source(power=-400)  # underflows to zero
        self.assertTrue(all((density > 0).all() for _, density in source.sets[0].curves.values()))

    def test_the_page_names_the_scan_and_the_range(self):
        self.source()
        done = run(self.path, "-o", self.path.parent / "page")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        page = (self.path.parent / "page/report.html").read_text(encoding="utf-8")
        for words in ("my scan.x3p", "3.125 µm to 25 µm", "wavelengths to be trusted", "Power spectral density"):
            self.assertIn(words, page)

    def test_scans_and_means_lie_over_each_other(self):
        q = 2 * np.pi / SIDE * np.arange(1, N // 2 + 1)
        with new_file(self.path) as file:
            file.attrs["command"] = "tabor psd a.x3p b.x3p --group all=* -o psd.h5"
            for i, name in enumerate(("a.x3p", "b.x3p")):
                node = file.create_group(f"scans/{i:04}")
                node.attrs["file"] = f"folder/{name}"
                node["q_x_rad_per_m"], node["psd_x_m3"] = q, (i + 1) * 1e-20 * q / q[0]
            node = file.create_group("groups/0000")
            node.attrs["group"], node.attrs["scans"] = "all", ["a.x3p", "b.x3p"]
            node["q_x_rad_per_m"], node["psd_x_m3_mean"] = q, 1.5e-20 * q / q[0]
            node["psd_x_m3_std"] = 0.7e-20 * q / q[0]
        source = build.open_result(self.path)
        self.addCleanup(source.file.close)
        (drawn,) = figure.draw(source)
        (panel,) = drawn.figure.panels
        _, _, mean, band = panel.items[:4]
        self.assertEqual(list(drawn.figure.labelled()), ["a", "b", "all, mean of 2", "range to be trusted"])
        np.testing.assert_allclose(mean.y, 1.5e-2 * q / q[0])
        np.testing.assert_allclose([band.low, band.high], [0.8e-2 * q / q[0], 2.2e-2 * q / q[0]])
        self.assertEqual(len(rows_of(drawn.data[""])), 3 * N // 2)
        done = run(self.path, "-o", self.path.parent / "page")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        page = (self.path.parent / "page/report.html").read_text(encoding="utf-8")
        for words in ("Power spectra of 2 scans", "all, mean of 2", "Of each scan and mean", "<dt>b</dt><dd>folder/b.x3p</dd>"):
            self.assertIn(words, page)

    def test_each_direction_has_a_column_of_exponents(self):
        with new_file(self.path) as file:
            for i, (name, hurst) in enumerate((("new/a.x3p", 0.7), ("old/a.x3p", 0.8))):
                node = file.create_group(f"scans/{i:04}")
                node.attrs["file"] = name
                for axis in ("x", "y"):
                    node[f"q_{axis}_rad_per_m"], node[f"psd_{axis}_m3"] = np.arange(1.0, 9), np.ones(8)
                node["psd_x_m3"].attrs.update({"hurst": hurst, "hurst_standard_error": 0.03})
        source = build.open_result(self.path)
        self.addCleanup(source.file.close)
        answer = page_spectra.sections(source)["answer"]
        self.assertEqual((answer["caption"], answer["header"][0], answer["header"][2:]), ("Of each scan", "points", ["Hurst exponent along x"]))
        self.assertEqual([(name, cells[0], cells[2]) for name, cells in answer["rows"]], [("new/a", "8", "0.70 ± 0.03"), ("old/a", "8", "0.80 ± 0.03")])

    def test_options_of_studies_are_rejected(self):
        self.source()
        self.assertEqual(run(self.path, "--scan", "0").returncode, 2)


if __name__ == "__main__":
    unittest.main()
