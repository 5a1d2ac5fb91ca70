"""Spectra of one scan: along x and y over each other, and radial, with the range to be trusted."""

import math

from tabor_report import style, units
from tabor_report.figures import Drawn
from tabor_report.figures.psd import FLOOR
from tabor_report.output import table_text
from tabor_report.spectra import NAMES, UNITS

_PANELS = {"profiles": ("x", "y"), "radial": ("radial",)}
_LABELS = {"profiles": "$C^{1D}$ (µm³)", "radial": "$C^{2D}$ (µm$^4$)"}
_SCALES = {"profiles": 1e18, "radial": 1e24}


def draw(source):
    """Yields the figure, if there is a curve."""
    panels = {panel: [axis for axis in axes if axis in source.curves] for panel, axes in _PANELS.items()}
    panels = {panel: axes for panel, axes in panels.items() if axes}
    if not panels:
        return
    figure, grid = style.new_figure(3.4, n_columns=len(panels), width=3.7 * len(panels))
    for axes, (panel, members) in zip(grid[0], panels.items()):
        _draw_panel(axes, source, panel, members)
    style.legend_on_top(figure, style.entries(*grid[0]))
    yield Drawn("spectra", "Power spectral density", _caption(source), figure, {"": _csv(source)})


def _draw_panel(axes, source, panel, members):
    for member in members:
        q, density = source.curves[member]
        shown = density > FLOOR * density.max()
        colour = style.COLOURS[list(NAMES).index(member)]
        axes.loglog(q[shown] * 1e-6, density[shown] * _SCALES[panel], color=colour, label=NAMES[member])
    low, high = source.trusted
    for place, label in ((low, "range to be trusted"), (high, None)):
        axes.axvline(place * 1e-6, color="0.45", linestyle=":", linewidth=1.0, label=label)
    for side in (axes.xaxis, axes.yaxis):
        style.log_axis(side)
    axes.set_xlabel("$q$ (rad/µm)")
    axes.set_ylabel(_LABELS[panel])
    axes.grid(color="0.92", linewidth=0.6)


def _caption(source):
    low, high = source.trusted
    return (
        "Power spectral densities against the angular wavevector q = 2π/λ. Between the dotted lines wavelengths are "
        f"longer than 4 pixels and shorter than a quarter of the side ({wavelength(high)} to {wavelength(low)}), a rule "
        f"of thumb for what a scan can be trusted with. Values below {units.number(FLOOR)} of the largest are left out."
    )


def wavelength(q):
    return units.length(2 * math.pi / q)


def _csv(source):
    columns = {"axis": [], "q_rad_per_m": [], "psd": [], "unit": []}
    for axis, (q, density) in source.curves.items():
        for name, values in zip(columns, ([axis] * len(q), q, density, [UNITS[axis]] * len(q))):
            columns[name].extend(values)
    return table_text(columns)
