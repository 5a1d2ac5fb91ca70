"""Every benchmark of tools/bench runs, at a size that takes a second, and prints the rows it is for."""

import json
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import unittest

BUILD = pathlib.Path(os.environ["TABOR_BUILD"])
BENCH = pathlib.Path(__file__).resolve().parents[2] / "tools/bench"


class Benchmark(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="tabor-bench-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_command(self, *words):
        return subprocess.run([sys.executable, *map(str, words)], cwd=self.folder, capture_output=True, text=True, check=False,
                              timeout=240, env={**os.environ, "TMPDIR": str(self.folder)})

    def output(self, *words):
        done = self.run_command(BENCH / words[0], *words[1:])
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def rows(self, first_cell, *words):
        """Cells of the lines that begin with this cell."""
        cells = [re.sub(r"[|]", " ", line).split() for line in self.output(*words).splitlines()]
        return [row for row in cells if row[:1] == [first_cell]]


class Solvers(Benchmark):
    def test_contact(self):
        rows = self.rows("edt", "contact", 32, "--baseline")
        self.assertEqual({row[2] for row in rows}, {"fast", "polonsky-keer"})
        self.assertEqual({row[-5] for row in rows}, {"yes"})

    def test_growth(self):
        rows = self.rows("32", "growth", 32, 64)
        self.assertEqual(len(rows), 2)  # two surfaces
        self.assertEqual(len(self.rows("exponent", "growth", 32, 64)), 2)

    def test_deposition(self):
        rows = self.rows("16", "deposition", 16)
        self.assertLessEqual({"limit", "droplets", "naive"}, {word for row in rows for word in row})

    def test_processors(self):
        rows = self.rows("friction", "processors", BUILD / "tools/tabor", BUILD / "tools/tabor", 64, "turns=1")
        self.assertEqual((len(rows), len(rows[0])), (1, 1 + 2 + 2 * 3), rows)  # name, "s", and twice "s (ratio)"

    def test_report_page(self):
        rows = self.rows("--static", "report_page", BUILD / "tools/tabor", 32, "turns=1", "pressures=5MPa", f"json={self.folder / 'rows.json'}")
        self.assertEqual((len(rows), rows[0][-1]), (1, "1"))  # a page alone
        found = json.loads((self.folder / "rows.json").read_text("utf-8"))
        self.assertEqual([row["page"] for row in found], ["interactive", "--static"])

    def test_fluid(self):
        rows = self.rows("16", "fluid", 16)
        self.assertEqual(len(rows), 1)
        self.assertGreater(float(rows[0][1]), 0)

    def test_impact(self):
        rows = self.rows("1", "impact", 60, "--baseline")
        self.assertEqual([row[1] for row in rows], ["kept", "plain"])
        self.assertEqual(rows[0][-1], rows[1][-1])  # one restitution, whichever way

    def test_line(self):
        rows = self.rows("100", "line", 100)
        self.assertEqual([row[1] for row in rows], ["plain", "tabor"])
        self.assertEqual(rows[0][2], rows[1][2])  # one film, whichever way

    def test_point(self):
        rows = self.rows("33", "point", 33)
        self.assertEqual([row[2] for row in rows], ["plain", "tabor", "tabor"])
        self.assertEqual(len({row[4] for row in rows}), 1)  # one film, whichever way and on any number of threads

    def test_stribeck(self):
        output = self.output("stribeck", "--tiny")
        for part in ("lapped-like", "polished-like", "longitudinal", "transverse", "bump of 500 nm"):
            self.assertIn(part, output)


class WholeRuns(Benchmark):
    def test_reading(self):
        output = self.output("reading", 64)
        for extension in (".sdf", ".npy", ".gsf", ".h5", ".x3p", ".txt"):
            self.assertIn(f"| {extension} |", output)
        self.assertNotIn("differs", output)

    def test_study(self):
        output = self.output("study", BUILD / "tools/tabor", "--pixels", 64, "--folder", self.folder / "study")
        record = json.loads(output[output.index("{\n"):])
        self.assertEqual((record["rows"], record["converged"]), (56, 56))


    @unittest.skipUnless((BUILD / "python/tabor/__init__.py").exists(), "the Python package is not built")
    def test_python_overhead(self):
        try:
            import numpy  # noqa: F401  # of the interpreter that the package is built for
        except ImportError:
            self.skipTest("no NumPy")
        output = self.output("python_overhead", 16, "rounds=1")
        for call in ("level", "psd", "rain", "contact"):
            self.assertIn(f"| {call} | 16 x 16 |", output)
        self.assertIn("tb.contact MB", output)


class Peers(Benchmark):
    """Those that are not installed are left out, which the run says."""

    TOOLS = ("tabor", "ASPHER", "Tamaas", "ContactMechanics", "slippy")

    def present(self, tool):
        return tool == "tabor" or (BUILD / f"peers/{'slippy' if tool == 'slippy' else 'main'}/bin/python").is_file()

    def compare(self, *words):
        done = self.run_command(BENCH / "peers/compare.py", "--build", BUILD, "--scans", self.folder, *words)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return [[cell.strip() for cell in line.strip("|").split("|")] for line in done.stdout.splitlines()[2:]], done.stderr

    def test_all_cases_of_tabor_meet_the_target(self):
        rows, _ = self.compare("--sizes", 64, "--tools", "tabor")
        self.assertEqual(len(rows), 3 * 6)  # surfaces, cases
        for row in rows:
            self.assertLessEqual(float(row[5]), 1e-6, row)
            self.assertLess(abs(float(row[6])), 1e-2, row)

    def test_installed_peers_find_the_same_area(self):
        rows, messages = self.compare("--sizes", 64, "--cases", "10 %", "--surface", "EDT-like")
        self.assertEqual({row[0] for row in rows}, {tool for tool in self.TOOLS if self.present(tool)})
        for tool in self.TOOLS:
            self.assertEqual(f"skipped: {tool} " in messages, not self.present(tool), messages)
        for row in rows:
            self.assertLess(abs(float(row[6])), 1e-2, row)


class Tutorials(Benchmark):
    """Those of packages that are not installed are left out, which the run says."""

    NAMES = ("rough", "saturated", "paraboloid", "waves", "sphere", "cone")
    PYTHON = BUILD / "peers/main/bin/python"

    def tutorials(self, python, *words):
        return subprocess.run([python, BENCH / "peers/tutorials.py", "--build", BUILD, *words], cwd=self.folder, capture_output=True, text=True,
                              check=False, timeout=240, env={**os.environ, "TMPDIR": str(self.folder)})

    @unittest.skipUnless(PYTHON.is_file(), "no other packages, tools/bench/peers/run installs them")
    @unittest.skipUnless((BUILD / "python/tabor/__init__.py").exists(), "the Python package is not built")
    def test_both_packages_agree(self):
        done = self.tutorials(self.PYTHON, "--repeats", "1", "sphere", "paraboloid")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in done.stdout.splitlines()[2:]]
        self.assertEqual(len(rows) / 2 + done.stderr.count("skipped: "), 2, done.stderr)
        for theirs, ours in zip(rows[::2], rows[1::2]):
            self.assertGreater(int(theirs[2]), int(ours[2]))
            self.assertEqual(theirs[5], "the same")
            self.assertLess(float(theirs[8]), 1e-4)

    def test_pieces_stand_alone(self):
        for name in self.NAMES:
            text = (BENCH / f"peers/tutorials/{name}.py").read_text("utf-8")
            headings = re.findall(r"(?m)^# --- (.*)$", text)
            self.assertEqual((len(headings), headings[2]), (3, "tabor"))
            self.assertLessEqual(max(map(len, text[text.index("# ---"):].splitlines())), 70)  # two stand side by side on a page
            compile(text, name, "exec")


