"""Mean friction against pressure, as averages.csv holds it, ready to plot."""

from dataclasses import dataclass

import numpy as np

from tabor.report import chart, oil, style, units
from tabor.report.table import Table, converged

DENSITY = "lubricant_density_g_per_m2"
PRESSURE, FRICTION = "mean pressure $P$ (MPa)", "friction coefficient $\\mu$"  # labels of axes
ERROR_NAMES = {"std": "standard deviation", "sem": "standard error of the mean"}


@dataclass
class Series:
    """One curve. pressure [Pa]; density [g/m^2] or NaN where it does not matter."""

    group: str
    density: float
    pressure: np.ndarray
    mean: np.ndarray
    std: np.ndarray
    sem: np.ndarray
    n: np.ndarray  # converged scans behind the mean
    loose_pressure: np.ndarray  # [Pa] of the cases that did not converge; no mean holds them
    loose_friction: np.ndarray
    rows: list  # of the averages

    def bar(self, kind):
        """Half length of the error bar; NaN (none) where one scan gives no spread."""
        return np.where(self.n > 1, getattr(self, kind), np.nan)

    @property
    def n_text(self):
        return number_text(self.n)


def number_text(n):
    """'n = 4', or 'n = 2-4' where not every mean has as many scans; means of nothing do not count."""
    known = n[n > 0]
    low, high = (int(known.min()), int(known.max())) if known.size else (0, 0)
    return f"n = {low}" if low == high else f"n = {low}\N{EN DASH}{high}"


def dry(study, group):
    """Dry friction knows neither density nor speed."""
    return _series(study, group, float("nan"), _by_pressure(_rows(study, group)), "friction_dry")


def lubricated(study, group, density):
    rows = _rows(study, group)
    rows = rows.where(rows.equal(DENSITY, density)) if rows else rows
    return _series(study, group, density, _by_pressure(rows), "friction_lubricated")


def trapped_share(study, group, density):
    """The share of the load that trapped oil carries."""
    rows = _rows(study, group)
    rows = rows.where(rows.equal(DENSITY, density)) if rows else rows
    return _series(study, group, density, _by_pressure(rows), oil.TRAPPED)


def densities(study):
    return [value for value in study.averages.distinct(DENSITY) if value > 0]


def experiment(study, group=None, density=None):
    """Measured points; those of another group (if the file names groups) or density are left out."""
    points = study.experiment
    if points and group is not None and "group" in points:
        points = points.where(points.equal("group", group))
    if points and density is not None and DENSITY in points:
        known = np.isfinite(points[DENSITY])
        points = points.where(points.equal(DENSITY, density) if np.isfinite(density) else ~known)
    return points


def measured_densities(study):
    """Distinct densities [g/m^2] of the experiment; NaN last if some point names none."""
    if not study.experiment:
        return []
    known = study.experiment.distinct(DENSITY)
    column = np.asarray(study.experiment.get(DENSITY, [np.nan]), dtype=float)
    return known + ([float("nan")] if np.isnan(column).any() else [])


def measured_label(density):
    return f"experiment {units.density(density)}" if np.isfinite(density) else "experiment"


def curve(series, error, **look):
    """The means with their bars."""
    shown = np.isfinite(series.mean)
    values = series.pressure[shown] * 1e-6, series.mean[shown]
    return chart.Curve(*values, error=series.bar(error)[shown], notes={"n": series.n[shown]}, **look)


def rings(x, y):
    """[] or one curve: cases that did not converge, ringed in the colour of a warning."""
    look = {"dash": "", "marker": "o", "size": 9, "colour": style.WARNING, "face": "none", "edge": 1.4}
    return [chart.Curve(x, y, "did not converge, in no mean", **look)] if len(x) else []


def rings_of(all_series):
    return rings(
        np.concatenate([series.loose_pressure * 1e-6 for series in all_series]),
        np.concatenate([series.loose_friction for series in all_series]),
    )


def measured(points, **look):
    error = np.asarray(points.get("error", np.full(len(points), np.nan)), dtype=float)
    values = points["mean_pressure_Pa"] * 1e-6, points["friction"]
    return chart.Curve(*values, error=error, dash="", face="white", bar=(0.8, 2.5), **look)


def csv_columns(study, all_series):
    """Columns of everything plotted: computed means, cases that did not converge, measured points."""
    names = "series group mean_pressure_Pa lubricant_density_g_per_m2 n friction std sem".split()
    columns = {name: [] for name in names}
    for series in all_series:
        for pressure, *values in zip(series.pressure, series.n, series.mean, series.std, series.sem):
            _append(columns, ("computed", series.group, pressure, series.density, *values))
        for pressure, friction in zip(series.loose_pressure, series.loose_friction):
            _append(columns, ("not converged", series.group, pressure, series.density, 1, friction, "", ""))
    for row in study.experiment.rows():
        where = (row.get("group", ""), row["mean_pressure_Pa"], row.get(DENSITY, float("nan")))
        _append(columns, ("experiment", *where, "", row["friction"], row.get("error", float("nan")), ""))
    return columns


def _append(columns, values):
    for name, value in zip(columns, values):
        columns[name].append(value)


def _rows(study, group):
    return study.averages.where(study.averages.equal("group", group)) if study.averages else Table({})


def _by_pressure(rows):
    """Rows by rising pressure; of equal pressures the one with most scans."""
    best = {}
    for row in rows.rows():
        known = best.get(row["mean_pressure_Pa"])
        if known is None or row["n"] > known["n"]:
            best[row["mean_pressure_Pa"]] = row
    return [best[pressure] for pressure in sorted(best)]


def _series(study, group, density, rows, name):
    def column(key):
        return np.array([row.get(key, np.nan) for row in rows], dtype=float)

    statistics = (column(f"{name}_{kind}") for kind in ("mean", "std", "sem"))
    loose = sorted(_loose(study, group, density, name))
    return Series(
        group,
        density,
        column("mean_pressure_Pa"),
        *statistics,
        column("n"),
        np.array([pressure for pressure, _ in loose], dtype=float),
        np.array([friction for _, friction in loose], dtype=float),
        rows,
    )


def _loose(study, group, density, name):
    """{(pressure, friction)} of the cases whose contact did not converge; equal ones are one."""
    table = study.table.where(~_contact_converged(study.table)) if study.table else Table({})
    if table:
        table = table.where(table.equal("group", group))
    if table and np.isfinite(density):
        table = table.where(table.equal(DENSITY, density))
    found = {(float(row["mean_pressure_Pa"]), float(row[name])) for row in table.rows()}
    return {pair for pair in found if np.isfinite(pair[1])}


def _contact_converged(table):
    """Where the film that flows did not, nothing is said against the contact at rest."""
    film = table.get("fluid_converged")
    return converged(table) if film is None else converged(table) | ~film.astype(bool)
