"""Films under load: cases of ``tabor ehl`` (docs/ehl.md, docs/ehl_line.md, docs/ehl_point.md).

A case is a file, or a mapping of its keys; settings override them, as ``--set`` does:

>>> import tabor as tb
>>> case = tb.ehl.squeeze(tb.ehl.template("squeeze"))
>>> case.solve().converged
True
"""

from __future__ import annotations

import json
import math
import os
import pathlib
import tempfile
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, Literal, NamedTuple, Union

import numpy as np

from . import _tabor
from ._arguments import Count, Path, Seed, mapping, path, typed, wrong
from ._contact import NotConverged
from ._doubts import tell
from ._errors import require_file
from ._groups import Column, columns_of
from ._guesses import Named, Values, missing_name
from ._optional import needs
from ._progress import Progress, watching
from ._records import Shown, Warning, plain_attributes, said, warnings_of
from ._sweep import Limit, Sweep
from ._values import in_unit, is_labelled

__all__ = ["Case", "Key", "Limit", "Solution", "Sweep", "Template", "impact", "keys", "line", "point", "squeeze", "template"]


#: Programs of ``tabor ehl``.
Program = Literal["impact", "squeeze", "line", "point"]
#: What a case may be varied in to see how far its numbers depend on it.
Varied = Literal["grid", "domain", "time-step"]


class Template(str):
    """The text of a case file."""


#: A case file, its keys, plain ("ball.radius") or in tables, or the text of one.
Source = Union[str, "os.PathLike[str]", Mapping[str, Any], Template]


class Key(NamedTuple):
    """One key of a case."""

    name: str
    unit: str
    usual: str  #: value if it is not given
    meaning: str


class Solution(Shown):
    """What was found out about a case. It does not change."""

    facts: tuple[tuple[str, str], ...]  #: the same for people
    warnings: tuple[Warning, ...]  #: reasons to doubt them
    references: tuple[str, ...]  #: what to cite
    converged: bool
    program: Program

    def __init__(self, solved: _tabor.SolvedCase, program: Program) -> None:
        self.__dict__.update(_solved=solved, program=program, _values=json.loads(solved.json), warnings=warnings_of(solved.warnings),
                             facts=tuple(solved.facts), references=tuple(solved.references), converged=solved.converged)

    @property
    def values(self) -> Mapping[str, Any]:
        """Numbers by the names of ``--json``, whose endings are the units; tables as dicts."""
        return Values(self.__dict__["_values"], "Solution")

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError("a Solution does not change")

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_solved": None}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)

    @typed
    def save(self, file: Path) -> None:
        """Writes the file of ``tabor ehl -o``, with histories and profiles, which ends with .h5. Raises OSError, and
        ValueError for another ending and for a solution that came out of a pickle, which has its numbers alone."""
        target = pathlib.Path(file)
        if target.suffix not in (".h5", ".hdf5"):
            raise ValueError(f"{target}: expected a name that ends with .h5 or .hdf5")
        if self._solved is None:
            raise ValueError("save: histories and profiles do not travel with a pickle; save it where it is solved")
        self._solved.save(target)

    def _all_columns(self) -> Mapping[str, Column]:
        """Histories, profiles and maps as the file of ``save`` has them."""
        found: Mapping[str, Column] | None = self.__dict__.get("_columns")
        if found is None:
            if self._solved is None:
                raise ValueError("to_xarray: histories and profiles do not travel with a pickle; take them where it is solved")
            h5py = needs("h5py", "to_xarray()")
            with tempfile.TemporaryDirectory() as folder:
                path = pathlib.Path(folder, "solution.h5")
                self.save(path)
                with h5py.File(path) as file:
                    found = self.__dict__["_columns"] = columns_of(file)
        return found

    def to_xarray(self) -> Any:
        """Histories, profiles and maps as a Dataset with units, ``contact_film`` over ``contact_y`` and ``contact_x``,
        numbers and warnings as its attributes, to be written as NetCDF; needs xarray and h5py. Raises ValueError for a
        solution that came out of a pickle, which has its numbers alone."""
        xarray = needs("xarray", "to_xarray()")
        columns = {name: (one.dims, one.values, dict(one.attributes)) for name, one in self._all_columns().items()}
        coords = {name: one for name, one in columns.items() if one[0] == (name,)}
        return xarray.Dataset({name: one for name, one in columns.items() if name not in coords}, coords,
                              {**plain_attributes(self.values), **said(self.warnings, self.references)})

    def _lines(self) -> list[tuple[str, str]]:
        return [*((heading, text) for heading, text in self.facts if text), *(("warning", warning.text) for warning in self.warnings)]

    def _title(self) -> str:
        return f"Solution of ehl {self.program}"


