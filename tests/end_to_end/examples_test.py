"""The examples find a python3 that has what their scripts need, whatever comes first on PATH."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"


def modules_of(script):
    """Modules a script imports that Python itself does not bring."""
    names = re.findall(r"^(?:import|from) (\w+)", script.read_text(encoding="utf-8"), re.MULTILINE)
    return {name for name in names if name not in sys.stdlib_module_names}


class ExamplesTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="tabor-test-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        bare = self.folder / "python3"  # without Debian's packages
        bare.write_text('#!/bin/sh\nexec /usr/bin/python3 -I -S "$@"\n', encoding="utf-8")
        bare.chmod(0o755)
        self.environment = {**os.environ, "PATH": f"{self.folder}:/usr/bin:/bin"}
        self.environment.pop("TABOR_PYTHON", None)

    def with_python(self, *words, **variables):
        return subprocess.run([EXAMPLES / "with_python", *words], cwd=self.folder, text=True, check=False,
                              capture_output=True, env={**self.environment, **variables})

    def test_a_python_that_lacks_a_module_is_passed_over(self):
        self.assertNotEqual(subprocess.run([self.folder / "python3", "-c", "import numpy"], check=False,
                                           capture_output=True).returncode, 0)
        done = self.with_python("numpy", "-c", "import numpy, sys; print(sys.argv[1])", "1 2")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "1 2\n", ""))

    def test_the_one_that_is_named_comes_first(self):
        done = self.with_python("json", "-c", "import sys; print(sys.flags.isolated)",
                                TABOR_PYTHON=str(self.folder / "python3"))
        self.assertEqual(done.stdout, "1\n")

    def test_a_module_that_nobody_has_is_named_in_one_line(self):
        done = self.with_python("no_such_module", "script.py")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertIn("no_such_module", done.stderr)

    def test_every_script_is_started_with_what_it_imports(self):
        started = 0
        for run in EXAMPLES.glob("*/run"):
            text = run.read_text(encoding="utf-8")
            for command, module, name in re.findall(r"^(python3|\.\./with_python (\w+)) (\w+\.py)", text,
                                                    re.MULTILINE):
                started += 1
                needed = modules_of(run.parent / name)
                self.assertEqual(needed, {module} if module else set(), f"{run}: {command} {name}")
        self.assertGreater(started, 5)


if __name__ == "__main__":
    unittest.main()
