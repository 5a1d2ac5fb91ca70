"""One look for all figures, and the same bytes for the same numbers."""

import io
import math
import re

import matplotlib

matplotlib.use("Agg")

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.colors import to_hex
from matplotlib.ticker import FuncFormatter, Locator, NullLocator, ScalarFormatter

from tabor.report import units
from tabor.report.errors import readable

DPI = 180
MOST_LOG_TICKS = 7
WIDTH = 7.2  # inches, a full text column pair

# Okabe & Ito (2008): told apart with every common colour blindness.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#444444")
MARKERS = ("o", "s", "^", "D", "v", "P", "X")
DRY, WET, LIQUID, SOLID, WARNING = "#E8862E", "#000000", "#3A86C8", "#B9B2A8", "#C1121F"
FLATTENED = "#EBA39B"

# Grey and dashed, over a curve that it coincides with.
DRY_CURVE = {"colour": "0.35", "dash": "--", "marker": "s", "size": 4, "face": "white", "z": 4}

_SETTINGS = {
    "font.size": 9,
    "axes.titlesize": 9.5,
    "axes.titlelocation": "left",
    "axes.labelsize": 9,
    "axes.linewidth": 0.7,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "legend.fontsize": 8,
    "legend.frameon": False,
    "lines.linewidth": 1.4,
    "lines.markersize": 5,
    "xtick.labelsize": 8,
    "ytick.labelsize": 8,
    "figure.dpi": DPI,
    "figure.constrained_layout.use": True,
    # Without these two an SVG differs from run to run.
    "svg.hashsalt": "tabor",
    "svg.fonttype": "path",
}


def apply():
    matplotlib.rcdefaults()
    matplotlib.rcParams.update(_SETTINGS)


def new_figure(height, n_rows=1, n_columns=1, width=WIDTH, **keywords):
    """figure, 2-D array of axes"""
    return plt.subplots(n_rows, n_columns, figsize=(width, height), squeeze=False, **keywords)


def colours(n):
    """n colours, no two alike: of the fixed set, or where that ends steps from dark to light."""
    if n <= len(COLOURS):
        return list(COLOURS[:n])
    return [to_hex(colour) for colour in plt.get_cmap("viridis", 2 * n)(np.linspace(0, 0.93, n))]


def sequence(n):
    """n colours for rising values, from dark to light."""
    return [to_hex(colour) for colour in plt.get_cmap("viridis")(np.linspace(0, 0.86, n))]


def curve_styles(n):
    """n looks of a chart.Curve: a colour, which no other has, and a marker.

    Symbols shrink from curve to curve, so that one drawn over another of the same values hides neither.
    """
    return [
        {"colour": colour, "marker": MARKERS[step % len(MARKERS)], "size": max(4.0, 8.5 - 2 * (step % len(MARKERS)))}
        for step, colour in enumerate(colours(n))
    ]


def ordered_styles(n):
    """curve_styles of a family in the order of a quantity: darker for more of it."""
    return [{**look, "colour": colour} for look, colour in zip(curve_styles(n), sequence(n)[::-1])]


