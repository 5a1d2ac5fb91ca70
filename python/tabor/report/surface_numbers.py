"""Numbers of all heights of the surface of a result: ISO 25178-2 parameters about the mean, and how the heights are distributed."""

import math
from dataclasses import dataclass

import numpy as np

from tabor.report import map_axes, units

ROWS_AT_ONCE = 64
BINS = 80
POINTS = 201  # of the material ratio curve
ENOUGH = 500_000  # heights that tell their unit
MOST = 4_000_000  # heights that the distribution is made of: evenly spread ones of a larger map


@dataclass
class Distribution:
    """Of heights in a unit that suits them: shares of the area in bins, and the material ratio curve (Abbott-Firestone)."""

    unit: str
    edges: np.ndarray
    density: np.ndarray  # share of the area per unit
    ratio: np.ndarray  # percent of the area that is higher than `curve`
    curve: np.ndarray


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


def distribution(height, mean=True):
    """None for a surface without two different heights."""
    z = _sorted_heights(height, mean)
    if z.size < 2 or z[0] == z[-1]:
        return None
    factor, unit = map_axes.height_unit(z[:: 1 + z.size // ENOUGH])
    z *= factor
    share, edges = np.histogram(z, bins=BINS)
    ratio = np.linspace(0, 100, POINTS)
    return Distribution(unit, edges, share / (z.size * np.diff(edges)), ratio, _at(ratio, z))


def _at(ratio, z):
    """Heights above which these percentages of them lie; few of them are looked at."""
    step = 100 / (z.size - 1)
    before = np.minimum((ratio / step).astype(int), z.size - 2)
    places = np.unique(np.clip([before - 1, before, before + 1, before + 2], 0, z.size - 1))
    shares = places * step
    shares[-1] = 100.0
    return np.interp(ratio, shares, z[places])


def _sorted_heights(height, mean):
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
