"""Facts and tables of a single-scan result for the page."""

from pathlib import Path

from tabor_report import hdf, units


def sections(single):
    return {
        "highlights": _highlights(single),
        "scans": [_scan(single)],
        "treatments": [(tuple(hdf.text_list(single.surface_facts.get("treatment"))), [single.title])],
        "settings": _settings(single),
        "results": _results(single.table, len(single.states)),
        "averages": {"header": [], "rows": [], "n_text": 0},
    }


def _highlights(single):
    found = []
    for state in single.states[:3]:
        facts = state.facts
        for key, name in (
            ("contact_area_fraction", "real contact area"),
            ("friction_dry", "dry friction"),
            ("friction_lubricated", "lubricated friction"),
            ("mean_film_m", "mean film"),
        ):
            if isinstance(facts.get(key), float):
                where = f" at {units.pressure(state.pressure)}" if state.pressure is not None else ""
                found.append((name + where, show(key, facts[key])))
    return found


def _scan(single):
    facts = single.surface_facts
    ny, nx = single.surface["height"].shape
    rows = [
        ("pixels", f"{nx} × {ny}"),
        ("pixel size", f"{units.length(single.pixel[0])} × {units.length(single.pixel[1])}"),
        ("format", facts.get("format", "")),
        ("instrument", facts.get("instrument", "")),
        ("periodic", "yes" if facts.get("periodic") else "no"),
    ]
    sha256 = hdf.text_list(single.facts.get("input_sha256"))
    return {
        "file": Path(facts.get("source") or single.title).name,
        "group": "",
        "sha256": sha256[0] if sha256 else "",
        "rows": [(name, text) for name, text in rows if text],
        "doubts": hdf.text_list(facts.get("doubts")),
    }


def _settings(single):
    scalars = {
        name: value
        for name, value in single.facts.items()
        if isinstance(value, (int, float)) and name != "format_version"
    }
    return [(name, show(name, value)) for name, value in scalars.items()]


def _results(table, n_states):
    names = [name for name in table if name not in ("converged", "warnings")]
    sure = table.get("converged", [True] * n_states)
    rows = [
        {
            "sure": sure[index] is not False and sure[index] != 0,
            "cells": [show(name, table[name][index]) for name in names],
        }
        for index in range(n_states if names else 0)
    ]
    return {
        "header": [name.replace("_", " ") for name in names] + ["converged"],
        "rows": rows,
        "n_total": len(rows),
        "n_text": 0,
    }


def show(name, value):
    """A value in a readable multiple of the SI unit its key ends in."""
    if not isinstance(value, (int, float)) or isinstance(value, bool):
        return units.number(value) if not isinstance(value, str) else value
    if name.endswith("_Pa"):
        return units.pressure(value)
    if name.endswith("_m"):
        return units.length(float(value))
    return units.number(value)