def round_numbers(low, high):
    """At least two round numbers between low and high of a logarithmic axis, but not many."""
    for digits in ((1,), (1, 3), (1, 2, 5), tuple(range(1, 10))):
        found = _with_digits(digits, low, high)
        if len(found) >= 3:
            return found[:: 1 + (len(found) - 1) // MOST_LOG_TICKS]
    return [low, high]


def _with_digits(digits, low, high):
    decades = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    numbers = [digit * 10.0**decade for decade in decades for digit in digits]
    return [number for number in numbers if low * 0.999 <= number <= high * 1.001]


def log_axis(axis):
    """Labels of an axis that is already logarithmic: round numbers, never one alone."""
    axis.set_major_locator(_RoundNumbers())
    axis.set_minor_locator(NullLocator())
    axis.set_major_formatter(FuncFormatter(lambda value, _: units.number(value)))


class _RoundNumbers(Locator):
    def __call__(self):
        low, high = sorted(self.axis.get_view_interval())
        return round_numbers(low, high) if 0 < low < high else [high]

    def tick_values(self, low, high):
        return round_numbers(low, high)


def legend_on_top(figure, entries):
    """A legend above the figure's edge: it can neither cover data nor squeeze it; saving takes it in.

    entries: {label: handle}
    """
    longest = max(len(label) for label in entries)
    columns = max(1, min(3, len(entries), int(figure.get_figwidth() / (0.067 * longest + 0.6))))
    figure.legend(
        list(entries.values()),
        list(entries),
        loc="lower left",
        bbox_to_anchor=(0, 1),
        ncol=columns,
        columnspacing=1.4,
        borderaxespad=0.2,
        handlelength=2.2,
    )


def legend_above(axes, n_columns, handles=None):
    """A legend that cannot cover data."""
    handles = handles if handles is not None else axes.get_legend_handles_labels()[0]
    if handles:
        axes.legend(
            handles=handles,
            loc="lower left",
            bbox_to_anchor=(0, 1.0),
            ncol=n_columns,
            borderaxespad=0.4,
            columnspacing=1.2,
            handlelength=1.8,
        )


def literal(text, longest=60):
    """A user's text without matplotlib reading $...$ as mathematics, cut where it would leave the page."""
    text = readable(text)
    text = text if len(text) <= longest else text[: longest - 1] + "\N{HORIZONTAL ELLIPSIS}"
    return text.replace("$", r"\$")


def quick_png(figure):
    """The same picture as that of png(), packed less."""
    return _bytes(figure, format="png", dpi=DPI, metadata={"Software": None}, pil_kwargs={"compress_level": 1})


def png(figure):
    return _bytes(figure, format="png", dpi=DPI, metadata={"Software": None})


def svg(figure):
    """Curves are rounded to 0.01 pt, 3.5 µm on paper, which makes them a quarter smaller."""
    text = _bytes(figure, format="svg", dpi=DPI, metadata={"Date": None, "Creator": None})
    return re.sub(rb' d="[^"]*"', lambda path: re.sub(rb"(\.\d\d)\d+", rb"\1", path[0]), text)


def picture(figure, form):
    """Bytes; form: png, svg or pdf."""
    return {"png": png, "svg": svg, "pdf": pdf}[form](figure)


def pdf(figure):
    return _bytes(figure, format="pdf", metadata={"CreationDate": None, "Creator": None, "Producer": None})


def close(figure):
    plt.close(figure)


def _bytes(figure, **keywords):
    stream = io.BytesIO()
    with matplotlib.rc_context({"figure.constrained_layout.use": False}):  # laid out once, by _frame
        figure.savefig(stream, bbox_inches=_frame(figure), **keywords)
    return stream.getvalue()


def _frame(figure):
    """The paper that holds all of a figure, in inches. What it holds keeps its place: every picture is of one layout."""
    if not hasattr(figure, "tabor_frame"):
        _write_plain_numbers(figure)
        figure.draw_without_rendering()
        # Tight: the layout engine does not see legends of the figure, nor labels beside axes of fixed aspect.
        figure.tabor_frame = figure.get_tightbbox(figure.canvas.get_renderer()).padded(0.08)
        figure.set_layout_engine(None)
    return figure.tabor_frame


class _PlainNumbers(ScalarFormatter):
    """Mathematics only for the power of ten beside an axis: to set every label in it takes most of the time of a figure."""

    def __init__(self):
        super().__init__(useMathText=False)

    def get_offset(self):
        self.set_useMathText(True)
        power = super().get_offset()
        self.set_useMathText(False)
        return power


def _write_plain_numbers(figure):
    for axes in figure.axes:
        for panel in (axes, *axes.child_axes):
            for axis in (panel.xaxis, panel.yaxis):
                if type(axis.get_major_formatter()) is ScalarFormatter:
                    axis.set_major_formatter(_PlainNumbers())