class Case(Named):
    """A case that can be solved, and pickled for process pools. Raises ValueError for one that makes no sense: keys that
    are unknown or missing, values out of range or of another dimension."""

    @typed
    def __init__(self, program: Program, source: Source, settings: Mapping[str, Any]) -> None:
        if not isinstance(source, (str, os.PathLike, Mapping)):
            raise wrong("case", source, "a case file, its keys as a mapping, or tabor.ehl.template(...)")
        units = _units(program)
        overrides = [(key, _toml(value, units.get(key), key)) for key, value in _flat(mapping(settings, "settings"))]
        if isinstance(source, Mapping):
            overrides = [(key, _toml(value, units.get(key), key)) for key, value in _flat(mapping(source, "case"))] + overrides
            self._case = _tabor.parse_case(program, "", "case", overrides)
        elif isinstance(source, Template):
            self._case = _tabor.parse_case(program, source, "case", overrides)
        else:
            require_file(path(source, "case"))
            self._case = _tabor.read_case(program, os.fspath(source), overrides)
        self.program = program
        self._name = "case" if isinstance(source, (Mapping, Template)) else os.path.abspath(source)

    @property
    def toml(self) -> str:
        """The case as the text of its file."""
        return self._case.toml

    def __getstate__(self) -> tuple[Program, str, str]:
        return self.program, self._name, self.toml

    def __setstate__(self, state: tuple[Program, str, str]) -> None:
        self.program, self._name, text = state
        self._case = _tabor.parse_case(self.program, text, self._name, [])

    def __repr__(self) -> str:
        return f"Case of ehl {self.program}\n{self.toml}"

    @typed
    def solve(self, *, seed: Seed = 1, check: bool = True, progress: Progress = None) -> Solution:
        """Solves it. ``seed`` is that of generated surfaces whose case names none. Raises ValueError for values
        out of range, NotConverged unless ``check`` is False."""
        with watching(progress) as told:
            found = Solution(_tabor.solve_case(self._case, seed, told), self.program)
        if check and not found.converged:
            raise NotConverged(f"ehl {self.program}: the film does not converge; check=False returns it all the same", found)
        tell(found.warnings)
        return found

    @typed
    def sweep(self, values: Mapping[str, Iterable[Any]], *, folder: Path | None = None, seed: Seed = 1,
              jobs: Count = 0, retry: bool = False, check: bool = True, progress: Progress = None) -> Sweep:
        """Solves it with all combinations of the values of some keys, as ``tabor ehl --set KEY=V1,V2`` does: speeds of
        point and line contacts from the highest one down, each film starting from the one before.

        Parameters
        ----------
        values : lists of values by key: ``{"motion.speed": np.geomspace(1e-3, 10, 9)}``.
        folder : where finished cases are kept; the same call goes on from there when it was stopped [nowhere].
        seed : of generated surfaces whose case names none.
        jobs : chains at the same time [as many as there are threads and room for].
        retry : what failed or did not converge is computed again.
        check : raise NotConverged where a film does not converge; its ``result`` is the sweep.

        Raises
        ------
        ValueError
            For keys that no case has, for lists without a value, and where no case makes sense.
        NotConverged
            Unless ``check`` is False.
        """
        given = {key: list(many) for key, many in _lists(values)}
        units = _units(self.program)
        axes = [(key, [_plain(_toml(one, units.get(key), key)) for one in many]) for key, many in given.items()]
        with watching(progress) as told:
            swept = _tabor.sweep_case(self._case, axes, seed, None if folder is None else pathlib.Path(folder), jobs,
                                      retry, told)
        return self._swept(swept, given, check)

    @typed
    def study(self, name: Varied = "grid", *, seed: Seed = 1, jobs: Count = 0, check: bool = True,
              progress: Progress = None) -> Sweep:
        """How far the result depends on the grid, as ``tabor ehl --study`` does: the case with coarser and finer ones
        around its own, each solved by itself; ``limits`` are what the numbers tend to.

        Parameters
        ----------
        name : "grid"; some programs have "domain" or "time-step" as well, "squeeze" has none.
        seed, jobs, check, progress : as those of ``sweep``.

        Raises
        ------
        ValueError
            For a study that the program does not have, and for a case that makes no sense.
        NotConverged
            Unless ``check`` is False.
        """
        with watching(progress) as told:
            swept = _tabor.vary_case(self._case, name, seed, jobs, told)
        return self._swept(swept, {}, check)

    def _swept(self, swept: _tabor.SweptCases, given: Mapping[str, list[Any]], check: bool) -> Sweep:
        found = Sweep(swept, given, _units(self.program), tuple(_tabor.case_references(self._case)))
        if check and not found.converged:
            errors = [row["error"] for row in found.rows if "error" in row]
            bad = sum(not row["converged"] for row in found.rows) - len(errors)
            met = [*([f"{bad} of {len(found.rows)} films do not converge"] if bad else []),
                   *([f"{len(errors)} of {len(found.rows)} cases {'is' if len(errors) == 1 else 'are'} invalid ({errors[0]})"] if errors else [])]
            raise NotConverged(f"ehl {self.program}: {', '.join(met)}; check=False returns the others", found)
        tell(found.warnings)
        return found


