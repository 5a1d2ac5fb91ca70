"""A test case that makes studies from recipes, opens them and draws their figures."""

import csv
import io
import tempfile
import unittest
from argparse import Namespace
from pathlib import Path

import synthetic_study
from synthetic_study import Recipe
from tabor.report import build, style

OPTIONS = Namespace(html=False, scan=None, all_scans=False, pressure=None, density=None, error_bar="std")


def rows_of(text):
    return list(csv.DictReader(io.StringIO(text)))


class StudyCase(unittest.TestCase):
    """`self.default` is the study of the default recipe, `self.default_rows` its rows, drawn once per class."""

    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.default_rows = synthetic_study.write(temporary.name, Recipe())
        cls.default = build.open_result(temporary.name)
        cls.addClassCleanup(cls.default.file.close)
        style.apply()
        cls.default_figures = draw(cls.default)

    def study(self, recipe=Recipe(), change=None):
        """A study of its own; its rows are `self.rows`."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.rows = synthetic_study.write(folder.name, recipe)
        if change:
            change(Path(folder.name))
        source = build.open_result(folder.name)
        self.addCleanup(source.file.close)
        return source


def draw(source, **changes):
    """{name: Drawn}, with options of the command line changed as asked."""
    figures = {}
    for drawn in build.study_figures(source, Namespace(**{**vars(OPTIONS), **changes})):
        drawn.close()
        figures[drawn.name] = drawn
    return figures
