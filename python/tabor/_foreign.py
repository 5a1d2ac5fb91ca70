"""Surfaces of other packages, known by what they have and not by their type."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from . import _tabor


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
    heights = np.ma.asarray(other.heights()).T  # [x, y] there
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


def _of_xarray(other: Any) -> Foreign:
    ordered = other.transpose("y", "x")
    pixel = []
    for axis in ("x", "y"):
        steps = np.diff(np.asarray(ordered[axis].values, dtype=np.float64))
        if steps.size == 0 or not np.allclose(steps, steps[0], rtol=1e-6, atol=0) or steps[0] <= 0:
            raise ValueError(f"coordinate {axis}: expected rising values at equal distances")
        pixel.append(float(steps.mean()) * _metres(ordered[axis].attrs.get("units"), f"units of {axis}"))
    unit = ordered.attrs.get("units")
    _metres(unit, "units of the heights")
    return Foreign(ordered.values, (pixel[0], pixel[1]), unit, False)


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
