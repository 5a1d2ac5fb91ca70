"""Amplitudes of the surface of a result: ISO 25178-2 height parameters about the mean, over the pixels that have a height."""

import math

import numpy as np

from tabor.report import units

MOST = 4_000_000  # heights that the distribution is made of: evenly spread ones of a larger map


def amplitudes(height):
    """{name: text} of Sa, Sq, Ssk, Sku, Sz; {} without heights, and no Ssk, Sku of a constant."""
    z = height[np.isfinite(height)].astype(float)
    if z.size == 0:
        return {}
    z -= z.mean()
    sq = math.sqrt(np.mean(z * z))
    found = {"Sa": units.length(np.mean(np.abs(z))), "Sq": units.length(sq)}
    if sq > 0:
        found["Ssk"] = units.number(np.mean(z**3) / sq**3, 4)
        found["Sku"] = units.number(np.mean(z**4) / sq**4, 4)
    return {**found, "Sz": units.length(z.max() - z.min())}


def sorted_heights(height, mean=True):
    """Valid heights [m] about their mean, or as they are, from high to low."""
    z = height[np.isfinite(height)].astype(float)
    z = z[:: 1 + (z.size - 1) // MOST] if z.size else z
    return np.sort(z - (z.mean() if mean and z.size else 0.0))[::-1]
