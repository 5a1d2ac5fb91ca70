"""Facts and tables of a study for the page."""

import numpy as np

from tabor.report import friction_series as series_of
from tabor.report import areas, oil, refusals, units
from tabor.report.figures import contact_area
from tabor.report.page_single import MOST_COLUMNS, evenly
from tabor.report.table import converged

MAX_ROWS = 400  # of the results table; results.csv holds all


def sections(study):
    marks = _Marks(study.table)
    return {
        "answer": answer(study, marks),
        "highlights": _highlights(study),
        "scans": [_scan(study, scan) for scan in study.scans],
        "treatments": _treatments(study.scans),
        "settings": _settings(study),
        "results": _results(study, marks),
        "averages": _averages(study, marks),
    }


class _Marks:
    """Signs behind the frictions, and their means, that `tabor table` leaves out."""

    def __init__(self, table):
        rows = table.rows()
        self._of_rows, self._of_means = refusals.of_rows(rows), refusals.of_means(rows)
        self._signs = refusals.Signs([*self._of_rows, *self._of_means.values()])

    def of_row(self, index, key, text, met):
        return self._signs.mark(text, self._of_rows[index].get(key), met)

    def of_mean(self, row, key, text, met):
        """row: group, pressure, density and speed of the mean."""
        return self._signs.mark(text, self._of_means.get(refusals.place_of_mean(row), {}).get(key), met)

    def notes(self, met):
        return self._signs.notes(met)


MOST_LINES = 24  # of the answer


def answer(study, marks=None):
    """One line per question and group, one column per pressure: the mean, with the deviation of n > 1 scans."""
    pressures = study.averages.distinct("mean_pressure_Pa")
    shown = [pressures[place] for place in evenly(len(pressures), MOST_COLUMNS)]
    lines = [line for group in study.groups for line in _lines(study, group, shown)]
    if not shown or not lines:
        return None
    marks, met = marks or _Marks(study.table), set()
    rows = [(question, [_marked(marks, *cell, met) for cell in cells]) for question, cells in lines[:MOST_LINES]]
    left_out = [f"{len(pressures) - len(shown)} more pressures"] * (len(pressures) > len(shown))
    left_out += [f"{len(lines) - MOST_LINES} more lines"] * (len(lines) > MOST_LINES)
    return {
        "caption": "Means over the scans of a group, with the standard deviation, at the mean pressure; "
        f"{areas.MEANINGS[areas.of_study(study)]}",
        "header": [units.pressure(pressure) for pressure in shown],
        "rows": rows,
        "left_out": marks.notes(met),
        "note": " ".join(filter(None, (f"{' and '.join(left_out)} stand in the averages and results." if left_out else "", oil.note(study.table.rows())))),
    }


def _lines(study, group, pressures):
    """(question, [(text, key, row of averages that it stands for or None)]) of a group, as far as it has them."""
    name = f" ({group})" if len(study.groups) > 1 else ""
    known, area, _ = contact_area.means(contact_area.states_of(study, group))
    shares = [(areas.share(value), "", None) for value in area]
    found = [(f"{study.column[areas.of_study(study)].heading}{name}", known, shares)]
    curves = {"friction dry": (refusals.DRY, series_of.dry(study, group))}
    for density in series_of.densities(study):
        curves[f"friction, {units.density(density)}"] = refusals.LUBRICATED, series_of.lubricated(study, group, density)
        if f"{oil.TRAPPED}_mean" in study.averages:
            curves[f"trapped oil carries, {units.density(density)}"] = oil.TRAPPED, series_of.trapped_share(study, group, density)
    for question, (key, series) in curves.items():
        show = _share_with_spread if key == oil.TRAPPED else _with_spread
        texts = [show(*numbers) for numbers in zip(series.mean, series.bar("std"))]
        cells = [(text, key, row) for text, row in zip(texts, series.rows)]
        found.append((f"{question}{name}", series.pressure, cells))
    found = [parts for parts in found if len(parts[1])]
    return [(question, [_at(known, cells, place) for place in pressures]) for question, known, cells in found]


