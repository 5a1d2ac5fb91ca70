"""Friction against the lubricant's density, as a result file holds it, and what that says: sentences, and a table of
where the densities that were asked for lie."""

import itertools
from dataclasses import dataclass, field

import h5py
import numpy as np

from tabor.report import hdf, units
from tabor.report.friction_series import DENSITY
from tabor.report.table import Table

PRESSURE = "mean_pressure_Pa"
WET = "lubricated_share"
DRY_SHARE = 0.01  #: a plateau whose wet share is below this counts as dry, as in the terminal
EDGES = ("plateau_from_g_per_m2", "plateau_to_g_per_m2", "beyond_plateau_g_per_m2")
MOST_COLUMNS = 8  # pressures of the table
MOST_ROWS = 40
_LEFT_OUT = "the figure of friction against density is left out"
_NO_PLACES = "the table of where densities lie is left out"


@dataclass
class Places:
    """Where the plateau of each group is under each pressure, and where each density lies; empty in older files."""

    edges: Table = field(default_factory=lambda: Table({}))
    asked: Table = field(default_factory=lambda: Table({}))


def load(file, name, values, warnings):
    """The table /name with the columns group, PRESSURE, DENSITY and `values`, of rows that can be drawn.

    Empty where the file has none, as older ones, or one that is damaged; `warnings` then says so.
    """
    node = hdf.child(file, name)
    if node is None:
        return Table({})
    names = ("group", PRESSURE, DENSITY, *values)
    problem = _problem(node, names)
    if problem:
        warnings.append(f"/{name}: {problem}; {_LEFT_OUT}; compute the result again.")
        return Table({})
    table = Table({key: hdf.columns(node)[key] for key in names})
    sound = _is_drawable(table, values[0])
    if not sound.all():
        warnings.append(f"/{name}: {np.sum(~sound)} of {len(sound)} rows hold no usable number and are left out.")
    return table.where(sound)


def answers(facts, table):
    """(short, all): the sentences of the result; short keeps those of each group's lowest and highest pressure."""
    sentences = [_readable(text) for text in hdf.text_list(facts.get("answers"))]
    keys = list(dict.fromkeys(zip(table.get("group", ()), table.get(PRESSURE, ()))))
    if len(keys) != len(sentences):
        return sentences, sentences
    ends = {end for _, members in itertools.groupby(sorted(keys), lambda key: key[0]) for end in _ends(members)}
    return [text for key, text in zip(keys, sentences) if key in ends], sentences


def _ends(keys):
    keys = list(keys)
    return keys[0], keys[-1]


def _readable(sentence):
    text = sentence.replace("g/m^2", "g/m²")
    return "A" + text[1:] if text.startswith("at ") else text


def _problem(node, names, texts=()):
    """Why the table of numbers (behind the first column) and texts cannot be used; "" if it can."""
    if not isinstance(node, h5py.Group):
        return "got no table"
    every = (*names, *texts)
    columns = hdf.columns({name: node[name] for name in every if name in node})
    missing = [name for name in every if name not in columns]
    if missing:
        return f"the column {missing[0]} is missing"
    lengths = {column.shape for column in columns.values()}
    if len(lengths) > 1 or len(next(iter(lengths))) != 1:
        return "its columns are not of one length"
    wrong = [name for name in names[1:] if columns[name].dtype.kind not in "fiu"]
    return f"the column {wrong[0]} holds no numbers" if wrong else ""


def load_places(file, warnings):
    """The tables /density_plateaus and /density_places; empty where the file has none or one is damaged."""
    numbers = {"density_plateaus": (PRESSURE, *EDGES), "density_places": (PRESSURE, DENSITY, WET)}
    tables = []
    for name, columns in numbers.items():
        node = hdf.child(file, name)
        texts = ("group", "place") if name == "density_places" else ("group",)
        problem = "" if node is None else _problem(node, (texts[0], *columns), texts[1:])
        if problem:
            warnings.append(f"/{name}: {problem}; {_NO_PLACES}; compute the result again.")
        if node is None or problem:
            return Places()
        optional = [WET] if WET in node else []  # of plateaus in older files
        tables.append(Table({key: hdf.columns(node)[key] for key in dict.fromkeys((*texts, *columns, *optional))}))
    return Places(*tables)


def places_table(places, group_names):
    """Rows of densities and columns of pressures for the page; None without places."""
    pressures = places.edges.distinct(PRESSURE)
    groups = list(dict.fromkeys(places.edges.get("group", ())))
    steps = min(len(pressures), MOST_COLUMNS)
    shown = [pressures[round(step * (len(pressures) - 1) / max(1, steps - 1))] for step in range(steps)]
    rows = []
    for group in groups:
        name = f" ({group})" if group_names else ""
        edges = places.edges.where(places.edges.equal("group", group))
        asked = places.asked.where(places.asked.equal("group", group)) if places.asked else places.asked
        rows.append((f"plateau from{name}", [_at(edges, pressure, _first) for pressure in shown]))
        for density in asked.distinct(DENSITY):
            lying = asked.where(asked.equal(DENSITY, density))
            dry = [_at(edges, pressure, _is_dry) is True for pressure in shown]
            texts = [_at(lying, pressure, lambda row, dry=is_dry: _place(row, dry)) for pressure, is_dry in zip(shown, dry)]
            firsts = [_at(edges, pressure, lambda row: row[EDGES[0]]) for pressure in shown]
            texts = [f"less wet{text.removeprefix('below')}, single droplets" if text.startswith("below") and density > first else text
                     for text, first in zip(texts, firsts)]
            rows.append((f"{units.density(density)}{name}", texts))
        rows.append((f"plateau ends in{name}", [_at(edges, pressure, _end) for pressure in shown]))
    if not rows:
        return None
    return {"header": [units.pressure(pressure) for pressure in shown], "rows": rows[:MOST_ROWS],
            "left_out": max(0, len(rows) - MOST_ROWS), "pressures_left_out": len(pressures) - len(shown)}


def _at(table, pressure, text):
    rows = table.where(table.equal(PRESSURE, pressure)).rows() if table else []
    return text(rows[0]) if rows else "\N{EN DASH}"


def _first(row):
    return units.density(row[EDGES[0]]) if np.isfinite(row[EDGES[0]]) else "no plateau"


def _end(row):
    if not np.isfinite(row[EDGES[2]]):
        return "\N{EN DASH}"
    return f"{units.number(float(row[EDGES[1]]))} to {units.density(float(row[EDGES[2]]))}"


def _is_dry(row):
    return bool(row.get(WET, 1) < DRY_SHARE)


def _place(row, is_dry):
    word = "dry" if row["place"] == "plateau" and is_dry else row["place"]
    return f"{word or 'no plateau'} ({units.number(100 * float(row[WET]), 3)} %)"


def _is_drawable(table, friction):
    positive = (np.isfinite(table[name]) & (table[name] > 0) for name in (PRESSURE, DENSITY))
    return np.logical_and.reduce([*positive, np.isfinite(table[friction])])
