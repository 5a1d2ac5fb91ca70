"""The page of a file of `tabor combine`."""

import re
import tempfile
import unittest
from pathlib import Path

from report_test import run
from synthetic_single import write_single
from tabor.report import build, hdf

FACTS = {
    "mode": "wear", "rms_height_first_m": 1.1e-6, "rms_height_second_m": 1.06e-6, "rms_height_m": 7.4e-8, "shift_x_m": 2e-7,
    "uncertainty_x_m": 3e-8, "shift_y_m": 0.0, "correlation": 0.9982, "worn_volume_m3": 3.8e-15,
    "worn_uncertainty_m3": 1.7e-17, "net_volume_m3": 2.5e-12, "net_uncertainty_m3": 0.0,
}  # fmt: skip


class Combination(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.path = Path(temporary.name) / "worn.h5"
        write_single(self.path)
        import h5py

        with h5py.File(self.path, "r+") as file:
            del file["states"]
            file["surface"].attrs["source"] = "before/a.x3p - after/b.x3p"
            file.create_group("combination").attrs.update(FACTS)

    def test_the_title_names_both_scans(self):
        source = build.open_result(self.path)
        self.addCleanup(source.file.close)
        self.assertEqual(source.title, "a.x3p \N{MINUS SIGN} b.x3p")
        self.assertEqual(hdf.attributes(source.file["combination"]), source.combination)

    def test_the_page_begins_with_the_volumes(self):
        done = run(self.path, "-o", self.path.parent / "page")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        page = (self.path.parent / "page/report.html").read_text(encoding="utf-8")
        self.assertIn("<h3>a.x3p \N{MINUS SIGN} b.x3p</h3>", page)
        self.assertNotIn("counterface", re.sub("(?s)<script.*?</script>", "", page))
        for words in ("two scans put together", "3800 µm³", "17 µm³", "0.0025 mm³", "200 nm", "0.9982"):
            self.assertIn(words, page)


if __name__ == "__main__":
    unittest.main()
