"""Stribeck curves: friction, film and solid contact of a point or line contact against speed."""

import numpy as np

from tabor.report import chart, style
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
    panels = _panels(curves, has_ratio, "sliding" if key == SPEEDS[0] else "entrainment")
    heights = [3, *[2] * (len(panels) - 1)]
    named = chart.Figure([[panels[0]], [panels[-1]]], 0).labelled()
    figure = chart.Figure([[panel] for panel in panels], 0.9 * sum(heights), 6.2, heights, shares_x=True, legend=tuple(named.values()))
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

    def friction(self, look):
        named = (
            ("friction_coefficient", "friction", {"marker": look["marker"]}),
            ("friction_fluid", "of the film", {"dash": "--", "width": 1.0}),
            ("friction_solid", "of solids", {"dash": ":", "width": 1.0}),
        )
        curves = [self._curve(self.values[name], text, look, **own) for name, text, own in named]
        unsure = np.where(self.sure, np.nan, self.values["friction_coefficient"])
        return [*curves, chart.Curve(self.speed, unsure, colour=style.WARNING, dash="", marker="x", size=9)]

    def film(self, look):
        return [self._marked(self.values["central_film_m"] * NM, "central film", look)]

    def ratio(self, look):
        return [self._marked(self.values["lambda_ratio"], "lambda", look)] if self.has_ratio else []

    def share(self, look):
        named = (("plastic_fraction", "plastic", "-."), ("solid_contact_fraction", "touching", (1, 3)))
        return [self._curve(100 * self.values[name], text, look, dash=dash, width=1.0) for name, text, dash in named if name in self.values]

    def _curve(self, values, text, look, **own):
        return chart.Curve(self.speed, values, f"{self.label}: {text}" if self.label else text, look["colour"], **own)

    def _marked(self, values, text, look):
        """Returns a curve for a logarithmic axis, which has no place for zero."""
        return self._curve(np.where(values > 0, values, np.nan), text, look, marker=look["marker"], size=4)


def _panels(curves, has_ratio, which):
    """Returns panels of friction, film, its ratio to the roughness where it is known, and share of the contact."""
    looks = style.curve_styles(len(curves))
    x = chart.Axis(f"{which} speed (m/s)", "log")

    def panel(kind, y):
        return chart.Panel(x, y, [item for curve, look in zip(curves, looks) for item in kind(curve, look)])

    share = panel(_Curve.share, chart.Axis("share of the contact (%)", low=0.0))
    highest = np.nanmax([np.nanmax(item.y) if np.isfinite(item.y).any() else 0.0 for item in share.items])
    share.y.high = max(5.0, 1.05 * float(highest))
    panels = [panel(_Curve.friction, chart.from_zero("friction coefficient", air=1)), panel(_Curve.film, chart.Axis("central film (nm)", "log"))]
    if has_ratio:
        panels.append(panel(_Curve.ratio, chart.Axis("film / rms roughness", "log")))
        panels[-1].items += [chart.Guide(bound) for bound in (1, 3)]
    return [*panels, share]
