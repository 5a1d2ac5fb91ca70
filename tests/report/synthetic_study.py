"""Study folders of the shape of docs/results.md with invented but plausible numbers.

Contact is a cut through the heights and the film fills them up to a locally smoothed level: good enough to look at,
never to be mistaken for a solution. Everything follows from the arguments, so equal arguments give equal folders.
"""

import csv
import hashlib
import json
from dataclasses import dataclass, field
from pathlib import Path

import h5py
import numpy as np

PIXEL = 0.67e-6
YOUNG, POISSON, SHEAR_STRENGTH, SATURATION = 70e9, 0.33, 70e6, 240e6
OIL_DENSITY = 900.0

RESULT_COLUMNS = ("case_id", "scan", "group", "mean_pressure_Pa", "lubricant_density_g_per_m2", "contact_area_fraction",
                  "contact_area_fraction_pixels", "saturated_area_fraction", "mean_gap_m", "lubricated_share",
                  "spill_over_fraction", "friction_dry", "friction_lubricated", "certificate", "converged")


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
    doubts: dict = field(default_factory=dict)  # {scan index: text}
    title: str = "EDT aluminium on steel, before sliding"

    @property
    def effective_modulus(self):
        return YOUNG / (1 - POISSON**2)


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
    low, high = 0.0, 1.0
    for _ in range(12):
        share = (low + high) / 2
        film = np.maximum(_tile_quantile(height, share) - height, 0)
        low, high = (share, high) if film.mean() < mean_film else (low, share)
    return film.astype(np.float32)


def _tile_quantile(height, share, side=24):
    level = np.empty_like(height)
    for y in range(0, height.shape[0], side):
        for x in range(0, height.shape[1], side):
            level[y:y + side, x:x + side] = np.quantile(height[y:y + side, x:x + side], share)
    return level


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
    result["radial_q_rad_per_m"], result["radial_c2d_m4"] = result["x_q_rad_per_m"], result["x_c1d_m3"] * PIXEL
    return result


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
    _write_csv(folder / "results.csv", RESULT_COLUMNS, rows)
    _write_csv(folder / "averages.csv", tuple(averages[0]), averages)
    _write_results(folder / "results.h5", recipe, scans, rows, averages)
    return rows


def average(rows):
    """averages.csv: mean, standard deviation (n - 1) and standard error over the scans of a group."""
    keys = list(dict.fromkeys((row["group"], row["mean_pressure_Pa"], row["lubricant_density_g_per_m2"]) for row in rows))
    result = []
    for group, pressure, density in keys:
        members = [row for row in rows if (row["group"], row["mean_pressure_Pa"], row["lubricant_density_g_per_m2"]) ==
                   (group, pressure, density)]
        line = {"group": group, "mean_pressure_Pa": pressure, "lubricant_density_g_per_m2": density, "n": len(members)}
        for kind in ("friction_dry", "friction_lubricated"):
            values = np.array([row[kind] for row in members])
            spread = values.std(ddof=1) if len(values) > 1 else np.nan
            line |= {f"{kind}_mean": values.mean(), f"{kind}_std": spread, f"{kind}_sem": spread / np.sqrt(len(values))}
        result.append(line)
    return result


def _write_scan(folder, recipe, index, group):
    height = height_map(recipe.shape, seed=100 + index)
    scan = {"file": f"before_{index + 1}.x3p", "group": group, "height": height, "doubts": recipe.doubts.get(index),
            "sha256": _sha256(f"scan {index}"), "contacts": {}, "films": {}, "rows": []}
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
    with _new_file(folder / name) as file:
        surface = _nxdata(file, "surface", "height")
        _map(surface, "height", scan["height"], "m", "height")
        surface["mask"] = np.zeros(scan["height"].shape, np.uint8)
        psd = file.create_group("psd")
        for key, values in spectra(scan["height"].astype(float)).items():
            psd[key] = values
        psd.attrs.update({"convention": "jacobs", "window": "hann", "hurst_x": 0.78, "hurst_y": 0.76, "hurst_radial": 0.77,
                          "rms_height_m": float(scan["height"].std()), "rms_slope": 0.21})
    return name


