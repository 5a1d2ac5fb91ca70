"""Friction against the areal density of the lubricant: one panel per group, one curve per pressure."""

import math
import textwrap
from dataclasses import dataclass

import numpy as np

from tabor.report import friction_series as series_of
from tabor.report import chart, style, units
from tabor.report.density_curves import PRESSURE
from tabor.report.figures import Drawn
from tabor.report.friction_series import DENSITY
from tabor.report.output import table_text

MAX_PANELS = 6
MAX_NAMED = 8  # pressures in the legend
TITLE_WIDTH = 44  # characters over a panel of half the page
DRY = "dry (same colours)"  # in the legend
DASHED = {"dash": (4, 3), "width": 0.8}
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
    drawn = [curve for curve in curves if curve.group in shown]
    colours = _colours(drawn)
    axes = _density_axis(drawn), chart.from_zero(series_of.FRICTION)
    panels = [
        _panel(axes, [curve for curve in drawn if curve.group == group], colours, asked.get(group, []), with_n=error_name is not None)
        for group in shown
    ]
    rows = chart.rows(panels, 2)
    figure = chart.Figure(rows, 0.5 + 2.8 * len(rows), style.WIDTH if len(panels) > 1 else 5.6, shares_x=True, shares_y="all", legend=_legend(colours))
    return Drawn(
        "friction_against_density",
        "Friction against lubricant density",
        _caption(curves, error_name, len(groups) - len(shown)),
        figure,
        {"": table_text(_csv_columns(curves, error_name))},
    )


def _colours(curves):
    """{pressure: colour}, the same in all panels, darker for less."""
    pressures = sorted({curve.pressure for curve in curves})
    return dict(zip(pressures, style.sequence(len(pressures))))


def _density_axis(curves):
    low, high = (pick(pick(curve.density) for curve in curves) for pick in (min, max))
    low, high = (low, high) if high > low else (low / 2, high * 2)
    return chart.Axis("lubricant density (g/m²)", "log", float(low), float(high))


def _panel(axes, curves, colours, asked, with_n):
    panel = chart.Panel(*axes, title=_title(curves) if with_n else "")
    curves = sorted(curves, key=lambda curve: curve.pressure)
    for curve in curves:
        panel.items += _items(curve, colours[curve.pressure], with_n)
    panel.items += [chart.Guide(curve.dry, False, DRY, colours[curve.pressure], **DASHED) for curve in curves if math.isfinite(curve.dry)]
    for curve in curves:
        look = {"dash": "", "marker": "o", "size": 3.5, "colour": colours[curve.pressure]}
        panel.items.append(chart.Curve(curve.asked, curve.found, units.pressure(curve.pressure), **look))
    panel.items += _marks(asked)
    return panel


def _title(curves):
    n = series_of.number_text(np.concatenate([curve.n for curve in curves]))
    return "\n".join(textwrap.wrap(f"{style.literal(curves[0].group)} ({n})", TITLE_WIDTH))


def _items(curve, colour, with_n):
    """A curve with its band."""
    label, notes = units.pressure(curve.pressure), {"n": curve.n} if with_n else {}
    return [
        chart.Curve(curve.density, curve.friction, label, colour, notes=notes),
        chart.Band(curve.density, curve.friction - curve.spread, curve.friction + curve.spread, label, colour, 0.18),
    ]


def _marks(asked):
    """Lines at the densities that were asked for, named above the panel, where no curve runs."""
    items, last = [], 0.0
    for density in asked:
        items.append(chart.Guide(density, True, colour="0.35", width=0.9, z=1))
        if density >= last * 10**LABEL_DECADES:
            last = density
            items.append(chart.Text(units.number(density), density, size=7, colour="0.35"))
    return items


def _legend(colours):
    """Some of the pressures, and in grey what looks alike under all."""
    pressures = list(colours)
    steps = np.unique(np.linspace(0, len(pressures) - 1, min(len(pressures), MAX_NAMED)).round().astype(int))
    named = [chart.Curve(label=units.pressure(pressures[step]), colour=colours[pressures[step]]) for step in steps]
    dry = chart.Curve(label=DRY, colour="0.35", **DASHED)
    return (*named, dry, chart.Curve(label="asked for", colour="0.35", dash=":", width=0.9, marker="o", size=3.5))


def _caption(curves, error_name, n_left_out):
    parts = [
        "Lubricated friction coefficient μ (dimensionless) against the areal density of the lubricant, at rest, one "
        "curve for each mean pressure P, for droplets that vanish (model limit). From left to right: friction falls "
        "while the oil fills the pockets under the contacts; on the plateau they are full, or hardly any contact has one, and more oil gathers in the "
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
