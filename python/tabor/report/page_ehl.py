"""Facts and tables of a result of `tabor ehl` for the page."""

import re

import numpy as np

from tabor.report import hdf, units
from tabor.report.columns import Column, words

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


# What a reader looks for stands first in the table of a sweep, what the solver did last.
_FIRST = (
    "friction_coefficient", "friction_fluid", "friction_solid", "central_film_m", "min_film_m", "lambda_ratio", "max_pressure_Pa",
    "solid_contact_fraction", "plastic_fraction",
)  # fmt: skip
_LAST = ("Hc", "Hm", "newton_iterations")


def sections(source):
    scalars = source.scalars
    return {
        "highlights": _shown_all(source, {key: scalars[key] for key in _HIGHLIGHTS if key in scalars}),
        "settings": list(_settings(source)),
        "results": _cases(source) if source.is_sweep else _numbers(source),
    }


def _numbers(source):
    """One row per number of a case, those of its parts behind its own."""
    cells = _rows(source, source.scalars)
    for name, scalars in source.parts.items():
        cells += [[f"{words(name)}: {key}", value] for key, value in _rows(source, scalars)]
    rows = [{"sure": True, "cells": row} for row in cells]
    return {"intro": "", "header": ["", "value"], "rows": rows, "n_total": len(rows), "n_text": 1}


def _rows(source, scalars):
    return sorted(map(list, _shown_all(source, scalars)), key=lambda row: row[0].casefold())


def _shown_all(source, scalars):
    return [(source.column[key].heading, source.column[key].show(value)) for key, value in scalars.items()]


def _in_order(names):
    known = {**{name: place - len(_FIRST) for place, name in enumerate(_FIRST)}, **{name: 1 + place for place, name in enumerate(_LAST)}}
    return sorted(names, key=lambda name: known.get(name, 0))


def _cases(source):
    """One row per case of a sweep."""
    node, axes = source.file["sweep"], source.axes
    numbers = source.numbers
    columns = [source.column[name] for name in _in_order(numbers)]
    sure = node["converged"][()] > 0 if "converged" in node else np.ones(node["shape"][()].prod(), dtype=bool)
    rows = []
    for number, place in enumerate(np.ndindex(*node["shape"][()])):
        values = [_at(axis, index) for axis, index in zip(axes.values(), place)]
        cells = [column.show(numbers[column.key][number]) for column in columns]
        rows.append({"sure": bool(sure[number]), "cells": values + source.codes[number : number + 1] + cells})
    header = [*axes, *["warnings"] * bool(source.codes), *(column.heading for column in columns)]
    intro = "" if sure.all() else "Rows in red did not converge."
    return {"intro": intro, "header": header, "rows": rows, "n_total": len(rows), "n_text": len(axes) + bool(source.codes)}


def _shown(value, unit):
    return units.si(float(value), hdf.text(unit))


def _at(axis, index):
    """What a sweep took for one value of an axis."""
    if "words" in axis.attrs:
        return hdf.text(axis.attrs["words"][index])
    return _shown(axis[index], "" if axis.attrs.get("units", "SI") == "SI" else axis.attrs["units"])


def _range(axis):
    """'1 mm/s to 10 m/s, 5 values'"""
    if "words" in axis.attrs:
        return ", ".join(_at(axis, index) for index in range(len(axis)))
    values = axis[()]
    return f"{_at(axis, values.argmin())} to {_at(axis, values.argmax())}, {len(axis)} values"


def _settings(source):
    """(dotted key, text) of every value of a case, and of what a sweep takes instead."""
    settings = dict(_flat(source.settings))
    settings.update({key: _range(axis) for key, axis in source.axes.items()})
    return [(key, _readable(text)) for key, text in sorted(settings.items())]


def _readable(text):
    """A quantity as it stands in a case, with the signs of print: '2.8e-15 m²/N', '20 µm'."""
    text = re.sub(r"(?<=[A-Za-z)])\^[23]", lambda power: units.signs(power[0]), text)
    return re.sub(r"(?<=[0-9 ])u(?=[mNsg])", "µ", text)


def _flat(values, path=""):
    """(dotted key, text) of values, tables in tables too."""
    for key, value in values.items():
        if isinstance(value, dict):
            yield from _flat(value, f"{path}{key}.")
        elif path:
            yield f"{path}{key}", Column("", "").show(value)
