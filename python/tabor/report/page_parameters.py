"""The table of roughness parameters for the page: scans side by side, with mean and standard deviation of each group."""

import math

from tabor.report import units
from tabor.report.parameters import Mean

MOST_SCANS = 6  # columns of one table
FIRST = ("Sa", "Sq", "Sz", "Sdq", "Sdr", "Ssk", "Sku")  # of the answer


def sections(source):
    settings = [("scans", str(len(source.scans)))]
    if source.treatment:
        settings.insert(0, ("treatment", source.treatment))
    settings += [(name, file) for name, file in zip(source.scans, source.files) if name != file]
    return {
        "answer": _answer(source),
        "settings": settings,
        "settings_title": "Scans",
        "results": {"intro": "", "header": [], "rows": [], "tables": _tables(source), "n_total": 0, "n_text": 1},
    }


def shown_first(source):
    """Names of the parameters of the answer."""
    return [name for name in FIRST if name in source.values]


def heading(group):
    """Of the column of its means."""
    return f"{group.name}, mean ± std".removeprefix(", ")


def scale(source, name):
    """(factor, unit with prefix) of a row: one for all its numbers, in which the largest reads well."""
    means = [group.means[name].mean for group in source.groups if name in group.means]
    known = [abs(value) for value in (*source.values[name], *means) if math.isfinite(value)]
    return units.scale(max(known, default=0), units.signs(source.units[name]))


def _answer(source):
    """Of a table with groups their means alone, as many scans as fit beside the mean of a table without."""
    if not source.scans or not shown_first(source):
        return None
    means = [("mean", group) for group in source.groups[:MOST_SCANS] if source.has_means]
    scans = [] if source.is_grouped else [("scan", place) for place in range(len(source.scans))][:MOST_SCANS]
    shown = scans + means + [("change", None)] * (source.has_change and bool(scans))
    left_out = len(source.groups) - len(means) if source.is_grouped else len(source.scans) - len(scans)
    what = "groups" if source.is_grouped else "scans, which count in the mean"
    return {
        "caption": _caption(source),
        "header": [_heading(source, column) for column in shown],
        "rows": [(row[0], row[1:]) for row in (_row(source, name, shown) for name in shown_first(source))],
        "note": f"The results hold {left_out} more {what}." if left_out > 0 else "",
    }


def _caption(source):
    if source.is_grouped:
        return "Mean and standard deviation of each group"
    return "Of each scan, with mean and standard deviation" if source.has_means else "Of the scan"


def _columns(source):
    """("scan", place) and ("mean", group): the scans of each group, then its mean."""
    columns = []
    for group in source.groups:
        columns += [("scan", place) for place in group.places]
        columns += [("mean", group)] * source.has_means
    return columns + [("change", None)] * source.has_change


def _tables(source):
    """At most MOST_SCANS columns beside each other, and a mean that would stand alone beside the last of its scans."""
    columns, tables = _columns(source), []
    while columns or not tables:
        n = MOST_SCANS + (len(columns) > MOST_SCANS and columns[MOST_SCANS][0] == "mean")
        part, columns = columns[:n], columns[n:]
        rows = [{"sure": True, "cells": _row(source, name, part)} for name in source.values]
        tables.append({"header": ["", *(_heading(source, column) for column in part)], "rows": rows})
    return tables


def _heading(source, column):
    kind, which = column
    return {"scan": lambda: source.scans[which], "mean": lambda: heading(which), "change": lambda: "change"}[kind]()


def _row(source, name, columns):
    """The name with its unit, then numbers."""
    factor, unit = scale(source, name)
    cells = [_cell_of(source, name, column, factor) for column in columns]
    return [f"{name} ({unit})" if unit else name, *cells]


def _cell_of(source, name, column, factor):
    kind, which = column
    if kind == "change":
        return _change(*source.values[name], source.units[name], factor)
    return _cell(source.values[name][which] if kind == "scan" else which.means.get(name), factor)


def _change(first, second, unit, factor):
    """From the first scan to the second, as `tabor params` prints it: a factor, or a difference where a factor says nothing."""
    if not (math.isfinite(first) and math.isfinite(second)):
        return "\N{EN DASH}"
    if unit not in ("%", "deg") and first > 0 and second > 0:
        return f"\N{MULTIPLICATION SIGN} {units.number(second / first, 4)}"
    difference = (second - first) * factor
    return f"{'+' if difference >= 0 else ''}{_number(difference)}"


def _cell(found, factor):
    """'860', or '800 ± 85' of a mean; what does not exist is left out."""
    if not isinstance(found, Mean):
        return _number(math.nan if found is None else found * factor)
    spread = f" ± {_number(found.deviation * factor, 2)}" if math.isfinite(found.deviation) else ""
    return f"{_number(found.mean * factor)}{spread}"


def _number(value, digits=4):
    """As units.number, with whole numbers in full and no power of ten below 10^7."""
    if not math.isfinite(value) or not 1 <= abs(value) < 1e7:
        return units.number(value, digits)
    rounded = float(f"{value:.{digits}g}") if value != round(value) else value
    return units.number(int(rounded) if rounded == round(rounded) else rounded, digits)
