"""Contact area and friction of one scan against pressure."""

import numpy as np

from tabor.report import areas, style, units
from tabor.report.figures import Drawn
from tabor.report.friction_series import draw_loose
from tabor.report.output import table_text

DRY, LUBRICATED = "friction_dry", "friction_lubricated"
_LABELS = {key: f"{name} $A_{{real}}/A_0$ (%)" for key, name in areas.NAMES.items()} | {
    DRY: "friction coefficient $\\mu$"
}


def draw(single):
    """None with fewer than two pressures: there is no curve."""
    states = [state for state in single.states if state.pressure is not None]
    if len({state.pressure for state in states}) < 2:
        return None
    area = areas.of_states(states)
    panels = [key for key in (area, DRY) if any(_has(state, key) for state in states)]
    if not panels:
        return None
    figure, grid = style.new_figure(3.4, n_columns=len(panels), width=3.7 * len(panels))
    for axes, key in zip(grid[0], panels):
        _draw_panel(axes, key, states)
    if DRY in panels:
        style.legend_on_top(figure, style.entries(grid[0][-1]))
    return Drawn(
        "against_pressure",
        "Friction against pressure" if DRY in panels else f"{areas.NAMES[area].capitalize()} against pressure",
        _caption(single, panels, states, area),
        figure,
        {"": table_text(_columns(states, area))},
    )


def _has(state, key):
    value = state.facts.get(key)
    return isinstance(value, float) and np.isfinite(value)


def _draw_panel(axes, key, states):
    curves = _curves(key, states)
    for (label, members), look in zip(curves, _looks(key, len(curves))):
        factor = 100 if key in areas.NAMES else 1
        if not any(state.visit for state, _ in members):  # a path of loads is drawn as it goes
            members = sorted(members, key=lambda pair: pair[0].pressure)
        sure = [(state, value) for state, value in members if state.facts.get("converged", True)]
        loose = [(state, value) for state, value in members if not state.facts.get("converged", True)]
        axes.plot(*_points(sure, factor), label=label, **look)
        draw_loose(axes, *_points(loose, factor))
    axes.set_xlabel("mean pressure $P$ (MPa)")
    axes.set_ylabel(_LABELS[key])
    axes.grid(color="0.92", linewidth=0.6)
    style.limits_from_zero(axes)


def _looks(key, n):
    """Grey and dashed without oil, then darker for more of it; the area has but one curve."""
    if key in areas.NAMES:
        return style.curve_styles(n)
    symbols = style.curve_styles(n)
    dry = {"color": "0.35", "linestyle": "--", "marker": "s", "markersize": 4, "markerfacecolor": "white", "zorder": 4}
    return [dry, *({**symbol, "color": colour} for symbol, colour in zip(symbols, style.sequence(n - 1)[::-1]))]


def _points(members, factor):
    return [state.pressure * 1e-6 for state, _ in members], [factor * value for _, value in members]


def _curves(key, states):
    """[(label, [(state, value)])]: the area and dry friction once, lubricated friction per density."""
    once = {}
    for state in states:
        if _has(state, key):
            once.setdefault((state.pressure, state.visit), state)
    first = [(state, state.facts[key]) for state in once.values()]
    if key != DRY:
        return [(areas.NAMES[key], first)]
    curves = [("dry", first)]
    densities = sorted({state.density for state in states if state.density and _has(state, LUBRICATED)})
    for density in densities:
        members = [state for state in states if state.density == density and _has(state, LUBRICATED)]
        curves.append((units.density(density), [(state, state.facts[LUBRICATED]) for state in members]))
    return curves


def _columns(states, area):
    keys = ["mean_pressure_Pa", "lubricant_density_g_per_m2", area, DRY, LUBRICATED, "converged"]
    return {key: [state.facts.get(key, "") for state in states] for key in keys}


def _caption(single, panels, states, area):
    parts = [f"{areas.MEANINGS[area].capitalize()} of {single.title} against the mean pressure P"]
    if DRY in panels:
        parts.append(
            " (left), and friction coefficient μ = (A_real − A_lub)/A₀ · τ_y/P (right): dashed dry, full lines with "
            "lubricant, darker for more of it. Contact that holds lubricant does not shear, or only with the strength "
            "of its film: a curve lies below the dashed one as far as contact is wet. Amounts whose curves coincide "
            "fill the same pockets; an amount whose curve lies far below the others stands above part of the contacts"
        )
    parts.append(".")
    if not all(state.facts.get("converged", True) for state in states):
        parts.append(" Red rings: states that did not converge.")
    return "".join(parts)
