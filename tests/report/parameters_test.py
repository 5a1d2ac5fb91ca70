"""The page of a table of `tabor params`."""

import math
import os
import statistics
import tempfile
import unittest
from pathlib import Path

from report_test import run
from tabor_report import parameters
from tabor_report.errors import InputError

TABLE = """scan,treatment,failure,N [1],Sa [m],Sq [m],Sdq [1],Vm(p) [m^3/m^2]
scans/a.x3p,level=plane,,262144,8.6e-07,1.07e-06,0.21,3e-08
"scans/b, new.x3p",level=plane,,262144,7.4e-07,0.9e-06,0.19,
scans/c.x3p,,c.x3p: no such file,,,,,
"""


class Parameters(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.path = Path(temporary.name) / "params.csv"

    def table(self, text=TABLE):
        self.path.write_text(text, encoding="utf-8")
        return parameters.load(self.path)

    def test_each_scan_is_a_column_and_one_that_failed_is_a_warning(self):
        found = self.table()
        self.assertEqual(found.scans, ["a.x3p", "b, new.x3p"])
        self.assertEqual(found.values["Sq"], [1.07e-6, 0.9e-6])
        self.assertEqual(found.units["Vm(p)"], "m^3/m^2")
        self.assertTrue(math.isnan(found.values["Vm(p)"][1]))
        self.assertEqual(found.warnings, ["Not measured: c.x3p: no such file"])

    def test_mean_and_deviation_are_those_of_the_scans(self):
        found = self.table()
        mean, deviation = found.mean_and_deviation("Sa")
        self.assertAlmostEqual(mean, statistics.mean([8.6e-7, 7.4e-7]), delta=1e-20)
        self.assertAlmostEqual(deviation, statistics.stdev([8.6e-7, 7.4e-7]), delta=1e-20)
        self.assertTrue(math.isnan(found.mean_and_deviation("Vm(p)")[1]))

    def test_the_page_shows_them_with_units(self):
        self.table()
        done = run(self.path)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        page = self.path.with_name("params_report").joinpath("report.html").read_text(encoding="utf-8")
        for words in ("860 nm", "1.07 µm", "b, new.x3p", "mean ± std", "800 ± 85 nm", "m³/m²", "c.x3p: no such file"):
            self.assertIn(words, page)

    def test_what_is_no_such_table_is_rejected_in_one_line(self):
        for text in ("", "a,b\n1,2\n", TABLE + "one,two\n", TABLE.replace("8.6e-07", "many"), TABLE + '"open'):
            with self.assertRaises(InputError, msg=text) as caught:
                self.table(text)
            self.assertEqual(len(str(caught.exception).splitlines()), 1)

    def test_a_pipe_is_rejected_and_not_waited_for(self):
        os.mkfifo(self.path)
        self.assertEqual(run(self.path).returncode, 3)

    def test_an_absent_table_is_rejected(self):
        self.assertEqual(run(self.path).returncode, 3)


if __name__ == "__main__":
    unittest.main()
