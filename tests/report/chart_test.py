"""Declared figures: where their axes end, what their legends say, and that Matplotlib draws the numbers that are declared."""

import unittest
from collections import Counter

import numpy as np
from matplotlib.collections import PolyCollection

import declared
from tabor.report import chart, chart_matplotlib, style
from tabor.report.plain_text import plain


def ends(*items, **axis):
    panel = chart.Panel(chart.Axis("x", **axis), chart.Axis("y"), list(items))
    found = chart.Figure([[panel]], 3.0).settled(panel, "x")
    return found.low, found.high


def curve(*x, **look):
    return chart.Curve(np.array(x, dtype=float), np.zeros(len(x)), **look)


class Ends(unittest.TestCase):
    def test_an_axis_goes_beyond_its_outermost_values_by_a_twentieth(self):
        np.testing.assert_allclose(ends(curve(0, 10), curve(20, np.nan)), (-1, 21))
        np.testing.assert_allclose(ends(curve(1, 100), scale="log"), (100**-0.05, 100**1.05))

    def test_ends_that_are_given_stay(self):
        self.assertEqual(ends(curve(0, 10), low=-7.0, high=3.0), (-7, 3))
        np.testing.assert_allclose(ends(curve(2, 10), low=0.0, air=2.0), (0, 20.8))

    def test_a_logarithmic_axis_takes_no_notice_of_what_it_cannot_show(self):
        np.testing.assert_allclose(ends(curve(-5, 0, 1, 100), scale="log"), (100**-0.05, 100**1.05))

    def test_one_value_and_none_have_room(self):
        for values in ((), (0.0,), (3.0,), (-2.0,), (np.nan,)):
            for scale in ("linear", "log"):
                low, high = ends(curve(*values), scale=scale)
                self.assertLess(low, high)

    def test_bars_bands_and_guides_count(self):
        items = [chart.Curve([0], np.array([5.0]), error=np.array([2.0])), chart.Band([0, 1], [1, 1], [2, 9]), chart.Guide(-1.0), chart.Guide(99.0, True)]
        panel = chart.Panel(chart.Axis(), chart.Axis(), items)
        found = chart.Figure([[panel]], 3.0).settled(panel, "y")
        np.testing.assert_allclose((found.low, found.high), (-1.5, 9.5))

    def test_panels_that_share_an_axis_end_alike_and_name_it_once(self):
        row = [chart.Panel(chart.Axis("x"), chart.Axis("y"), [chart.Curve([0, 1], [0, top])]) for top in (1, 2, 4)]
        figure = chart.Figure(chart.rows(row, 2), 3.0, shares_x=True, shares_y="row")
        tops = [figure.settled(panel, "y").high for panel in figure.panels]
        self.assertEqual(tops, [2.1, 2.1, 4.2])
        named = [[figure.is_named(y, x, "x") for x in range(len(row))] for y, row in enumerate(figure.rows)]
        self.assertEqual(named, [[False, True], [True]])
        self.assertEqual([figure.is_named(0, x, "y") for x in (0, 1)], [True, False])


class Legends(unittest.TestCase):
    def test_labels_come_in_order_each_once(self):
        self.assertEqual(list(declared.figure().samples()), ["band", "a", "b", "guide"])

    def test_samples_stand_in_their_place(self):
        figure = declared.figure()
        figure.legend = (chart.Curve(label="b"), chart.Guide(0.0, label="grey"), chart.Band([], [], [], "area"))
        self.assertEqual(list(figure.samples()), ["b", "grey", "area"])
        drawing = chart_matplotlib.draw(figure)
        self.assertEqual([text.get_text() for text in drawing.legends[0].get_texts()], ["b", "grey", "area"])
        style.close(drawing)
        figure.legend = ()
        drawing = chart_matplotlib.draw(figure)
        self.assertEqual(drawing.legends, [])
        style.close(drawing)

    def test_formulas_become_plain_text(self):
        for text, shown in (("$A_{real}/A_0$ (%)", "Aᵣₑₐₗ/A₀ (%)"), ("$C^{1D}$ (µm$^4$)", "C¹ᴰ (µm⁴)"), (r"5 \$ $\mu$", "5 $ μ"), ("a\nb", "a b")):
            self.assertEqual(plain(text), shown)


class ByMatplotlib(declared.Results, unittest.TestCase):
    def test_every_kind_of_result_declares_its_curves(self):
        names = {drawn.name for _, drawn in self.declared}
        self.assertLessEqual({"against_pressure", "friction_against_density", "heights", "dry_friction", "lubricated_friction", "mixed_friction", "contact_area",
                              "psd", "spectra", "parameters", "stribeck", "impact_force", "line_profile", "point_along", "point_slice_plane"}, names)  # fmt: skip

    def test_the_drawn_numbers_are_the_declared_ones(self):
        for name, drawn in self.declared:
            with self.subTest(name, figure=drawn.name):
                drawing = chart_matplotlib.draw(drawn.figure)
                shown = Counter(values(*line.get_data(orig=True)) for axes in drawing.axes for line in axes.lines)
                self.assertLessEqual(Counter(values(item.x, item.y) for item in items(drawn.figure, chart.Curve)), shown)
                bands = sum(isinstance(part, PolyCollection) for axes in drawing.axes for part in axes.collections)
                self.assertEqual(bands, len(items(drawn.figure, chart.Band)))
                style.close(drawing)

    def test_drawn_axes_end_where_they_are_declared_to(self):
        for name, drawn in self.declared:
            with self.subTest(name, figure=drawn.name):
                drawing = chart_matplotlib.draw(drawn.figure)
                drawing.draw_without_rendering()
                found = {(*axes.get_xlim(), *axes.get_ylim()) for axes in drawing.axes}
                for panel in drawn.figure.panels:
                    x, y = drawn.figure.settled(panel, "x"), drawn.figure.settled(panel, "y")
                    self.assertIn((x.low, x.high, y.low, y.high), found)
                style.close(drawing)

    def test_the_axis_on_the_right_has_its_own_scale(self):
        drawing = chart_matplotlib.draw(declared.figure())
        self.assertEqual([axes.get_yscale() for axes in drawing.axes if axes.get_ylabel() == "share"], ["linear"])
        self.assertEqual(drawing.axes[0].get_yscale(), "log")
        style.close(drawing)


def items(figure, kind):
    return [item for panel in figure.panels for item in panel.items if isinstance(item, kind)]


def values(x, y):
    """What tells curves apart: all of their numbers."""
    return np.array([x, y], dtype=float).tobytes()


if __name__ == "__main__":
    unittest.main()
