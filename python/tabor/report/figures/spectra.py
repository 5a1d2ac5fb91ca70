"""Spectra of one scan over each other, or of many scans with means of groups; the range to be trusted."""

import math

import numpy as np

from tabor.report import style, units
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
    figure, grid = style.new_figure(3.4, n_columns=len(panels), width=3.7 * len(panels))
    for axes, lines in zip(grid[0], panels):
        _draw_panel(axes, source, lines)
    style.legend_on_top(figure, style.entries(*grid[0]))
    yield Drawn("spectra", "Power spectral density", _caption(source), figure, {"": _csv(source)})


def _panels(source):
    """Of each panel the (label, style, axis, curves): of one scan the directions together, else a panel for each."""
    if len(source.sets) == 1:
        (one,) = source.sets
        colours = dict(zip(NAMES, style.COLOURS))
        panels = [[axis for axis in axes if axis in one.curves] for axes in (("x", "y"), ("radial",))]
        return [[(NAMES[axis], {"color": colours[axis]}, axis, one) for axis in panel] for panel in panels if panel]
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
    return [{"color": colour, "linewidth": width} for colour, width in zip(style.colours(len(sets)), widths)]


def _draw_panel(axes, source, lines):
    for label, look, axis, one in lines:
        q, density = one.curves[axis]
        shown, scale = density > FLOOR * density.max(), _SCALES[UNITS[axis]]
        axes.loglog(q[shown] * 1e-6, density[shown] * scale, label=label, zorder=1.9 if one.is_mean else 2, **look)  # scans on top
        if one.is_mean:
            _draw_band(axes, q[shown], density[shown] * scale, one.deviations[axis][shown] * scale, look["color"])
    for place, label in zip(source.trusted or (), ("range to be trusted", None)):
        axes.axvline(place * 1e-6, color="0.45", linestyle=":", linewidth=1.0, label=label)
    for side in (axes.xaxis, axes.yaxis):
        style.log_axis(side)
    axis = lines[0][2]
    axes.set_xlabel("$q$ (rad/µm)" if len(source.sets) == 1 else f"$q$ {NAMES[axis]} (rad/µm)")
    axes.set_ylabel(_LABELS[UNITS[axis]])
    axes.grid(color="0.92", linewidth=0.6)


def _draw_band(axes, q, mean, deviation, colour):
    """One standard deviation; below, where the logarithm of mean minus deviation ends, down to a tenth of the mean."""
    spread = np.nan_to_num(deviation)
    axes.fill_between(q * 1e-6, np.maximum(mean - spread, 0.1 * mean), mean + spread, color=colour, alpha=0.2, linewidth=0)


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
