"""Contact area and friction of one scan against pressure."""

import numpy as np

from tabor.report import areas, chart, oil, style, units
from tabor.report.figures import Drawn
from tabor.report.friction_series import FRICTION, PRESSURE, rings
from tabor.report.output import table_text

DRY, LUBRICATED = "friction_dry", "friction_lubricated"


def draw(single):
    """None with fewer than two pressures: there is no curve."""
    states = [state for state in single.states if state.pressure is not None]
    if len({state.pressure for state in states}) < 2:
        return None
    area = areas.of_states(states)
    panels = [key for key in (area, DRY) if any(_has(state, key) for state in states)]
    if not panels:
        return None
    name = single.column[area].heading
    labels = {area: f"{name} $A_{{real}}/A_0$ (%)", DRY: FRICTION}
    row = [_panel(key, labels[key], _curves(key, name, states)) for key in panels]
    legend = tuple(chart.Figure([row[-1:]], 0).labelled().values()) if DRY in panels else ()
    return Drawn(
        "against_pressure",
        "Friction against pressure" if DRY in panels else f"{name.capitalize()} against pressure",
        _caption(single, panels, states, area),
        chart.Figure([row], 3.4, 3.7 * len(panels), legend=legend),
        {"": table_text(_columns(states, area))},
    )


def _has(state, key):
    value = state.facts.get(key)
    return isinstance(value, float) and np.isfinite(value)


def _panel(key, label, curves):
    items, loose = [], []
    for (name, members), look in zip(curves, _looks(key, len(curves))):
        factor = 100 if key in areas.KEYS else 1
        if not any(state.visit for state, _ in members):  # a path of loads is drawn as it goes
            members = sorted(members, key=lambda pair: pair[0].pressure)
        sure = [(state, value) for state, value in members if state.facts.get("converged", True)]
        loose += [(state, factor * value) for state, value in members if not state.facts.get("converged", True)]
        items.append(chart.Curve(*_points(sure, factor), label=name, **look))
    items += rings(*_points(loose, 1))
    return chart.Panel(chart.from_zero(PRESSURE, air=1), chart.from_zero(label), items)


def _looks(key, n):
    """Grey and dashed without oil, then darker for more of it; the area has but one curve."""
    if key in areas.KEYS:
        return style.curve_styles(n)
    return [style.DRY_CURVE, *style.ordered_styles(n - 1)]


def _points(members, factor):
    return [state.pressure * 1e-6 for state, _ in members], [factor * value for _, value in members]


def _curves(key, name, states):
    """[(label, [(state, value)])]: the area and dry friction once, lubricated friction per density."""
    once = {}
    for state in states:
        if _has(state, key):
            once.setdefault((state.pressure, state.visit), state)
    first = [(state, state.facts[key]) for state in once.values()]
    if key != DRY:
        return [(name, first)]
    curves = [("dry", first)]
    densities = sorted({state.density for state in states if state.density and _has(state, LUBRICATED)})
    for density in densities:
        members = [state for state in states if state.density == density and _has(state, LUBRICATED)]
        curves.append((units.density(density), [(state, state.facts[LUBRICATED]) for state in members]))
    return curves


def _columns(states, area):
    keys = ["mean_pressure_Pa", "lubricant_density_g_per_m2", area, DRY, LUBRICATED, "converged"]
    return {key: [state.facts.get(key, "") for state in states] for key in keys}


def _about_friction(rows):
    if oil.is_trapped(rows):
        return (
            ", without oil (left), and friction coefficient (right): dashed dry, full lines with lubricant, darker for more of it. "
            f"With oil, {oil.of_trapped(rows)}"
        )
    flowing = f". The oil of these curves is at rest; while it flows, it carries {oil.span(oil.shares(rows, oil.FLOWING))}"
    return (
        " (left), and friction coefficient μ = (A_real − A_lub)/A₀ · τ_y/P (right): dashed dry, full lines with "
        "lubricant, darker for more of it. Contact that holds lubricant does not shear, or only with the strength "
        "of its film: a curve lies below the dashed one as far as contact is wet. Amounts whose curves coincide "
        "fill the same pockets; an amount whose curve lies far below the others stands above part of the contacts"
        f"{flowing if oil.is_flowing(rows) else ''}"
    )


def _caption(single, panels, states, area):
    parts = [f"{areas.MEANINGS[area].capitalize()} of {single.title} against the mean pressure P"]
    if DRY in panels:
        parts.append(_about_friction([state.facts for state in states]))
    parts.append(".")
    if not all(state.facts.get("converged", True) for state in states):
        parts.append(" Red rings: states that did not converge.")
    return "".join(parts)
