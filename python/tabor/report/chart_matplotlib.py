"""Figures of curves drawn by Matplotlib, for papers and still pages."""

import numpy as np

from tabor.report import chart, style

GREY = "0.92"  # of the grid
ABOVE = 26  # points between a panel and its title, where texts stand


def draw(figure):
    """A figure of Matplotlib."""
    n_rows, n_columns = len(figure.rows), max(len(row) for row in figure.rows)
    drawing, grid = style.new_figure(figure.height, n_rows, n_columns, width=figure.width, height_ratios=figure.heights)
    handles = {}
    for place, axes in np.ndenumerate(grid):
        row, column = place
        if column >= len(figure.rows[row]):
            axes.set_visible(False)
            continue
        panel = figure.rows[row][column]
        _draw_panel(figure, panel, axes, handles)
        _label(panel, axes, *(figure.is_named(row, column, which) for which in "xy"))
    entries = {label: handles.get(label) if figure.legend is None else _sample(grid[0][0], item) for label, item in figure.samples().items()}
    if entries:
        style.legend_on_top(drawing, entries)
    return drawing


def _draw_panel(figure, panel, axes, handles):
    sides = {False: axes, True: axes.twinx() if panel.right else None}
    _set_axis(axes, "x", figure.settled(panel, "x"))
    _set_axis(axes, "y", figure.settled(panel, "y"))
    for item in panel.items:
        drawn = _DRAW[type(item)](sides[getattr(item, "is_right", False)], item)
        if getattr(item, "label", ""):
            handles.setdefault(item.label, drawn)
    if panel.right:
        _set_axis(sides[True], "y", figure.settled(panel, "right"))
        sides[True].set_ylabel(panel.right.label)
        sides[True].spines["right"].set_visible(True)
    elif panel.grid != "none":
        axes.grid(axis=panel.grid, color=GREY, linewidth=0.6)


def _set_axis(axes, which, axis):
    scale = {"value": axis.scale, **({"linthresh": axis.linear_to} if axis.scale == "symlog" else {})}
    set_scale, set_limits, side = (axes.set_xscale, axes.set_xlim, axes.xaxis) if which == "x" else (axes.set_yscale, axes.set_ylim, axes.yaxis)
    set_scale(**scale)
    set_limits(axis.low, axis.high)
    if axis.scale == "log":
        style.log_axis(side)
    if axis.names:
        side.set_ticks(list(axis.names), list(axis.names.values()))


def _label(panel, axes, has_x, has_y):
    axes.set_xlabel(panel.x.label if has_x else "")
    axes.set_ylabel(panel.y.label if has_y else "")
    axes.tick_params(labelbottom=has_x, labelleft=has_y)
    if panel.x.names and not any(panel.x.names.values()):
        axes.tick_params(bottom=False)
    if panel.title:
        has_words = any(isinstance(item, chart.Text) and item.y is None for item in panel.items)
        axes.set_title(panel.title, **({"pad": ABOVE} if has_words else {}))


def _look(curve):
    face = {} if curve.face is None else {"markerfacecolor": curve.face}
    return {
        **_stroke(curve), "marker": curve.marker or "None", "markersize": curve.size, "markeredgewidth": curve.edge, "alpha": curve.alpha, **face,
    }  # fmt: skip


def _dash(dash):
    return (0, dash) if isinstance(dash, tuple) else dash or "none"


def _curve(axes, curve):
    look = _look(curve)
    if curve.error is None:
        return axes.plot(curve.x, curve.y, **look)[0]
    width, cap = curve.bar
    return axes.errorbar(curve.x, curve.y, yerr=curve.error if curve.has_bars else None, elinewidth=width, capsize=cap, **look)


def _sample(axes, item):
    """The handle of an entry that is drawn nowhere."""
    if isinstance(item, chart.Band):
        return axes.fill_between([], [], color=item.colour, alpha=item.alpha, linewidth=0)
    return axes.plot([], [], **(_look(item) if isinstance(item, chart.Curve) else _stroke(item)))[0]


def _band(axes, band):
    return axes.fill_between(band.x, band.low, band.high, color=band.colour, alpha=band.alpha, linewidth=0)


def _guide(axes, guide):
    return axes.axvline(guide.at, **_stroke(guide)) if guide.is_upright else axes.axhline(guide.at, **_stroke(guide))


def _stroke(item):
    return {"color": item.colour, "linestyle": _dash(item.dash), "linewidth": item.width, "zorder": item.z}


def _text(axes, text):
    look = {"textcoords": "offset points", "fontsize": text.size, "color": text.colour}
    if text.y is None:
        return axes.annotate(text.text, (text.x, 1), xytext=(0, 2), xycoords=("data", "axes fraction"), rotation=90, ha="center", va="bottom", **look)
    return axes.annotate(text.text, (text.x, text.y), xytext=(6, 4), **look)


_DRAW = {chart.Curve: _curve, chart.Band: _band, chart.Guide: _guide, chart.Text: _text}
