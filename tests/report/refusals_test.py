"""Numbers that `tabor table` leaves out: the page marks those, and no others."""

import json
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

import synthetic_study
from report_test import run
from synthetic_single import write_single
from synthetic_study import Recipe
from tabor.report import build, refusals

PROGRAM = os.environ.get("TABOR")
# Of a file of one scan: (pressure, density) of each state, its codes, and whether it converged.
STATES = {
    (2e6, 0.45): ("clamp spill-over", True),
    (2e6, 0.9): ("clamp frictionless", True),
    (2e6, 3.0): ("frictionless flood", True),
    (5e6, 0.45): ("", False),
    (5e6, 0.9): ("implausible-friction", True),
    (5e6, 3.0): ("fluid-film flooded", True),
}
STRING = h5py.string_dtype()


def one_scan(path):
    pressures, densities = ([*dict.fromkeys(key[place] for key in STATES)] for place in (0, 1))
    write_single(path, Recipe(shape=(20, 24), pressures=tuple(pressures), densities=tuple(densities)))
    with h5py.File(path, "a") as file:
        for state, (codes, converged) in zip(file["states"].values(), STATES.values()):
            state.attrs["warning_codes"] = np.array(codes.split(), dtype=STRING)
            state.attrs["converged"] = int(converged)


def study(folder, codes, not_converged=(), failed=()):
    """codes: {(scan, pressure): codes of its rows}; failed: places of rows."""
    recipe = Recipe(groups=("a", "a", "b"), pressures=(2e6, 5e6, 9e6), densities=(0.45, 0.9), shape=(24, 32), not_converged=not_converged)
    rows = synthetic_study.write(folder, recipe)
    with h5py.File(Path(folder) / "results.h5", "a") as file:
        table = file["table"]
        table["warning_codes"] = np.array([codes.get((row["scan"], row["mean_pressure_Pa"]), "") for row in rows], dtype=STRING)
        table["error"] = np.array(["no load" if place in failed else "" for place in range(len(rows))], dtype=STRING)
        converged = table["converged"][()].astype(int)
        del table["converged"]
        table["converged"] = converged
    return rows


CODES = {("before_1.x3p", 2e6): "frictionless", ("before_2.x3p", 5e6): "flood clamp", ("before_1.x3p", 9e6): "resolution", ("before_3.x3p", 9e6): "implausible-friction"}