def _write_films(path, films):
    with _new_file(path) as file:
        for key, (density, film) in enumerate(films.items()):
            node = _nxdata(file, f"films/{key:04d}", "film_thickness")
            _map(node, "film_thickness", film, "m", "film thickness")
            node.attrs.update({"lubricant_density_g_per_m2": density, "mean_film_m": float(film.mean()),
                               "wet_fraction": float((film > 0).mean()), "max_film_m": float(film.max())})


def _write_state(folder, recipe, scan, index, step, pressure, films):
    state, gap = contact_maps(scan["height"], pressure, recipe, seed=3 * index)
    sure = (index, step) not in recipe.not_converged
    facts = {"mean_pressure_Pa": pressure, "contact_area_fraction_pixels": float((state > 0).mean()),
             "contact_area_fraction": float((state > 0).mean()) * 0.985, "saturated_area_fraction": float((state == 2).mean()),
             "mean_gap_m": float(gap.mean()), "certificate": 4e-9 if sure else 3e-3, "converged": sure}
    if recipe.saturated:
        facts["contact_area_fraction"] = max(facts["contact_area_fraction"], pressure / SATURATION)
    name = f"store/contact-{_sha256(f'contact {index} {step}')[:16]}.h5"
    with _new_file(folder / name) as file:
        node = _nxdata(file, "contact", "state")
        _map(node, "state", state, "1", "contact state")
        _map(node, "gap", gap, "m", "gap")
        node.attrs.update(facts)
    scan["contacts"][step] = (name, "/contact")
    for density, film in films.items():
        scan["rows"].append(_row(folder, scan, facts, density, film, state, gap))


def _row(folder, scan, facts, density, film, state, gap):
    touching = state > 0
    share = float((film[touching] > 0).mean())
    dry = facts["contact_area_fraction"] * SHEAR_STRENGTH / facts["mean_pressure_Pa"]
    row = {"case_id": _sha256(f"{scan['file']} {facts['mean_pressure_Pa']} {density}")[:16], "scan": scan["file"],
           "group": scan["group"], "lubricant_density_g_per_m2": density, "lubricated_share": share,
           "spill_over_fraction": float(np.maximum(film - gap, 0).sum() / film.sum()), "friction_dry": dry,
           "friction_lubricated": dry * (1 - share), **facts}
    row = {name: row[name] for name in RESULT_COLUMNS}
    (folder / "store" / f"case-{row['case_id']}.json").write_text(json.dumps(row))
    return row


def _write_results(path, recipe, scans, rows, averages):
    with _new_file(path) as file:
        file.attrs.update({"title": recipe.title, "shear_strength_Pa": SHEAR_STRENGTH, "youngs_modulus_Pa": YOUNG,
                           "poissons_ratio": POISSON, "effective_modulus_Pa": recipe.effective_modulus,
                           "oil_density_kg_per_m3": OIL_DENSITY, "area": "corrected", "n_cases_done": len(rows),
                           "n_cases": len(recipe.groups) * len(recipe.pressures) * len(recipe.densities)})
        if recipe.saturated:
            file.attrs["saturation_pressure_Pa"] = SATURATION
        _write_columns(file.create_group("table"), rows)
        _write_columns(file.create_group("averages"), averages)
        for index, scan in enumerate(scans):
            _link_scan(file.create_group(f"scans/{index:04d}"), scan)
        if recipe.experiment:
            _write_columns(file.create_group("experiment"), measured(recipe))


def measured(recipe):
    """Invented friction tests, falling with pressure."""
    return [{"mean_pressure_Pa": pressure, "friction": 0.24 - 0.05 * density - 4e-9 * pressure, "error": 0.008,
             "lubricant_density_g_per_m2": density} for density in recipe.densities for pressure in recipe.pressures]


