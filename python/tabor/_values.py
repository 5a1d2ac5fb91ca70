"""Values as a user gives them: SI numbers, texts with a unit, or quantities of a package for units."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any, Protocol, Union

import numpy as np

from . import _tabor
from ._arguments import kind_of


class Quantity(Protocol):
    """A number, or an array, with its unit: of pint, astropy or unyt."""

    def to(self, unit: Any, /) -> Any:
        """The same in another unit."""


#: An SI number, a text with its unit ("7 MPa"), a quantity of pint, astropy or unyt, or a number of
#: xarray with the attribute ``units``.
Value = Union[float, int, str, "np.number[Any]", Quantity]

#: SI unit of each dimension, "kg/m^2".
_UNITS = _tabor.si_units()


def si(value: Value, dimension: str, name: str) -> float:
    """The SI number of a value.

    Raises ValueError for a text that is not understood, has no unit or one of another dimension,
    and for NaN; TypeError for what is neither number, text nor quantity.
    """
    if isinstance(value, str):
        return _tabor.parse_si(value, dimension, name)
    if type(value) is float:  # what studies and sweeps pass: the questions below take longer than some calls
        return _number(value, name)
    plain = in_si(value, dimension, name)
    if isinstance(plain, (bool, np.bool_)) or not isinstance(plain, (int, float, np.number, np.ndarray)):
        raise TypeError(f"{name}: got {kind_of(plain)}; expected an SI number, a text with its unit or a quantity")
    if np.ndim(plain) != 0:
        raise TypeError(f"{name}: got an array of shape {np.shape(plain)}; expected one number")
    if not isinstance(plain, (int, float)) and np.asarray(plain).dtype.kind not in "fiu":
        raise TypeError(f"{name}: got a number of type {np.asarray(plain).dtype}; expected a real one")
    try:
        return _number(float(plain), name)
    except OverflowError:
        raise ValueError(f"{name}: got a number beyond 1e308; expected a smaller one") from None


def _number(number: float, name: str) -> float:
    if math.isnan(number):
        raise ValueError(f"{name}: got NaN; expected a number")
    return number


def is_quantity(value: Any) -> bool:
    """A number or an array with its unit, of pint, astropy, unyt or another package like them."""
    return hasattr(value, "to") and any(hasattr(value, name) for name in ("magnitude", "unit", "units"))


def is_labelled(value: Any) -> bool:
    """An array of xarray."""
    return all(hasattr(value, name) for name in ("dims", "coords", "attrs", "values"))


def in_si(value: Any, dimension: str, name: str) -> Any:
    """The SI numbers of what carries its unit; anything else as it is."""
    if is_labelled(value):
        unit = value.attrs.get("units")
        if is_quantity(value.data):
            return in_unit(value.data, _UNITS[dimension], name)
        return value.values * _tabor.parse_si(f"1 {unit}", dimension, name) if unit else value.values
    return in_unit(value, _UNITS[dimension], name) if is_quantity(value) else value


def in_unit(value: Any, unit: str, name: str) -> Any:
    """The numbers of a quantity in this unit, "" for plain ones."""
    if is_labelled(value):
        value = value.data
    if not is_quantity(value):
        return value
    words = unit.replace("^", "**").replace(" ", "*")
    try:
        return value.to_value(words) if hasattr(value, "to_value") else value.to(words).magnitude
    except Exception as error:
        what = value if np.ndim(value) == 0 else f"an array in {getattr(value, 'units', getattr(value, 'unit', '?'))}"
        raise ValueError(f"{name}: got {what}; expected a quantity in {unit or 'no unit'}") from error


def optional_si(value: Value | None, dimension: str, name: str) -> float | None:
    """The same of a value that may be absent."""
    return None if value is None else si(value, dimension, name)


def si_list(values: Value | Iterable[Value], dimension: str, name: str) -> tuple[list[float], bool]:
    """SI numbers of one value or of many, of any kind that can be gone through in order, or of a text with a list or a
    range ("2 MPa..15 MPa:7"), and whether it was one alone."""
    plain = in_si(values, dimension, name)
    if isinstance(plain, str) and (".." in plain or "," in plain):
        return _tabor.parse_si_list(plain, dimension, name), False
    if _is_single(plain):
        return [si(plain, dimension, name)], True
    found = [si(value, dimension, name) for value in plain]
    if not found:
        raise ValueError(f"{name}: got an empty list; expected at least one value")
    return found, False


def _is_single(value: Any) -> bool:
    if isinstance(value, (str, bytes, Mapping, set, frozenset)) or not isinstance(value, Iterable):
        return True
    return isinstance(value, np.ndarray) and value.ndim == 0
