"""Result files as Python sees them: attributes, maps, histories and profiles (docs/results.md)."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from ._records import Warning

#: Switches, which files hold as 0 and 1.
_SWITCHES = ("converged", "_valid", "flooded", "_at_bound", "_settled", "gap_closing_at_turning")
#: Attributes that describe the file and not the result.
_OF_THE_FILE = ("NX_class", "axes", "signal", "DIMENSION_LIST", "REFERENCE_LIST", "CLASS", "NAME")
#: " (2 of 6 cases", which begins what a warning of several states ends in.
_CASES = re.compile(r"( \((?:both|all \d+|\d+ of \d+) cases)(?=.*\)$)")
#: What a curve runs over, where the file names no scale.
_SCALES = ("time", "x", "place", "radius", "level")


class Column(NamedTuple):
    """A dataset of a result file."""

    dims: tuple[str, ...]
    values: Any  #: array
    attributes: Mapping[str, str]  #: units and long_name


def plain(value: Any) -> Any:
    """A number or text as Python's own; arrays of texts as tuples."""
    if isinstance(value, bytes):
        return value.decode("utf-8")
    if isinstance(value, np.ndarray):
        return tuple(plain(one) for one in value.tolist())
    return value.item() if isinstance(value, np.generic) else value


def numbers_of(group: Any) -> dict[str, Any]:
    """The attributes of a state or of a result by the names of ``--json``; tables inside as dicts."""
    found: dict[str, Any] = {}
    for key, value in group.attrs.items():
        if key not in _OF_THE_FILE:
            is_switch = any(key.endswith(end) for end in _SWITCHES)
            found[key] = bool(value) if is_switch else list(plain(value)) if isinstance(value, np.ndarray) else plain(value)
    found.update({key: numbers_of(one) for key, one in group.items() if hasattr(one, "items")})
    return found


def texts_of(group: Any, name: str) -> tuple[str, ...]:
    """A list of texts among the attributes; empty where there is none."""
    return tuple(str(one) for one in plain(group.attrs[name])) if name in group.attrs else ()


def warnings_in(file: Any) -> tuple[Warning, ...]:
    """Warnings of the whole file, each with its code at the end of the line."""
    found = []
    for text, kind in zip(texts_of(file, "warnings"), texts_of(file, "warning_classes")):
        said, _, code = text.rpartition(" [")
        found.append(Warning(code.removesuffix("]"), said, kind) if said else Warning("", text, kind))
    return tuple(found)


def of_a_file(one: Warning) -> Warning:
    """A warning of one state, whose text was gathered from all states: "(all 6 cases of the file, the worst shown)"."""
    return one._replace(text=_CASES.sub(r"\1 of the file", one.text))


def _dims_of(dataset: Any, group: Any, name: str) -> tuple[str, ...]:
    scales = [dataset.dims[i][0].name.rpartition("/")[2] if len(dataset.dims[i]) else "" for i in range(dataset.ndim)]
    for i, scale in enumerate(scales):
        if not scale:
            fitting = [one for one in _SCALES if one in group and group[one].shape == (dataset.shape[i],) and one not in scales]
            scales[i] = fitting[0] if fitting else f"index{i}"
    return tuple(f"{name}_{scale}" for scale in scales)


def columns_of(file: Any) -> dict[str, Column]:
    """Histories, profiles and maps of a solution by ``group_name``, "contact_film"."""
    found: dict[str, Column] = {}
    for name, group in file.items():
        if name in ("columns", "result") or not hasattr(group, "items"):
            continue
        for key, dataset in group.items():
            if getattr(dataset, "ndim", 0) and dataset.dtype.kind in "fiu":
                attributes = {one: str(plain(dataset.attrs[one])) for one in ("units", "long_name") if one in dataset.attrs}
                found[f"{name}_{key}"] = Column(_dims_of(dataset, group, name), dataset[()], {k: v for k, v in attributes.items() if v})
    return found
