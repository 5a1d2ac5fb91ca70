"""Roughness parameters of groups of scans: each scan, and mean and standard deviation of each group."""

import math

import numpy as np

from tabor.report import chart, style
from tabor.report.figures import Drawn
from tabor.report.output import table_text
from tabor.report.page_parameters import scale, shown_first

COLUMNS = 4


def draw(source):
    """Yields the figure, if there are groups and a parameter that the page begins with."""
    names = shown_first(source)
    if not names or not source.is_grouped:
        return
    rows = chart.rows([_panel(source, name) for name in names], COLUMNS)
    figure = chart.Figure(rows, 2.2 * len(rows), 1.9 * len(rows[0]))
    yield Drawn("parameters", "Roughness parameters of the groups", _caption(), figure, {"": _csv(source)})


def _panel(source, name):
    factor, unit = scale(source, name)
    count = len(source.groups)
    x = chart.Axis("", low=-0.6, high=count - 0.4, names={place: "" for place in range(count)})
    panel = chart.Panel(x, chart.Axis(style.literal(f"{name} ({unit})" if unit else name)), grid="y")
    for place, (group, look) in enumerate(zip(source.groups, style.curve_styles(count))):
        found = group.means.get(name)
        if found is not None and math.isfinite(found.mean):
            spread, notes = np.array([found.deviation * factor]), {"n": np.array([found.n])}
            look = {**look, "dash": "", "size": 6, "bar": (1.5, 4)}
            panel.items.append(chart.Curve([place], np.array([found.mean * factor]), _label(group), error=spread, notes=notes, **look))
        panel.items.append(_scans(source, name, factor, (place, group, look["colour"])))
    return panel


def _scans(source, name, factor, group):
    """Small rings, left of the mean so that its bar hides none."""
    place, members, colour = group
    values = [source.values[name][scan] * factor for scan in members.places]
    look = {"dash": "", "marker": "o", "size": 4, "face": "none", "colour": colour}
    notes = {"scan": np.array([source.scans[scan] for scan in members.places])}
    return chart.Curve([place - 0.25] * len(values), values, _label(members), notes=notes, **look)


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
