"""Maps of surfaces and results: arrays of xarray, pictures, thumbnails."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Mapping
from operator import attrgetter
from types import MappingProxyType
from typing import Any, NamedTuple, Protocol

import numpy as np
import numpy.typing as npt

from ._arguments import wrong
from ._optional import needs
from ._values import si_list

Array = npt.NDArray[np.float64]

#: A part of a map: x0, y0, width and height [m], from its upper left corner.
Window = Any

#: What pictures show in place of an SI unit: (factor, unit).
_SHOWN = {"m": (1e6, "µm"), "Pa": (1e-6, "MPa")}


class Grid(Protocol):
    """What a map stands on."""

    @property
    def shape(self) -> tuple[int, int]:
        """(ny, nx)"""

    @property
    def pixel(self) -> tuple[float, float]:
        """Sides of a pixel [m]."""

    @property
    def x(self) -> Array:
        """Centres of the columns [m]."""

    @property
    def y(self) -> Array:
        """Centres of the rows [m]."""


class Map(NamedTuple):
    """One map of a result."""

    values: npt.NDArray[Any]  #: shape (ny, nx)
    unit: str  #: SI; "" for shares, masks and numbers of patches
    label: str  #: for people


class Kind(NamedTuple):
    """What a result has a map of."""

    path: str  #: of the attribute, "film.thickness"
    unit: str
    label: str

    def of(self, result: Any) -> Map:
        """The map of a result."""
        return Map(attrgetter(self.path)(result), self.unit, self.label)


def map_to_xarray(surface: Grid, values: npt.NDArray[Any], name: str, unit: str,
                  attributes: Mapping[str, Any] = MappingProxyType({})) -> Any:
    """A map as a DataArray with coordinates x and y [m]; masks are 0 and 1, which every file takes."""
    xarray = needs("xarray", "to_xarray()")
    if values.dtype == bool:
        values = values.astype(np.int8)
    units = {"units": unit} if unit else {}
    found = xarray.DataArray(values, {"y": surface.y, "x": surface.x}, ("y", "x"), name, {**units, **attributes})
    found.x.attrs["units"] = found.y.attrs["units"] = "m"
    return found


def maps_to_xarray(surface: Grid, result: Any, kinds: Mapping[str, Kind], attributes: Mapping[str, Any]) -> Any:
    """Maps of a result as a Dataset."""
    xarray = needs("xarray", "to_xarray()")
    maps = {name: one.of(result) for name, one in kinds.items()}
    return xarray.Dataset({name: map_to_xarray(surface, one.values, name, one.unit, {"long_name": one.label})
                           for name, one in maps.items()}, attrs=dict(attributes))


def _pixels(surface: Grid, window: Window) -> tuple[slice, slice]:
    """Rows and columns whose centres lie in a window."""
    if window is None:
        return slice(None), slice(None)
    if isinstance(window, str) or np.size(np.asarray(window, dtype=object)) != 4:
        raise wrong("window", window, "four lengths: x0, y0, width and height")
    x0, y0, width, height = si_list(window, "length", "window")[0]
    rows = np.flatnonzero((surface.y >= y0) & (surface.y <= y0 + height))
    columns = np.flatnonzero((surface.x >= x0) & (surface.x <= x0 + width))
    if rows.size == 0 or columns.size == 0:
        (ny, nx), (dx, dy) = surface.shape, surface.pixel
        raise ValueError(f"window: got one without a pixel; the map is {nx * dx * 1e6:.6g} x {ny * dy * 1e6:.6g} µm")
    return slice(int(rows[0]), int(rows[-1]) + 1), slice(int(columns[0]), int(columns[-1]) + 1)


def chosen(result: Any, kinds: Mapping[str, Kind], field: str) -> Map:
    """The map of a name; ValueError with those that there are."""
    if field not in kinds:
        raise ValueError(f"field: got {field!r}; expected one of {', '.join(kinds)}")
    return kinds[field].of(result)


def _place_of_bar(ax: Any) -> Any:
    """Axes of the colour bar that ``plot_map`` drew beside these before, emptied; None for the first picture."""
    image, place = ax.__dict__.pop("_tabor_drawn", (None, None))
    if image is not None and image in ax.images:
        image.remove()
    if place is None or place not in ax.figure.axes:
        return None
    place.clear()
    return place


def plot_map(surface: Grid, one: Map, ax: Any, window: Window = None, cmap: str | None = None) -> Any:
    """A map as a picture in µm with its scale. Drawn again into the same axes, it takes the place of the picture and
    the colour bar before."""
    rows, columns = _pixels(surface, window)
    factor, unit = _SHOWN.get(one.unit, (1, one.unit))
    ax = ax or needs("matplotlib.pyplot", "plot()").gca()
    place = _place_of_bar(ax)
    (ny, nx), (dx, dy) = surface.shape, surface.pixel
    left, right, _ = columns.indices(nx)
    top, bottom, _ = rows.indices(ny)
    shown = one.values[rows, columns] * factor
    image = ax.imshow(shown, extent=tuple(1e6 * side for side in (left * dx, right * dx, bottom * dy, top * dy)), cmap=cmap)
    ax.set_xlabel("x [µm]")
    ax.set_ylabel("y [µm]")
    bar = ax.figure.colorbar(image, cax=place, ax=ax if place is None else None, label=f"{one.label} [{unit}]" if unit else one.label)
    ax._tabor_drawn = (image, bar.ax)
    return ax


def thumbnail(values: Array, side: int = 128) -> bytes:
    """A grey PNG of at most side x side pixels, from the 1st to the 99th percentile; holes are black."""
    step = max(1, -(-max(values.shape) // side))
    small = values[::step, ::step]
    known = small[np.isfinite(small)]
    low, high = np.percentile(known, [1, 99]) if known.size else (0.0, 1.0)
    share = np.clip((small - low) / (high - low if high > low else 1.0), 0, 1)
    grey = np.where(np.isfinite(share), 32 + 223 * np.nan_to_num(share), 0).astype(np.uint8)
    rows = b"".join(b"\0" + row.tobytes() for row in grey)
    head = struct.pack(">IIBBBBB", grey.shape[1], grey.shape[0], 8, 0, 0, 0, 0)
    chunks = [(b"IHDR", head), (b"IDAT", zlib.compress(rows)), (b"IEND", b"")]
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        for kind, data in chunks)
