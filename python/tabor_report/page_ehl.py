"""Facts and tables of a result of `tabor ehl` for the page."""

from tabor_report.page_single import show, words

_HIGHLIGHTS = ("restitution", "max_force_N", "min_film_m", "max_force_N_per_m", "lag_s")


def sections(source):
    scalars = source.scalars
    rows = [{"sure": True, "cells": [words(key), show(key, value)]} for key, value in sorted(scalars.items())]
    return {
        "highlights": [(words(key), show(key, scalars[key])) for key in _HIGHLIGHTS if key in scalars],
        "scans": [],
        "treatments": [],
        "settings": [
            (f"{table}.{key}", show("", value))
            for table, values in source.settings.items()
            if isinstance(values, dict)
            for key, value in values.items()
        ],
        "results": {"header": ["", "value"], "rows": rows, "n_total": len(rows), "n_text": 1},
        "averages": {"header": [], "rows": [], "n_text": 0},
    }
