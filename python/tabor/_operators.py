"""Arithmetic of surfaces with numbers, arrays and each other, and the parts of a surface that a slice names."""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Self

import numpy as np

from . import _tabor
from ._arguments import kind_of
from ._heights import Array, checked
from ._values import is_labelled, is_quantity, si

_WORDS = {"add": "plus", "subtract": "minus", "multiply": "times", "divide": "divided by"}


class Operators:
    """Arithmetic for Surface, which has ``height``, ``pixel`` and ``_derived``."""

    if TYPE_CHECKING:
        @property
        def height(self) -> Array:
            """Heights [m]."""

        @property
        def name(self) -> str:
            """What the history calls it."""

    #: Operators of arrays and numbers of NumPy leave the work to the surface.
    __array_priority__ = 1000

    def _derived(self, heights: Array, note: str, second: Any = None) -> Self:
        raise NotImplementedError

    def _other(self, other: Any, action: str) -> tuple[Any, str, Any]:
        """(heights or number, what the history calls it, the surface if it is one)."""
        if isinstance(other, Operators):
            if action not in ("add", "subtract"):
                raise TypeError(f"Surface: got a Surface to {action} by; expected a number")
            require_same_grid(self, other)
            return other.height, other.name, other
        if isinstance(other, np.ndarray) and other.ndim > 0:
            heights = checked(other, "array")
            if heights.shape != self.height.shape:
                raise ValueError(f"array: got shape {heights.shape}; expected that of the surface, {self.height.shape}")
            return heights, "an array", None
        if action in ("add", "subtract"):
            number = si(other, "length", "height")
            return number, _tabor.format_si(number, "m"), None
        number = si(other, "none", "factor")
        return number, f"{number:.6g}", None

    def _with(self, other: Any, action: str, compute: Callable[[Any, Any], Array]) -> Self:
        value, name, second = self._other(other, action)
        return self._derived(compute(self.height, value), f"{_WORDS[action]} {name}", second)

    def __add__(self, other: Any) -> Self:
        return self._with(other, "add", operator.add) if is_operand(other) else NotImplemented

    __radd__ = __add__

    def __sub__(self, other: Any) -> Self:
        return self._with(other, "subtract", operator.sub) if is_operand(other) else NotImplemented

    def __rsub__(self, other: Any) -> Self:
        if not is_operand(other):
            return NotImplemented
        value, name, _ = self._other(other, "subtract")
        return self._derived(value - self.height, f"turned over, plus {name}")

    def __mul__(self, other: Any) -> Self:
        return self._with(other, "multiply", operator.mul) if is_operand(other) else NotImplemented

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Self:
        return self._with(other, "divide", _divided) if is_operand(other) else NotImplemented

    def __neg__(self) -> Self:
        return self._derived(-self.height, "turned over")

    def __pos__(self) -> Self:
        return self


def _divided(heights: Array, by: Any) -> Array:
    if np.any(np.asarray(by) == 0):
        raise ValueError("factor: got a division by zero")
    found: Array = heights / by
    return found


def is_operand(value: Any) -> bool:
    """A surface, an array, a number, a text with its unit or a quantity."""
    return isinstance(value, (Operators, np.ndarray, np.number, int, float, str)) and not isinstance(value, bool) \
        or is_quantity(value) or is_labelled(value)


def require_same_grid(first: Any, second: Any) -> None:
    """ValueError where two surfaces have other pixels."""
    if first.height.shape != second.height.shape:
        raise ValueError(f"Surface: got surfaces of shape {first.height.shape} and {second.height.shape}; expected one grid; "
                         "tabor.combine registers two scans")
    for axis, one, other in zip("xy", first.pixel, second.pixel):
        if abs(one - other) > 1e-6 * one:
            raise ValueError(f"Surface: got pixels of {one:g} m and {other:g} m along {axis}; expected one grid")


def _bounds(index: Any, n: int, axis: str) -> tuple[int, int]:
    """First and end of the pixels that a slice names."""
    if not isinstance(index, slice):
        raise TypeError(f"Surface: got {kind_of(index)} along {axis}; expected slices, surface[10:200, 5:100], which are a "
                        "surface; surface.height[...] takes any index and is an array")
    try:
        first, end, step = index.indices(n)
    except TypeError as error:
        raise TypeError(f"Surface: got a slice along {axis} that is not of whole numbers; expected pixels") from error
    if step != 1:
        raise ValueError(f"Surface: got a step of {step} along {axis}; expected none: resample(\"nx,ny\") changes the pixels, "
                         'flip("x") the direction')
    if end <= first:
        raise ValueError(f"Surface: got the pixels {first} to {end} along {axis}; expected at least one of {n}")
    return first, end


def part_of(index: Any, shape: tuple[int, int]) -> tuple[int, int, int, int]:
    """x0, y0, nx and ny of the pixels that an index names: slices along y and x."""
    parts = list(index) if isinstance(index, tuple) else [index]
    if Ellipsis in [one for one in parts if isinstance(one, type(Ellipsis))]:
        at = next(i for i, one in enumerate(parts) if one is Ellipsis)
        parts[at:at + 1] = [slice(None)] * (3 - len(parts))
    if len(parts) > 2:
        raise IndexError(f"Surface: got {len(parts)} indices; expected two, along y and x")
    parts += [slice(None)] * (2 - len(parts))
    (y0, y1), (x0, x1) = (_bounds(one, n, axis) for one, n, axis in zip(parts, shape, "yx"))
    return x0, y0, x1 - x0, y1 - y0
