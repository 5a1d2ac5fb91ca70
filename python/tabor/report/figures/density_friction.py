"""Friction against the areal density of the lubricant: one panel per group, one curve per pressure."""

import math
import textwrap
from dataclasses import dataclass

import numpy as np

from tabor.report import friction_series as series_of
from tabor.report import style, units
from tabor.report.density_curves import PRESSURE
from tabor.report.figures import Drawn
from tabor.report.friction_series import DENSITY
from tabor.report.output import table_text

MAX_PANELS = 6
MAX_NAMED = 8  # pressures in the legend
TITLE_WIDTH = 44  # characters over a panel of half the page
DRY = "dry (same colours)"  # in the legend
LABEL_DECADES = 0.14  # asked densities nearer to each other than this share a label


@dataclass
class Curve:
    """One group under one pressure [Pa]; densities [g/m^2]; spread is NaN where n = 1; dry is NaN if unknown."""

    group: str
    pressure: float
    density: np.ndarray
    friction: np.ndarray
    spread: np.ndarray
    n: np.ndarray
    dry: float
    asked: np.ndarray  # densities that films were computed for [g/m^2], and the friction found with them
    found: np.ndarray


def of_study(study, error="std"):
    """None without curves, as in older files."""
    curves = [
        _curve_of_study(rows, group, pressure, study, error)
        for group, pressure, rows in _parts(study.density_averages)
    ]
    asked = {group: _asked_in_study(study, group) for group in study.groups}
    return _draw(curves, asked, series_of.ERROR_NAMES[error])


def of_single(single):
    """None without curves, as in older files."""
    curves = [_curve_of_single(rows, pressure, single) for _, pressure, rows in _parts(single.density_curves)]
    asked = sorted({state.density for state in single.states if state.density})
    return _draw(curves, {curve.group: asked for curve in curves}, None)


def _parts(table):
    """(group, pressure, rows by rising density), in the order of the file."""
    keys = dict.fromkeys(zip(table.get("group", ()), table.get(PRESSURE, ())))
    for group, pressure in keys:
        rows = table.where(table.equal("group", group) & table.equal(PRESSURE, pressure))
        yield group, float(pressure), rows.where(np.argsort(rows[DENSITY], kind="stable"))


def _curve_of_study(rows, group, pressure, study, error):
    spread = np.where(rows["n"] > 1, rows[f"friction_lubricated_{error}"], np.nan)
    dry = series_of.dry(study, group)
    known = dry.mean[np.isclose(dry.pressure, pressure, rtol=1e-9)]
    mean = rows["friction_lubricated_mean"]
    known_dry = float(known[0]) if known.size else math.nan
    asked, found = _found_in_study(study, group, pressure)
    return Curve(group, pressure, rows[DENSITY], mean, spread, rows["n"], known_dry, asked, found)


def _found_in_study(study, group, pressure):
    """(densities, mean friction) of the films that were computed."""
    table = study.averages
    if not table or DENSITY not in table or "friction_lubricated_mean" not in table:
        return np.empty(0), np.empty(0)
    table = table.where(table.equal("group", group) & table.equal(PRESSURE, pressure))
    return _above_zero(table[DENSITY], table["friction_lubricated_mean"])


def _above_zero(density, friction):
    density, friction = np.asarray(density, dtype=float), np.asarray(friction, dtype=float)
    usable = (density > 0) & np.isfinite(friction)
    return density[usable], friction[usable]


def _curve_of_single(rows, pressure, single):
    states = [state for state in single.states if state.pressure == pressure]
    dry = [state.facts.get("friction_dry", math.nan) for state in states]
    n, unknown = np.ones(len(rows)), np.full(len(rows), np.nan)
    known = [state for state in states if state.density]
    asked, found = _above_zero(
        [state.density for state in known], [state.facts.get("friction_lubricated", math.nan) for state in known]
    )
    friction = rows["friction_lubricated"]
    return Curve("", pressure, rows[DENSITY], friction, unknown, n, dry[0] if dry else math.nan, asked, found)


def _asked_in_study(study, group):
    table = study.table.where(study.table.equal("group", group)) if study.table else study.table
    return [density for density in table.distinct(DENSITY) if density > 0]


def _draw(curves, asked, error_name):
    groups = list(dict.fromkeys(curve.group for curve in curves))
    if not groups:
        return None
    shown = groups[:MAX_PANELS]
    figure, axes = _grid(len(shown))
    looks = _looks([curve for curve in curves if curve.group in shown])
    for panel, group in zip(axes.ravel(), shown):
        members = [curve for curve in curves if curve.group == group]
        _draw_panel(panel, members, looks, asked.get(group, []), with_n=error_name is not None)
    _finish(figure, axes, shown, [curve for curve in curves if curve.group in shown], looks)
    return Drawn(
        "friction_against_density",
        "Friction against lubricant density",
        _caption(curves, error_name, len(groups) - len(shown)),
        figure,
        {"": table_text(_csv_columns(curves, error_name))},
    )


def _grid(n_panels):
    columns = min(n_panels, 2)
    rows = math.ceil(n_panels / columns)
    width = style.WIDTH if columns > 1 else 5.6
    return style.new_figure(0.5 + 2.8 * rows, rows, columns, width=width, sharex=True, sharey=True)


