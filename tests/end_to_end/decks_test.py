"""The decks of `tabor table`, read by programs of others where these are installed: ansys-dyna-core
(PyPI) reads those for LS-DYNA. TABOR=PROGRAM PYTHON decks_test.py runs it with another interpreter."""

import csv
import io
import unittest

from program import SOURCE, ProgramTest

try:
    from ansys.dyna.core import Deck
except ImportError:
    Deck = None

OPTIONS = ("--units", "mm,s,t", "--group", "before")
EVERY_POINT = 1e-9  # decks have ten digits


class DecksTest(ProgramTest):
    def setUp(self):
        super().setUp()
        done = self.tabor("sweep", SOURCE / "examples/06_study/study.toml", "-o", "results")
        self.assertEqual(done.returncode, 0, done.stderr)

    def table(self, program):
        done = self.tabor("table", "results", "--for", program, *OPTIONS)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def averages(self):
        """(pressure in MPa, density in t/mm^2, friction) of the means that averages.csv does not name as left out."""
        with open(self.folder / "results/averages.csv", encoding="utf-8") as file:
            return [(float(row["mean_pressure_Pa"]) * 1e-6, float(row["lubricant_density_g_per_m2"]) * 1e-12,
                     float(row["friction_lubricated_mean"]))
                    for row in csv.DictReader(file) if row["group"] == "before" and not row["left_out"]]

    def assert_same(self, numbers, expected):
        self.assertEqual(len(numbers), len(expected))
        for number, wanted in zip(sorted(numbers), sorted(expected)):
            for value, other in zip(number, wanted):
                self.assertAlmostEqual(value, other, delta=EVERY_POINT * abs(other))

    def test_csv_holds_the_averages(self):
        lines = [line for line in self.table("csv").splitlines() if not line.startswith("#")]
        rows = list(csv.DictReader(io.StringIO("\n".join(lines))))
        self.assert_same([(float(row["mean_pressure_MPa"]), float(row["lubricant_density_t_per_mm2"]),
                           float(row["friction_coefficient"])) for row in rows], self.averages())

    @unittest.skipIf(Deck is None, "needs ansys-dyna-core (PyPI)")
    def test_lsdyna_deck_is_read_by_ansys_dyna_core(self):
        deck = Deck()
        result = deck.loads(self.table("lsdyna"))
        self.assertEqual(deck.string_keywords, [], "keywords that were not understood")
        self.assertFalse(result is not None and result.get_summary(), result and result.get_summary())
        keywords = list(deck.keywords)
        self.assertEqual(sorted({f"{one.keyword}_{one.subkeyword}" for one in keywords}),
                         ["DEFINE_CURVE", "DEFINE_TABLE"])
        densities = sorted({density for _, density, _ in self.averages()})
        numbers = []
        for density in densities:
            table = keywords.pop(0)
            self.assertEqual(table.subkeyword, "TABLE")
            for pressure in list(table.points):
                curve = keywords.pop(0)
                self.assertEqual(curve.subkeyword, "CURVE")
                points = curve.curves.to_numpy()
                self.assertEqual(points.shape, (2, 2))
                self.assertEqual(points[0, 0], 0)
                self.assertEqual(points[0, 1], points[1, 1])
                numbers.append((pressure, density, points[0, 1]))
        self.assertEqual(keywords, [])
        self.assert_same(numbers, self.averages())


if __name__ == "__main__":
    unittest.main()
