"""Power spectral densities along x and y of all groups (Figure 4 of the seed paper)."""

import numpy as np

from tabor.report import style, units
from tabor.report.figures import Drawn
from tabor.report.output import table_text

REFERENCE_HURST = 0.8
# A low-pass filter leaves rounding noise far below the spectrum; it would squeeze the picture.
FLOOR = 1e-11


def draw(study):
    curves = {axis: _curves(study, axis) for axis in ("x", "y")}
    if not curves["x"] and not curves["y"]:
        return None
    figure, axes = style.new_figure(3.3, 1, 2, sharey=True)
    for panel, axis in zip(axes[0], ("x", "y")):
        _draw_panel(panel, axis, curves[axis])
    axes[0][0].set_ylabel("$C^{1D}$ (µm³)")
    _legend(figure, axes[0], curves)
    return Drawn(
        "psd", "Power spectral density along x and y", _caption(study), figure, {"": _csv(curves)}
    )


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


def _draw_panel(axes, axis, curves):
    for index, look in enumerate(style.curve_styles(len(curves))):
        _, q, density, _, _ = curves[index]
        shown = density > density.max() * FLOOR
        axes.loglog(
            q[shown] * 1e-6,
            density[shown] * 1e18,
            color=look["color"],
            linestyle=(0, (4, 4)) if _is_drawn(q, density, curves[:index]) else "-",
            linewidth=1.1,
        )
    if curves:
        _draw_slope(axes, curves)
    for side in (axes.xaxis, axes.yaxis):
        style.log_axis(side)
    axes.set_xlabel(f"$q$ along ${axis}$ (rad/µm)")
    axes.grid(which="major", color="0.92", linewidth=0.6)


def _is_drawn(q, density, curves):
    """Whether one of these runs where this one does: dashed over it, both can be seen."""
    same_grid = (other for _, grid, other, _, _ in curves if np.array_equal(q, grid))
    return any(np.allclose(density, other, rtol=0.1, atol=0) for other in same_grid)


def _draw_slope(axes, curves):
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
    axes.loglog(q * 1e-6, line * 1e18, color="0.25", linestyle=(0, (4, 3)), linewidth=1.1)
    middle = np.sqrt(low * high)
    axes.annotate(
        f"$H$ = {REFERENCE_HURST}",
        (middle * 1e-6, 3 * highest * middle**exponent * 1e18),
        xytext=(6, 4),
        textcoords="offset points",
        fontsize=8,
        color="0.25",
    )


def _slope_range(curves):
    q = np.concatenate([grid[density > density.max() * FLOOR] for _, grid, density, _, _ in curves])
    span = np.log(q.max() / q.min())
    return q.min() * np.exp(0.35 * span), q.min() * np.exp(0.75 * span)


def _legend(figure, panels, curves):
    """One entry per curve with the Hurst exponents of both panels; curves come in the same order in both."""
    longest = max(curves.values(), key=len)
    lines = panels[list(curves).index("x" if longest is curves["x"] else "y")].get_lines()
    labels = [_label(index, curves) for index in range(len(longest))]
    style.legend_on_top(figure, dict(zip(labels, lines)))


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
