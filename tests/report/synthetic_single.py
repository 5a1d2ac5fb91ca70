"""Result files of one scan, as `contact -o`, `lubricate -o` and `friction -o` write them."""

import itertools
from dataclasses import replace

import numpy as np

from synthetic_file import add_map, add_nxdata, new_file
from synthetic_maps import PIXEL, SATURATION, contact_maps, film_map, height_map
from synthetic_study import Recipe, write_density_curves
from synthetic_tables import density_curves


def write_single(path, recipe=Recipe(pressures=(5e6, 10e6), densities=(0.9,)), film=True, contact=True):
    """A file as `friction -o` writes it; without film as `contact -o`, without contact as `lubricate -o`."""
    height = height_map(recipe.shape, seed=7)
    with new_file(path) as file:
        surface = add_nxdata(file, "surface", "height")
        add_map(surface, "height", height.astype(float), "m", "height")
        surface["x"], surface["y"] = (np.arange(n) * PIXEL for n in height.shape[::-1])
        surface.attrs.update(
            {
                "source": "one.x3p",
                "format": "x3p",
                "instrument": "confocal",
                "periodic": 0,
                "treatment": ["level=plane"],
                "doubts": [],
            }
        )
        pairs = itertools.product(recipe.pressures if contact else (None,), recipe.densities)
        for key, (pressure, density) in enumerate(pairs):
            _write_single_state(file, key, height, pressure, density if film else None, recipe)
        if recipe.density_curves:
            write_density_curves(file, density_curves(replace(recipe, groups=("",))), recipe.densities)
            del file["density_averages"]
            file.attrs["answers"] = [text.strip() for text in file.attrs["answers"]]


def _write_single_state(file, key, height, pressure, density, recipe):
    node = add_nxdata(file, f"states/{key:04d}", "gap" if pressure else "film_thickness")
    if pressure:
        state, gap = contact_maps(height, pressure, recipe)
        add_map(node, "pressure", np.array([0.0, 0.6 * SATURATION, SATURATION])[state], "Pa", "pressure")
        add_map(node, "gap", gap.astype(float), "m", "gap")
        add_map(node, "displacement", gap * 0.0, "m", "displacement")
        node.attrs.update(
            {
                "mean_pressure_Pa": pressure,
                "contact_area_fraction": float((state > 0).mean()),
                "converged": True,
                "certificate": 1e-9,
                "saturation_pressure_Pa": SATURATION,
            }
        )
    if density:
        add_map(node, "film_thickness", film_map(height, density).astype(float), "m", "film thickness")
        node.attrs["lubricant_density_g_per_m2"] = density
    if pressure and density:
        node.attrs.update({"friction_dry": 0.3, "friction_lubricated": 0.3 - 1e-8 * pressure * density})
