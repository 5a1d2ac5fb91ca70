"""Spectra of one scan over each other, or of many scans with means of groups; the range to be trusted."""

import math

import numpy as np

from tabor.report import chart, style, units
from tabor.report.figures import Drawn
from tabor.report.figures.psd import FLOOR
from tabor.report.output import table_text
from tabor.report.spectra import NAMES, UNITS

_LABELS = {"m3": "$C^{1D}$ (µm³)", "m4": "$C^{2D}$ (µm$^4$)"}
_SCALES = {"m3": 1e18, "m4": 1e24}


def draw(source):
    """Yields the figure, if there is a curve."""
    panels = _panels(source)
    if not panels:
        return
    figure = chart.Figure([[_panel(source, lines) for lines in panels]], 3.4, 3.7 * len(panels))
    yield Drawn("spectra", "Power spectral density", _caption(source), figure, {"": _csv(source)})


def _panels(source):
    """Of each panel the (label, style, axis, curves): of one scan the directions together, else a panel for each."""
    if len(source.sets) == 1:
        (one,) = source.sets
        colours = dict(zip(NAMES, style.COLOURS))
        panels = [[axis for axis in axes if axis in one.curves] for axes in (("x", "y"), ("radial",))]
        return [[(NAMES[axis], {"colour": colours[axis]}, axis, one) for axis in panel] for panel in panels if panel]
    styles = _styles(source.sets)
    return [
        [(_label(one), look, axis, one) for one, look in zip(source.sets, styles) if axis in one.curves]
        for axis in source.axes
    ]


def _label(one):
    return style.literal(f"{one.name}, mean of {one.n_scans}" if one.is_mean else one.name)


def _styles(sets):
    """Scans beside means are thin; each curve has a colour of its own."""
    has_means = any(one.is_mean for one in sets)
    widths = [2.2 if one.is_mean else 0.8 if has_means else 1.3 for one in sets]
    return [{"colour": colour, "width": width} for colour, width in zip(style.colours(len(sets)), widths)]


def _panel(source, lines):
    axis = lines[0][2]
    x = chart.Axis("$q$ (rad/µm)" if len(source.sets) == 1 else f"$q$ {NAMES[axis]} (rad/µm)", "log")
    panel = chart.Panel(x, chart.Axis(_LABELS[UNITS[axis]], "log"))
    for line in lines:
        panel.items += _items(*line)
    panel.items += [chart.Guide(place * 1e-6, True, "range to be trusted") for place in source.trusted or ()]
    return panel


def _items(label, look, axis, one):
    """A spectrum, of a mean with a band of one standard deviation; below, where the logarithm of mean minus deviation ends,
    down to a tenth of the mean."""
    q, density = one.curves[axis]
    shown, scale = density > FLOOR * density.max(), _SCALES[UNITS[axis]]
    q, mean = q[shown] * 1e-6, density[shown] * scale
    curve = chart.Curve(q, mean, label, z=1.9 if one.is_mean else 2, **look)  # scans on top
    if not one.is_mean:
        return [curve]
    spread = np.nan_to_num(one.deviations[axis][shown] * scale)
    return [curve, chart.Band(q, np.maximum(mean - spread, 0.1 * mean), mean + spread, label, look["colour"], 0.2)]


def _caption(source):
    text = "Power spectral densities against the angular wavevector q = 2π/λ."
    if source.trusted:
        low, high = source.trusted
        text += (
            " Between the dotted lines wavelengths are longer than 4 pixels and shorter than a quarter of the side"
            f"{'' if len(source.sets) == 1 else ' of every scan'} ({wavelength(high)} to {wavelength(low)}), a rule of thumb "
            "for what a scan can be trusted with."
        )
    elif len(source.sets) > 1:
        text += " There is no range of wavelengths that every scan can be trusted with."
    if any(one.is_mean for one in source.sets):
        text += " Bands are one standard deviation of the scans of a group about their mean, cut at a tenth of it."
    return f"{text} Values below {units.number(FLOOR)} of the largest are left out."


def wavelength(q):
    return units.length(2 * math.pi / q)


def _csv(source):
    columns = {"scan": [], "axis": [], "q_rad_per_m": [], "psd": [], "std": [], "unit": []}
    for one in source.sets:
        for axis, (q, density) in one.curves.items():
            spread = one.deviations.get(axis, [""] * len(q))
            cells = [one.file or one.name] * len(q), [axis] * len(q), q, density, spread, [UNITS[axis]] * len(q)
            for name, values in zip(columns, cells):
                columns[name].extend(values)
    return table_text(columns)
