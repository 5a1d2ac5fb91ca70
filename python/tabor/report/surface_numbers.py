"""Amplitudes of the surface of a result: ISO 25178-2 height parameters about the mean, over the pixels that have a height."""

import math

import numpy as np

from tabor.report import units

ROWS_AT_ONCE = 64
MOST = 4_000_000  # heights that the distribution is made of: evenly spread ones of a larger map


def amplitudes(height):
    """{name: text} of Sa, Sq, Ssk, Sku, Sz; {} without heights, and no Ssk, Sku of a constant."""
    n, total = 0, 0.0
    for z in _parts(height):
        n, total = n + z.size, total + z.sum()
    if n == 0:
        return {}
    sums, lowest, highest = np.zeros(4), math.inf, -math.inf
    for z in _parts(height):
        z -= total / n
        squared = z * z
        sums += np.abs(z).sum(), squared.sum(), (squared * z).sum(), (squared * squared).sum()
        lowest, highest = min(lowest, z.min(initial=math.inf)), max(highest, z.max(initial=-math.inf))
    sa, square, cube, fourth = sums / n
    sq = math.sqrt(square)
    found = {"Sa": units.length(sa), "Sq": units.length(sq)}
    if sq > 0:
        found["Ssk"] = units.number(cube / sq**3, 4)
        found["Sku"] = units.number(fourth / sq**4, 4)
    return {**found, "Sz": units.length(highest - lowest)}


def _parts(height):
    """Valid heights [m], some rows at a time: a large map is not copied."""
    for start in range(0, len(height), ROWS_AT_ONCE):
        rows = height[start : start + ROWS_AT_ONCE]
        yield rows[np.isfinite(rows)].astype(float)


def sorted_heights(height, mean=True):
    """Valid heights [m] about their mean, or as they are, from high to low."""
    z = _evenly_spread(height)
    level = z.astype(float).mean() if mean and z.size else 0.0
    z.sort()  # before they are double: half as large
    z = z.astype(float)
    z -= level
    return z[::-1]


def _evenly_spread(height):
    known = np.isfinite(height)
    z = height.ravel() if known.all() else height[known]
    return z[:: 1 + (z.size - 1) // MOST].copy() if z.size else z
