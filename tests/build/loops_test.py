"""tools/check/loops finds what it is there to find: each test plants one loop in a small source."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

CHECK = pathlib.Path(__file__).resolve().parents[2] / "tools/check/loops"


def run_check(text, folder="contact"):
    with tempfile.TemporaryDirectory() as place:
        root = pathlib.Path(place)
        (root / "src/tabor" / folder).mkdir(parents=True)
        (root / "src/tabor" / folder / "a.cpp").write_text("// A source.\n" + text)
        return subprocess.run([sys.executable, CHECK, "--root", root], capture_output=True, text=True, check=False)


class Loops(unittest.TestCase):
    def assert_rejected(self, text):
        result = run_check(text)
        self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
        self.assertIn("src/tabor/contact/a.cpp:2: ", result.stdout)
        self.assertEqual(len(result.stdout.splitlines()), 1)

    def assert_accepted(self, text, folder="contact"):
        result = run_check(text, folder)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def test_loop_over_the_pixels_of_a_map(self):
        self.assert_rejected("for (Index i = 0; i < map.size(); ++i) map(i) = 0;\n")

    def test_loop_over_rows(self):
        self.assert_rejected("  for (Index y = 0; y < height.rows(); ++y) {\n")

    def test_loop_over_a_block(self):
        self.assert_rejected("for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k) {\n")

    def test_loop_over_a_grid(self):
        self.assert_rejected("for (Index x = 0; x < grid.nx; ++x) {\n")

    def test_loop_whose_head_is_long(self):
        self.assert_rejected("for (std::size_t k = place_of(set, begin);\n     k < set.size(); ++k) {\n")

    def test_reason_must_be_given(self):
        self.assert_rejected("for (Index i = 0; i < n; ++i) {  // raw loop:\n")
        self.assert_accepted("for (Index i = 0; i < n; ++i) {  // raw loop: joins depend on those before\n")

    def test_primitives_and_iterations_are_no_such_loops(self):
        self.assert_accepted("for_each(map.size(), [=](Index i) { values[i] = 0; });\n")
        self.assert_accepted("for (int step = 0; step < most_steps; ++step) {\n")
        self.assert_accepted("for (const double pressure : pressures) add(pressure);\n")

    def test_other_modules_are_not_looked_at(self):
        self.assert_accepted("for (Index i = 0; i < map.size(); ++i) map(i) = 0;\n", "scan")


if __name__ == "__main__":
    unittest.main()
