"""Lubricated friction against pressure, one panel per group, one curve per density (Figure 9)."""

import math
import textwrap

import numpy as np

from tabor.report import friction_series as series_of
from tabor.report import style, units
from tabor.report.figures import Drawn
from tabor.report.output import table_text

MAX_COLUMNS = 3
TITLE_WIDTH = 28  # characters over a panel of a third of the page


def draw(study, error="std"):
    panels = [(group, _curves(study, group)) for group in study.groups]
    panels = [(group, curves) for group, curves in panels if curves]
    if not panels:
        return None
    figure, axes = _grid(len(panels))
    for panel, (group, curves) in zip(axes.ravel(), panels):
        _draw_panel(panel, study, group, curves, error)
    for unused in axes.ravel()[len(panels) :]:
        unused.set_visible(False)
    _label(axes, len(panels))
    style.limits_from_zero(axes[0][0])
    style.legend_on_top(
        figure, {label: handle for panel in axes.ravel() for label, handle in style.entries(panel).items()}
    )
    every = [series for group, curves in panels for series in (series_of.dry(study, group), *curves)]
    return Drawn(
        "lubricated_friction",
        "Lubricated friction against pressure",
        _caption(study, every, error),
        figure,
        {"": table_text(series_of.csv_columns(study, every))},
    )


def _curves(study, group):
    curves = (series_of.lubricated(study, group, density) for density in series_of.densities(study))
    return [series for series in curves if np.isfinite(series.mean).any()]


def _grid(n_panels):
    columns = min(n_panels, MAX_COLUMNS)
    rows = math.ceil(n_panels / columns)
    width = {1: 5.6}.get(columns, style.WIDTH)
    return style.new_figure(0.5 + 2.8 * rows, rows, columns, width=width, sharex=True, sharey=True)


def _draw_panel(axes, study, group, curves, error):
    series_of.draw(
        axes,
        series_of.dry(study, group),
        error,
        label="dry",
        color="0.35",
        marker="s",
        linestyle="--",
        markersize=4,
        markerfacecolor="white",
        zorder=4,  # to be seen over a curve that it coincides with
    )
    looks = _looks(study)
    for series in curves:
        look = looks[series.density]
        series_of.draw(axes, series, error, label=f"computed {units.density(series.density)}", **look)
    for density, look in looks.items():
        points = series_of.experiment(study, group, density)
        if points:
            series_of.draw_experiment(
                axes, points, color=look["color"], marker="d", label=series_of.measured_label(density)
            )
    axes.set_title("\n".join(textwrap.wrap(f"{style.literal(group)} ({curves[0].n_text})", TITLE_WIDTH)))
    axes.grid(color="0.92", linewidth=0.6)


def _looks(study):
    """{density: look}, in all panels the same; a measured density that was computed too has the look of its curve."""
    computed = series_of.densities(study)
    measured = series_of.measured_densities(study)
    densities = computed + [density for density in measured if not np.isclose(density, computed, rtol=1e-9).any()]
    densities = sorted(densities, key=lambda density: (np.isnan(density), density))
    return dict(zip(densities, style.ordered_styles(len(densities))))


def _label(axes, n_panels):
    columns = axes.shape[1]
    for index, panel in enumerate(axes.ravel()[:n_panels]):
        if index + columns >= n_panels:
            panel.set_xlabel("mean pressure $P$ (MPa)")
            panel.tick_params(labelbottom=True)
        if index % columns == 0:
            panel.set_ylabel("friction coefficient $\\mu$")


def _caption(study, curves, error):
    parts = [
        "Friction coefficient μ = (A_real − A_lub)/A₀ · τ_y/P (dimensionless), in which contact pixels that hold "
        "lubricant do not shear, mean over the scans of a group against the mean pressure P, for each areal "
        "lubricant density; dashed: the same contacts dry. "
    ]
    if any((series.n > 1).any() for series in curves):
        parts.append(
            f"Error bars: {series_of.ERROR_NAMES[error]} over the n scans in the panel's title; none where n = 1. "
        )
    else:
        parts.append("One scan per group (n = 1), hence no error bars. ")
    if study.experiment:
        parts.append("Hollow diamonds: measured, with the error given in the measurement file. ")
    if any(len(series.loose_pressure) for series in curves):
        parts.append("Red rings: single cases that did not converge; no mean holds them. ")
    return "".join(parts) + "As Figure 9 of Costagliola et al."
