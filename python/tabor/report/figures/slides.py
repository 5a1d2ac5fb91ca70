"""Friction of the sheets of a study against the distance that a tool has slid, one panel per pressure."""

import numpy as np

from tabor.report import chart, style, units
from tabor.report.figures import Drawn
from tabor.report.output import table_text

MAX_COLUMNS = 2
_DENSITY = "lubricant_density_g_per_m2"


def draw(study):
    """None for a study whose sheets do not slide."""
    slides = study.slides
    if not slides:
        return None
    pressures = sorted(set(slides["mean_pressure_Pa"]))
    factor, unit = units.length_scale(max(slides["distance_m"]))
    axis = chart.Axis(f"distance ({unit})", low=0.0)
    panels = [_panel(slides.where(slides["mean_pressure_Pa"] == pressure), pressure, axis, factor) for pressure in pressures]
    rows = chart.rows(panels, MAX_COLUMNS)
    return Drawn(
        "slides",
        "Friction while sliding",
        "Friction coefficient with its part of ploughing against the distance that a rough tool has slid, one line for each scan: without oil (grey, dashed); "
        "with oil that stays on its pixels, a lower bound (full, darker for more of it); with oil that contacts squeeze out, an upper bound (dotted).",
        chart.Figure(rows, 0.6 + 2.9 * len(rows), style.WIDTH if len(panels) > 1 else 5.6, shares_x=True, shares_y="all"),
        {"": table_text({key: slides[key] for key in slides})},
    )


def _panel(slides, pressure, axis, factor):
    densities = sorted(set(slides[_DENSITY]))
    looks = dict(zip(densities, style.ordered_styles(len(densities))))
    items = []
    for density in densities:
        for one in _each(slides.where(slides[_DENSITY] == density)):
            x, colour = one["distance_m"] * factor, looks[density]["colour"]
            items.append(chart.Curve(x, one["friction_dry"], "dry", style.DRY_CURVE["colour"], "--", 0.9))
            if density > 0:
                items.append(chart.Curve(x, one["friction_lubricated"], f"{units.density(density)}, oil kept", colour))
                items.append(chart.Curve(x, one["friction_lubricated_squeezed"], f"{units.density(density)}, oil squeezed out", colour, ":"))
    return chart.Panel(axis, chart.from_zero("friction coefficient $\\mu$"), items, title=f"$P$ = {units.pressure(pressure)}")


def _each(slides):
    """The states of each scan, in their order."""
    scans = np.array([f"{group} {scan}" for group, scan in zip(slides["group"], slides["scan"])])
    return [slides.where(scans == scan) for scan in dict.fromkeys(scans)]