def _lists(values: Mapping[str, Iterable[Any]]) -> Iterator[tuple[str, list[Any]]]:
    if not mapping(values, "values"):
        raise ValueError("values: got no key; expected lists of values by key")
    for key, many in values.items():
        if isinstance(many, (str, bytes, Mapping)) or not isinstance(many, Iterable) or np.ndim(getattr(many, "magnitude", ())) == 0:
            raise ValueError(f"values: {key}: got {many!r}; expected a list of values")
        found = [one.item() if isinstance(one, np.generic) else one for one in many]
        if not found:
            raise ValueError(f"values: {key}: got an empty list; expected at least one value")
        yield key, found


def _flat(settings: Mapping[str, Any], before: str = "") -> Iterator[tuple[str, Any]]:
    for key, value in settings.items():
        if isinstance(value, Mapping):
            yield from _flat(mapping(value, f"{before}{key}"), f"{before}{key}.")
        else:
            yield before + key, value


def _units(program: str) -> dict[str, str]:
    """Of each key, "m/s"; "" for plain numbers and words."""
    return {name: unit for name, unit, *_ in _tabor.case_keys(program)}


def _toml(value: Any, unit: str | None, key: str) -> str:
    """TOML, whose numbers, texts, switches and lists are those of JSON; a number of a key with a unit is SI, and a
    quantity is taken in that unit. No case has a key whose unit is None."""
    if unit is None:
        return json.dumps(str(value))
    if isinstance(value, (list, tuple)):
        return f"[{', '.join(_toml(one, unit, key) for one in value)}]"
    if is_labelled(value) and value.attrs.get("units"):
        return json.dumps(f"{float(value)!r} {value.attrs['units']}")
    value = in_unit(value, unit, key)
    value = value.item() if isinstance(value, (np.generic, np.ndarray)) and np.ndim(value) == 0 else value
    if isinstance(value, float) and not math.isfinite(value):
        raise ValueError(f"{key}: got {value}; expected a finite number")
    if unit and isinstance(value, (int, float)) and not isinstance(value, bool):
        return json.dumps(f"{float(value)!r} {unit}")
    if not isinstance(value, (str, int, float, os.PathLike)):
        raise wrong(key, value, "a number, a text with its unit or a quantity" if unit else "a number, a text or a switch")
    return json.dumps(os.fspath(value) if isinstance(value, os.PathLike) else value)