def _marked(marks, text, key, row, met):
    return text if row is None else marks.of_mean(row, key, text, met)


def _with_spread(mean, spread):
    text = units.number(float(mean), 3)
    return text if not np.isfinite(spread) else f"{text} ± {units.number(float(spread), 2)}"


def _share_with_spread(mean, spread):
    return f"{_with_spread(100 * mean, 100 * spread)} %" if np.isfinite(mean) else units.number(float(mean))


def _at(known, cells, pressure):
    places = np.flatnonzero(np.isclose(known, pressure, rtol=1e-9))
    return cells[places[0]] if places.size else ("\N{EN DASH}", "", None)


def _highlights(study):
    """What a reader wants first: pressures, densities, range of friction, how much to trust."""
    table = study.table
    keys = ("mean_pressure_Pa", "lubricant_density_g_per_m2", areas.of_study(study), "friction_dry", "friction_lubricated",
            "liquid_load_share", "sliding_speed_m_per_s", "fluid_load_share", "friction_mixed")  # fmt: skip
    found = [(study.column[key].heading, _range(table, key, study.column[key].show)) for key in keys]
    found.append(("converged", f"{len(table) - table.not_converged()} of {len(table)} rows"))
    return [(name, text) for name, text in found if text]


def _range(table, name, show):
    values = table.distinct(name)
    return units.span(values, show) if values else ""


_SETTINGS_OF_SCANS = ("contact", "area", "reading")
_SETTINGS = ("youngs_modulus_Pa", "poissons_ratio", "effective_modulus_Pa", "shear_strength_Pa", "oil_density_kg_per_m3", "area",
             "viscosity_Pa_s", "pressure_viscosity_per_Pa", "eyring_stress_Pa", "saturation_pressure_Pa")  # fmt: skip


def _own_settings(scans):
    """The settings in which the scans of the study differ, by the names of their attributes."""
    return [name for name in _SETTINGS_OF_SCANS if len({scan.facts.get(name) for scan in scans}) > 1]


def _scan(study, scan):
    facts = scan.facts
    rows = [("file", scan.file)] * (scan.name != scan.file)
    rows += _surface_rows(scan) if scan.is_treated else [("surface", "not treated yet")]
    rows += [(study.column[name].heading, facts[name]) for name in _own_settings(study.scans) if name in facts]
    return {
        "file": scan.name,
        "group": scan.group,
        "sha256": facts.get("input_sha256", ""),
        "rows": rows,
        "steps": scan.steps,
        "treatment": scan.treatment,
    }


def _surface_rows(scan):
    facts, sides = scan.facts, (scan.facts["nx"], scan.facts["ny"])
    sizes = (units.length(pixel * side) for pixel, side in zip(scan.pixel, sides))
    return [
        ("pixels", " × ".join(map(str, sides))),
        ("pixel size", " × ".join(map(units.length, scan.pixel))),
        ("size", " × ".join(sizes)),
        ("Sq", units.length(facts.get("rms_height_m"))),
        ("rms slope", units.number(facts.get("rms_slope"))),
        *_hurst_rows(scan),
    ]


def _hurst_rows(scan):
    psd = scan.psd()
    names = ("hurst_x", "hurst_y") if psd is not None else ()
    return [
        (f"Hurst exponent {name[-1]}", units.number(float(psd.attrs[name]), 3))
        for name in names
        if name in psd.attrs
    ]


def _treatments(scans):
    """[(steps, names)], scans with the same chain together: by their groups where no group has two chains."""
    chains = {}
    for scan in scans:
        chains.setdefault(tuple(scan.steps), []).append(scan)
    if len(scans) == 1:
        return [(tuple(scans[0].treatment), [scans[0].name])]
    groups = [group for members in chains.values() for group in {scan.group for scan in members}]
    by_group = len(set(groups)) == len(groups)
    return [
        (steps, list(dict.fromkeys(scan.group if by_group else scan.name for scan in members)))
        for steps, members in chains.items()
    ]


