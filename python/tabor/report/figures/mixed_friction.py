"""Friction with oil that flows: against speed (a Stribeck curve), or against pressure at one speed."""

from dataclasses import dataclass

import numpy as np

from tabor.report import friction_series as series_of
from tabor.report import chart, style, units
from tabor.report.figures import Drawn
from tabor.report.output import table_text
from tabor.report.table import converged

SPEED, PRESSURE, DENSITY = "sliding_speed_m_per_s", "mean_pressure_Pa", series_of.DENSITY
SCALE = {SPEED: 1.0, PRESSURE: 1e-6}
LABEL = {SPEED: "sliding speed $u$ (m/s)", PRESSURE: series_of.PRESSURE}
MEANS = ("friction_mixed", "friction_viscous", "fluid_load_share")
MAX_PANELS = 3


def is_one(study):
    return bool(study.averages) and f"{MEANS[0]}_mean" in study.averages


def draw(study, error="std"):
    """None if no film flows, or if there are no means yet."""
    if not is_one(study):
        return None
    x = SPEED if len(study.averages.distinct(SPEED)) > 1 else PRESSURE
    panels = [(group, _curves(study, group, x)) for group in study.groups]
    panels = [(group, curves) for group, curves in panels if curves]
    if not panels:
        return None
    shown = panels[:MAX_PANELS]
    axis = _x_axis(x, [curve for _, curves in shown for curve in curves])
    rows = [[_friction(axis, *panel, error) for panel in shown], [_load_share(axis, curves, error) for _, curves in shown]]
    width = style.WIDTH if len(shown) > 1 else 5.6
    figure = chart.Figure(rows, 5.2, width, (3, 2), shares_x=True, shares_y="row")
    every = [curve for _, curves in panels for curve in curves]
    return Drawn(
        "mixed_friction",
        "Stribeck curve" if x == SPEED else "Friction with oil that flows",
        _caption(study, every, x, error, len(panels) - len(shown)),
        figure,
        {"": table_text(_csv_columns(every))},
    )


@dataclass
class _Curve:
    """One group under one pressure (or at one speed) with one density."""

    rows: list  # of averages, by rising x
    loose: list  # single cases of which some part did not converge
    x: str
    label: str

    def column(self, name):
        return np.array([row[name] for row in self.rows], dtype=float)

    @property
    def n(self):
        return self.column("n")

    def bar(self, name, error):
        """Half length of the error bars; NaN (none) where one scan gives no spread."""
        return np.where(self.n > 1, self.column(f"{name}_{error}"), np.nan)

    @property
    def place(self):
        return self.column(self.x) * SCALE[self.x]


def _curves(study, group, x):
    rows = study.averages.where(study.averages.equal("group", group)).rows()
    table = study.table.where(study.table.equal("group", group)) if study.table else study.table
    loose = table.where(~converged(table)).rows() if table else []
    keys = sorted({_key(row, x) for row in rows})
    curves = [
        _Curve(
            sorted((row for row in rows if _key(row, x) == key), key=lambda row: row[x]),
            [row for row in loose if _key(row, x) == key and np.isfinite(row["friction_mixed"])],
            x,
            _text(key, x),
        )
        for key in keys
    ]
    return [curve for curve in curves if np.isfinite(curve.column("friction_mixed_mean")).any() or curve.loose]


def _key(row, x):
    """What tells curves apart: (pressure or speed, density)."""
    return float(row[PRESSURE if x == SPEED else SPEED]), float(row[DENSITY])


def _text(key, x):
    first = units.pressure(key[0]) if x == SPEED else f"{units.number(key[0])} m/s"
    return f"{first}, {units.density(key[1])}"


def _friction(axis, group, curves, error):
    """Returns the panel of friction: of solids and oil together, and of the oil alone."""
    panel = chart.Panel(axis, chart.from_zero(series_of.FRICTION), _means(curves, "friction_mixed", error))
    for curve, drawn in zip(curves, list(panel.items)):
        panel.items.append(chart.Curve(curve.place, curve.column("friction_viscous_mean"), curve.label, drawn.colour, ":", 1.0))
    panel.items += _rings(curves, "friction_mixed")
    n_text = series_of.number_text(np.concatenate([curve.n for curve in curves]))
    panel.title = f"{style.literal(group, 28)} ({n_text})"
    return panel


def _load_share(axis, curves, error):
    label = "share of the load\nthat oil carries"
    return chart.Panel(axis, chart.from_zero(label, air=1), _means(curves, "fluid_load_share", error) + _rings(curves, "fluid_load_share"))


def _means(curves, name, error):
    return [
        chart.Curve(curve.place, curve.column(f"{name}_mean"), curve.label, error=curve.bar(name, error), notes={"n": curve.n}, **look)
        for curve, look in zip(curves, style.ordered_styles(len(curves)))
    ]


def _rings(curves, name):
    rows = [(row[curve.x] * SCALE[curve.x], row[name]) for curve in curves for row in curve.loose]
    return series_of.rings([x for x, _ in rows], [y for _, y in rows])


def _x_axis(x, curves):
    values = np.concatenate([curve.column(x) for curve in curves])
    moving = values[values > 0]
    if x == PRESSURE or not moving.size:
        return chart.from_zero(LABEL[x], air=1)
    slowest, fastest = float(moving.min()), float(moving.max())
    if fastest < 10 * slowest:
        return chart.Axis(LABEL[x])
    if (values == 0).any():  # has no place on a logarithmic axis: it stands left of the slowest
        return chart.Axis(LABEL[x], "symlog", -0.2 * slowest, 1.2 * fastest, linear_to=slowest)
    return chart.Axis(LABEL[x], "log")


def _caption(study, curves, x, error, n_left_out):
    against = "the sliding speed u" if x == SPEED else "the mean pressure P"
    parts = [
        "Friction coefficient (dimensionless) of the solids that still touch and of the oil that flows between the "
        f"surfaces, mean over the scans of a group against {against}; dotted: the part of the oil's shear. Below: the "
        "share of the load that the oil carries. "
    ]
    if any((curve.n > 1).any() for curve in curves):
        parts.append(
            f"Error bars: {series_of.ERROR_NAMES[error]} over the n scans in the panel's title; none where n = 1. "
        )
    if any(curve.loose for curve in curves):
        parts.append("Red rings: single cases that did not converge; no mean holds them. ")
    if n_left_out:
        parts.append(f"{n_left_out} more groups stand in the CSV file. ")
    return "".join(parts) + f"Viscosity of the oil {units.number(study.facts.get('viscosity_Pa_s'))} Pa s."


def _csv_columns(curves):
    names = ["group", PRESSURE, DENSITY, SPEED, "n"]
    names += [f"{name}_{kind}" for name in MEANS for kind in ("mean", "std", "sem")]
    columns = {name: [row[name] for curve in curves for row in curve.rows] for name in names}
    columns["series"] = ["computed" for curve in curves for _ in curve.rows]
    for curve in curves:
        for row in curve.loose:
            for name in columns:
                columns[name].append(_loose_value(row, name))
    return {"series": columns.pop("series"), **columns}


def _loose_value(row, name):
    if name == "series":
        return "not converged"
    if name == "n":
        return 1
    return row[name.removesuffix("_mean")] if name.removesuffix("_mean") in row else float("nan")
