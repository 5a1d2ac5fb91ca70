"""Spectra of a sheet before and after sliding, along x and y (Figure 4 of the seed paper)."""

import numpy as np

from tabor.report import chart, style
from tabor.report.figures import Drawn
from tabor.report.figures.psd import FLOOR
from tabor.report.output import table_text
from tabor.report.slide import AXES, BEFORE

MOST_BETWEEN = 4  # states between both ends
BINS_PER_DECADE = 12  # of the ratio


def draw(slide):
    """None without spectra."""
    lines = _lines(slide)
    axes = [axis for axis in AXES if any(axis in slide.spectra[key] for key, _, _ in lines)]
    if len(lines) < 2 or not axes:
        return None
    rows = [[_panel(slide, axis, lines) for axis in axes], [_ratio(slide, axis, lines) for axis in axes]]
    names = {"x": "along x, the direction of sliding", "y": "along y"}
    return Drawn(
        "slide_spectra",
        "Spectra of the sheet before and after",
        f"Top: power spectral density of {slide.title} {', and '.join(names[axis] for axis in axes)}, before sliding (grey, dashed), along the way (thin) and "
        f"after (thick), against the angular wavevector q = 2π/λ. Below: each over that before, mean of {BINS_PER_DECADE} bins a decade.",
        chart.Figure(rows, 5.6, 3.8 * len(axes), shares_y="row"),
        {"": _csv(slide, lines)},
    )


def _lines(slide):
    """[(key, label, look)]: before, some states, the last one."""
    keys = [state.key for state in slide.states if state.key in slide.spectra]
    if BEFORE not in slide.spectra or not keys:
        return []
    between = keys[1:-1]
    step = max(1, -(-len(between) // MOST_BETWEEN))
    names = {state.key: state.name for state in slide.states}
    found = [(BEFORE, "before", {"colour": "0.4", "dash": "--", "width": 1.4})]
    chosen = between[step - 1 :: step]
    found += [(key, names[key], {"colour": colour, "width": 0.7}) for key, colour in zip(chosen, style.sequence(len(chosen)))]
    return [*found, (keys[-1], names[keys[-1]], {"colour": style.COLOURS[1], "width": 1.7})]


def _panel(slide, axis, lines):
    items = []
    for key, label, look in lines:
        if axis not in slide.spectra[key]:
            continue
        q, density = slide.spectra[key][axis]
        shown = density > FLOOR * density.max()
        items.append(chart.Curve(q[shown] * 1e-6, density[shown] * 1e18, label, **look))
    return chart.Panel(chart.Axis(f"$q_{axis}$ (rad/µm)", "log"), chart.Axis("$C^{1D}$ (µm³)", "log"), items)


def _ratio(slide, axis, lines):
    items = [chart.Guide(1.0, colour="0.4", dash="--")]
    before = slide.spectra[BEFORE].get(axis)
    for key, label, look in lines[1:]:
        if before is not None and axis in slide.spectra[key]:
            items.append(chart.Curve(*_binned(before[0], slide.spectra[key][axis][1], before[1]), label, **look))
    return chart.Panel(chart.Axis(f"$q_{axis}$ (rad/µm)", "log"), chart.Axis("after / before"), items)


def _binned(q, after, before):
    """(middle of each bin [rad/µm], ratio of the sums in it)"""
    place = np.floor(BINS_PER_DECADE * np.log10(q / q[0])).astype(int)
    sums = [np.bincount(place, weights=values) for values in (q, after, before, np.ones_like(q))]
    there = sums[3] > 0
    middle, above, below, count = (values[there] for values in sums)
    return middle / count * 1e-6, above / below


def _csv(slide, lines):
    columns = {"state": [], "axis": [], "q_rad_per_m": [], "psd_m3": []}
    for key, label, _ in lines:
        for axis, (q, density) in slide.spectra[key].items():
            for name, values in zip(columns, ([label] * len(q), [axis] * len(q), q, density)):
                columns[name].extend(np.asarray(values).tolist())
    return table_text(columns)
