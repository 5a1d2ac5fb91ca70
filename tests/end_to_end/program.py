"""The tabor program as the tests of this folder call it."""

import json
import os
import pathlib
import subprocess
import tempfile
import time
import unittest

TABOR = os.environ["TABOR"]
SOURCE = pathlib.Path(__file__).resolve().parents[2]

ALUMINIUM = ["--youngs-modulus", "70GPa", "--poisson-ratio", "0.33"]


class ProgramTest(unittest.TestCase):
    """Each test has an empty folder of its own and works in it."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="tabor-test-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def tabor(self, *words, **options):
        """One finished call; options go to subprocess.run."""
        options.setdefault("timeout", 120)
        return subprocess.run([TABOR, *map(str, words)], cwd=self.folder, text=True,
                              capture_output="stdout" not in options, check=False, **options)

    def start(self, *words):
        return subprocess.Popen([TABOR, *map(str, words)], cwd=self.folder, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True)

    def stop_when(self, ready, stop, process):
        """Sends `stop` as soon as `ready()`; status, output and messages of the ended process."""
        deadline = time.monotonic() + 120
        while not ready():
            self.assertIsNone(process.poll(), "the program ended before it could be stopped")
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.002)
        process.send_signal(stop)
        out, err = process.communicate(timeout=60)
        return process.returncode, out, err

    def json(self, *words):
        done = self.tabor(*words, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def generate(self, name, kind="edt", pixels=64, *words):
        done = self.tabor("generate", kind, "-o", name, "--pixels", pixels, *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.folder / name

    def assert_rejected(self, done, code, *parts):
        """The exit code and one clear line that holds `parts`."""
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertTrue(done.stderr.startswith("tabor: "), done.stderr)
        for part in parts:
            self.assertIn(part, done.stderr)
        self.assertFalse(done.stdout)

    def files(self):
        return sorted(path.name for path in self.folder.iterdir())
