"""Study folders of the shape of docs/results.md with invented but plausible numbers.

Everything follows from the arguments, so equal arguments give equal folders.
"""

import hashlib
import json
from dataclasses import dataclass, field
from pathlib import Path

import h5py
import numpy as np

from synthetic_file import add_map, add_nxdata, new_file
from synthetic_maps import OIL_DENSITY, PIXEL, SATURATION, contact_maps, film_map, height_map, spectra
from synthetic_tables import average, average_curves, density_curves, measured, places, plateaus
from synthetic_tables import write_columns, write_csv

YOUNG, POISSON, SHEAR_STRENGTH = 70e9, 0.33, 70e6

RESULT_COLUMNS = tuple("""case_id scan group mean_pressure_Pa lubricant_density_g_per_m2 contact_area_fraction
    contact_area_fraction_pixels saturated_area_fraction mean_gap_m lubricated_share spill_over_fraction
    friction_dry friction_lubricated certificate converged""".split())
FLOW_COLUMNS = tuple("""sliding_speed_m_per_s fluid_load_share fluid_contact_area_fraction fluid_mean_gap_m
    friction_solid friction_viscous friction_mixed fluid_load_error fluid_gap_error fluid_converged""".split())


@dataclass
class Recipe:
    groups: tuple = ("side A", "side A", "side B", "side B")  # one scan each
    pressures: tuple = (2e6, 5e6, 10e6, 15e6)
    densities: tuple = (0.45, 0.9)
    shape: tuple = (96, 128)  # ny, nx
    saturated: bool = True
    experiment: bool = True
    not_converged: tuple = ()  # (scan index, pressure index)
    missing_cases: tuple = ()  # the same: neither computed nor stored
    warnings: dict = field(default_factory=dict)  # {scan index: text}
    title: str = "EDT aluminium on steel, before sliding"
    speeds: tuple = ()  # [m/s]: the oil flows
    density_curves: bool = False  # friction against density and what it says
    contacts: dict = field(default_factory=dict)  # {group: "elastic"}: settings of its own
    unsteady: tuple = ()  # (scan index, speed index) whose film did not converge

    @property
    def columns(self):
        return RESULT_COLUMNS + (FLOW_COLUMNS if self.speeds else ())

    @property
    def effective_modulus(self):
        return YOUNG / (1 - POISSON**2)


def write(folder, recipe=Recipe()):
    """Makes the folder and returns the rows of results.csv as dicts."""
    folder = Path(folder)
    (folder / "store").mkdir(parents=True, exist_ok=True)
    scans, rows = [], []
    for index, group in enumerate(recipe.groups):
        scan = _write_scan(folder, recipe, index, group)
        scans.append(scan)
        rows.extend(scan["rows"])
    averages = average(rows)
    write_csv(folder / "results.csv", recipe.columns, rows)
    write_csv(folder / "averages.csv", tuple(averages[0]), averages)
    _write_results(folder / "results.h5", recipe, scans, rows, averages)
    return rows


def _write_scan(folder, recipe, index, group):
    height = height_map(recipe.shape, seed=100 + index)
    scan = {
        "file": f"before_{index + 1}.x3p",
        "group": group,
        "height": height,
        "doubts": recipe.warnings.get(index),
        "sha256": _sha256(f"scan {index}"),
        "contacts": {},
        "films": {},
        "fluid": {},
        "rows": [],
    }
    scan["surface"] = _write_surface(folder, scan)
    film_file = f"store/film-{_sha256(f'film {index}')[:16]}.h5"
    films = {density: film_map(height, density) for density in recipe.densities}
    _write_films(folder / film_file, films)
    scan["films"] = {key: (film_file, f"/films/{key:04d}") for key in range(len(films))}
    for step, pressure in enumerate(recipe.pressures):
        if (index, step) not in recipe.missing_cases:
            _write_state(folder, recipe, scan, index, step, pressure, films)
    return scan


