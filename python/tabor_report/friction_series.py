"""Mean friction against pressure, as averages.csv holds it, ready to plot."""

from dataclasses import dataclass

import numpy as np

from tabor_report import style
from tabor_report.table import Table, converged

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
    n: np.ndarray
    doubtful: np.ndarray  # a case behind the mean did not converge

    def bar(self, kind):
        """Half length of the error bar; NaN (none) where one scan gives no spread."""
        return np.where(self.n > 1, getattr(self, kind), np.nan)

    @property
    def n_text(self):
        low, high = int(self.n.min()), int(self.n.max())
        return f"n = {low}" if low == high else f"n = {low}\N{EN DASH}{high}"


def dry(study, group):
    """Dry friction does not know the density; of equal pressures the row with most scans is taken."""
    rows = _rows(study, group)
    best = {}
    for row in rows.rows():
        known = best.get(row["mean_pressure_Pa"])
        if known is None or row["n"] > known["n"]:
            best[row["mean_pressure_Pa"]] = row
    return _series(study, group, float("nan"), [best[pressure] for pressure in sorted(best)], "friction_dry")


def lubricated(study, group, density):
    rows = _rows(study, group)
    rows = rows.where(rows.equal("lubricant_density_g_per_m2", density)) if rows else rows
    ordered = sorted(rows.rows(), key=lambda row: row["mean_pressure_Pa"])
    return _series(study, group, density, ordered, "friction_lubricated")


def densities(study):
    return [value for value in study.averages.distinct("lubricant_density_g_per_m2") if value > 0]


def experiment(study, group=None, density=None):
    """Measured points; those of another group (if the file names groups) or density are left out."""
    points = study.experiment
    if points and group is not None and "group" in points:
        points = points.where(points.equal("group", group))
    if points and density is not None and "lubricant_density_g_per_m2" in points:
        points = points.where(points.equal("lubricant_density_g_per_m2", density))
    return points


def draw(axes, series, error, **look):
    """The curve with its bars, and a ring round every mean that holds a doubtful case."""
    shown = np.isfinite(series.mean)
    axes.errorbar(series.pressure[shown] * 1e-6, series.mean[shown], yerr=_bars(series.bar(error)[shown]), capsize=2.5,
                  elinewidth=0.9, **look)
    rings = shown & series.doubtful
    label = {"label": "holds a case that did not converge"} if rings.any() else {}
    axes.plot(series.pressure[rings] * 1e-6, series.mean[rings], linestyle="none", marker="o", markersize=11,
              markerfacecolor="none", markeredgecolor=style.WARNING, markeredgewidth=1.4, **label)


def draw_experiment(axes, points, **look):
    error = np.asarray(points.get("error", np.full(len(points), np.nan)), dtype=float)
    axes.errorbar(points["mean_pressure_Pa"] * 1e-6, points["friction"], yerr=_bars(error), linestyle="none", capsize=2.5,
                  elinewidth=0.8, markerfacecolor="white", **look)


def csv_columns(study, all_series):
    """Columns of everything plotted: computed means, then measured points."""
    columns = {name: [] for name in ("series", "group", "mean_pressure_Pa", "lubricant_density_g_per_m2", "n",
                                     "friction", "std", "sem", "not_converged")}
    for series in all_series:
        for values in zip(series.pressure, series.n, series.mean, series.std, series.sem, series.doubtful):
            _append(columns, ("computed", series.group, values[0], series.density, *values[1:]))
    for row in study.experiment.rows():
        _append(columns, ("experiment", row.get("group", ""), row["mean_pressure_Pa"],
                          row.get("lubricant_density_g_per_m2", float("nan")), "", row["friction"],
                          row.get("error", float("nan")), "", False))
    return columns


def _bars(lengths):
    """matplotlib stumbles over bars that are all NaN."""
    return lengths if np.isfinite(lengths).any() else None


def _append(columns, values):
    for name, value in zip(columns, values):
        columns[name].append(value)


def _rows(study, group):
    return study.averages.where(study.averages.equal("group", group)) if study.averages else Table({})


def _series(study, group, density, rows, name):
    def column(key):
        return np.array([row.get(key, np.nan) for row in rows], dtype=float)

    pressure = column("mean_pressure_Pa")
    return Series(group, density, pressure, column(f"{name}_mean"), column(f"{name}_std"), column(f"{name}_sem"),
                  column("n"), _doubtful(study, group, density, pressure))


def _doubtful(study, group, density, pressures):
    loose = study.table.where(~converged(study.table)) if study.table else Table({})
    if not loose:
        return np.zeros(len(pressures), dtype=bool)
    mask = loose.equal("group", group)
    if np.isfinite(density):
        mask = mask & loose.equal("lubricant_density_g_per_m2", density)
    bad = loose["mean_pressure_Pa"][mask]
    return np.array([np.any(np.isclose(bad, pressure, rtol=1e-9)) for pressure in pressures], dtype=bool)
