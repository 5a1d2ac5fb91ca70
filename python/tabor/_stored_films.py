"""Solutions and sweeps of films under load out of their files (docs/ehl.md)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ._groups import columns_of, numbers_of, plain, texts_of, warnings_in
from ._records import Warning, with_unit
from ._sweep import Sweep
from .ehl import Solution


def _facts(file: Any, values: Mapping[str, Any]) -> tuple[tuple[str, str], ...]:
    """Headings and numbers of a solution as the file says them."""
    columns = file["columns"]
    rows = zip(*(columns[name].asstr()[()] for name in ("key", "heading", "units")))
    return tuple((str(heading), with_unit(values[key], unit))
                 for key, heading, unit in rows if heading and isinstance(values.get(key), (int, float)))


def solution_in(file: Any, program: str) -> Solution:
    """The solution of one case."""
    values = numbers_of(file["result"])
    found = Solution.__new__(Solution)
    found.__dict__.update(_solved=None, program=program, _values=values, warnings=warnings_in(file), references=texts_of(file, "methods"),
                          facts=_facts(file, values), converged=bool(values.get("converged", True)), _columns=columns_of(file))
    return found


#: What the group of a sweep has beside its columns; files of earlier versions do not list those.
_BESIDE_COLUMNS = ("axes", "shape", "warnings", "warning_codes", "converged")


def _axes_in(group: Any) -> dict[str, tuple[Any, ...]]:
    """Values of each key, SI; words as they are."""
    axes: dict[str, tuple[Any, ...]] = {}
    for key in texts_of(group, "axes"):
        axis = group["axes"][key]
        axes[key] = texts_of(axis, "words") or tuple(float(one) for one in axis[()])
    return axes


def _units_in(group: Any) -> dict[str, str]:
    """SI units of the values of each key."""
    return {key: str(plain(group["axes"][key].attrs.get("units", ""))) for key in texts_of(group, "axes")}


def _warnings_of_cases(group: Any, kinds: Mapping[str, str]) -> list[tuple[Warning, ...]]:
    """Of each case; the file says the class of each code once."""
    texts, codes = (group[name].asstr()[()] for name in ("warnings", "warning_codes"))
    return [tuple(Warning(code, text, kinds.get(code, "doubt")) for code, text in zip(of_case.split(), lines.split("\n")))
            for of_case, lines in zip(codes, texts)]


def sweep_in(file: Any) -> Sweep:
    """The sweep with the numbers of its columns; limits are not in the file."""
    group = file["sweep"]
    axes, warnings = _axes_in(group), warnings_in(file)
    keys = texts_of(group, "columns") or tuple(key for key in group if key not in _BESIDE_COLUMNS)
    columns = tuple((key, *(str(plain(group[key].attrs.get(name, ""))) for name in ("long_name", "units"))) for key in keys)
    numbers = {key: group[key][()] for key, _, _ in columns}
    converged = group["converged"][()].astype(bool)
    of_cases = _warnings_of_cases(group, {one.code: one.kind for one in warnings})
    rows = tuple({**{key: axes[key][i] for key, i in zip(axes, place)},
                  **{key: None if np.isnan(values[row]) else float(values[row]) for key, values in numbers.items()},
                  "converged": bool(converged[row]), "warnings": of_cases[row]}
                 for row, place in enumerate(np.ndindex(*(len(values) for values in axes.values()))))
    found = Sweep.__new__(Sweep)
    found.__dict__.update(axes=axes, rows=rows, columns=columns, limits={}, warnings=warnings, references=texts_of(file, "methods"),
                          n_computed=0, _swept=None, _units=_units_in(group), converged=bool(converged.all()))
    return found
