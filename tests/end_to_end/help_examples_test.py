"""The examples that --help shows work as they stand, in the project's folder."""

import os
import pathlib
import shlex
import shutil
import unittest

from program import ALUMINIUM, SOURCE, ProgramTest

VERBS = ["info", "convert", "params", "psd", "combine", "generate", "contact", "lubricate", "friction", "sweep",
         "ehl", "report", "table", "formats", "cite", "options", "completion", "man"]


def examples_of(help_text):
    lines = help_text.split("Examples:\n")[1].replace("\\\n", "").splitlines()
    return [shlex.split(line) for line in lines if line.strip()]


class HelpExamples(ProgramTest):
    def setUp(self):
        super().setUp()
        shutil.copytree(SOURCE / "surfaces", self.folder / "surfaces")
        shutil.copytree(SOURCE / "examples", self.folder / "examples")

    def run_examples(self, verb):
        done = self.tabor(verb, "--help")
        self.assertEqual(done.returncode, 0, done.stderr)
        examples = examples_of(done.stdout)
        self.assertGreaterEqual(len(examples), 2)
        for words in examples:
            self.assertEqual(words[0], "tabor")
            done = self.tabor(*words[1:])
            self.assertEqual(done.returncode, 0, f"{shlex.join(words)}\n{done.stderr}")

    def test_table(self):
        done = self.tabor("sweep", "examples/06_study/study.toml", "-o", "study_results")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.run_examples("table")


def add_test(verb):
    setattr(HelpExamples, f"test_{verb}", lambda self: self.run_examples(verb))


for name in VERBS:
    if name not in ("sweep", "report", "table"):
        add_test(name)


class HelpOfEveryVerb(ProgramTest):
    def test_is_named_by_the_overview(self):
        overview = self.tabor("--help").stdout
        for verb in VERBS:
            self.assertIn(f"\n  {verb} ", overview)


if __name__ == "__main__":
    unittest.main()
