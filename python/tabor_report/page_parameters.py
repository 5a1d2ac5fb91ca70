"""The table of roughness parameters for the page: scans side by side, with their mean and standard deviation."""

import math

from tabor_report import units

MOST_SCANS = 6  # columns of one table
FIRST = ("Sa", "Sq", "Sz", "Sdq", "Sdr", "Ssk", "Sku")  # of the answer


def sections(source):
    return {
        "answer": _answer(source),
        "settings": [("treatment", source.treatment or "none"), ("scans", str(len(source.scans)))],
        "results": {"intro": "", "header": [], "rows": [], "tables": _tables(source), "n_total": 0, "n_text": 1},
    }


def _answer(source):
    names = [name for name in FIRST if name in source.values]
    if not source.scans or not names:
        return None
    shown = source.scans[:MOST_SCANS]
    rows = [(name, _cells(source, name)[: len(shown)] + _statistics(source, name)) for name in names]
    left_out = len(source.scans) - len(shown)
    return {
        "caption": "Of each scan, with mean and standard deviation" if len(source.scans) > 1 else "Of the scan",
        "header": shown + (["mean ± std"] if len(source.scans) > 1 else []),
        "rows": rows,
        "note": f"{left_out} more scans stand in the results and count in the mean." if left_out else "",
    }


def _tables(source):
    """At most MOST_SCANS scans beside each other; the mean stands in the last table."""
    starts = range(0, max(1, len(source.scans)), MOST_SCANS)
    tables = []
    for start in starts:
        part, is_last = slice(start, start + MOST_SCANS), start == starts[-1]
        ending = ["mean ± std"] if is_last and len(source.scans) > 1 else []
        rows = [
            {"sure": True, "cells": [name, *_cells(source, name)[part], *(_statistics(source, name) if ending else [])]}
            for name in source.values
        ]
        tables.append({"header": ["", *source.scans[part], *ending], "rows": rows})
    return tables


def _cells(source, name):
    return [_shown(value, source.units[name]) for value in source.values[name]]


def _statistics(source, name):
    """[] for one scan."""
    if len(source.scans) < 2:
        return []
    (mean, deviation), unit = source.mean_and_deviation(name), source.units[name]
    factor, shown = _scale(mean, unit)
    spread = f" ± {units.number(deviation * factor, 2)}" if math.isfinite(deviation) else ""
    return [f"{units.number(mean * factor, 4)}{spread} {shown}".rstrip()]


def _shown(value, unit):
    factor, shown = _scale(value, unit)
    return f"{units.number(value * factor, 4)} {shown}".rstrip()


def _scale(value, unit):
    """Lengths get a prefix; what has a power keeps its unit."""
    if not math.isfinite(value) or unit == "1":
        return 1.0, ""
    factor, shown = units.scale(value, unit) if unit == "m" else (1.0, unit)
    return factor, shown.replace("^2", "²").replace("^3", "³").replace("deg", "°")
