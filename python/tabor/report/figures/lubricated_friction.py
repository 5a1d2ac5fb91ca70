"""Lubricated friction against pressure, one panel per group, one curve per density (Figure 9)."""

import textwrap

import numpy as np

from tabor.report import friction_series as series_of
from tabor.report import chart, oil, style, units
from tabor.report.figures import Drawn
from tabor.report.output import table_text

MAX_COLUMNS = 3
_AT_REST = " μ = (A_real − A_lub)/A₀ · τ_y/P (dimensionless), in which contact pixels that hold lubricant do not shear"
TITLE_WIDTH = 28  # characters over a panel of a third of the page


def draw(study, error="std"):
    panels = [(group, _curves(study, group)) for group in study.groups]
    panels = [(group, curves) for group, curves in panels if curves]
    if not panels:
        return None
    rows = chart.rows([_panel(study, group, curves, error) for group, curves in panels], MAX_COLUMNS)
    width = 5.6 if len(panels) == 1 else style.WIDTH
    every = [series for group, curves in panels for series in (series_of.dry(study, group), *curves)]
    return Drawn(
        "lubricated_friction",
        "Lubricated friction against pressure",
        _caption(study, every, error),
        chart.Figure(rows, 0.5 + 2.8 * len(rows), width, shares_x=True, shares_y="all"),
        {"": table_text(series_of.csv_columns(study, every))},
    )


def _curves(study, group):
    curves = (series_of.lubricated(study, group, density) for density in series_of.densities(study))
    return [series for series in curves if np.isfinite(series.mean).any()]


def _panel(study, group, curves, error):
    title = "\n".join(textwrap.wrap(f"{style.literal(group)} ({curves[0].n_text})", TITLE_WIDTH))
    dry, looks = series_of.dry(study, group), _looks(study)
    items = [series_of.curve(dry, error, label="dry", **style.DRY_CURVE)]
    items += [series_of.curve(series, error, label=f"computed {units.density(series.density)}", **looks[series.density]) for series in curves]
    for density, look in looks.items():
        points = series_of.experiment(study, group, density)
        if points:
            items.append(series_of.measured(points, colour=look["colour"], marker="d", label=series_of.measured_label(density)))
    items += series_of.rings_of([dry, *curves])
    x, y = chart.from_zero(series_of.PRESSURE, air=1), chart.from_zero(series_of.FRICTION)
    return chart.Panel(x, y, items, title=title)


def _looks(study):
    """{density: look}, in all panels the same; a measured density that was computed too has the look of its curve."""
    computed = series_of.densities(study)
    measured = series_of.measured_densities(study)
    densities = computed + [density for density in measured if not np.isclose(density, computed, rtol=1e-9).any()]
    densities = sorted(densities, key=lambda density: (np.isnan(density), density))
    return dict(zip(densities, style.ordered_styles(len(densities))))


def _caption(study, curves, error):
    rows = study.table.rows()
    parts = [
        f"Friction coefficient{'' if oil.is_trapped(rows) else _AT_REST}, mean over the scans of a group against the mean pressure P, "
        "for each areal lubricant density; dashed: the same contacts dry. "
    ]
    if oil.is_trapped(rows):
        parts.append(f"With oil, {oil.of_trapped(rows)}. ")
    if oil.is_flowing(rows):
        parts.append(f"The oil of these curves is at rest; while it flows, it carries {oil.span(oil.shares(rows, oil.FLOWING))}. ")
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
    return "".join(parts).rstrip() + " As Figure 9 of Costagliola et al." * (not oil.is_trapped(rows))
