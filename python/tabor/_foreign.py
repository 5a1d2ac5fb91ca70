"""Surfaces and arrays of other packages, known by what they have and not by their type."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from . import _tabor
from ._values import in_si, is_labelled, is_quantity


class Foreign(NamedTuple):
    """What a Surface is made of."""

    heights: Any  #: in ``unit``, shape (ny, nx), row 0 on top
    pixel: tuple[float, float]  #: along x and y [m]
    unit: str
    periodic: bool


def _metres(unit: Any, name: str) -> float:
    if not unit:
        raise ValueError(f"{name}: it has no unit; give tabor.Surface its heights and pixel")
    return _tabor.parse_si(f"1 {unit}", "length", name)


def _of_surface_topography(other: Any) -> Foreign:
    heights = np.asanyarray(other.heights()).T  # [x, y] there
    ny, nx = heights.shape
    lx, ly = other.physical_sizes
    metres = _metres(other.unit, "unit of the surface")
    return Foreign(heights, (lx * metres / nx, ly * metres / ny), str(other.unit), bool(other.is_periodic))


def _of_surfalize(other: Any) -> Foreign:
    return Foreign(other.data, (other.step_x * 1e-6, other.step_y * 1e-6), "um", False)


def _of_gwyfile(other: Any) -> Foreign:
    ny, nx = other.data.shape
    for axis in ("xy", "z"):
        unit = getattr(getattr(other, f"si_unit_{axis}", None), "unitstr", None)
        if unit != "m":
            raise ValueError(f"unit of {axis}: got {unit!r}; expected 'm'")
    return Foreign(other.data, (other.xreal / nx, other.yreal / ny), "m", False)


class Carried(NamedTuple):
    """Heights that say themselves what they are in."""

    heights: Any  #: shape (ny, nx)
    metres: float | None  #: per unit; None where they do not say it
    unit: str  #: as they say it
    is_si: bool  #: they are in metres already


def _metres_of_quantity(quantity: Any) -> float:
    """One of its unit; NaN where that is no unit of length."""
    unit = getattr(quantity, "units", getattr(quantity, "unit", None))
    try:
        return float(in_si(type(quantity)(1.0, unit), "length", "heights"))
    except Exception:
        return float("nan")


def carried(z: Any) -> Carried:
    """What an array says of its unit: a quantity, or an array of xarray, whose columns become the rows where its
    dimensions are x and y."""
    if is_labelled(z):
        ordered = z.transpose("y", "x") if set(z.dims) == {"x", "y"} else z
        if is_quantity(ordered.data):
            return carried(ordered.data)
        unit = ordered.attrs.get("units")
        return Carried(ordered.values, _metres(unit, "units of the heights") if unit else None, str(unit), False)
    if is_quantity(z):
        unit = str(getattr(z, "units", getattr(z, "unit", "")))
        return Carried(in_si(z, "length", "heights"), _metres_of_quantity(z), unit, True)
    return Carried(z, None, "", False)


def spacing(array: Any, axis: str) -> float | None:
    """Distance of the coordinates of an array of xarray [m]; None where it says none."""
    if axis not in array.coords or not array[axis].attrs.get("units"):
        return None
    steps = np.diff(np.asarray(in_si(array[axis], "length", f"coordinate {axis}"), dtype=np.float64))
    if steps.size == 0:
        return None
    if not np.allclose(steps, steps[0], rtol=1e-6, atol=0) or steps[0] <= 0:
        raise ValueError(f"coordinate {axis}: expected rising values at equal distances")
    return float(steps.mean())


def _of_xarray(other: Any) -> Foreign:
    sides = []
    for axis in ("x", "y"):
        side = spacing(other, axis)
        if side is None:
            raise ValueError(f"coordinate {axis}: got none with units and two values; give tabor.Surface the pixel")
        sides.append(side)
    heights = carried(other)
    if heights.metres is None:
        raise ValueError("units of the heights: it has no unit; give tabor.Surface its heights and pixel")
    return Foreign(heights.heights, (sides[0], sides[1]), "m" if heights.is_si else heights.unit, False)


_KNOWN = ((("heights", "physical_sizes", "unit", "is_periodic"), _of_surface_topography),
          (("data", "step_x", "step_y"), _of_surfalize), (("data", "xreal", "yreal"), _of_gwyfile),
          (("dims", "coords", "transpose", "attrs"), _of_xarray))


def foreign(other: Any) -> Foreign | None:
    """A surface of SurfaceTopography, surfalize, gwyfile, or an array of xarray with coordinates x and y and
    units; None for anything else. Raises ValueError where it has no unit."""
    for names, convert in _KNOWN:
        if all(hasattr(other, name) for name in names):
            return convert(other)
    return None
