"""Facts and tables of a study for the page."""

import numpy as np

from tabor.report import friction_series as series_of
from tabor.report import areas, refusals, units
from tabor.report.figures import contact_area
from tabor.report.page_single import MOST_COLUMNS, evenly
from tabor.report.table import converged

MAX_ROWS = 400  # of the results table; results.csv holds all


def sections(study):
    marks = _Marks(study.table)
    return {
        "answer": answer(study, marks),
        "highlights": _highlights(study),
        "scans": [_scan(scan, _own_settings(study.scans)) for scan in study.scans],
        "treatments": _treatments(study.scans),
        "settings": _settings(study.facts, _own_settings(study.scans)),
        "results": _results(study.table, study.names, marks),
        "averages": _averages(study.averages, marks),
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
        "note": f"{' and '.join(left_out)} stand in the averages and results." if left_out else "",
    }


def _lines(study, group, pressures):
    """(question, [(text, key, row of averages that it stands for or None)]) of a group, as far as it has them."""
    name = f" ({group})" if len(study.groups) > 1 else ""
    known, area, _ = contact_area.means(contact_area.states_of(study, group))
    shares = [(areas.share(value), "", None) for value in area]
    found = [(f"{areas.NAMES[areas.of_study(study)]}{name}", known, shares)]
    curves = {"friction dry": (refusals.DRY, series_of.dry(study, group))}
    for density in series_of.densities(study):
        curves[f"friction, {units.density(density)}"] = refusals.LUBRICATED, series_of.lubricated(study, group, density)
    for question, (key, series) in curves.items():
        texts = [_with_spread(*numbers) for numbers in zip(series.mean, series.bar("std"))]
        cells = [(text, key, row) for text, row in zip(texts, series.rows)]
        found.append((f"{question}{name}", series.pressure, cells))
    found = [parts for parts in found if len(parts[1])]
    return [(question, [_at(known, cells, place) for place in pressures]) for question, known, cells in found]


def _marked(marks, text, key, row, met):
    return text if row is None else marks.of_mean(row, key, text, met)


def _with_spread(mean, spread):
    text = units.number(float(mean), 3)
    return text if not np.isfinite(spread) else f"{text} ± {units.number(float(spread), 2)}"


def _at(known, cells, pressure):
    places = np.flatnonzero(np.isclose(known, pressure, rtol=1e-9))
    return cells[places[0]] if places.size else ("\N{EN DASH}", "", None)


def _highlights(study):
    """What a reader wants first: pressures, densities, range of friction, how much to trust."""
    table, area = study.table, areas.of_study(study)
    found = [
        ("mean pressures", _range(table, "mean_pressure_Pa", units.pressure)),
        ("lubricant densities", _range(table, "lubricant_density_g_per_m2", units.density)),
        (areas.NAMES[area], _range(table, area, areas.share)),
        ("dry friction", _range(table, "friction_dry", lambda value: units.number(value, 3))),
        ("lubricated friction", _range(table, "friction_lubricated", lambda value: units.number(value, 3))),
        ("sliding speeds", _range(table, "sliding_speed_m_per_s", lambda value: f"{units.number(value)} m/s")),
        ("load on the oil", _range(table, "fluid_load_share", lambda value: f"{value:.2%}")),
        ("friction with flowing oil", _range(table, "friction_mixed", lambda value: units.number(value, 3))),
    ]
    sure = len(table) - table.not_converged()
    found.append(("converged", f"{sure} of {len(table)} rows"))
    return [(name, text) for name, text in found if text]


def _range(table, name, show):
    values = table.distinct(name)
    return units.span(values, show) if values else ""


_SETTINGS_OF_SCANS = {"contact": "contact", "area": "area used for friction", "reading": "reading of the droplet rule"}


def _own_settings(scans):
    """The settings in which the scans of the study differ, by the names of their attributes."""
    return [name for name in _SETTINGS_OF_SCANS if len({scan.facts.get(name) for scan in scans}) > 1]


def _scan(scan, own):
    facts = scan.facts
    rows = [("file", scan.file)] * (scan.name != scan.file)
    rows += _surface_rows(scan) if scan.is_treated else [("surface", "not treated yet")]
    rows += [(_SETTINGS_OF_SCANS[name], facts[name]) for name in own if name in facts]
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


