"""Heights and pixels of a surface as they are given."""

from __future__ import annotations

import sys
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _tabor
from ._errors import InputError
from ._foreign import Carried, carried, spacing
from ._values import is_labelled, si_list

Array = npt.NDArray[np.float64]


def pixel_sides(pixel: Any) -> tuple[float, float]:
    """Sides of a pixel along x and y [m], of one value or two."""
    lengths, _ = si_list(pixel, "length", "pixel")
    if len(lengths) > 2:
        raise ValueError(f"pixel: got {len(lengths)} lengths; expected one, or two for x and y")
    for length in lengths:
        if not 0 < length < np.inf:
            raise ValueError(f"pixel: got {length:g} m; expected a length above zero")
    return lengths[0], lengths[-1]


def in_metres(z: Any, unit: str | None) -> Array:
    """Heights in metres, by their own unit or the one that is given; ValueError where these contradict each other.
    ``z`` with the unit metres in ``Carried`` is taken as it is."""
    z, own, name, is_si = z if isinstance(z, Carried) else carried(z)
    given = None if unit is None else _tabor.parse_si(f"1 {unit}", "length", "unit")
    if given is not None and own is not None and not abs(given - own) <= 1e-9 * given:
        raise ValueError(f"unit: got {unit!r} for heights that say they are in {name!r}; leave it out")
    factor = 1.0 if is_si else own if own is not None else given
    heights = checked(z)
    if np.isnan(heights).all():
        raise InputError("heights: got no valid height at any pixel; expected a map with heights")
    return heights if factor is None or factor == 1.0 else heights * factor


def require_spacing(z: Any, pixel: tuple[float, float]) -> None:
    """ValueError where an array of xarray has other coordinates."""
    for axis, side in zip("xy", pixel) if is_labelled(z) else ():
        own = spacing(z, axis)
        if own is not None and abs(own - side) > 1e-6 * side:
            raise ValueError(f"pixel: got {side:g} m along {axis} for an array whose coordinates are {own:g} m apart; "
                             "leave it out")


def _is_masked(z: Any) -> bool:
    """Asked without loading numpy.ma, which takes a while and locks that a copy of the process may find taken."""
    masked = getattr(sys.modules.get("numpy.ma"), "MaskedArray", None)
    return masked is not None and isinstance(z, masked)


def _shape_of(z: npt.NDArray[Any]) -> str:
    """Shape of an array that is no map, for a message."""
    if z.ndim == 0:
        return "one number"
    if z.size == 0:
        return f"an array of shape {z.shape}, which is empty"
    return f"an array of {z.ndim} dimension{'s' if z.ndim > 1 else ''}, shape {z.shape}"


def checked(z: Any, name: str = "heights") -> Array:
    """C-ordered float64 of shape (ny, nx), NaN where there is no height. Raises TypeError for arrays of anything but
    real numbers, ValueError for other shapes and infinite heights."""
    if _is_masked(z):
        if z.dtype.kind not in "fiu":
            raise TypeError(f"{name}: got an array of {z.dtype}; expected real numbers")
        z = z.astype(np.float64).filled(np.nan)
    try:
        heights = np.asarray(z)
    except Exception as error:
        raise TypeError(f"{name}: got {type(z).__name__} that is no array; expected real numbers in rows of one length") from error
    if heights.dtype.kind not in "fiu":
        raise TypeError(f"{name}: got an array of {heights.dtype}; expected real numbers")
    if heights.ndim != 2 or heights.size == 0:
        raise ValueError(f"{name}: got {_shape_of(heights)}; expected a map of shape (ny, nx), row 0 on top")
    heights = np.ascontiguousarray(heights, dtype=np.float64)
    if np.isinf(heights).any():
        raise ValueError(f"{name}: got an infinite height; expected numbers, NaN where there is none")
    return heights
