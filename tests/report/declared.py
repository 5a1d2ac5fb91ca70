"""A declared figure that has one of everything, and those of every kind of result."""

import tempfile
from pathlib import Path

import numpy as np

import kinds_test
import synthetic_study
from study_case import OPTIONS
from synthetic_single import write_single
from synthetic_study import Recipe
from tabor.report import build, chart, style

NAN = float("nan")


def figure():
    """Two panels above each other with a common x; the upper one has an axis on the right."""
    x = np.array([1.0, 10.0, 100.0])
    upper = chart.Panel(
        chart.Axis("$q$ (1/m)", "log"),
        chart.Axis("$A_{real}$", "log"),
        [
            chart.Band(x, [1, NAN, 3], [2, 4, 6], "band", "0.5", 0.3),
            chart.Curve(x, [2.0, 20.0, 200.0], "a", "#0072B2", error=np.array([1.0, NAN, 50.0]), marker="o", notes={"n": [2, 1, 3]}),
            chart.Curve(x, [0.0, 50.0, 90.0], "b", "#D55E00", "--", is_right=True),
            chart.Guide(5.0, True, "guide"),
            chart.Text("word", 10.0, 20.0),
            chart.Text("above", 10.0),
        ],
        right=chart.Axis("share"),
        title="upper",
    )
    lower = chart.Panel(upper.x, chart.from_zero("y"), [chart.Curve(x * 10, [1.0, 2.0, 3.0], "a", "#0072B2"), chart.Guide(2.5)])
    return chart.Figure([[upper], [lower]], 4.0, heights=(2, 1), shares_x=True)


def of_results(folder):
    """Yields (name of the result, Drawn) of every declared figure of results of every kind."""
    style.apply()
    for name, make in {**kinds_test.KINDS, "curves.h5": _curves, "study": _study, "flow": _flow}.items():
        path = Path(folder) / name
        make(path)
        source = build.open_result(path)
        with source.file:
            for drawn in build._drawings(source, OPTIONS, with_maps=False):
                if drawn.is_declared:
                    yield name, drawn
                drawn.close()


def _curves(path):
    write_single(path, Recipe(shape=(70, 90), pressures=(5e6, 10e6), densities=(0.45, 0.9), density_curves=True))


def _study(path):
    synthetic_study.write(path, Recipe(shape=(24, 32), density_curves=True, not_converged=((2, 0),)))


def _flow(path):
    synthetic_study.write(path, Recipe(shape=(24, 32), pressures=(2e6, 5e6), speeds=(0.01, 0.1, 1.0), unsteady=((1, 0),)))


class Results:
    """Of a test class: `self.declared` of all results, made once."""

    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            cls.declared = list(of_results(folder))
