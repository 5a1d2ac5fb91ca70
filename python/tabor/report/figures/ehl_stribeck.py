"""Stribeck curves: friction, film and solid contact of a point or line contact against speed."""

import numpy as np

from tabor.report import style
from tabor.report.figures import Drawn
from tabor.report.figures.ehl_curves import curves_along, swept_keys
from tabor.report.output import table_text

NM = 1e9
SPEEDS = ("motion.speed", "motion.entrainment_speed")


def is_one(source):
    sweep = source.file["sweep"]
    return any(key in sweep["axes"] for key in SPEEDS) and all(name in sweep for name in _Curve.NAMES)


def draw(source):
    """Friction, film and solid contact against speed, one colour for every surface of the sweep."""
    node = source.file["sweep"]
    keys = swept_keys(node)
    key = next(key for key in keys if key in SPEEDS)
    curves = [_Curve(node, keys, key, index, label) for index, label in curves_along(node, keys, key)]
    has_ratio = any(curve.has_ratio for curve in curves)
    heights = [3, 2, 2, 2] if has_ratio else [3, 2, 2]
    figure, grid = style.new_figure(0.9 * sum(heights), n_rows=len(heights), width=6.2, sharex=True, height_ratios=heights)
    panels = dict(zip(("friction", "film", "ratio", "share") if has_ratio else ("friction", "film", "share"), grid[:, 0]))
    for curve, look in zip(curves, style.curve_styles(len(curves))):
        curve.draw(panels, look["color"], look["marker"])
    _label_stribeck(panels, "sliding" if key == SPEEDS[0] else "entrainment")
    style.legend_on_top(figure, style.entries(panels["friction"], panels["share"]))
    warning = "" if all(curve.sure.all() for curve in curves) else " Red crosses: not converged."
    if any(np.isnan(curve.values["friction_coefficient"]).any() for curve in curves):
        warning += " Gaps: no friction is known there; the warnings say why."
    data = {f"{key} (m/s)": curves[0].speed}
    for curve in curves:
        data.update(curve.data())
    yield Drawn(
        "stribeck",
        "Stribeck curve",
        "Against one axis of speeds, from above: friction of film and solids; the central film; "
        + ("its ratio to the rms roughness of the contact (lambda); " if has_ratio else "")
        + "how much of the dry contact's area touches and how much of it is plastic." + warning,
        figure,
        {"": table_text(data)},
    )


class _Curve:
    """One surface of a Stribeck curve, in the order of the speeds."""

    NAMES = (
        "friction_coefficient",
        "friction_fluid",
        "friction_solid",
        "central_film_m",
        "solid_contact_fraction",
    )
    OF_SOME = ("plastic_fraction", "lambda_ratio")

    def __init__(self, node, keys, key, index, label):
        shape = [len(node["axes"][other]) for other in keys]
        order = np.argsort(node["axes"][key][()])
        self.label = label
        self.speed = node["axes"][key][()][order]
        names = [*self.NAMES, *(name for name in self.OF_SOME if name in node)]
        self.values = {name: node[name][()].reshape(shape)[index][order] for name in names}
        self.sure = node["converged"][()].reshape(shape)[index][order] > 0

    def data(self):
        prefix = f"{self.label} " if self.label else ""
        named = {**self.values, "converged": self.sure}
        return {f"{prefix}{name}": values for name, values in named.items()}

    @property
    def has_ratio(self):
        return np.isfinite(self.values.get("lambda_ratio", np.nan)).any()

    def draw(self, panels, colour, marker):
        top, share = panels["friction"], panels["share"]
        prefix = f"{self.label}: " if self.label else ""
        for name, text, look in (
            ("friction_coefficient", "friction", {"marker": marker}),
            ("friction_fluid", "of the film", {"linestyle": "--", "linewidth": 1}),
            ("friction_solid", "of solids", {"linestyle": ":", "linewidth": 1}),
        ):
            top.plot(self.speed, self.values[name], color=colour, label=prefix + text, **look)
        unsure = np.where(self.sure, np.nan, self.values["friction_coefficient"])
        top.plot(self.speed, unsure, color=style.WARNING, marker="x", linestyle="none", markersize=9)
        film = self.values["central_film_m"] * NM
        shown = np.where(film > 0, film, np.nan)  # no film has no place on a logarithmic axis
        panels["film"].plot(self.speed, shown, color=colour, marker=marker, markersize=4, label=prefix + "central film")
        if "ratio" in panels and self.has_ratio:
            ratio = self.values["lambda_ratio"]
            panels["ratio"].plot(self.speed, np.where(ratio > 0, ratio, np.nan), color=colour, marker=marker, markersize=4, label=prefix + "lambda")
        for name, text, line in (("plastic_fraction", "plastic", "-."), ("solid_contact_fraction", "touching", (0, (1, 3)))):
            if name in self.values:
                share.plot(self.speed, 100 * self.values[name], color=colour, linestyle=line, linewidth=1, label=prefix + text)


def _label_stribeck(panels, which):
    top, share = panels["friction"], panels["share"]
    top.set_xscale("log")
    style.log_axis(share.xaxis)
    for name in ("film", "ratio"):
        if name in panels:
            panels[name].set_yscale("log")
            style.log_axis(panels[name].yaxis)
    top.set_ylim(bottom=0)
    highest = share.dataLim.y1
    share.set_ylim(0, max(5, 1.05 * highest) if np.isfinite(highest) else 5)
    labels = {"friction": "friction coefficient", "film": "central film (nm)", "ratio": "film / rms roughness", "share": "share of the contact (%)"}
    for name, axes in panels.items():
        axes.grid(color="0.92", linewidth=0.6)
        axes.set_ylabel(labels[name])
    if "ratio" in panels:
        for bound in (1, 3):
            panels["ratio"].axhline(bound, color="0.45", linestyle=":", linewidth=1.0)
    share.set_xlabel(f"{which} speed (m/s)")
