"""Options of the report that a kind of result has no use for are rejected; the others are taken."""

import contextlib
import io
import tempfile
import unittest
import zipfile
from pathlib import Path

import h5py
import synthetic_study
from synthetic_single import write_single
from synthetic_study import Recipe
from tabor.report import applicable, build, cli
from tabor.report.errors import UsageError
from ehl_test import impact_file, sweep_file

OF_STUDIES = (["--scan", "0"], ["--all-scans"], ["--pressure", "5MPa"], ["--density", "0.9g/m^2"],
              ["--error-bar", "std"], ["--error-bar", "sem"])
OF_ALL = (["--no-html"], ["--static"], ["--figures", "png,pdf"], ["--quiet"], ["-o", "elsewhere"], [])


def parsed(path, words):
    options = cli._parser().parse_args([str(path), *words])
    cli._convert(options)
    return options


class NoResults(unittest.TestCase):
    def test_a_scan_is_told_from_a_result_and_the_message_says_what_makes_one(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, make in (("scan.x3p", write_zip), ("scan.h5", write_foreign_hdf5), ("empty.h5", lambda path: path.touch())):
                path = Path(folder) / name
                make(path)
                said = io.StringIO()
                with contextlib.redirect_stderr(said):
                    self.assertEqual(cli.main([str(path)]), 3)
                self.assertIn("no result of tabor", said.getvalue())
                self.assertIn(f"tabor friction {name}", said.getvalue())
                self.assertEqual(len(said.getvalue().splitlines()), 1)


def write_zip(path):
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("main.xml", "<p/>")


def write_foreign_hdf5(path):
    with h5py.File(path, "w") as file:
        file["height"] = [[0.0]]


class Options(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def study(self, recipe=Recipe()):
        synthetic_study.write(self.folder, recipe)
        return self.folder

    def others(self):
        for make in (write_single, impact_file, sweep_file):
            path = self.folder / f"{make.__name__}.h5"
            make(path)
            yield path

    def check(self, path, words):
        source = build.open_result(path)
        self.addCleanup(source.file.close)
        applicable.check(source, parsed(path, words))

    def test_of_studies_are_rejected_for_every_other_result(self):
        for path in self.others():
            for words in OF_STUDIES:
                with self.assertRaises(UsageError, msg=f"{path} {words}") as caught:
                    self.check(path, words)
                self.assertIn(words[0], str(caught.exception))
                self.assertEqual(len(str(caught.exception).splitlines()), 1)

    def test_of_all_results_are_taken_by_all(self):
        for path in (*self.others(), self.study()):
            for words in OF_ALL:
                self.check(path, words)

    def test_of_studies_are_taken_by_studies(self):
        study = self.study()
        for words in OF_STUDIES:
            self.check(study, words)

    def test_that_contradict_each_other_are_rejected(self):
        with self.assertRaises(UsageError):
            self.check(self.study(), ["--scan", "0", "--all-scans"])

    def test_a_density_is_rejected_where_no_scan_is_lubricated(self):
        with self.assertRaises(UsageError):
            self.check(self.study(Recipe(densities=(0.0,))), ["--density", "0.9g/m^2"])

    def test_the_program_ends_with_a_usage_error_and_writes_nothing(self):
        path = self.folder / "one.h5"
        write_single(path)
        messages = io.StringIO()
        with contextlib.redirect_stderr(messages):
            self.assertEqual(cli.main([str(path), "--scan", "0"]), 2)
        self.assertIn("--scan", messages.getvalue())
        self.assertEqual([entry.name for entry in self.folder.iterdir()], ["one.h5"])
