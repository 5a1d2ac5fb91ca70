"""Dry friction against pressure, one curve per group (Figure 6 of the seed paper)."""

import itertools

import numpy as np

from tabor.report import friction_series as series_of
from tabor.report import chart, style, units
from tabor.report.figures import Drawn
from tabor.report.output import table_text


def draw(study, error="std"):
    curves = [
        series
        for series in (series_of.dry(study, group) for group in study.groups)
        if np.isfinite(series.mean).any()
    ]
    if not curves:
        return None
    panel = chart.Panel(chart.from_zero(series_of.PRESSURE, air=1), chart.from_zero(f"dry {series_of.FRICTION}"))
    for series, look in zip(curves, style.curve_styles(len(curves))):
        label = f"{style.literal(series.group) or 'computed'} ({series.n_text})"
        panel.items.append(series_of.curve(series, error, label=label, **look))
    panel.items += _experiment(study) + series_of.rings_of(curves) + _limit(study)
    return Drawn(
        "dry_friction",
        "Dry friction against pressure",
        _caption(study, curves, error),
        chart.Figure([[panel]], 3.4),
        {"": table_text(series_of.csv_columns(study, curves))},
    )


def limit(study):
    """tau_y / p_sat, where every contact pixel is saturated; None if elastic."""
    strength, cap = study.facts.get("shear_strength_Pa"), study.saturation_pressure
    return strength / cap if strength and cap else None


def _limit(study):
    value = limit(study)
    return [] if value is None else [chart.Guide(value, label=f"all contact saturated, $\\mu$ = {value:.3g}")]


def _experiment(study):
    """A curve of symbols for each density."""
    return [
        series_of.measured(series_of.experiment(study, density=density), colour="0.1", marker=marker, label=series_of.measured_label(density))
        for density, marker in zip(series_of.measured_densities(study), itertools.cycle("dph*<>8"))
    ]


def _caption(study, curves, error):
    strength = units.pressure(study.facts.get("shear_strength_Pa"))
    parts = [
        f"Dry friction coefficient μ = (A_real/A₀) τ_y/P (dimensionless) with shear strength τ_y = {strength}, "
        "mean over the scans of a group against the mean pressure P. "
    ]
    if any((series.n > 1).any() for series in curves):
        parts.append(
            f"Error bars: {series_of.ERROR_NAMES[error]} over the n scans of the legend; no bar where n = 1. "
        )
    else:
        parts.append("One scan per group (n = 1), hence no error bars. ")
    if limit(study) is not None:
        parts.append("Dotted: all contact saturated, μ = τ_y/p_sat. ")
    if study.experiment:
        parts.append("Hollow symbols: measured, with the error given in the measurement file. ")
    if any(len(series.loose_pressure) for series in curves):
        parts.append("Red rings: single cases that did not converge; no mean holds them. ")
    return "".join(parts) + "As Figure 6 of Costagliola et al."