def _write_surface(folder, scan):
    name = f"store/surface-{_sha256(scan['file'])[:16]}.h5"
    with new_file(folder / name) as file:
        surface = add_nxdata(file, "surface", "height")
        add_map(surface, "height", scan["height"], "m", "height")
        surface["mask"] = np.zeros(scan["height"].shape, np.uint8)
        psd = file.create_group("psd")
        for key, values in spectra(scan["height"].astype(float)).items():
            psd[key] = values
        psd.attrs.update(
            {
                "convention": "jacobs",
                "window": "hann",
                "hurst_x": 0.78,
                "hurst_y": 0.76,
                "hurst_radial": 0.77,
                "rms_height_m": float(scan["height"].std()),
                "rms_slope": 0.21,
            }
        )
    return name


def _write_films(path, films):
    with new_file(path) as file:
        for key, (density, film) in enumerate(films.items()):
            node = add_nxdata(file, f"films/{key:04d}", "film_thickness")
            add_map(node, "film_thickness", film, "m", "film thickness")
            node.attrs.update(
                {
                    "lubricant_density_g_per_m2": density,
                    "mean_film_m": float(film.mean()),
                    "wet_fraction": float((film > 0).mean()),
                    "max_film_m": float(film.max()),
                }
            )


def _write_state(folder, recipe, scan, index, step, pressure, films):
    state, gap = contact_maps(scan["height"], pressure, recipe, seed=3 * index)
    sure = (index, step) not in recipe.not_converged
    facts = {
        "mean_pressure_Pa": pressure,
        "contact_area_fraction_pixels": float((state > 0).mean()),
        "contact_area_fraction": float((state > 0).mean()) * 0.985,
        "saturated_area_fraction": float((state == 2).mean()),
        "mean_gap_m": float(gap.mean()),
        "certificate": 4e-9 if sure else 3e-3,
        "converged": sure,
    }
    if recipe.saturated:
        facts["contact_area_fraction"] = max(facts["contact_area_fraction"], pressure / SATURATION)
    name = f"store/contact-{_sha256(f'contact {index} {step}')[:16]}.h5"
    with new_file(folder / name) as file:
        node = add_nxdata(file, "contact", "state")
        add_map(node, "state", state, "1", "contact state")
        add_map(node, "gap", gap, "m", "gap")
        node.attrs.update(facts)
    scan["contacts"][step] = (name, "/contact")
    for density, film in films.items():
        row = _row(folder, scan, facts, density, film, state, gap)
        flowing = [_flow(folder, recipe, scan, index, row, place) for place in range(len(recipe.speeds))]
        scan["rows"].extend(flowing or [row])


def _row(folder, scan, facts, density, film, state, gap):
    touching = state > 0
    share = float((film[touching] > 0).mean())
    dry = facts["contact_area_fraction"] * SHEAR_STRENGTH / facts["mean_pressure_Pa"]
    row = {
        "case_id": _sha256(f"{scan['file']} {facts['mean_pressure_Pa']} {density}")[:16],
        "scan": scan["file"],
        "group": scan["group"],
        "lubricant_density_g_per_m2": density,
        "lubricated_share": share,
        "spill_over_fraction": float(np.maximum(film - gap, 0).sum() / film.sum()),
        "friction_dry": dry,
        "friction_lubricated": dry * (1 - share),
        **facts,
    }
    row = {name: row[name] for name in RESULT_COLUMNS}
    (folder / "store" / f"case-{row['case_id']}.json").write_text(json.dumps(row))
    return row