def _plain(toml: str) -> str:
    """A text without its quotes, as an axis of a sweep has it."""
    return str(json.loads(toml)) if toml.startswith('"') else toml


def impact(case: Source, **settings: Any) -> Case:
    """A ball falls on a lubricated flat.

    Parameters
    ----------
    case : a case file, its keys as a mapping, or ``template("impact")``.
    settings : keys that override those of the case, with their units: ``**{"motion.speed": "0.1 m/s"}``.

    Returns
    -------
    Case
        That can be solved, swept over values and varied in its grid.

    Raises
    ------
    ValueError
        For unknown keys, with the nearest one, and for values that make no sense.

    Examples
    --------
    >>> import tabor as tb
    >>> tb.ehl.impact(tb.ehl.template("impact")).program
    'impact'
    """
    return Case("impact", case, settings)


def squeeze(case: Source, **settings: Any) -> Case:
    """A roller closes on a sliding flat.

    Parameters
    ----------
    case : a case file, its keys as a mapping, or ``template("squeeze")``.
    settings : keys that override those of the case, with their units: ``**{"motion.speed": "0.1 m/s"}``.

    Returns
    -------
    Case
        That can be solved, swept over values and varied in its grid.

    Raises
    ------
    ValueError
        For unknown keys, with the nearest one, and for values that make no sense.

    Examples
    --------
    >>> import tabor as tb
    >>> tb.ehl.squeeze(tb.ehl.template("squeeze")).program
    'squeeze'
    """
    return Case("squeeze", case, settings)


def line(case: Source, **settings: Any) -> Case:
    """A line contact, smooth, rough or worn.

    Parameters
    ----------
    case : a case file, its keys as a mapping, or ``template("line")``.
    settings : keys that override those of the case, with their units: ``**{"motion.speed": "0.1 m/s"}``.

    Returns
    -------
    Case
        That can be solved, swept over values and varied in its grid.

    Raises
    ------
    ValueError
        For unknown keys, with the nearest one, and for values that make no sense.

    Examples
    --------
    >>> import tabor as tb
    >>> tb.ehl.line(tb.ehl.template("line")).program
    'line'
    """
    return Case("line", case, settings)


def point(case: Source, **settings: Any) -> Case:
    """A point contact, smooth or rough.

    Parameters
    ----------
    case : a case file, its keys as a mapping, or ``template("point")``.
    settings : keys that override those of the case, with their units: ``**{"motion.speed": "0.1 m/s"}``.

    Returns
    -------
    Case
        That can be solved, swept over values and varied in its grid.

    Raises
    ------
    ValueError
        For unknown keys, with the nearest one, and for values that make no sense.

    Examples
    --------
    >>> import tabor as tb
    >>> tb.ehl.point(tb.ehl.template("point")).program
    'point'
    """
    return Case("point", case, settings)


@typed
def keys(program: Program) -> tuple[Key, ...]:
    """All keys of the cases of a program.

    Parameters
    ----------
    program : "impact", "squeeze", "line" or "point".

    Returns
    -------
    tuple of Key
        With names, units, defaults and meanings.

    Examples
    --------
    >>> import tabor as tb
    >>> [one.unit for one in tb.ehl.keys("point") if one.name == "motion.speed"]
    ['m/s']
    """
    return tuple(Key(*row) for row in _tabor.case_keys(program))


@typed
def template(program: Program) -> Template:
    """A case to start from, with every key there is.

    Parameters
    ----------
    program : "impact", "squeeze", "line" or "point".

    Returns
    -------
    Template
        The text of a case file.

    Examples
    --------
    >>> import tabor as tb
    >>> "viscosity" in tb.ehl.template("squeeze")
    True
    """
    return Template(_tabor.case_template(program))

for _class in (Limit, Sweep):
    _class.__module__ = "tabor.ehl"
del _class


def __getattr__(name: str) -> object:
    if name.startswith("_"):
        raise AttributeError(f"module 'tabor.ehl' has no attribute {name!r}", name=name)
    raise missing_name("tabor.ehl", name, __all__)


def __dir__() -> list[str]:
    return list(__all__)
