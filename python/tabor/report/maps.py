"""Large maps made small enough to print, without losing what they show."""

from dataclasses import dataclass

import numpy as np

MAX_SIDE = 1000  # pixels along the longer side of a printed map: 180 dpi over 5.5 inches


@dataclass
class Window:
    """Rows y0..y1 and columns x0..x1 (exclusive) of a map."""

    y0: int
    y1: int
    x0: int
    x1: int

    def of(self, field):
        return field[self.y0 : self.y1, self.x0 : self.x1]

    @property
    def shape(self):
        return self.y1 - self.y0, self.x1 - self.x0


def whole(field):
    return Window(0, field.shape[0], 0, field.shape[1])


def block_size(shape, max_side=MAX_SIDE):
    return max(1, -(-max(shape) // max_side))


def block_mean(field, block):
    """Mean of the valid pixels of each block x block tile; the last tiles may be smaller."""
    if block == 1:
        return np.asarray(field, dtype=float)
    valid = ~np.isnan(field)
    if valid.all():
        return _tile_sum(field, block) / np.outer(*(_tile_sides(length, block) for length in field.shape))
    total, count = _tile_sum(np.where(valid, field, 0), block), _tile_sum(valid, block)
    return np.divide(total, count, out=np.full(total.shape, np.nan), where=count > 0)


def ink(share):
    """Darkness of a tile of which `share` is in contact.

    Never below 0.35 where anything touches: a one-pixel contact would vanish in the paper's white.
    """
    return np.where(share > 0, 0.35 + 0.65 * share, 0.0)


def extent(window, pixel, factor):
    """matplotlib's (left, right, bottom, top) with y running downwards from the top row."""
    px, py = pixel[0] * factor, pixel[1] * factor
    return window.x0 * px, window.x1 * px, window.y1 * py, window.y0 * py


def tile_centres(start, stop, block, pixel, factor):
    edges = np.minimum(np.arange(start, stop + block, block), stop)
    edges = np.unique(edges)
    return (edges[:-1] + edges[1:]) / 2 * pixel * factor


def _tile_sides(length, block):
    return np.diff(np.append(np.arange(0, length, block), length))


def _tile_sum(field, block):
    rows = np.add.reduceat(field, np.arange(0, field.shape[0], block), axis=0, dtype=float)
    return np.add.reduceat(rows, np.arange(0, field.shape[1], block), axis=1)
