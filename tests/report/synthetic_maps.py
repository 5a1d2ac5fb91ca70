"""Invented heights, films and contacts: good enough to look at, never to be mistaken for a solution.

Contact is a cut through the heights; the film fills tiles of the surface to a level of their own.
"""

import numpy as np

PIXEL = 0.67e-6
OIL_DENSITY = 900.0
SATURATION = 240e6


def height_map(shape, seed):
    """[m], self-affine with H = 0.8 on craters and plateaus, flattened on top. Shape (ny, nx)."""
    rng = np.random.default_rng(seed)
    qy, qx = np.meshgrid(np.fft.fftfreq(shape[0], PIXEL), np.fft.rfftfreq(shape[1], PIXEL), indexing="ij")
    q = np.hypot(qx, 1.3 * qy)
    cut = 1 / 60e-6
    amplitude = np.maximum(q, cut) ** -1.8 * (q > 0)
    field_ = np.fft.irfft2(amplitude * np.exp(2j * np.pi * rng.random(q.shape)), shape)
    field_ /= field_.std()
    flattened = np.where(field_ > 0.5, 0.5 + 0.35 * (field_ - 0.5), field_)
    return (1.1e-6 * (flattened - flattened.mean())).astype(np.float32)


def film_map(height, density):
    """[m]: flat pools, one per 24 x 24 pixel tile, each filled to the same share of the tile's heights.

    The share is chosen so that the mean film is density / oil density.
    """
    mean_film = density * 1e-3 / OIL_DENSITY
    tiles = list(_tiles(height.shape))
    ranked = [np.sort(height[tile], axis=None) for tile in tiles]
    low, high = 0.0, 1.0
    for _ in range(12):
        share = (low + high) / 2
        film = np.empty_like(height)
        for tile, heights in zip(tiles, ranked):
            film[tile] = np.maximum(heights[round(share * (len(heights) - 1))] - height[tile], 0)
        low, high = (share, high) if film.mean() < mean_film else (low, share)
    return film.astype(np.float32)


def _tiles(shape, side=24):
    for y in range(0, shape[0], side):
        for x in range(0, shape[1], side):
            yield slice(y, y + side), slice(x, x + side)


def contact_maps(height, pressure, recipe, seed=0):
    """state, gap: the highest pixels touch; of them those highest are saturated."""
    fraction = min(0.9, pressure / SATURATION * 1.12 if recipe.saturated else pressure / 400e6)
    fraction *= 1 + 0.03 * (seed % 5) * (1 + 4e6 / pressure)  # scans differ, most at low load
    level = np.quantile(height, 1 - fraction)
    state = (height > level).astype(np.uint8)
    if recipe.saturated:
        state[height > np.quantile(height, 1 - 0.8 * fraction)] = 2
    return state, np.maximum(level - height, 0).astype(np.float32)


def spectra(height):
    """C1D along x and y and radial C2D in the convention of Jacobs, Junge & Pastewka (2017)."""
    ny, nx = height.shape
    result = {}
    for name, lines, n in (("x", height, nx), ("y", height.T, ny)):
        power = np.abs(PIXEL * np.fft.rfft(lines, axis=1)) ** 2 / (n * PIXEL)
        result[f"{name}_q_rad_per_m"] = 2 * np.pi * np.fft.rfftfreq(n, PIXEL)[1:]
        result[f"{name}_c1d_m3"] = power.mean(axis=0)[1:]
    result["radial_q_rad_per_m"], result["radial_c2d_m4"] = (
        result["x_q_rad_per_m"],
        result["x_c1d_m3"] * PIXEL,
    )
    return result
