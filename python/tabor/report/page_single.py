"""Facts and tables of a single-scan result for the page."""


from tabor.report import areas, hdf, oil, refusals, units
from tabor.report.columns import Columns


def sections(single):
    marks = _Marks(single.states)
    return {
        "answer": _combined(single.combination) if single.combination else answer(single.states, single.column, marks),
        "highlights": _highlights(single),
        "scans": [_scan(single)],
        "treatments": [(tuple(hdf.text_list(single.surface_facts.get("treatment"))), [single.title])],
        "settings": _settings(single),
        "results": _results(single.states, single.column, marks),
    }


class _Marks:
    """Signs behind the frictions of states that `tabor table` leaves out."""

    def __init__(self, states):
        reasons = refusals.of_rows([{**state.facts, "visit": state.visit} for state in states])
        self._reasons = {state.key: of_state for state, of_state in zip(states, reasons)}
        self._signs = refusals.Signs(reasons)

    def mark(self, state, key, text, met):
        return self._signs.mark(text, self._reasons[state.key].get(key), met)

    def notes(self, met):
        return self._signs.notes(met)


def _combined(facts):
    """What `tabor combine` found: volumes with their uncertainty, or the heights of both scans and of the map."""
    rows = [
        (name, [units.si(facts[f"{key}_{what}_m3"], "m³") for what in ("volume", "uncertainty")])
        for key, name in (("worn", "worn"), ("piled_up", "piled up"), ("net", "net, whole overlap"))
        if f"{key}_volume_m3" in facts
    ]
    heights = [
        ("rms height of the first", ("rms_height_first_m", None)),
        ("rms height of the second", ("rms_height_second_m", None)),
        ("rms height of this map", ("rms_height_m", None)),
        ("shift of the second along x", ("shift_x_m", "uncertainty_x_m")),
        ("shift of the second along y", ("shift_y_m", "uncertainty_y_m")),
    ]
    rows += [(name, [_length(facts, key) for key in keys]) for name, keys in heights if keys[0] in facts]
    correlation = facts.get("correlation")
    note = "" if correlation is None else f"Correlation of both over the overlap: {units.number(correlation, 4)}."
    return {"caption": "Of both scans", "header": ["value", "± (1 sigma)"], "rows": rows, "note": note}


def _length(facts, key):
    return units.length(facts[key]) if key in facts else "–"


_ASKED = (*areas.KEYS, "friction_dry", "friction_lubricated", "friction_mixed", oil.TRAPPED, oil.FLOWING)
_HIGHLIGHTS = (*areas.KEYS, "mean_film_m", *_ASKED[2:])


MOST_COLUMNS = 8  # pressures of the answer
MOST_STATES = 6  # columns of one table of results


def answer(states, column=Columns(), marks=None):
    """One line per question, one column per pressure; None where nothing is asked of a pressure."""
    pressures = list(dict.fromkeys(state.pressure_text for state in states if state.pressure is not None))
    shown = [pressures[place] for place in evenly(len(pressures), MOST_COLUMNS)]
    marks, rows, met = marks or _Marks(states), {}, set()
    area = areas.of_states(states)
    for state in states:
        for name, key, text in _questions(state, column, area):
            cells = rows.setdefault((_ASKED.index(key), name), {})
            if state.pressure_text not in cells:
                cells[state.pressure_text] = marks.mark(state, key, text, met if state.pressure_text in shown else set())
    ordered = sorted(rows, key=lambda place: place[0])
    lines = [(place[1], [rows[place].get(pressure, "\N{EN DASH}") for pressure in shown]) for place in ordered]
    if not shown or not lines:
        return None
    return {
        "caption": _answer_caption(states, area),
        "header": shown,
        "rows": lines,
        "note": " ".join(filter(None, (_left_out(len(pressures) - len(shown)), oil.note([state.facts for state in states])))),
        "left_out": marks.notes(met),
    }


def _answer_caption(states, area):
    has_area = any(isinstance(state.facts.get(area), float) for state in states)
    has_friction = any("friction_dry" in state.facts for state in states)
    if not has_area:
        return "At the mean pressure"
    return f"At the mean pressure{', friction' * has_friction} on the {areas.MEANINGS[area]}"


def _left_out(count):
    return f"The results hold {count} more pressures." if count else ""


