"""What a surface has in common with an array: shape, coordinates, sides of its pixels."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from . import _tabor
from ._heights import Array


class OnGrid:
    """Shape and coordinates for Surface, which has ``height`` and ``_heights``."""

    if TYPE_CHECKING:
        _heights: _tabor.Topography

        @property
        def height(self) -> Array:
            """Heights [m]."""

    @property
    def shape(self) -> tuple[int, int]:
        """(ny, nx)"""
        ny, nx = self.height.shape
        return ny, nx

    @property
    def ndim(self) -> int:
        """2, as an array of heights has."""
        return 2

    @property
    def size(self) -> int:
        """Number of pixels, as of an array; ``lengths`` are the sides."""
        return self.height.size

    def __len__(self) -> int:
        """Number of rows."""
        return self.shape[0]

    @property
    def lengths(self) -> tuple[float, float]:
        """Sides (lx, ly) of the surface [m]."""
        return self._heights.lx, self._heights.ly

    @property
    def pixel(self) -> tuple[float, float]:
        """Sides (dx, dy) of a pixel [m]."""
        ny, nx = self.shape
        return self._heights.lx / nx, self._heights.ly / ny

    @property
    def dx(self) -> float:
        """Side of a pixel along x [m]."""
        return self.pixel[0]

    @property
    def dy(self) -> float:
        """Side of a pixel along y [m]."""
        return self.pixel[1]

    @property
    def x(self) -> Array:
        """Centres of the columns [m], shape (nx,), from the left edge."""
        return (np.arange(self.shape[1], dtype=np.float64) + 0.5) * self.dx

    @property
    def y(self) -> Array:
        """Centres of the rows [m], shape (ny,), from the upper edge."""
        return (np.arange(self.shape[0], dtype=np.float64) + 0.5) * self.dy

    @property
    def extent(self) -> tuple[float, float, float, float]:
        """(left, right, bottom, top) [m], as ``imshow`` of matplotlib takes it for a map whose row 0 is on top."""
        lx, ly = self.lengths
        return 0.0, lx, ly, 0.0

    @property
    def unit(self) -> str:
        """Unit of heights and lengths: "m"."""
        return "m"

    @property
    def mask(self) -> npt.NDArray[np.bool_]:
        """True at holes, shape (ny, nx)."""
        return np.isnan(self.height)
