"""tools/check/mutate makes the mistakes it says, notices who notices, and changes no source."""

import importlib.machinery
import importlib.util
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "tools/check/mutate"


def load():
    loader = importlib.machinery.SourceFileLoader("mutate", str(SCRIPT))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("mutate", loader))
    sys.modules["mutate"] = module  # for its dataclasses
    loader.exec_module(module)
    return module


MUTATE = load()


def after(line, head="void f() {\n"):
    """What a line of a function can become."""
    return {change.after for change in MUTATE.changes_of("f.cpp", f"{head}  {line}\n}}\n") if change.before == line}


class Changes(unittest.TestCase):
    def test_swap_operators_between_two_terms(self):
        self.assertEqual(after("x = a * b;"), {"x = a / b;"})
        self.assertEqual(after("x -= a - b;"), {"x += a - b;", "x -= a + b;"})
        self.assertEqual(after("if (a <= b && !c) {"), {"if (a < b && !c) {", "if (a > b && !c) {", "if (a <= b || !c) {", "if (a <= b && c) {"})
        self.assertEqual(after("x = std::min(a, 0);"), {"x = std::max(a, 0);", "x = std::min(a, 1);"})

    def test_leave_pointers_references_and_templates_alone(self):
        for line in ("double* p = &x;", "Film&& film = make();", "std::vector<double> v;", "p->x = *q;", "x = -a;"):
            self.assertEqual(after(line), set(), line)

    def test_leave_words_and_rejections_alone(self):
        for line in ("// a + b", "x = name(\"a + b 1\");", "call();  // 1 + 1",
                     "throw InputError(\"a\", format(a + 1), \"b\");", "c = ' ';"):
            self.assertEqual(after(line), set(), line)

    def test_negate_numbers_that_are_returned_only(self):
        self.assertEqual(after("return a;", "double f() {\n"), {"return -(a);"})
        self.assertEqual(after("return a;", "bool f() {\n"), set())

    def test_know_the_function(self):
        text = "int k = 1;\nint f(int a) {\n  g(a,\n    a + 2);\n}\nconstexpr int h = 1;\n"
        self.assertEqual({(change.function, change.number) for change in MUTATE.changes_of("f.cpp", text)},
                         {("at the top", 1), ("f", 4), ("at the top", 6)})


SOURCE = """int plus(int a, int b) {
  return a + b;
}

int zeros(int n) {
  int count = 0;
  while (n > 0 && count < 20) {
    n = n / 10, ++count;
  }
  return count;
}

int unseen(int a) {
  return a == 3 ? 7 : 4;
}

int twice(int a) { return plus(a, a) * 1; }
"""
TEST = """int plus(int, int);
int zeros(int);
int unseen(int);
int twice(int);
int main() { return plus(2, 5) == 7 && zeros(100) == 3 && twice(0) == 0 ? 0 : 1; }
"""
LISTS = """cmake_minimum_required(VERSION 3.25)
project(p CXX)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_CXX_FLAGS -O1)
add_library(sums STATIC sums.cpp)
add_executable(test_sums test.cpp)
target_link_libraries(test_sums sums)
"""
EQUIVALENT = """# a comment
sums.cpp: zeros
- while (n > 0 && count < 20) {
+ while (n > 0 && count <= 20) {
= no int has so many digits

sums.cpp: zeros
- while (n > 0 && count < 30) {
+ while (n > 0 && count <= 30) {
= of a line that is no longer there
"""


class Run(unittest.TestCase):
    """On a project of one source and one test."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="tabor-mutate-")
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        (self.root / "tools/check").mkdir(parents=True)
        for name, text in {"sums.cpp": SOURCE, "test.cpp": TEST, "CMakeLists.txt": LISTS,
                           "tools/check/mutate_equivalent.txt": EQUIVALENT}.items():
            (self.root / name).write_text(text)
        build = self.root / "build/release"
        subprocess.run(["cmake", "-S", self.root, "-B", build, "-G", "Ninja"], check=True, capture_output=True)

    def run_script(self, *words):
        code = f"""