def _settings(study):
    facts = {**study.facts}
    facts.setdefault("saturation_pressure_Pa", "none (elastic)")
    if "area" in _own_settings(study.scans):
        facts["area"] = "as each scan says"
    return [(study.column[key].heading, study.column[key].show(facts[key])) for key in _SETTINGS if facts.get(key) is not None]


# What a reader looks for stands first: a narrow page cuts the rest off until it is scrolled.
_FIRST_OF_RESULTS = ("scan", "group")
_RESULTS = (
    "mean_pressure_Pa", "lubricant_density_g_per_m2", "friction_dry", "friction_lubricated", "sliding_speed_m_per_s", "friction_mixed",
    "friction_viscous", "fluid_load_share", "friction_solid", "friction_boundary", "liquid_load_share", "n_pockets", "n_at_seal", areas.CORRECTED, "lubricated_share", "certificate", "converged", areas.PIXELS,
    "saturated_area_fraction", "mean_gap_m", "spill_over_fraction",
)  # fmt: skip


def _results(study, marks):
    table, sure = study.table, converged(study.table)
    texts = [name for name in _FIRST_OF_RESULTS if name in table]
    numbers = [_numbers(study, name, table[name]) for name in _RESULTS if name in table]
    order = list(range(len(table)))
    if len(order) > MAX_ROWS:
        loose = [index for index in order if not sure[index]]
        order = sorted(set(loose + order[:MAX_ROWS]))
    met, rows, names = set(), [], study.names
    for index in order:
        cells = [names.get(table[name][index], table[name][index]) if name == "scan" else table[name][index] for name in texts]
        for title, name, show in numbers:
            text = ("yes" if sure[index] else "NO") if name == "converged" else show(_value(table[name][index]))
            cells.append(marks.of_row(index, name, text, met))
        rows.append({"sure": bool(sure[index]), "cells": cells})
    return {
        "header": [*texts, *(title for title, _, _ in numbers)],
        "rows": rows,
        "left_out": marks.notes(met),
        "n_total": len(table),
        "n_text": len(texts),
    }


def _numbers(study, name, values):
    """(title with the unit, name, what shows one of its numbers) of a column of plain numbers."""
    column = study.column[name]
    if name == "converged":
        return column.heading, name, str
    factor, unit = column.scale(values)
    return column.title(unit), name, lambda value: column.number(value, factor)


_PLACES = ("mean_pressure_Pa", "lubricant_density_g_per_m2", "sliding_speed_m_per_s")
_MEANS = ("friction_dry", "friction_lubricated", "friction_mixed", "friction_viscous", "fluid_load_share", "liquid_load_share")


def _averages(study, marks):
    table, met = study.averages, set()
    columns = [("group", "group", str)] if "group" in table else []
    columns += [_numbers(study, name, table[name]) for name in _PLACES if name in table]
    columns += [("n", "n", lambda value: str(int(value)))] if "n" in table else []
    for name in _MEANS:
        columns += _statistics(study, name)
    rows = [
        [marks.of_mean(row, name.removesuffix("_mean"), show(_value(row[name])), met) for _, name, show in columns]
        for row in table.rows()
    ]
    return {"header": [title for title, _, _ in columns], "rows": rows, "n_text": 1, "left_out": marks.notes(met)}


def _statistics(study, name):
    """Mean, standard deviation and standard error, in one unit."""
    table, column = study.averages, study.column[name]
    if f"{name}_mean" not in table:
        return []
    factor, unit = column.scale(table[f"{name}_mean"])

    def spread(value):
        return units.number(value * factor, 2)

    parts = (("", "_mean", lambda value: column.number(value, factor)), (", std", "_std", spread), (", sem", "_sem", spread))
    return [(column.title(unit) + part, f"{name}{ending}", show) for part, ending, show in parts if f"{name}{ending}" in table]


def _value(value):
    return value.item() if isinstance(value, np.generic) else value
