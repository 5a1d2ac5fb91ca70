"""Roughness parameters of groups of scans: each scan, and mean and standard deviation of each group."""

import math

import numpy as np

from tabor.report import style
from tabor.report.figures import Drawn
from tabor.report.output import table_text
from tabor.report.page_parameters import scale, shown_first

COLUMNS = 4


def draw(source):
    """Yields the figure, if there are groups and a parameter that the page begins with."""
    names = shown_first(source)
    if not names or not source.is_grouped:
        return
    n_rows = math.ceil(len(names) / COLUMNS)
    figure, grid = style.new_figure(2.2 * n_rows, n_rows, min(COLUMNS, len(names)), width=1.9 * min(COLUMNS, len(names)))
    for axes in grid.flat[len(names) :]:
        axes.set_visible(False)
    for axes, name in zip(grid.flat, names):
        _draw_panel(axes, source, name)
    style.legend_on_top(figure, style.entries(grid[0][0]))
    yield Drawn("parameters", "Roughness parameters of the groups", _caption(), figure, {"": _csv(source)})


def _draw_panel(axes, source, name):
    factor, unit = scale(source, name)
    for place, (group, look) in enumerate(zip(source.groups, style.curve_styles(len(source.groups)))):
        _draw_scans(axes, source, name, factor, (place, group, look["color"]))
        found = group.means.get(name)
        if found is None or not math.isfinite(found.mean):
            continue
        spread = [found.deviation * factor] if math.isfinite(found.deviation) else None
        bars = axes.errorbar([place], [found.mean * factor], yerr=spread, fmt=look["marker"], color=look["color"],
                             markersize=6, capsize=4, label=_label(group))  # fmt: skip
        style.note(bars.lines[0], n=np.array([found.n]))
    axes.set_xlim(-0.6, len(source.groups) - 0.4)
    axes.set_xticks([])
    axes.tabor_x_names = {place: "" for place in range(len(source.groups))}
    axes.set_ylabel(style.literal(f"{name} ({unit})" if unit else name))
    axes.grid(axis="y", color="0.92", linewidth=0.6)


def _draw_scans(axes, source, name, factor, group):
    """Small rings, left of the mean so that its bar hides none."""
    place, members, colour = group
    values = [source.values[name][scan] * factor for scan in members.places]
    (line,) = axes.plot([place - 0.25] * len(values), values, "o", color=colour, fillstyle="none", markersize=4)
    line.tabor_label = _label(members)
    style.note(line, scan=np.array([source.scans[scan] for scan in members.places]))


def _label(group):
    return style.literal(f"{group.name}, mean of {len(group.places)}")


def _caption():
    return (
        "Filled symbols: mean over the scans of a group, with error bars of one standard deviation (n \N{MINUS SIGN} 1), none for one scan. "
        "Rings: the scans."
    )


def _csv(source):
    columns = {"group": [], "parameter": [], "unit": [], "n": [], "mean": [], "std": []}
    for group in source.groups:
        for name, found in group.means.items():
            cells = group.name, name, source.units[name], found.n, found.mean, found.deviation
            for column, cell in zip(columns.values(), cells):
                column.append(cell)
    return table_text(columns)
