"""Friction, ploughing, contact and the heights of a sheet against the distance that a tool has slid."""

import numpy as np

from tabor.report import chart, style, units
from tabor.report.figures import Drawn
from tabor.report.output import table_text

_DRY, _KEPT, _SQUEEZED, _PLOUGHING = style.COLOURS[6], style.COLOURS[0], style.COLOURS[1], style.COLOURS[2]
_KEYS = ("distance_m", "friction_dry", "friction_lubricated", "friction_lubricated_squeezed", "friction_ploughing", "friction_ploughing_lower",
         "friction_ploughing_upper", "contact_area_fraction_pixels", "saturated_area_fraction", "lubricated_share", "squeezed_lubricated_share",
         "rms_height_m", "mean_roughness_m", "core_height_m", "peak_height_m", "dale_height_m", "moved_volume_m3_per_m2",
         "lost_volume_m3_per_m2", "worn_volume_m3_per_m2", "converged")  # fmt: skip


def draw(slide):
    """None where there is no way to draw along."""
    distance = slide.column_of("distance_m")
    if len(distance) < 2 or not distance.max() > 0:
        return None
    factor, unit = units.length_scale(distance.max())
    x = distance * factor
    axis = chart.Axis(f"distance ({unit})", low=0.0)
    has_oil = np.isfinite(slide.column_of("friction_lubricated")).any()
    rows = [[_friction(slide, x, axis), _ploughing(slide, x, axis)], [_contact(slide, x, axis), _heights(slide, x, axis)]]
    return Drawn(
        "along_the_way",
        "Friction and sheet along the way",
        _caption(slide, has_oil),
        chart.Figure(rows, 6.4, 7.6),
        {"": table_text({key: slide.column_of(key) for key in _KEYS})},
    )


def _friction(slide, x, axis):
    dry, kept, squeezed = (slide.column_of(f"friction_{name}") for name in ("dry", "lubricated", "lubricated_squeezed"))
    items = [chart.Curve(x, dry, "dry", _DRY, "--", marker="s", size=3.5, face="white")]
    if np.isfinite(squeezed).any():
        items.append(chart.Band(x, kept, squeezed, "between the bounds", _KEPT, 0.12))
        items.append(chart.Curve(x, squeezed, "oil squeezed out", _SQUEEZED, marker="^", size=4))
    if np.isfinite(kept).any():
        items.append(chart.Curve(x, kept, "oil kept", _KEPT, marker="o", size=4))
    return chart.Panel(axis, chart.from_zero("friction coefficient $\\mu$"), items)


def _ploughing(slide, x, axis):
    work, lower, upper = (1e3 * slide.column_of(f"friction_ploughing{name}") for name in ("", "_lower", "_upper"))
    known = np.isfinite(work)
    items = [chart.Band(x[known], lower[known], upper[known], "bounds of ploughing", _PLOUGHING, 0.2),
             chart.Curve(x[known], work[known], "ploughing", _PLOUGHING, marker="D", size=3.5)]  # fmt: skip
    return chart.Panel(axis, chart.Axis("ploughing, part of $\\mu$ ($10^{-3}$)", low=min(0.0, float(lower[known].min(initial=0.0)))), items)


def _contact(slide, x, axis):
    shown = (("contact_area_fraction_pixels", "counted contact", style.COLOURS[6], "-", "o"),
             ("saturated_area_fraction", "saturated", style.COLOURS[6], ":", ""),
             ("lubricated_share", "of it wet, oil kept", _KEPT, "-", ""),
             ("squeezed_lubricated_share", "of it wet, oil squeezed out", _SQUEEZED, "-", ""))  # fmt: skip
    areas = [chart.Curve(x, 100 * slide.column_of(key), label, colour, dash, marker=marker, size=3.5, is_right=key.endswith("lubricated_share"))
             for key, label, colour, dash, marker in shown if np.isfinite(slide.column_of(key)).any()]  # fmt: skip
    right = chart.from_zero("of the contact wet (%)") if any(one.is_right for one in areas) else None
    return chart.Panel(axis, chart.from_zero("share of the area (%)"), areas, right=right)


def _heights(slide, x, axis):
    names = (("rms_height_m", "Sq"), ("core_height_m", "Sk"), ("peak_height_m", "Spk"), ("dale_height_m", "Svk"))
    items = [chart.Curve(x, slide.column_of(key) * 1e6, name, colour, marker="", width=1.6)
             for (key, name), colour in zip(names, style.COLOURS[2:6])]  # fmt: skip
    return chart.Panel(axis, chart.Axis("heights of the sheet (µm)", "log"), items)


def _caption(slide, has_oil):
    oil = (
        " Oil that stays on its pixels gives the lower bound of lubricated friction, oil that contacts squeeze out the upper one; the truth, which depends "
        "on how oil flows, lies between."
        if has_oil and np.isfinite(slide.column_of("friction_lubricated_squeezed")).any()
        else ""
    )
    loose = "" if all(state.facts.get("converged", True) for state in slide.states) else " Some contacts along the way did not converge."
    return (
        f"A rough tool slides over {slide.title} under {units.pressure(slide.states[0].pressure)}. Top: friction with its part of ploughing, and that part "
        f"with its bounds, a mean since the state before.{oil} Below: contact, and heights of the unloaded sheet; the counted contact grows while contacts "
        f"conform, as more of its pixels carry less than p_sat.{loose}"
    )
