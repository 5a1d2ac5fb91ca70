"""Roughness parameters by their symbols."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import numpy as np

from ._guesses import missing_key
from ._optional import needs
from ._records import Shown, table_html


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

    def __init__(self, parameters: Iterable[Parameter]) -> None:
        self.__dict__["_by_symbol"] = {one.symbol: one for one in parameters}

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
        return [*super().__dir__(), *self]

    @property
    def sets(self) -> dict[str, Parameters]:
        """The parameters of each set: "height", "spatial", "hybrid", ..."""
        names = dict.fromkeys(one.set for one in self.values())
        return {name: Parameters(one for one in self.values() if one.set == name) for name in names}

    def to_xarray(self) -> Any:
        """A Dataset with a number for each symbol, with ``units`` and ``definition``; needs xarray."""
        xarray = needs("xarray", "to_xarray()")
        return xarray.Dataset({symbol: ((), np.float64(one), {"units": one.unit, "definition": one.definition, "set": one.set})
                               for symbol, one in self.items()})

    def __repr__(self) -> str:
        return "\n".join(f"{one.symbol:<8} {float(one):<14.6g} {one.unit:<6} {one.definition}" for one in self.values())

    def _repr_html_(self) -> str:
        return table_html("Parameters", [(one.symbol, f"{float(one):.6g} {one.unit}   {one.definition}") for one in self.values()])


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
    return Parameters(found.values())
