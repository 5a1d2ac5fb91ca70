"""Sections through surfaces: heights along a line."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ._arguments import Axes, typed
from ._maps import Array
from ._optional import needs
from ._records import Shown
from ._values import si_list


@dataclass(frozen=True, eq=False, repr=False)
class Section(Shown):
    """Heights along the line between two points of a surface."""

    distance: Array  #: from the first point [m], rising, at most a pixel apart
    height: Array  #: [m]; NaN where a pixel that it lies between is a hole
    start: tuple[float, float]  #: (x, y) [m]
    end: tuple[float, float]  #: (x, y) [m]

    @typed
    def plot(self, ax: Axes = None, **style: Any) -> Any:
        """Draws height over distance in µm; needs matplotlib. Returns the axes."""
        ax = ax or needs("matplotlib.pyplot", "plot()").gca()
        ax.plot(1e6 * self.distance, 1e6 * self.height, **style)
        ax.set_xlabel("distance [µm]")
        ax.set_ylabel("height [µm]")
        return ax

    def to_xarray(self) -> Any:
        """The heights as a DataArray over ``distance``, with x and y of its points [m]; needs xarray."""
        xarray = needs("xarray", "to_xarray()")
        places = {name: ("distance", np.linspace(a, b, self.distance.size), {"units": "m"})
                  for name, a, b in zip("xy", self.start, self.end)}
        coords = {"distance": ("distance", self.distance, {"units": "m"}), **places}
        return xarray.DataArray(self.height, coords, ("distance",), "height", {"units": "m"})

    def _lines(self) -> list[tuple[str, str]]:
        (x0, y0), (x1, y1) = self.start, self.end
        return [("from", f"({1e6 * x0:.6g}, {1e6 * y0:.6g}) µm to ({1e6 * x1:.6g}, {1e6 * y1:.6g}) µm"),
                ("length", f"{1e6 * self.distance[-1]:.6g} µm, {self.distance.size} points")]


def point_of(value: Any, name: str, lengths: tuple[float, float]) -> tuple[float, float]:
    """(x, y) [m] of a point on a surface of these lengths [m]."""
    found, single = si_list(value, "length", name)
    if single or len(found) != 2:
        raise ValueError(f"{name}: got {1 if single else len(found)} lengths; expected two, x and y")
    for axis, at, length in zip("xy", found, lengths):
        if not -1e-9 * length <= at <= (1 + 1e-9) * length:
            raise ValueError(f"{name}: got {axis} = {1e6 * at:.6g} µm; expected a point on the surface, 0 to {1e6 * length:.6g} µm")
    return found[0], found[1]


def section_of(height: Array, pixel: tuple[float, float], start: tuple[float, float], end: tuple[float, float]) -> Section:
    """Heights between the pixel centres, linear along x and y; beyond the outermost centres the nearest ones hold."""
    length = float(np.hypot(end[0] - start[0], end[1] - start[1]))
    if length == 0:
        raise ValueError("section: got one point twice; expected two points")
    n = int(np.ceil(length / min(pixel) * (1 - 1e-12))) + 1
    share = np.linspace(0, 1, n)
    places = []
    for a, b, side, count in zip(start, end, pixel, height.shape[::-1]):
        place = np.clip((a + share * (b - a)) / side - 0.5, 0, count - 1)
        nearest = np.rint(place)  # a point on a centre has the height of its pixel alone
        place = np.where(np.abs(place - nearest) < 1e-9 * count, nearest, place)
        low = np.minimum(place.astype(int), max(count - 2, 0))
        places.append((low, np.minimum(low + 1, count - 1), place - low))
    (x0, x1, u), (y0, y1, v) = places
    parts = ((y0, x0, (1 - v) * (1 - u)), (y0, x1, (1 - v) * u), (y1, x0, v * (1 - u)), (y1, x1, v * u))
    heights = np.zeros(n)
    for row, column, weight in parts:
        heights += np.where(weight > 0, weight * height[row, column], 0.0)
    return Section(share * length, heights, start, end)
