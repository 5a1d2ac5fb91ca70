"""The page of a table of `tabor params`."""

import math
import os
import statistics
import tempfile
import unittest
from pathlib import Path

from report_test import run
from tabor.report import parameters
from tabor.report.errors import InputError

TABLE = """scan,treatment,failure,N [1],Sa [m],Sq [m],Sdq [1],Vm(p) [m^3/m^2]
scans/a.x3p,level=plane,,262144,8.6e-07,1.07e-06,0.21,3e-08
"scans/b, new.x3p",level=plane,,262144,7.4e-07,0.9e-06,0.19,
scans/c.x3p,,c.x3p: no such file,,,,,
"""
GROUPS = """group,parameter,unit,n,mean,std,sem,a_1.x3p,a_2.x3p,b.x3p
new,Sq,m,2,3e-07,1.4142135623730951e-07,1e-07,2e-07,4e-07,
new,Sku,1,2,3,1,0.7,2.3,3.7,
'-worn,Sq,m,1,8e-07,,,,,8e-07
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
        self.assertEqual(found.scans, ["a", "b, new"])
        self.assertEqual(found.files, ["scans/a.x3p", "scans/b, new.x3p"])
        self.assertEqual(found.values["Sq"], [1.07e-6, 0.9e-6])
        self.assertEqual(found.units["Vm(p)"], "m^3/m^2")
        self.assertTrue(math.isnan(found.values["Vm(p)"][1]))
        self.assertEqual(found.warnings, ["Not measured: c.x3p: no such file"])

    def test_mean_and_deviation_are_those_of_the_scans(self):
        (everything,) = self.table().groups
        found = everything.means["Sa"]
        self.assertEqual(found.n, 2)
        self.assertAlmostEqual(found.mean, statistics.mean([8.6e-7, 7.4e-7]), delta=1e-20)
        self.assertAlmostEqual(found.deviation, statistics.stdev([8.6e-7, 7.4e-7]), delta=1e-20)
        self.assertTrue(math.isnan(everything.means["Vm(p)"].deviation))

    def test_a_group_has_its_scans_and_means(self):
        found = self.table(GROUPS)
        new, worn = found.groups
        self.assertEqual([(new.name, new.places), (worn.name, worn.places)], [("new", [0, 1]), ("-worn", [2])])
        self.assertEqual(new.means["Sq"], parameters.Mean(2, 3e-7, 1.4142135623730951e-7))
        self.assertTrue(math.isnan(worn.means["Sq"].deviation))
        self.assertEqual(found.values["Sq"], [2e-7, 4e-7, 8e-7])
        self.assertTrue(math.isnan(found.values["Sku"][2]))

    def page(self, *options):
        done = run(self.path, *options)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return self.path.with_name("params_report").joinpath("report.html").read_text(encoding="utf-8")

    def test_the_page_shows_them_with_units(self):
        self.table()
        page = self.page()
        for words in ("Sa (nm)", ">860<", "Sq (µm)", "1.07", "b, new.x3p", "mean ± std", "800 ± 85", "nm³/nm²", "c.x3p: no such file"):
            self.assertIn(words, page)
        self.assertIn(">262\N{NARROW NO-BREAK SPACE}144<", page)
        self.assertIn("<dt>a</dt><dd>scans/a.x3p</dd>", page)
        self.assertNotIn("unknown", page[page.index('id="cite"') :])

    def test_the_page_of_groups_has_a_figure_and_the_scans_beside_their_mean(self):
        self.table(GROUPS)
        page = self.page("--static", "--figures", "svg")
        for words in ("3 scans, 2 groups", "new, mean ± std", "-worn, mean ± std", "300 ± 140", ">800<", "Roughness parameters of the groups"):
            self.assertIn(words, page)
        order = [page.index(f">{name}</th>", page.index('id="results"')) for name in ("a_1", "a_2", "new, mean ± std", "b")]
        self.assertEqual(order, sorted(order))
        table = self.path.with_name("params_report").joinpath("figures/parameters.csv").read_text(encoding="utf-8")
        self.assertIn("'-worn,Sq,m,1,", table)

    def test_a_mean_never_stands_apart_from_its_scans(self):
        names = [f"s{number}.x3p" for number in range(6)]
        self.table(f"group,parameter,unit,n,mean,std,sem,{','.join(names)}\nall,Sq,m,6,1e-6,0,0" + 6 * ",1e-6" + "\n")
        results = self.page("--static").split('id="results"')[1]
        self.assertEqual(results.count("<table"), 1)

    def test_what_is_no_such_table_is_rejected_in_one_line(self):
        for text in ("", "a,b\n1,2\n", TABLE + "one,two\n", TABLE.replace("8.6e-07", "many"), TABLE + '"open', GROUPS.replace("8e-07", "many"), GROUPS.replace(",2,3e-07", ",,3e-07")):
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
