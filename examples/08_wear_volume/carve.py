"""Wears a pit of known volume into a surface and scans it again: elsewhere, tilted, with noise.

usage: carve.py BEFORE.npy AFTER.npy TRUTH.json    (periodic heights in metres, pixels of 1 um)
BEFORE.npy gets its noise as well.
"""

import json
import sys

import numpy as np

PIXEL = 1e-6
MOVED_X, MOVED_Y = 23.4, -12.7  # [pixels] what was at x is at x + MOVED_X
CENTRE_X, CENTRE_Y = 150e-6, 170e-6
RADIUS, DEPTH = 60e-6, 1.2e-6  # of a paraboloid below the mean plane
NOISE = 5e-9  # [m], of each scan
MARGIN = 40  # pixels of each side that the second scan does not see: more than it moved


def moved(heights, dx, dy):
    """Shifts periodic heights by any part of a pixel, exactly below the Nyquist frequency."""
    ny, nx = heights.shape
    phase = np.add.outer(np.fft.fftfreq(ny) * dy, np.fft.fftfreq(nx) * dx)
    return np.fft.ifft2(np.fft.fft2(heights) * np.exp(-2j * np.pi * phase)).real


before = np.load(sys.argv[1])
after = moved(before, MOVED_X, MOVED_Y)
y, x = np.indices(after.shape) * PIXEL
r2 = (x - CENTRE_X) ** 2 + (y - CENTRE_Y) ** 2
pit = DEPTH * (r2 / RADIUS**2 - 1)
worn = np.where(r2 < RADIUS**2, np.maximum(after - pit, 0), 0)  # valleys below the pit stay

random = np.random.default_rng(8)
before = before + NOISE * random.standard_normal(before.shape)
after = after - worn + NOISE * random.standard_normal(after.shape)
after = after + 2e-6 + 3e-4 * x - 1e-4 * y
seen = np.s_[MARGIN:-MARGIN, MARGIN:-MARGIN]
assert worn[seen].sum() == worn.sum(), "the pit must lie where both scans look"
np.save(sys.argv[1], before)
np.save(sys.argv[2], after[seen])
with open(sys.argv[3], "w", encoding="utf-8") as file:
    json.dump({"shift_x_m": (MOVED_X - MARGIN) * PIXEL, "shift_y_m": (MOVED_Y - MARGIN) * PIXEL,
               "worn_m3": worn.sum() * PIXEL**2}, file)