def _looks(curves):
    """{pressure: colour}, the same in all panels, darker for less."""
    pressures = sorted({curve.pressure for curve in curves})
    return dict(zip(pressures, style.sequence(len(pressures))))


def _draw_panel(axes, curves, looks, asked, with_n):
    for curve in sorted(curves, key=lambda curve: curve.pressure):
        colour = looks[curve.pressure]
        (line,) = axes.plot(curve.density, curve.friction, color=colour, label=units.pressure(curve.pressure))
        if with_n:
            style.note(line, n=curve.n)
        axes.fill_between(
            curve.density, curve.friction - curve.spread, curve.friction + curve.spread, color=colour, alpha=0.18, lw=0
        )
        if math.isfinite(curve.dry):
            axes.axhline(curve.dry, color=colour, linestyle=(0, (4, 3)), linewidth=0.8).tabor_label = DRY
    for curve in curves:
        axes.plot(curve.asked, curve.found, linestyle="none", marker="o", markersize=3.5, color=looks[curve.pressure])
    axes.set_xscale("log")
    axes.grid(color="0.92", linewidth=0.6)
    _mark(axes, asked)
    n = series_of.number_text(np.concatenate([curve.n for curve in curves]))
    title = f"{style.literal(curves[0].group)} ({n})" if with_n else ""
    axes.set_title("\n".join(textwrap.wrap(title, TITLE_WIDTH)), pad=26)


def _mark(axes, asked):
    """Lines at the densities that were asked for, named above the panel, where no curve runs."""
    last = 0.0
    for density in asked:
        axes.axvline(density, color="0.35", linestyle=":", linewidth=0.9, zorder=1)
        if density < last * 10**LABEL_DECADES:
            continue
        last = density
        axes.annotate(
            units.number(density),
            (density, 1),
            xytext=(0, 2),
            xycoords=("data", "axes fraction"),
            textcoords="offset points",
            rotation=90,
            ha="center",
            va="bottom",
            fontsize=7,
            color="0.35",
        )


def _finish(figure, axes, shown, curves, looks):
    panels = axes.ravel()
    low, high = (pick(pick(curve.density) for curve in curves) for pick in (min, max))
    low, high = (low, high) if high > low else (low / 2, high * 2)
    panels[0].set_xlim(low, high)
    style.log_axis(panels[0].xaxis)
    panels[0].set_ylim(0, panels[0].get_ylim()[1] * 1.02)
    for index, panel in enumerate(panels):
        panel.set_visible(index < len(shown))
        panel.tick_params(labelbottom=index + axes.shape[1] >= len(shown))
        if index + axes.shape[1] >= len(shown):
            panel.set_xlabel("lubricant density (g/m²)")
        if index % axes.shape[1] == 0:
            panel.set_ylabel("friction coefficient $\\mu$")
    style.legend_on_top(figure, _legend_entries(panels[: len(shown)], looks))


def _legend_entries(panels, looks):
    found = {label: handle for panel in panels for label, handle in style.entries(panel).items()}
    steps = np.unique(np.linspace(0, len(looks) - 1, min(len(looks), MAX_NAMED)).round().astype(int))
    named = [units.pressure(list(looks)[step]) for step in steps]
    entries = {label: found[label] for label in named}
    grey = {"color": "0.35"}
    (dry,) = panels[0].plot([], [], linestyle=(0, (4, 3)), linewidth=0.8, **grey)
    (asked,) = panels[0].plot([], [], linestyle=":", linewidth=0.9, marker="o", markersize=3.5, **grey)
    return entries | {DRY: dry, "asked for": asked}


def _caption(curves, error_name, n_left_out):
    parts = [
        "Lubricated friction coefficient μ (dimensionless) against the areal density of the lubricant, at rest, one "
        "curve for each mean pressure P, for droplets that vanish (model limit). From left to right: friction falls "
        "while the oil fills the pockets under the contacts; on the plateau they are full and more oil gathers in the "
        "valleys, so that the density hardly matters; where it ends the oil level reaches the contacts, and beyond it "
        "covers more of them. Dashed: the same contacts dry. Dotted lines and dots: the densities that were asked "
        "for and the friction in the tables, of the droplets that were asked for. "
    ]
    if error_name is not None:
        parts.append(_about_n(curves, error_name))
    if n_left_out:
        parts.append(f"{n_left_out} more groups stand in the CSV file. ")
    return "".join(parts).rstrip()


def _about_n(curves, error_name):
    if any(np.isfinite(curve.spread).any() for curve in curves):
        return f"Means over the n scans in the panel's title; bands: {error_name}, none where n = 1. "
    return "One scan per group (n = 1), hence no bands. "


def _csv_columns(curves, error_name):
    def column(values_of):
        return np.concatenate([np.broadcast_to(values_of(curve), curve.density.shape) for curve in curves])

    columns = {"group": column(lambda curve: np.array(curve.group, dtype=object))} if error_name else {}
    return columns | {
        PRESSURE: column(lambda curve: curve.pressure),
        DENSITY: column(lambda curve: curve.density),
        "n": column(lambda curve: curve.n).astype(int),
        "friction_lubricated": column(lambda curve: curve.friction),
        "spread": column(lambda curve: curve.spread),
        "friction_dry": column(lambda curve: curve.dry),
    }