class Certify(Benchmark):
    """Pressures go in and out as they are, whatever their size, and what is no field is rejected in one line."""

    def npy(self, name, values, rows, columns, form="<f8"):
        header = f"{{'descr': '{form}', 'fortran_order': False, 'shape': ({rows}, {columns}), }}".ljust(117) + "\n"
        data = struct.pack(f"<{len(values)}d", *values)
        path = self.folder / name
        path.write_bytes(b"\x93NUMPY\x01\0" + struct.pack("<H", len(header)) + header.encode() + data)
        return path

    def certify(self, *words):
        return subprocess.run([BUILD / "tools/bench/bench_certify", *map(str, words)], capture_output=True, text=True, check=False,
                              timeout=60)

    def check(self, pressure, heights=(0.0,) * 16, mean="2e9"):
        return self.certify("check", self.npy("z.npy", heights, 4, 4), pressure, "1e-6", "1e11", mean, "inf")

    def test_takes_pressures_that_no_height_could_be(self):
        done = self.check(self.npy("p.npy", [1e9] * 8 + [3e9] * 8, 4, 4))
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stdout)
        self.assertEqual(found["contact_area"], 1)
        self.assertEqual(found["highest_pressure_Pa"], 3e9)
        self.assertEqual(found["load_error"], 0)

    def test_gives_back_the_uniform_pressure_of_a_flat(self):
        flat = self.npy("z.npy", [0.0] * 16, 4, 4)
        done = self.certify("solve", flat, self.folder / "p.npy", "1e-6", "1e11", "2e9", "inf", "1e-9")
        self.assertEqual(done.returncode, 0, done.stderr)
        written = (self.folder / "p.npy").read_bytes()
        self.assertEqual(written, self.npy("expected.npy", [2e9] * 16, 4, 4).read_bytes())

    def test_rejects_what_is_no_field(self):
        bad = {"nan.npy": ([float("nan")] * 16, 4, 4), "short.npy": ([1e9] * 15, 4, 4), "shape.npy": ([1e9] * 8, 2, 4),
               "type.npy": ([1e9] * 16, 4, 4, "<i8")}
        for name, array in bad.items():
            done = self.check(self.npy(name, *array))
            self.assertEqual(done.returncode, 1, name)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            self.assertIn(name, done.stderr)


if __name__ == "__main__":
    unittest.main()
