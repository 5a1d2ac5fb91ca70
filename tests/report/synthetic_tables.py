"""Averages, invented measurements, and tables as CSV and HDF5 columns."""

import csv

import h5py
import numpy as np


KEYS = ("group", "mean_pressure_Pa", "lubricant_density_g_per_m2", "sliding_speed_m_per_s")


def average(rows):
    """averages.csv: mean, standard deviation (n - 1) and standard error over a group's converged scans."""
    keys = list(dict.fromkeys(_key(row) for row in rows))
    result = []
    for key in keys:
        members = [row for row in rows if _key(row) == key and row["converged"]]
        line = dict(zip(KEYS[:3], key)) | {"n": len(members)}
        line |= _statistics(members, ("friction_dry", "friction_lubricated"))
        if key[3] is not None:
            line[KEYS[3]] = key[3]
            line |= _statistics(members, ("fluid_load_share", "friction_viscous", "friction_mixed"))
        result.append(line)
    return result


DOSES = (0.001, 0.01, 0.1, 1.0, 10.0)  # [g/m^2]


def density_curves(recipe):
    """Rows of /density_curves, invented: flat from 0.1 to 1 g/m^2, then drowned; scans differ a little."""
    return [
        {
            "scan": f"scan {index}",
            "group": group,
            "mean_pressure_Pa": pressure,
            "lubricant_density_g_per_m2": dose,
            "lubricated_share": share,
            "friction_lubricated": (0.3 - 0.01 * index - 2e-9 * pressure) * (1 - share),
        }
        for index, group in enumerate(recipe.groups)
        for pressure in recipe.pressures
        for dose, share in zip(DOSES, (0.05, 0.1, 0.2, 0.2, 1.0))
    ]


def plateaus(rows):
    """Rows of /density_plateaus of these mean curves."""
    keys = dict.fromkeys((row["group"], row["mean_pressure_Pa"]) for row in rows)
    return [
        {
            "group": group,
            "mean_pressure_Pa": pressure,
            "below_plateau_g_per_m2": 0.01,
            "plateau_from_g_per_m2": 0.1,
            "plateau_to_g_per_m2": 1.0,
            "beyond_plateau_g_per_m2": 10.0,
            "lubricated_share": 0.2,
        }
        for group, pressure in keys
    ]


def places(rows, densities):
    """Rows of /density_places."""
    keys = dict.fromkeys((row["group"], row["mean_pressure_Pa"]) for row in rows)
    return [
        {
            "group": group,
            "mean_pressure_Pa": pressure,
            "lubricant_density_g_per_m2": density,
            "lubricated_share": 0.2 if density <= 1 else 0.6,
            "place": "plateau" if density <= 1 else "beyond",
        }
        for group, pressure in keys
        for density in densities
    ]


def average_curves(rows):
    """Rows of /density_averages."""
    names = ("group", "mean_pressure_Pa", "lubricant_density_g_per_m2")
    result = []
    for key in dict.fromkeys(tuple(row[name] for name in names) for row in rows):
        members = [row for row in rows if tuple(row[name] for name in names) == key]
        line = dict(zip(names, key)) | {"n": len(members)}
        result.append(line | _statistics(members, ("lubricated_share", "friction_lubricated")))
    return result


def _key(row):
    return tuple(row.get(name) for name in KEYS)


def _statistics(members, kinds):
    line = {}
    for kind in kinds:
        values = np.array([row[kind] for row in members])
        spread = values.std(ddof=1) if len(values) > 1 else np.nan
        line[f"{kind}_mean"] = values.mean() if len(values) else np.nan
        line |= {f"{kind}_std": spread, f"{kind}_sem": spread / np.sqrt(max(1, len(values)))}
    return line


def measured(recipe):
    """Invented friction tests, falling with pressure."""
    return [
        {
            "mean_pressure_Pa": pressure,
            "friction": 0.24 - 0.05 * density - 4e-9 * pressure,
            "error": 0.008,
            "lubricant_density_g_per_m2": density,
        }
        for density in recipe.densities
        for pressure in recipe.pressures
    ]


def write_columns(group, rows):
    for name in rows[0] if rows else ():
        values = [row[name] for row in rows]
        group[name] = (
            np.array(values, dtype=h5py.string_dtype()) if isinstance(values[0], str) else np.array(values)
        )


def write_csv(path, columns, rows):
    with open(path, "w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, columns)
        writer.writeheader()
        writer.writerows(rows)
