"""Facts and tables of a result of `tabor ehl` for the page."""

from tabor_report.page_single import show, words

_HIGHLIGHTS = (
    "restitution",
    "max_force_N",
    "min_film_m",
    "central_film_m",
    "friction_coefficient",
    "solid_contact_fraction",
    "max_force_N_per_m",
    "lag_s",
)


def sections(source):
    scalars = source.scalars
    rows = [{"sure": True, "cells": [words(key), show(key, value)]} for key, value in sorted(scalars.items())]
    return {
        "highlights": [(words(key), show(key, scalars[key])) for key in _HIGHLIGHTS if key in scalars],
        "scans": [],
        "treatments": [],
        "settings": list(_settings(source.settings)),
        "results": {"header": ["", "value"], "rows": rows, "n_total": len(rows), "n_text": 1},
        "averages": {"header": [], "rows": [], "n_text": 0},
    }


def _settings(values, path=""):
    """(dotted key, text) of every value of a case, tables in tables too."""
    for key, value in values.items():
        if isinstance(value, dict):
            yield from _settings(value, f"{path}{key}.")
        elif path:
            yield f"{path}{key}", ", ".join(map(str, value)) if isinstance(value, list) else show("", value)
