"""Values as a user gives them: SI numbers, texts with a unit, or quantities of pint."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, Union

import numpy as np

from . import _tabor

#: An SI number, a text with its unit ("7 MPa"), or anything with ``to(unit)`` and ``magnitude``,
#: as a quantity of pint.
Value = Union[float, int, str, Any]

_UNITS = {"length": "m", "wavevector": "1/m", "pressure": "Pa", "areal_density": "kg/m^2",
          "density": "kg/m^3", "speed": "m/s", "viscosity": "Pa*s", "per_pressure": "1/Pa",
          "none": ""}


def si(value: Value, dimension: str, name: str) -> float:
    """The SI number of a value.

    Raises ValueError for a text that is not understood, has no unit or one of another dimension,
    and for NaN; TypeError for what is neither number, text nor quantity.
    """
    if isinstance(value, str):
        return _tabor.parse_si(value, dimension, name)
    if type(value) is float:  # what studies and sweeps pass: the questions below take longer than some calls
        return _number(value, name)
    if hasattr(value, "to") and hasattr(value, "magnitude"):
        return _of_quantity(value, dimension, name)
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, float, np.number, np.ndarray)):
        raise TypeError(f"{name}: got {type(value).__name__}; expected an SI number, a text with "
                        "its unit or a quantity")
    if np.ndim(value) != 0:
        raise TypeError(f"{name}: got an array of shape {np.shape(value)}; expected one number")
    return _number(float(value), name)


def _number(number: float, name: str) -> float:
    if math.isnan(number):
        raise ValueError(f"{name}: got NaN; expected a number")
    return number


def _of_quantity(value: Any, dimension: str, name: str) -> float:
    unit = _UNITS[dimension]
    try:
        return float(value.to(unit).magnitude)
    except Exception as error:
        raise ValueError(f"{name}: got {value}; expected a quantity in {unit or 'no unit'}") from error


def optional_si(value: Value | None, dimension: str, name: str) -> float | None:
    """The same of a value that may be absent."""
    return None if value is None else si(value, dimension, name)


def si_list(values: Value | Sequence[Value], dimension: str, name: str) -> tuple[list[float], bool]:
    """SI numbers of one value or of many, and whether it was one alone."""
    if isinstance(values, str) or not hasattr(values, "__len__") or _is_single(values):
        return [si(values, dimension, name)], True
    several: Any = values
    found = [si(value, dimension, name) for value in several]
    if not found:
        raise ValueError(f"{name}: got an empty list; expected at least one value")
    return found, False


def _is_single(values: Any) -> bool:
    return np.ndim(getattr(values, "magnitude", values)) == 0 and not isinstance(values, (list, tuple))
