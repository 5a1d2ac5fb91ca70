"""Friction against the lubricant's density, as a result file holds it, and the sentences that say what it shows."""

import itertools

import h5py
import numpy as np

from tabor_report import hdf
from tabor_report.friction_series import DENSITY
from tabor_report.table import Table

PRESSURE = "mean_pressure_Pa"
_LEFT_OUT = "the figure of friction against density is left out"


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


def _problem(node, names):
    """Why the table cannot be drawn; "" if it can."""
    if not isinstance(node, h5py.Group):
        return "got no table"
    columns = hdf.columns({name: node[name] for name in names if name in node})
    missing = [name for name in names if name not in columns]
    if missing:
        return f"the column {missing[0]} is missing"
    lengths = {column.shape for column in columns.values()}
    if len(lengths) > 1 or len(next(iter(lengths))) != 1:
        return "its columns are not of one length"
    texts = [name for name in names[1:] if columns[name].dtype.kind not in "fiu"]
    return f"the column {texts[0]} holds no numbers" if texts else ""


def _is_drawable(table, friction):
    positive = (np.isfinite(table[name]) & (table[name] > 0) for name in (PRESSURE, DENSITY))
    return np.logical_and.reduce([*positive, np.isfinite(table[friction])])
