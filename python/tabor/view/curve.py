"""Friction against pressure: drawn as one moves, and over the whole range on request."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import replace
from typing import Any

from bokeh.models import Column, ColumnDataSource, HoverTool, Range1d, Row
from bokeh.models.widgets import Button, Div
from bokeh.plotting import figure

from .answers import Answer
from .controls import pressure_range
from .looks import CURVES, STYLE
from .pictures import add_saving
from .state import State

N_POINTS = 9  #: of a whole curve


def family(state: State) -> Hashable:
    """What all points of one curve have in common: everything but the pressure and what is switched off."""
    return replace(state, pressure="", steps=()), state.treatment


class Curve:
    """The figure: a point for each full answer of one family, the working point among them."""

    def __init__(self, file: str) -> None:
        self._family: Hashable = None
        self._points: dict[float, tuple[float, float]] = {}
        self._source = ColumnDataSource({"pressure": [], "dry": [], "lubricated": []})
        self._here = ColumnDataSource({"pressure": [], "dry": [], "lubricated": []})
        self.range = Range1d(start=0.1, end=100)  # [MPa]
        self._top = Range1d(start=0, end=1)
        self.plot: Any = figure(width=660, height=250, x_axis_type="log", x_range=self.range, y_range=self._top, x_axis_label="mean pressure [MPa]", y_axis_label="friction",
                                tools="box_zoom,wheel_zoom,reset", toolbar_location="right", name="curve")
        self.plot.toolbar.logo = None
        self.plot.toolbar.active_scroll = None
        for name, marker in (("dry", "circle"), ("lubricated", "square")):
            colour = CURVES[name]
            self.plot.line("pressure", name, source=self._source, color=colour, line_width=1.5)
            self.plot.scatter("pressure", name, source=self._source, marker=marker, size=5, color=colour, legend_label=name)
            self.plot.scatter("pressure", name, source=self._here, marker=marker, size=13, line_width=2, line_color=colour, fill_color="white")
        self.plot.add_tools(HoverTool(visible=False, tooltips=[("pressure", "@pressure{0.000} MPa"), ("dry", "@dry{0.0000}"), ("lubricated", "@lubricated{0.0000}")]))
        add_saving(self.plot, f"{file}_friction")
        self.plot.legend.update(location="bottom_left", orientation="horizontal", background_fill_alpha=0.7)
        self.draw = Button(label=f"Draw {N_POINTS} pressures", width=150, name="draw")
        self.note = Div(text="<p class='note'>A point for each pressure that was fully computed; the large one is here.</p>", stylesheets=[STYLE], width=440)
        self.view = Column(children=[Row(children=[self.draw, self.note]), self.plot])

    def show(self, answer: Answer) -> None:
        """Adds the point of a full answer, and marks it."""
        low, high = pressure_range(answer.state)
        self.range.update(start=10.0**low, end=10.0**high)
        if family(answer.state) != self._family:
            self._family, self._points = family(answer.state), {}
        found = answer.friction
        if found is None or answer.is_preview:
            here: dict[str, list[float]] = {"pressure": [], "dry": [], "lubricated": []}
        else:
            pressure = float(found.values["mean_pressure_Pa"]) / 1e6
            self._points[pressure] = (found.dry, found.lubricated)
            here = {"pressure": [pressure], "dry": [found.dry], "lubricated": [found.lubricated]}
        self._here.data = here
        pressures = sorted(self._points)
        self._top.end = 1.2 * max(map(max, self._points.values()), default=0.5) or 1.0
        self._source.data = {"pressure": pressures, "dry": [self._points[one][0] for one in pressures],
                             "lubricated": [self._points[one][1] for one in pressures]}
