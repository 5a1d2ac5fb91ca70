"""Sweeps of films under load over values of their case."""

from __future__ import annotations

import json
import pathlib
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np

from . import _tabor
from ._arguments import Axes, Path, typed
from ._guesses import missing_key
from ._maps import Array
from ._optional import needs
from ._records import Shown, Warning, said, warnings_of


_CONVERGED, _REJECTED = "converged", "rejected"


class Limit(NamedTuple):
    """What a number tends to on ever finer grids, by the three finest (Richardson); NaN where they show no limit."""

    value: float
    order: float  #: p of the error ~ spacing^p that they show; NaN where the number does not depend on the grid


class Sweep(Shown):
    """What was found out about a case with each combination of some values, the last one fastest. It does not
    change."""

    axes: Mapping[str, tuple[Any, ...]]  #: keys of the case with their values, SI; words as they are
    rows: tuple[Mapping[str, Any], ...]  #: one for each case: its values and numbers, ``converged``, ``warnings``; a rejected one has ``status`` and ``error``
    columns: tuple[tuple[str, str, str], ...]  #: (key, heading, unit) of the numbers that say most
    limits: Mapping[str, Limit]  #: of the columns, where one key was varied that refines the grid
    warnings: tuple[Warning, ...]  #: reasons to doubt them, each said once
    references: tuple[str, ...]  #: what to cite
    n_computed: int  #: cases; the others were in the folder
    converged: bool  #: all of them

    def __init__(self, swept: _tabor.SweptCases, given: Mapping[str, list[Any]], units: Mapping[str, str],
                 references: tuple[str, ...]) -> None:
        axes = {key: tuple(given[key] if any(map(_is_word, given.get(key, ()))) else numbers)
                for key, numbers in swept.axes}
        cases = [({**json.loads(text), "converged": status == _CONVERGED, **({"status": status, "error": error} if status == _REJECTED else {})},
                  warnings_of(warnings)) for text, status, error, warnings in swept.cases]
        places = np.ndindex(*(len(values) for values in axes.values()))
        rows = tuple({**{key: axes[key][i] for key, i in zip(axes, place)}, **values, "warnings": warnings}
                     for place, (values, warnings) in zip(places, cases))
        limits = {key: Limit(*limit) for (key, _, _), limit in zip(swept.columns, swept.limits)}
        self.__dict__.update(axes=axes, rows=rows, columns=tuple(swept.columns), limits=limits, warnings=warnings_of(swept.warnings),
                             references=references, n_computed=swept.n_computed, _swept=swept, _units={key: units.get(key, "") for key in axes},
                             converged=all(row["converged"] for row in rows))

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError("a Sweep does not change")

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_swept": None}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)

    @typed
    def save(self, file: Path) -> None:
        """Writes what ``tabor ehl`` writes of a sweep: the file of ``-o``, which ends with .h5 and which ``report``
        draws curves of, without limits, or the table of ``--csv``, which ends with .csv. Raises OSError, and ValueError for other
        endings and for a sweep that came out of a pickle, which has its numbers alone."""
        path = pathlib.Path(file)
        if path.suffix not in (".h5", ".hdf5", ".csv"):
            raise ValueError(f"{path}: expected a name that ends with .h5, .hdf5 or .csv")
        if self.__dict__["_swept"] is None:
            raise ValueError("save: what a file is made of does not travel with a pickle; save it where it is swept")
        self.__dict__["_swept"].save(path)

    def _unit(self, key: str) -> str:
        """SI unit of the values of an axis; "" for plain numbers and words."""
        is_word = any(isinstance(one, str) for one in self.axes[key])
        return "" if is_word else self.__dict__.get("_units", {}).get(key, "")

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of values on each axis."""
        return tuple(len(values) for values in self.axes.values())

    def __getitem__(self, key: str) -> Array:
        """One number of all cases, in the shape of the axes, NaN where a case has none; "wear.mean_depth_m" is
        that of a table inside. Raises KeyError for what no case has, with the nearest name."""
        found = self._column(key)
        if found is None:
            raise missing_key("Sweep", key, self.keys())
        return found

    def __getattr__(self, name: str) -> Any:
        """``sweep.central_film_m`` is ``sweep["central_film_m"]``."""
        found = None if name.startswith("_") or "rows" not in self.__dict__ else self._column(name)
        return super().__getattr__(name) if found is None else found

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *(key for key in self.keys() if key.isidentifier())})

    def keys(self) -> tuple[str, ...]:
        """Names of the numbers of the cases, those of tables inside with a dot."""
        return tuple(dict.fromkeys(key for row in self.rows for key in _names(row)))

    def _column(self, key: str) -> Array | None:
        found = [_inside(row, key) for row in self.rows]
        if all(one is None for one in found) or any(isinstance(one, (str, tuple, list, Mapping)) for one in found):
            return None
        return np.array([np.nan if one is None else one for one in found], dtype=np.float64).reshape(self.shape)

    @typed
    def plot(self, field: str | None = None, ax: Axes = None, **style: Any) -> Any:
        """Draws one number over the first axis, a line for each combination of the others; needs matplotlib. Returns
        the axes.

        Parameters
        ----------
        field : name of the number, "central_film_m" [the first of ``columns``].
        ax : axes of matplotlib [the current ones].
        style : of the lines, as ``Axes.plot`` takes it.

        Raises
        ------
        ValueError
            For a number that no case has, with the nearest name.
        """
        key = self.columns[0][0] if field is None else field
        if self._column(key) is None:
            raise ValueError(f"field: {missing_key('Sweep', key, self.keys())}")
        (first, values), *others = self.axes.items()
        lines = self[key].reshape(len(values), -1)
        ax = ax or needs("matplotlib.pyplot", "plot()").gca()
        for line, place in zip(lines.T, np.ndindex(*(len(many) for _, many in others))):
            said_by = ", ".join(f"{name} = {_text(many[i], self._unit(name))}" for (name, many), i in zip(others, place))
            ax.plot(_coordinate(values), line, **{"label": said_by or None, "marker": ".", **style})
        if not any(isinstance(one, str) for one in values) and min(values) > 0 and max(values) >= 10 * min(values):
            ax.set_xscale("log")
        heading, unit = next(((text, unit) for name, text, unit in self.columns if name == key), (key, ""))
        ax.set_xlabel(_label(first, self._unit(first)))
        ax.set_ylabel(_label(heading or key, unit))
        if others:
            ax.legend()
        return ax

    @property
    def table(self) -> Any:
        """The rows as a DataFrame; needs pandas."""
        return needs("pandas", "table").DataFrame(list(self.rows))

    def to_xarray(self) -> Any:
        """The columns and whether films converged as a Dataset over the axes, warnings as its attribute, to be
        written as NetCDF; needs xarray."""
        xarray = needs("xarray", "to_xarray()")
        dims = tuple(self.axes)
        columns: dict[str, Any] = {key: (dims, self[key], {"long_name": heading, "units": unit})
                                   for key, heading, unit in self.columns}
        columns["converged"] = (dims, self["converged"].astype(np.int8))
        return xarray.Dataset(columns, coords={key: (key, _coordinate(values), {"units": self._unit(key)} if self._unit(key) else {})
                                       for key, values in self.axes.items()},
                              attrs=said(self.warnings, self.references))

    def _lines(self) -> list[tuple[str, str]]:
        good = sum(row["converged"] for row in self.rows)
        lines = [(key, f"{', '.join(map(_text, values))} {self._unit(key)}".rstrip()) for key, values in self.axes.items()]
        heading = {key: text for key, text, _ in self.columns}
        lines += [(f"limit of {heading[key]}", f"{limit.value:.6g}" + (f" (order {limit.order:.2g})" if np.isfinite(limit.order) else ""))
                  for key, limit in self.limits.items() if np.isfinite(limit.value)]
        return [*lines, ("converged", f"{good} of {len(self.rows)}"), *(("warning", warning.text) for warning in self.warnings)]


def _coordinate(values: tuple[Any, ...]) -> list[Any]:
    """Of one type: words, where there is one."""
    return [str(one) for one in values] if any(isinstance(one, str) for one in values) else list(values)


def _is_word(value: Any) -> bool:
    """No number, and no text of one with its unit."""
    return isinstance(value, str) and not value.lstrip(" +-.")[:1].isdigit()


def _inside(row: Mapping[str, Any], key: str) -> Any:
    if key in row:
        return row[key]
    table, _, rest = key.partition(".")
    inner = row.get(table)
    return _inside(inner, rest) if rest and isinstance(inner, Mapping) else None


def _text(value: Any, unit: str = "") -> str:
    return f"{value:g} {unit}".rstrip() if isinstance(value, float) else str(value)


def _label(text: str, unit: str) -> str:
    """A heading with its unit, for an axis of a plot."""
    return f"{text} [{unit}]" if unit else text


def _names(row: Mapping[str, Any], before: str = "") -> Iterator[str]:
    """Names of the numbers of a row."""
    for key, value in row.items():
        if isinstance(value, Mapping):
            yield from _names(value, f"{before}{key}.")
        elif isinstance(value, (bool, int, float)):
            yield before + key