def _settings(facts, own):
    cap = facts.get("saturation_pressure_Pa")
    rows = [
        ("Young's modulus E", facts.get("youngs_modulus_Pa"), units.pressure),
        ("Poisson's ratio ν", facts.get("poissons_ratio"), units.number),
        ("effective modulus E*", facts.get("effective_modulus_Pa"), units.pressure),
        ("shear strength τ_y", facts.get("shear_strength_Pa"), units.pressure),
        ("oil density", facts.get("oil_density_kg_per_m3"), lambda value: f"{units.number(value)} kg/m³"),
        ("area used for friction", "as each scan says" if "area" in own else facts.get("area"), str),
        ("oil viscosity η", facts.get("viscosity_Pa_s"), lambda value: f"{units.number(value)} Pa s"),
        (
            "pressure-viscosity coefficient α",
            facts.get("pressure_viscosity_per_Pa"),
            lambda value: f"{units.number(value * 1e9)} 1/GPa",
        ),
        ("Eyring stress", facts.get("eyring_stress_Pa"), units.pressure),
    ]
    shown = [(name, show(value)) for name, value, show in rows if value is not None]
    return shown + [("saturation pressure p_sat", units.pressure(cap) if cap else "none (elastic)")]


# What a reader looks for stands first: a narrow page cuts the rest off until it is scrolled.
_RESULT_COLUMNS = (
    ("scan", "scan", str),
    ("group", "group", str),
    ("P (MPa)", "mean_pressure_Pa", lambda value: units.number(value * 1e-6)),
    ("lubricant (g/m²)", "lubricant_density_g_per_m2", units.number),
    ("μ dry", "friction_dry", units.number),
    ("μ lubricated", "friction_lubricated", units.number),
    ("u (m/s)", "sliding_speed_m_per_s", units.number),
    ("μ flowing", "friction_mixed", units.number),
    ("of oil", "friction_viscous", units.number),
    ("load on oil", "fluid_load_share", units.number),
    ("contact area A/A₀", areas.CORRECTED, units.number),
    ("wet share", "lubricated_share", units.number),
    ("certificate", "certificate", lambda value: units.number(value, 2)),
    ("converged", None, lambda sure: "yes" if sure else "NO"),
    ("counted contact A/A₀", areas.PIXELS, units.number),
    ("saturated A/A₀", "saturated_area_fraction", units.number),
    ("mean gap (µm)", "mean_gap_m", lambda value: units.number(value * 1e6)),
    ("spill-over", "spill_over_fraction", units.number),
)


def _results(table, names, marks):
    columns = [column for column in _RESULT_COLUMNS if column[1] is None or column[1] in table]
    sure = converged(table)

    def value(index, name):
        found = _value((table[name] if name else sure)[index])
        return names.get(found, found) if name == "scan" else found

    order = list(range(len(table)))
    if len(order) > MAX_ROWS:
        loose = [index for index in order if not sure[index]]
        order = sorted(set(loose + order[:MAX_ROWS]))
    met = set()
    rows = [
        {
            "sure": bool(sure[index]),
            "cells": [marks.of_row(index, name, show(value(index, name)), met) for _, name, show in columns],
        }
        for index in order
    ]
    return {
        "header": [title for title, _, _ in columns],
        "rows": rows,
        "left_out": marks.notes(met),
        "n_total": len(table),
        "n_text": sum(name in ("scan", "group") for _, name, _ in columns),
    }


_STATISTICS = (
    ("", "_mean", units.number),
    (", std", "_std", lambda value: units.number(value, 2)),
    (", sem", "_sem", lambda value: units.number(value, 2)),
)


def _averages(table, marks):
    columns = [
        (title, name, show)
        for title, name, show in (
            ("group", "group", str),
            ("P (MPa)", "mean_pressure_Pa", lambda value: units.number(value * 1e-6)),
            ("lubricant (g/m²)", "lubricant_density_g_per_m2", units.number),
            ("u (m/s)", "sliding_speed_m_per_s", units.number),
            ("n", "n", lambda value: str(int(value))),
        )
        if name in table
    ]
    kinds = (
        ("friction_dry", "μ dry"),
        ("friction_lubricated", "μ lubricated"),
        ("friction_mixed", "μ flowing"),
        ("friction_viscous", "of oil"),
        ("fluid_load_share", "load on oil"),
    )
    for kind, title in kinds:
        columns += [
            (f"{title}{part}", f"{kind}{suffix}", show)
            for part, suffix, show in _STATISTICS
            if f"{kind}{suffix}" in table
        ]
    met = set()
    rows = [
        [marks.of_mean(row, name.removesuffix("_mean"), show(_value(row[name])), met) for _, name, show in columns]
        for row in table.rows()
    ]
    return {"header": [title for title, _, _ in columns], "rows": rows, "n_text": 1, "left_out": marks.notes(met)}


def _value(value):
    return value.item() if isinstance(value, np.generic) else value
