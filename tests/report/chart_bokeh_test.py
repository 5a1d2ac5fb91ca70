"""Declared figures drawn by Bokeh: the numbers that are declared, in the same axes, named for legend and pointer."""

import importlib.util
import unittest

import numpy as np

import declared
from tabor.report import chart
from tabor.report.plain_text import plain

if importlib.util.find_spec("bokeh") is None:
    raise unittest.SkipTest("needs Bokeh (PyPI)")

from bokeh.models import ColumnDataSource, HoverTool, LinearScale, LogScale, Span

from tabor.report import bokeh_looks, chart_bokeh


def rows_of(source):
    return {name: np.asarray(column, dtype=float) for name, column in source.data.items() if name in ("x", "y", "error")}


class OneOfEverything(unittest.TestCase):
    def setUp(self):
        self.figure = declared.figure()
        ((self.upper,), (self.lower,)) = chart_bokeh.draw(self.figure, "name")

    def tagged(self, label):
        return [model for plot in (self.upper, self.lower) for model in plot.references() if f"name:{label}" in model.tags]

    def test_a_second_axis_is_linear_beside_a_logarithmic_one(self):
        self.assertIsInstance(self.upper.y_scale, LogScale)
        self.assertIsInstance(self.upper.extra_y_scales["right"], LinearScale)

    def test_panels_share_one_range_and_name_it_once(self):
        self.assertIs(self.upper.x_range, self.lower.x_range)
        self.assertEqual([plot.xaxis[0].axis_label for plot in (self.upper, self.lower)], ["", "q (1/m)"])
        self.assertEqual(self.upper.yaxis[0].axis_label, "Aᵣₑₐₗ")

    def test_a_band_has_a_piece_on_each_side_of_a_gap(self):
        (band,) = self.tagged("band")
        self.assertEqual([len(piece) for piece in band.data_source.data["xs"]], [2, 2])

    def test_all_that_has_a_label_is_hidden_with_it(self):
        self.assertEqual(len(self.tagged("a")), 5)  # line, marks, bars and their caps; the line below
        self.assertEqual([type(model) for model in self.tagged("guide")], [Span])

    def test_the_pointer_says_what_the_axes_are_called(self):
        hovers = [tool for tool in self.upper.tools if isinstance(tool, HoverTool)]
        said = [dict(tool.tooltips) for tool in hovers]
        self.assertEqual(len(said), 2)
        self.assertLessEqual({"q (1/m)", "Aᵣₑₐₗ", "n", "\u00b1"}, set(said[0]))
        self.assertEqual(set(said[1]), {"", "q (1/m)", "share"})

    def test_legends_show_lines_marks_and_areas(self):
        entries = bokeh_looks.legend(self.figure)
        self.assertEqual([(entry["label"], entry["dash"], entry["marker"]) for entry in entries],
                         [("band", "", "area"), ("a", "solid", "circle"), ("b", [5, 2], ""), ("guide", "dotted", "")])  # fmt: skip

    def test_what_bokeh_has_no_scale_for_is_not_drawn(self):
        self.figure.rows[0][0].x.scale = "symlog"
        self.assertIsNone(chart_bokeh.draw(self.figure, "name"))


class ByBokeh(declared.Results, unittest.TestCase):
    def test_the_drawn_numbers_are_the_declared_ones(self):
        for name, drawn in self.declared:
            with self.subTest(name, figure=drawn.name):
                rows = chart_bokeh.draw(drawn.figure, drawn.name)
                for panel, plot in zip(drawn.figure.panels, (plot for row in rows for plot in row)):
                    sources = [rows_of(source) for source in plot.select({"type": ColumnDataSource})]
                    for item in panel.items:
                        if isinstance(item, chart.Curve) and len(item.x) and np.isfinite(np.asarray(item.y, dtype=float)).any():
                            self.assertTrue(any(is_of(item, source) for source in sources), item.label)

    def test_axes_end_where_they_are_declared_to(self):
        for name, drawn in self.declared:
            with self.subTest(name, figure=drawn.name):
                rows = chart_bokeh.draw(drawn.figure, drawn.name)
                for panel, plot in zip(drawn.figure.panels, (plot for row in rows for plot in row)):
                    for which, found in (("x", plot.x_range), ("y", plot.y_range)):
                        axis = drawn.figure.settled(panel, which)
                        self.assertEqual((found.start, found.end), (axis.low, axis.high))

    def test_every_label_of_the_legend_hides_something(self):
        for name, drawn in self.declared:
            if drawn.name == "friction_against_density":
                continue  # has a sample of what looks alike under all pressures
            with self.subTest(name, figure=drawn.name):
                rows = chart_bokeh.draw(drawn.figure, drawn.name)
                tags = {tag for row in rows for plot in row for model in plot.references() for tag in model.tags}
                named = {f"{drawn.name}:{plain(entry['label'])}" for entry in bokeh_looks.legend(drawn.figure)}
                self.assertLessEqual(named, tags)


def is_of(curve, source):
    if len(source.get("x", ())) != len(curve.x) or "y" not in source:
        return False
    has_numbers = all(np.array_equal(source[name], np.asarray(getattr(curve, name), dtype=float), equal_nan=True) for name in "xy")
    return has_numbers and (not curve.has_bars or np.array_equal(source.get("error"), np.asarray(curve.error, dtype=float), equal_nan=True))


if __name__ == "__main__":
    unittest.main()
