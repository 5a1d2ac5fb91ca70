"""Power spectral densities along x and y of all groups (Figure 4 of the seed paper)."""

import numpy as np

from tabor.report import chart, style, units
from tabor.report.figures import Drawn
from tabor.report.output import table_text

REFERENCE_HURST = 0.8
# A low-pass filter leaves rounding noise far below the spectrum; it would squeeze the picture.
FLOOR = 1e-11


def draw(study):
    curves = {axis: _curves(study, axis) for axis in ("x", "y")}
    if not curves["x"] and not curves["y"]:
        return None
    labels = [_label(index, curves) for index in range(max(map(len, curves.values())))]
    row = [_panel(axis, of_axis, labels) for axis, of_axis in curves.items()]
    figure = chart.Figure([row], 3.3, style.WIDTH, shares_y="all")
    return Drawn("psd", "Power spectral density along x and y", _caption(study), figure, {"": _csv(curves)})


def mean_by_grid(members):
    """Averages spectra on the same wavevectors; those on another grid stay apart.

    members: list of (q [rad/m], density [m^3], hurst). Returns the same with n appended.
    """
    grids = {}
    for q, density, hurst in members:
        grids.setdefault(q.tobytes(), []).append((q, density, hurst))
    return [
        (
            group[0][0],
            np.mean([item[1] for item in group], axis=0),
            _mean([item[2] for item in group]),
            len(group),
        )
        for group in grids.values()
    ]


def _curves(study, axis):
    """[(group, q, density, hurst, n)]"""
    members = {}
    for scan in study.scans:
        psd = scan.psd()
        if psd is not None:
            members.setdefault(scan.group, []).append(
                (
                    psd[f"{axis}_q_rad_per_m"][()],
                    psd[f"{axis}_c1d_m3"][()],
                    float(psd.attrs.get(f"hurst_{axis}", np.nan)),
                )
            )
    return [(group, *curve) for group, spectra in members.items() for curve in mean_by_grid(spectra)]


def _panel(axis, curves, labels):
    """Curves come in the same order in both panels, so that they share labels, which hold the Hurst exponents of both."""
    panel = chart.Panel(chart.Axis(f"$q$ along ${axis}$ (rad/µm)", "log"), chart.Axis("$C^{1D}$ (µm³)", "log"))
    for index, (look, label) in enumerate(zip(style.curve_styles(len(curves)), labels)):
        _, q, density, _, _ = curves[index]
        shown = density > density.max() * FLOOR
        dash = (4, 4) if _is_drawn(q, density, curves[:index]) else "-"
        panel.items.append(chart.Curve(q[shown] * 1e-6, density[shown] * 1e18, label, look["colour"], dash, 1.1))
    if curves:
        panel.items += _slope(curves)
    return panel


def _is_drawn(q, density, curves):
    """Whether one of these runs where this one does: dashed over it, both can be seen."""
    same_grid = (other for _, grid, other, _, _ in curves if np.array_equal(q, grid))
    return any(np.allclose(density, other, rtol=0.1, atol=0) for other in same_grid)


def _slope(curves):
    """A dashed line C ~ q^-(1 + 2H), three times above the highest curve in its range."""
    low, high = _slope_range(curves)
    q = np.array([low, high])
    exponent = -(1 + 2 * REFERENCE_HURST)
    highest = max(
        np.max(density[inside] / grid[inside] ** exponent)
        for _, grid, density, _, _ in curves
        for inside in [(grid >= low) & (grid <= high)]
        if inside.any()
    )
    line = 3 * highest * q**exponent
    middle = np.sqrt(low * high)
    place = middle * 1e-6, 3 * highest * middle**exponent * 1e18
    return [
        chart.Curve(q * 1e-6, line * 1e18, colour="0.25", dash=(4, 3), width=1.1),
        chart.Text(f"$H$ = {REFERENCE_HURST}", *place),
    ]


def _slope_range(curves):
    q = np.concatenate([grid[density > density.max() * FLOOR] for _, grid, density, _, _ in curves])
    span = np.log(q.max() / q.min())
    return q.min() * np.exp(0.35 * span), q.min() * np.exp(0.75 * span)


def _label(index, curves):
    found = {axis: of_axis[index] for axis, of_axis in curves.items() if index < len(of_axis)}
    group, _, _, _, n = next(iter(found.values()))
    fitted = [f"{curve[3]:.2f} along ${axis}$" for axis, curve in found.items() if np.isfinite(curve[3])]
    exponents = f", $H$ = {' and '.join(fitted)}" if fitted else ""
    return f"{style.literal(group) or 'scans'} (n = {n}{exponents})"


def _mean(values):
    finite = [value for value in values if np.isfinite(value)]
    return float(np.mean(finite)) if finite else float("nan")


def _caption(study):
    facts = next((dict(scan.psd().attrs) for scan in study.scans if scan.psd() is not None), {})
    convention, window = facts.get("convention", "jacobs"), facts.get("window", "")
    cut = f"Values below {units.number(FLOOR)} of the largest are left out. "
    return (
        "One-dimensional power spectral densities of the treated scans against the angular wavevector q = 2π/λ, "
        "along x (sliding direction, left) and y (right), averaged over the scans of a group. The dashed line has "
        f"the slope −(1 + 2H) of a self-affine surface with Hurst exponent H = {REFERENCE_HURST}; the H in the "
        f"legend is fitted to each scan and averaged. Convention: {convention}"
        + (f", window: {window}. " if window else ". ")
        + cut
        + "As Figure 4 of Costagliola et al."
    )


def _csv(curves):
    columns = {"axis": [], "group": [], "n": [], "q_rad_per_m": [], "c1d_m3": []}
    for axis, of_axis in curves.items():
        for group, q, density, _, n in of_axis:
            for name, values in zip(columns, ([axis] * len(q), [group] * len(q), [n] * len(q), q, density)):
                columns[name].extend(values)
    return table_text(columns)