def evenly(count, most):
    """At most so many of `count` places, with the first and the last."""
    steps = min(count, most)
    return [round(place * (count - 1) / max(1, steps - 1)) for place in range(steps)]


def _questions(state, column, area):
    """(question, key, answer) of one state, as far as it has them."""
    facts, amount = state.facts, f", {units.density(state.density)}" if state.density else ""
    flow = f"{amount}, {units.si(facts.get('sliding_speed_m_per_s'), 'm/s')}"
    known = {
        column[area].heading: (area, areas.share),
        column["friction_dry"].heading: ("friction_dry", _three_digits),
        f"friction{amount}": ("friction_lubricated" if amount else "", _three_digits),
        f"friction while oil flows{flow}": ("friction_mixed", _three_digits),
        f"trapped oil carries{amount}": (oil.TRAPPED if amount else "", areas.share),
        f"oil that flows carries{flow}": (oil.FLOWING, areas.share),
    }
    return [(name, key, show(facts[key])) for name, (key, show) in known.items() if isinstance(facts.get(key), float)]


def _three_digits(value):
    return units.number(value, 3)


def _highlights(single):
    """What a reader wants first: of one or two states their numbers, of more the range."""
    columns = [single.column[key] for key in _highlighted(single.states)]
    if len(single.states) > 2:
        return _ranges(single, columns)
    return [
        (f"{column.heading}, {state.name}", column.show(state.facts[column.key]))
        for state in single.states
        for column in columns
        if isinstance(state.facts.get(column.key), float)
    ]


def _highlighted(states):
    """With one of the two areas."""
    area = areas.of_states(states)
    return [key for key in _HIGHLIGHTS if key not in areas.KEYS or key == area]


def _ranges(single, columns):
    found = []
    for column in (single.column["mean_pressure_Pa"], single.column["lubricant_density_g_per_m2"], *columns):
        values = [state.facts[column.key] for state in single.states if isinstance(state.facts.get(column.key), float)]
        found += [(column.heading, units.span(values, column.show))] if values else []
    return found


def _scan(single):
    facts = single.surface_facts
    ny, nx = single.surface["height"].shape
    rows = [
        ("pixels", f"{nx} × {ny}"),
        ("pixel size", f"{units.length(single.pixel[0])} × {units.length(single.pixel[1])}"),
        ("format", facts.get("format", "")),
        ("instrument", facts.get("instrument", "")),
        ("periodic", "yes" if facts.get("periodic") else "no"),
    ]
    rows += list(single.amplitudes.items())
    sha256 = hdf.text_list(single.facts.get("input_sha256"))
    return {
        "file": single.title,
        "group": "",
        "sha256": sha256[0] if sha256 else "",
        "rows": [(name, text) for name, text in rows if text],
        "steps": [],
        "treatment": [],
    }


def _settings(single):
    return [(single.column[key].heading, single.column[key].show(value)) for key, value in single.settings.items() if not isinstance(value, dict)]


def _results(states, column, marks):
    """One row per quantity, one column per state: few states, many quantities. More states make more tables."""
    known = {key: place for place, key in enumerate(column)}  # in the order of the file, where it has one
    keys = dict.fromkeys(key for state in states for key in state.scalars if key != "converged")
    keys = sorted(keys, key=lambda key: known.get(key, len(known)))
    parts = [states[start : start + MOST_STATES] for start in range(0, len(states), MOST_STATES)]
    return {
        **({} if "certificate" in keys else {"intro": ""}),
        "header": [],
        "rows": [],
        "tables": [_table(part, [column[key] for key in keys], marks) for part in parts],
        "n_total": 0,
        "n_text": 1,
    }


def _table(states, columns, marks):
    met = set()
    rows = []
    for column in columns:
        cells = [marks.mark(state, column.key, column.show(state.scalars.get(column.key)), met) for state in states]
        rows.append({"sure": True, "cells": [areas.MEANINGS.get(column.key, column.heading), *cells]})
    sure = [bool(state.facts["converged"]) for state in states if "converged" in state.facts]
    if sure:
        answers = ["yes" if state.facts.get("converged", True) else "NO" for state in states]
        rows.append({"sure": all(sure), "cells": ["converged", *answers]})
    return {"header": ["", *(state.name for state in states)], "rows": rows, "left_out": marks.notes(met)}