def _flow(folder, recipe, scan, index, row, place):
    """The row at one speed: oil carries more of the load the faster, as on a Stribeck curve."""
    speed, sure = recipe.speeds[place], (index, place) not in recipe.unsteady
    share = 0.6 * speed / (speed + 0.1)
    solid, viscous = row["friction_lubricated"] * (1 - share), 0.01 * speed**0.5
    values = (speed, share, row["contact_area_fraction"] * (1 - share), row["mean_gap_m"] * (1 + share))
    values += (solid, viscous, solid + viscous, 1e-4 if sure else 0.3, 1e-5, sure)
    flow = {**row, **dict(zip(FLOW_COLUMNS, values)), "converged": row["converged"] and sure}
    key = f"{scan['file']} {row['mean_pressure_Pa']} {row['lubricant_density_g_per_m2']} {speed}"
    flow["case_id"] = _sha256(key)[:16]
    name = f"store/fluid-{flow['case_id']}.h5"
    with new_file(folder / name) as file:
        node = add_nxdata(file, "fluid", "fluid_pressure")
        add_map(node, "fluid_pressure", np.full(recipe.shape, share * row["mean_pressure_Pa"]), "Pa", "oil")
        for attribute in ("mean_pressure_Pa", "lubricant_density_g_per_m2", "sliding_speed_m_per_s"):
            node.attrs[attribute] = flow[attribute]
        node.attrs["warnings"] = [] if sure else ["film NOT CONVERGED"]
    scan["fluid"][len(scan["fluid"])] = (name, "/fluid")
    return flow


def _write_results(path, recipe, scans, rows, averages):
    with new_file(path) as file:
        file.attrs.update(
            {
                "title": recipe.title,
                "shear_strength_Pa": SHEAR_STRENGTH,
                "youngs_modulus_Pa": YOUNG,
                "poissons_ratio": POISSON,
                "effective_modulus_Pa": recipe.effective_modulus,
                "oil_density_kg_per_m3": OIL_DENSITY,
                "area": "corrected",
                "n_cases_done": len(rows),
                "n_cases": len(recipe.groups)
                * len(recipe.pressures)
                * len(recipe.densities)
                * max(1, len(recipe.speeds)),
            }
        )
        if recipe.saturated:
            file.attrs["saturation_pressure_Pa"] = SATURATION
        write_columns(file.create_group("table"), rows)
        write_columns(file.create_group("averages"), averages)
        if recipe.density_curves:
            write_density_curves(file, density_curves(recipe), recipe.densities)
        for index, scan in enumerate(scans):
            node = file.create_group(f"scans/{index:04d}")
            _link_scan(node, scan)
            node.attrs["contact"] = recipe.contacts.get(scan["group"], "saturated")
        if recipe.experiment:
            write_columns(file.create_group("experiment"), measured(recipe))


def write_density_curves(file, curves, densities):
    averages = average_curves(curves)
    write_columns(file.create_group("density_plateaus"), plateaus(averages))
    write_columns(file.create_group("density_places"), places(averages, [one for one in densities if one > 0]))
    write_columns(file.create_group("density_curves"), curves)
    write_columns(file.create_group("density_averages"), averages)
    keys = dict.fromkeys((row["group"], row["mean_pressure_Pa"]) for row in averages)
    sentences = [f"{group} at {1e-6 * pressure:g} MPa: full from 0.1 g/m^2" for group, pressure in keys]
    file.attrs["answers"] = sentences


def _link_scan(group, scan):
    ny, nx = scan["height"].shape
    group.attrs.update(
        {
            "file": scan["file"],
            "group": scan["group"],
            "input_sha256": scan["sha256"],
            "nx": nx,
            "ny": ny,
            "pixel_x_m": PIXEL,
            "pixel_y_m": PIXEL,
            "rms_height_m": float(scan["height"].std()),
            "rms_slope": 0.21,
            "treatment": ["level=plane", "lowpass=hann:512/L"],
            "doubts": [scan["doubts"]] if scan["doubts"] else [],
        }
    )
    group["surface"] = h5py.ExternalLink(scan["surface"], "/surface")
    group["psd"] = h5py.ExternalLink(scan["surface"], "/psd")
    for folder in ("contact", "films", "fluid"):
        members = group.create_group(folder)
        for key, (file, inside) in scan["contacts" if folder == "contact" else folder].items():
            members[f"{key:04d}"] = h5py.ExternalLink(file, inside)


def _sha256(text):
    return hashlib.sha256(text.encode()).hexdigest()