@unittest.skipUnless(PROGRAM, "TABOR names no program")
class AsTheProgram(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def table(self, result, *words):
        return subprocess.run([PROGRAM, "table", result, "--for", "csv", "--units", "m,s,kg", "-o", self.folder / "table.csv", *words],
                              capture_output=True, text=True, timeout=60)

    def left_out(self, result, *words):
        """{(pressure, density): code} of numbers without a mean."""
        done = self.table(result, "--json", *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        found = [one for one in json.loads(done.stdout)["left_out"] if one["whole"]]
        return {(one["mean_pressure_Pa"], round(one["lubricant_density_g_per_m2"], 9)): one["code"] for one in found}

    def test_the_codes_are_those_of_the_program_in_their_order(self):
        one_scan(self.folder / "one.h5")
        said = self.table(self.folder / "one.h5", "--keep", "nothing").stderr
        self.assertEqual(said.strip().split("expected ")[1].split(", "), list(refusals.CODES))

    def test_states_of_one_scan(self):
        one_scan(self.folder / "one.h5")
        reasons = refusals.of_rows([{"mean_pressure_Pa": p, "lubricant_density_g_per_m2": d, "warning_codes": codes, "converged": sure, "friction_dry": 0.3, "friction_lubricated": 0.2}
                                    for (p, d), (codes, sure) in STATES.items()])  # fmt: skip
        expected = {key: one[refusals.LUBRICATED] for key, one in zip(STATES, reasons) if refusals.LUBRICATED in one}
        self.assertEqual(self.left_out(self.folder / "one.h5"), expected)
        self.assertEqual(set(expected.values()), set(refusals.CODES) - set(refusals.OF_FLOW))
        dry = {(p, 0.0): one[refusals.DRY] for (p, _), one in zip(STATES, reasons) if refusals.DRY in one}
        self.assertEqual(self.left_out(self.folder / "one.h5", "--density", "0g/m^2"), dry)
        self.assertEqual(dry, {(5e6, 0.0): "implausible-friction"})

    def test_means_of_a_study(self):
        study(self.folder / "study", CODES, not_converged=((0, 1), (2, 0)), failed=(3,))
        source = build.open_result(self.folder / "study")
        self.addCleanup(source.file.close)
        means = refusals.of_means(source.table.rows())
        for group in "ab":
            for key, words in ((refusals.LUBRICATED, ()), (refusals.DRY, ("--density", "0g/m^2"))):
                here = {place: reasons for place, reasons in means.items() if place[0] == group and key in reasons}
                expected = {(place[1], 0.0 if words else place[2]): reasons[key] for place, reasons in here.items()}
                self.assertEqual(self.left_out(self.folder / "study", "--group", group, *words), expected, (group, key))


class OnThePage(unittest.TestCase):
    def page(self, make):
        with tempfile.TemporaryDirectory() as temporary:
            result = Path(temporary) / "result"
            make(result)
            done = run(result, "-o", Path(temporary) / "page", "--static")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            return (Path(temporary) / "page/report.html").read_text(encoding="utf-8")

    @staticmethod
    def rows(page, begin):
        """{first cell: the others} of the table behind `begin`, of several rows of one name the last."""
        table = page[page.index(begin) : page.index("</table>", page.index(begin))]
        rows = [re.findall(r"<t[dh][^>]*>([^<]*)</t", row) for row in re.findall(r"<tr.*?</tr>", table, re.S)]
        return {row[0]: [cell.replace("\N{NO-BREAK SPACE}", " ") for cell in row[1:]] for row in rows}

    def test_states_have_the_sign_of_their_reason_and_a_line_below_says_it(self):
        page = self.page(one_scan)
        answer = self.rows(page, '<table class="answer">')
        signs = {name: [cell[-1] if cell[-1] in "†‡§¶‖" else "" for cell in cells] for name, cells in answer.items() if name.startswith("friction")}
        self.assertEqual(signs, {"friction dry": ["", "‖"], "friction, 0.45 g/m²": ["", "†"], "friction, 0.9 g/m²": ["§", "‖"], "friction, 3 g/m²": ["‡", "¶"]})
        for sign, code in zip("†‡§¶‖", ("not-converged", "flood", "frictionless", "flooded", "implausible-friction")):
            self.assertIn(f"{sign} <code>tabor table</code> leaves out this number: {code}.", page)
        results = self.rows(page, '<section id="results">')
        self.assertEqual([cell[-1] for cell in results["friction wet"]], [results["friction wet"][0][-1], "§", "‡", "†", "‖", "¶"])

    def test_rows_and_means_of_a_study(self):
        page = self.page(lambda folder: study(folder, CODES))
        averages = page[page.index('<section id="averages">') : page.index('<section id="results">')]
        marked = [re.findall(r"<td[^>]*>([^<]*)</td>", row) for row in re.findall(r"<tr>.*?</tr>", averages, re.S)]
        marked = [(row[0], row[1], row[2], [cell[-1] for cell in row if cell[-1] in "†‡§"]) for row in marked if row]
        self.assertEqual(
            [row for row in marked if row[3]],
            [(group, pressure, density, signs)
             for group, pressure, signs in (("a", "2", ["‡"]), ("a", "5", ["†"]), ("b", "9", ["§", "§"])) for density in ("0.45", "0.9")],
        )  # fmt: skip
        self.assertIn("† <code>tabor table</code> leaves out this number: flood. ‡", averages)
        answer = self.rows(page, '<table class="answer">')
        self.assertTrue(answer["friction, 0.9 g/m² (a)"][0].endswith("‡"))
        self.assertFalse(answer["friction dry (a)"][0].endswith("‡"))

    def test_a_page_without_such_numbers_says_nothing(self):
        page = self.page(lambda folder: study(folder, {("before_1.x3p", 2e6): "clamp resolution"}))
        self.assertNotIn("leaves out", page)


if __name__ == "__main__":
    unittest.main()