import importlib.machinery, importlib.util, pathlib, sys
loader = importlib.machinery.SourceFileLoader("mutate", {str(SCRIPT)!r})
mutate = importlib.util.module_from_spec(importlib.util.spec_from_loader("mutate", loader))
sys.modules["mutate"] = mutate
loader.exec_module(mutate)
sys.exit(mutate.main({list(words)!r}, {{"sums": mutate.Module(("sums.cpp",), ("test_sums",))}}, pathlib.Path({str(self.root)!r})))
"""
        environment = {key: value for key, value in os.environ.items() if key != "TABOR_BUILD"}
        return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, env=environment, timeout=240)

    def kinds(self, done):
        """Of every line that was changed: what became of it, and the kind of outcome."""
        lines = [line.split(maxsplit=2) for line in done.stdout.splitlines() if line.split(" ")[0] in ("caught", "survived", "same", "broken")]
        return [(kind, place.rpartition(":")[2], rest) for kind, place, rest in lines]

    def test_tells_caught_from_survived_and_leaves_the_sources_alone(self):
        done = self.run_script("--seconds", "200")
        found = self.kinds(done)
        self.assertIn(("caught", "2"), {(kind, line) for kind, line, _ in found}, done.stdout + done.stderr)
        self.assertEqual({kind for kind, line, _ in found if line == "14"}, {"survived"})  # nothing calls unseen()
        self.assertIn("survived sums.cpp:14  return a != 3 ? 7 : 4;", done.stdout)
        self.assertIn(("survived", "7"), {(kind, line) for kind, line, rest in found if "count <= 20" in rest})
        self.assertNotIn("+ while (n > 0 && count <= 20) {", done.stdout)  # listed as equivalent
        self.assertEqual(done.returncode, 0 if self.share(done) >= 90 else 1)
        self.assertIn("- return a == 3 ? 7 : 4;\n+ return a != 3 ? 7 : 4;", done.stdout)
        self.assertIn("no longer possible: while (n > 0 && count <= 30) {", done.stderr)
        self.assertEqual((self.root / "sums.cpp").read_text(), SOURCE)

    def share(self, done):
        return float(next(line for line in done.stdout.splitlines() if line.startswith("| all |")).split("|")[-2].strip(" %"))

    def test_takes_a_hang_for_noticed(self):
        shop = MUTATE.Workshop.__new__(MUTATE.Workshop)
        sleeper = self.root / "sleeper"
        sleeper.write_text("#!/bin/sh\nexec sleep 100\n")
        sleeper.chmod(0o755)
        self.assertEqual(shop.run_test(sleeper, 0.3), "a hang")

    def test_draws_the_same_changes_for_the_same_seed_and_records_a_table(self):
        page = self.root / "page.md"
        page.write_text("# Page\n\nbefore\n")
        first = self.run_script("--count", "3", "--jobs", "1", "--seed", "4", "--record", str(page))
        second = self.run_script("--count", "3", "--jobs", "1", "--seed", "4", "--record", str(page))
        places = [(line, rest.rpartition("(")[0]) for _, line, rest in self.kinds(first)]
        self.assertEqual(len(places), 3, first.stdout + first.stderr)
        self.assertEqual(places, [(line, rest.rpartition("(")[0]) for _, line, rest in self.kinds(second)])
        text = page.read_text()
        self.assertTrue(text.startswith("# Page\n\nbefore\n\n## Deliberate mistakes\n\n<!-- mutation:begin -->"))
        self.assertEqual(text.count("| sums | "), 1)
        self.assertEqual(text.count("## Deliberate mistakes"), 1)


class Equivalents(unittest.TestCase):
    def test_of_the_project_can_be_read_and_have_reasons(self):
        known = MUTATE.read_equivalent(SCRIPT.with_name("mutate_equivalent.txt"))
        self.assertTrue(all(reason.strip() for reason in known.values()))


if __name__ == "__main__":
    unittest.main()
