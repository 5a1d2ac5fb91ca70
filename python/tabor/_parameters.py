"""Roughness parameters by their symbols."""

from __future__ import annotations

import json
import math
import pathlib
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import numpy as np

from . import _tabor
from ._arguments import Path, typed
from ._errors import InputError
from ._guesses import missing_key
from ._optional import needs
from ._records import Shown, Warning, said, table_html


class Parameter(float):
    """A roughness parameter: its number in SI, with everything that is needed to compare it with another program's.

    It computes as a float; NaN where the parameter does not exist.
    """

    symbol: str
    unit: str
    definition: str
    note: str
    set: str  #: "height", "hybrid", ...

    def __new__(cls, symbol: str, value: float, unit: str, definition: str, note: str, set: str) -> Parameter:
        made = super().__new__(cls, value)
        made.__dict__.update(symbol=symbol, unit=unit, definition=definition, note=note, set=set)
        return made

    @property
    def value(self) -> float:
        """The number alone, SI."""
        return float(self)

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError("a Parameter does not change")

    def __reduce__(self) -> tuple[Any, ...]:
        return Parameter, (self.symbol, float(self), self.unit, self.definition, self.note, self.set)

    def __repr__(self) -> str:
        return f"{self.symbol} = {float(self):.6g} {self.unit}".rstrip()


class Parameters(Shown, Mapping[str, Parameter]):
    """Roughness parameters in their order, by symbol: ``parameters["Sq"]`` or ``parameters.Sq``.

    A mapping: ``keys()``, ``values()``, ``items()`` and ``get()`` are those of a dict. A symbol that is not there is a
    KeyError that names the nearest.

    Examples
    --------
    >>> import tabor as tb
    >>> found = tb.generate("edt", pixels=64, seed=1).level("plane").parameters(["Sa", "Sq", "hybrid"])
    >>> list(found)
    ['Sa', 'Sq', 'Sdq', 'Sdr']
    >>> found.Sq > found["Sa"] > 0, found.Sq.unit, list(found.sets)
    (True, 'm', ['height', 'hybrid'])
    """

    source: str  #: file or name of the surface
    history: tuple[str, ...]  #: its treatment
    warnings: tuple[Warning, ...]  #: reasons to doubt the numbers

    def __init__(self, parameters: Iterable[Parameter], *, source: str = "", history: Iterable[str] = (),
                 warnings: Iterable[Warning] = ()) -> None:
        self.__dict__.update(_by_symbol={one.symbol: one for one in parameters}, source=source, history=tuple(history),
                             warnings=tuple(warnings))

    def _some(self, parameters: Iterable[Parameter]) -> Parameters:
        """Some of the same surface."""
        return Parameters(parameters, source=self.source, history=self.history, warnings=self.warnings)

    def __getitem__(self, symbol: str) -> Parameter:
        found: Parameter | None = self.__dict__["_by_symbol"].get(symbol)
        if found is None:
            raise missing_key("Parameters", symbol, self)
        return found

    def __iter__(self) -> Iterator[str]:
        return iter(self.__dict__["_by_symbol"])

    def __len__(self) -> int:
        return len(self.__dict__["_by_symbol"])

    def __getattr__(self, name: str) -> Any:
        if name in self.__dict__.get("_by_symbol", ()):
            return self[name]
        return super().__getattr__(name)

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError("a table of Parameters does not change")

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *self})

    @property
    def sets(self) -> dict[str, Parameters]:
        """The parameters of each set: "height", "spatial", "hybrid", ..."""
        names = dict.fromkeys(one.set for one in self.values())
        return {name: self._some(one for one in self.values() if one.set == name) for name in names}

    @typed
    def save(self, file: Path) -> None:
        """Writes them as ``tabor params --json`` does, into a file that ends with .json and that ``tabor.load`` takes. Raises
        ValueError for another ending, OSError where it cannot be written."""
        path = pathlib.Path(file)
        if path.suffix != ".json":
            raise ValueError(f"{path}: expected a name that ends with .json; tabor.parameters makes a table")
        _tabor.write_file(path, (json.dumps(self._json(), indent=2) + "\n").encode())

    def _json(self) -> dict[str, Any]:
        """As the command line says them; null is what does not exist."""
        numbers = {one.symbol: {"value": None if math.isnan(one) else float(one), "unit": one.unit, "definition": one.definition,
                                "set": one.set, "note": one.note} for one in self.values()}
        return {"tabor_version": _tabor.version, "command": "tabor.save", "scan": {"path": self.source},
                "treatment_history": list(self.history), "parameters": numbers,
                "warnings": [{"code": one.code, "class": one.kind, "text": one.text} for one in self.warnings]}

    def to_xarray(self) -> Any:
        """A Dataset with a number for each symbol, with ``units`` and ``definition``, warnings as its attribute; needs
        xarray."""
        xarray = needs("xarray", "to_xarray()")
        return xarray.Dataset({symbol: ((), np.float64(one), {"units": one.unit, "definition": one.definition, "set": one.set})
                               for symbol, one in self.items()}, attrs=said(self.warnings, ()))

    def __repr__(self) -> str:
        return "\n".join(f"{one.symbol:<8} {float(one):<14.6g} {one.unit:<6} {one.definition}" for one in self.values())

    def _repr_html_(self) -> str:
        return table_html("Parameters", [(one.symbol, f"{float(one):.6g} {one.unit}   {one.definition}") for one in self.values()])


def _warning_of(given: Any) -> Warning:
    return Warning(given["code"], given["text"], given["class"]) if isinstance(given, dict) else Warning("", given)


def parameters_in(file: Any, name: str) -> Parameters:
    """Those that ``save`` or ``tabor params --json`` wrote. Raises InputError for another file."""
    try:
        found = json.loads(pathlib.Path(file).read_text("utf-8"))
        numbers = [Parameter(symbol, math.nan if one["value"] is None else one["value"], one["unit"], one["definition"],
                             one.get("note", ""), one["set"]) for symbol, one in found["parameters"].items()]
        return Parameters(numbers, source=found["scan"]["path"], history=found["treatment_history"],
                          warnings=map(_warning_of, found["warnings"]))
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise InputError(f"{name}: no parameters of one scan, as Parameters.save and 'tabor params --json' write them") from error


def selected(every: Parameters, wanted: Iterable[str]) -> Parameters:
    """Those of some symbols and sets, in the order they are asked for. Raises ValueError for a name that is neither."""
    sets = every.sets
    found: dict[str, Parameter] = {}
    for name in wanted:
        if name not in every and name not in sets:
            near = missing_key("surface", name, [*every, *sets]).args[0].partition("; ")[2]
            raise ValueError(f"symbols: got {name!r}; expected some of {', '.join(every)}, or the sets {', '.join(sets)}"
                             + (f"; {near}" if near.startswith("did") else ""))
        found.update({name: every[name]} if name in every else sets[name])
    return every._some(found.values())
