"""The area that friction was computed with against pressure, every scan and the mean of its group."""

import numpy as np

from tabor.report import areas, chart, style, units
from tabor.report.figures import Drawn
from tabor.report.friction_series import PRESSURE, number_text, rings
from tabor.report.output import table_text
from tabor.report.table import converged


def draw(study):
    groups = [(group, states_of(study, group)) for group in study.groups]
    groups = [(group, members) for group, members in groups if members]
    if not groups:
        return None
    name = study.column[areas.of_study(study)].heading
    panel = chart.Panel(chart.from_zero(PRESSURE, air=1), chart.from_zero(f"{name} $A_{{real}}/A_0$ (%)"))
    looks = [_named(*group, look) for group, look in zip(groups, style.curve_styles(len(groups)))]
    for (_, states), look in zip(groups, looks):
        panel.items += _curves(states, look)
    others = _rings(groups) + _bound(study)
    panel.items += others
    return Drawn(
        "contact_area",
        f"{name.capitalize()} against pressure",
        _caption(study),
        chart.Figure([[panel]], 3.4, legend=tuple([chart.Curve(**look) for look in looks] + others)),
        {"": _csv(groups, areas.of_study(study))},
    )


def means(states):
    """Pressures [Pa], mean area fraction over the scans, number of scans; of converged states only."""
    states = [state for state in states if state["sure"]]
    pressures = np.array(sorted({state["pressure"] for state in states}))
    members = [[state["area"] for state in states if state["pressure"] == pressure] for pressure in pressures]
    return (
        pressures,
        np.array([np.mean(areas) for areas in members]),
        np.array([len(areas) for areas in members]),
    )


def states_of(study, group):
    """One entry per scan and pressure: the area does not depend on the lubricant."""
    table, area = study.table, areas.of_study(study)
    if not table:
        return []
    rows = table.where(table.equal("group", group))
    found = {}
    for row, sure in zip(rows.rows(), converged(rows)):
        key = (row["scan"], float(row["mean_pressure_Pa"]))
        if np.isfinite(row[area]):
            found[key] = {
                "scan": row["scan"],
                "group": group,
                "pressure": key[1],
                "area": float(row[area]),
                "sure": bool(sure),
            }
    return [found[key] for key in sorted(found)]


def _named(group, states, look):
    """The look with the label of a group: its name and the number of scans."""
    return {**look, "label": f"{style.literal(group) or 'mean'} ({number_text(means(states)[2])})"}


def _curves(states, look):
    """The means as a line, every scan as a symbol."""
    pressures, mean, n = means(states)
    scans = [state["pressure"] * 1e-6 for state in states], [state["area"] * 100 for state in states]
    return [
        chart.Curve(pressures * 1e-6, mean * 100, look["label"], look["colour"], notes={"n": n}),
        chart.Curve(*scans, dash="", alpha=0.75, **look),
    ]


def _rings(groups):
    loose = [state for _, states in groups for state in states if not state["sure"]]
    pressures, areas = ([state[name] for state in loose] for name in ("pressure", "area"))
    return rings(np.array(pressures) * 1e-6, np.array(areas) * 100)


def _bound(study):
    cap = study.saturation_pressure
    if not cap:
        return []
    top = float(np.max(study.table["mean_pressure_Pa"]))
    label = f"$P/p_{{sat}}$, $p_{{sat}}$ = {units.pressure(cap)}"
    return [chart.Curve([0, top * 1e-6], [0, top / cap * 100], label, "0.35", ":")]


def _caption(study):
    text = (
        f"{areas.MEANINGS[areas.of_study(study)].capitalize()} as a share of the apparent area (%) against the mean "
        "pressure P. Symbols: every scan; lines: mean over the n scans of a group. "
    )
    if study.saturation_pressure:
        text += (
            "Dotted: P/p_sat, the smallest area that can carry P when no contact bears more than p_sat; no "
            f"solution {_limited(study)}may lie below it. "
        )
    if study.table.not_converged():
        text += "Red rings: did not converge and count in no mean. "
    return text.rstrip()


def _limited(study):
    """Whose solutions the saturation pressure bounds, where not all."""
    return "of a saturated contact " if any(scan.facts.get("contact") == "elastic" for scan in study.scans) else ""


def _csv(groups, area):
    states = [state for _, members in groups for state in members]
    return table_text(
        {
            "scan": [state["scan"] for state in states],
            "group": [state["group"] for state in states],
            "mean_pressure_Pa": [state["pressure"] for state in states],
            area: [state["area"] for state in states],
            "converged": [state["sure"] for state in states],
        }
    )