def _link_scan(group, scan):
    ny, nx = scan["height"].shape
    group.attrs.update({"file": scan["file"], "group": scan["group"], "input_sha256": scan["sha256"], "nx": nx, "ny": ny,
                        "pixel_x_m": PIXEL, "pixel_y_m": PIXEL, "rms_height_m": float(scan["height"].std()),
                        "rms_slope": 0.21, "treatment": ["level=plane", "lowpass=hann:512/L"],
                        "doubts": [scan["doubts"]] if scan["doubts"] else []})
    group["surface"] = h5py.ExternalLink(scan["surface"], "/surface")
    group["psd"] = h5py.ExternalLink(scan["surface"], "/psd")
    for folder in ("contact", "films"):
        members = group.create_group(folder)
        for key, (file, inside) in scan["contacts" if folder == "contact" else "films"].items():
            members[f"{key:04d}"] = h5py.ExternalLink(file, inside)


def write_single(path, recipe=Recipe(pressures=(5e6, 10e6), densities=(0.9,)), film=True, contact=True):
    """A file as `friction -o` writes it; without film as `contact -o`, without contact as `lubricate -o`."""
    height = height_map(recipe.shape, seed=7)
    with _new_file(path) as file:
        surface = _nxdata(file, "surface", "height")
        _map(surface, "height", height.astype(float), "m", "height")
        surface["x"], surface["y"] = (np.arange(n) * PIXEL for n in height.shape[::-1])
        surface.attrs.update({"source": "one.x3p", "format": "x3p", "instrument": "confocal", "periodic": 0,
                              "treatment": ["level=plane"], "doubts": []})
        for key, pressure in enumerate(recipe.pressures if contact else (None,)):
            _write_single_state(file, key, height, pressure, recipe, film)


def _write_single_state(file, key, height, pressure, recipe, film):
    node = _nxdata(file, f"states/{key:04d}", "gap" if pressure else "film_thickness")
    if pressure:
        state, gap = contact_maps(height, pressure, recipe)
        _map(node, "pressure", np.array([0.0, 0.6 * SATURATION, SATURATION])[state], "Pa", "pressure")
        _map(node, "gap", gap.astype(float), "m", "gap")
        _map(node, "displacement", gap * 0.0, "m", "displacement")
        node.attrs.update({"mean_pressure_Pa": pressure, "contact_area_fraction": float((state > 0).mean()),
                           "converged": True, "certificate": 1e-9, "saturation_pressure_Pa": SATURATION})
    if film:
        _map(node, "film_thickness", film_map(height, recipe.densities[0]).astype(float), "m", "film thickness")
        node.attrs["lubricant_density_g_per_m2"] = recipe.densities[0]


def _new_file(path):
    file = h5py.File(path, "w")
    file.attrs.update({"format": "tabor", "format_version": 1, "software_version": "0.1.0",
                       "command": "tabor sweep study.toml", "config_toml": 'shear_strength = "70 MPa"\n',
                       "created": "2026-01-02T03:04:05Z", "default": "surface"})
    return file


def _nxdata(file, name, signal):
    group = file.create_group(name)
    group.attrs.update({"NX_class": "NXdata", "signal": signal, "axes": ["y", "x"]})
    return group


def _map(group, name, values, unit, long_name):
    dataset = group.create_dataset(name, data=values, compression="gzip", compression_opts=4, shuffle=True)
    dataset.attrs.update({"units": unit, "long_name": long_name})


def _write_columns(group, rows):
    for name in rows[0] if rows else ():
        values = [row[name] for row in rows]
        group[name] = np.array(values, dtype=h5py.string_dtype()) if isinstance(values[0], str) else np.array(values)


def _write_csv(path, columns, rows):
    with open(path, "w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, columns)
        writer.writeheader()
        writer.writerows(rows)


def _sha256(text):
    return hashlib.sha256(text.encode()).hexdigest()
