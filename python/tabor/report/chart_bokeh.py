"""Figures of curves drawn by Bokeh, for interactive pages: with readings under the pointer, and a legend that hides and shows."""

import numpy as np
from bokeh.models import (
    BoxZoomTool,
    ColumnDataSource,
    CustomJSTickFormatter,
    FixedTicker,
    HoverTool,
    Label,
    LinearAxis,
    LinearScale,
    LogAxis,
    LogScale,
    LogTicker,
    PanTool,
    Range1d,
    ResetTool,
    SaveTool,
    Span,
    WheelZoomTool,
)
from bokeh.plotting import figure as new_figure
from matplotlib.colors import to_hex

from tabor.report import bokeh_looks, chart
from tabor.report.plain_text import plain

PIXELS_PER_INCH = 106
SCREEN_WIDTH = 900  # of all panels of a row
LARGEST_WIDTH = 760
LEFT_BORDER = 68  # for an axis with its label and four digits
LOW_PANEL = 2.2  # inches, in which six labels of an axis stand on each other
LABELS = 0.4  # inches, below the lowest panel on paper
BORDER = 0.1  # inches, around any
_LOG_LABELS = """
if (tick >= 0.001 && tick < 10000) return String(Number(tick.toPrecision(6)))
const power = Math.floor(Math.log10(tick) + 1e-9), digits = Number((tick / 10 ** power).toPrecision(3))
const small = "\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079"
const raised = String(power).replace(/./g, (d) => d == "-" ? "\u207b" : small[d])
return (digits == 1 ? "" : digits + "\u00d7") + "10" + raised
"""


def draw(figure, name):
    """Rows of Bokeh figures; None where an axis is linear about zero and logarithmic beyond, which Bokeh has not.

    What a label names has the tag `label` of the page's figure `name`.
    """
    if any(panel.x.scale == "symlog" for panel in figure.panels):
        return None
    ranges = {}
    return [[_Panel(figure, row, column, name, ranges).run() for column in range(len(panels))] for row, panels in enumerate(figure.rows)]


class _Panel:
    def __init__(self, figure, row, column, name, ranges):
        self.figure, self.row, self.column, self.name, self.ranges = figure, row, column, name, ranges
        self.panel = figure.rows[row][column]
        self.readings = {False: {}, True: {}}  # {is on the right: {names of further columns: renderers}}

    def run(self):
        self.plot = self._new_plot()
        sides = {False: {}, True: self._second_axis() if self.panel.right else {}}
        for item in sorted(self.panel.items, key=lambda item: (not isinstance(item, chart.Band), getattr(item, "z", 0))):
            is_right = getattr(item, "is_right", False)
            _DRAW[type(item)](self, item, sides[is_right])
        for is_right, readings in self.readings.items():
            for columns, renderers in readings.items():
                self.plot.add_tools(self._hover(self.panel.right if is_right else self.panel.y, columns, renderers))
        return self.plot

    def _new_plot(self):
        n_columns = len(self.figure.rows[self.row])
        x, y = self.panel.x, self.panel.y
        plot = new_figure(
            width=min(SCREEN_WIDTH // n_columns, LARGEST_WIDTH),
            height=max(240, round(PIXELS_PER_INCH * self._inches() + 60)),
            x_range=self._range("x"),
            y_range=self._range("y"),
            x_axis_type=x.scale,
            y_axis_type=y.scale,
            title=plain(self.panel.title),
            tools=[PanTool(), BoxZoomTool(), WheelZoomTool(), ResetTool(), SaveTool()],
            toolbar_location="above",
            sizing_mode="scale_width" if n_columns == 1 else None,
            max_width=LARGEST_WIDTH,
        )
        _dress(plot)
        for which, axis, declared in (("x", plot.xaxis[0], x), ("y", plot.yaxis[0], y)):
            self._dress_axis(axis, declared, is_upright=which == "y")
            axis.axis_label = axis.axis_label if self.figure.is_named(self.row, self.column, which) else ""
        return plot

    def _inches(self):
        """Height of the panel on paper, without its labels."""
        heights = self.figure.heights or [1] * len(self.figure.rows)
        return (self.figure.height - LABELS) * heights[self.row] / sum(heights) - BORDER

    def _second_axis(self):
        axis, is_log = self.panel.right, self.panel.right.scale == "log"
        self.plot.extra_y_ranges["right"] = self._range("right")
        self.plot.extra_y_scales["right"] = LogScale() if is_log else LinearScale()  # not that of the first axis
        drawn = (LogAxis if is_log else LinearAxis)(y_range_name="right")
        self.plot.add_layout(drawn, "right")
        self._dress_axis(drawn, axis, is_upright=True)
        return {"y_range_name": "right"}

    def _range(self, which):
        """One for all panels that share it."""
        shared = {"x": self.figure.shares_x, "y": self.figure.shares_y}.get(which)
        place = (which, self.row if shared == "row" else None) if shared else (which, id(self.panel))
        if place not in self.ranges:
            axis = self.figure.settled(self.panel, which)
            self.ranges[place] = Range1d(axis.low, axis.high)
        return self.ranges[place]

    def _dress_axis(self, axis, declared, is_upright):
        axis.axis_label = plain(declared.label)
        axis.axis_label_text_font_style = "normal"
        axis.axis_label_text_font_size = "14px"
        axis.major_label_text_font_size = "12px"
        axis.minor_tick_line_color = None
        if declared.scale == "log":
            is_low = is_upright and self._inches() < LOW_PANEL
            axis.ticker = LogTicker(mantissas=[1, 2, 5], desired_num_ticks=4 if is_low else 6)
            axis.formatter = CustomJSTickFormatter(code=_LOG_LABELS)
        elif declared.names:
            axis.ticker = FixedTicker(ticks=[float(place) for place in declared.names])
            axis.major_label_overrides = {float(place): name for place, name in declared.names.items()}

    def _hover(self, y, extra, renderers):
        """What is under the pointer, with names and units as on the axes."""
        lines = [("", "$name"), (plain(self.panel.x.label), "@x{%.4g}"), (plain(y.label), "@y{%.4g}")]
        formats = {"@x": "printf", "@y": "printf"}
        for name in extra:
            lines.append(("\u00b1", "@error{%.2g}") if name == "error" else (name, f"@{{{name}}}"))
        if "error" in extra:
            formats["@error"] = "printf"
        return HoverTool(renderers=renderers, tooltips=lines, formatters=formats, visible=False, line_policy="nearest")

    def band(self, band, keywords):
        low, high = np.broadcast_arrays(np.asarray(band.low, dtype=float), np.asarray(band.high, dtype=float))
        x = np.broadcast_to(np.asarray(band.x, dtype=float), low.shape)
        runs = _runs(np.isfinite(x) & np.isfinite(low) & np.isfinite(high))
        self._named(
            band,
            self.plot.patches(
                [np.concatenate([x[run], x[run][::-1]]) for run in runs],
                [np.concatenate([low[run], high[run][::-1]]) for run in runs],
                fill_color=to_hex(band.colour),
                fill_alpha=band.alpha,
                line_alpha=0,
                **keywords,
            ),
        )

    def curve(self, curve, keywords):
        x, y = (np.asarray(values, dtype=float) for values in (curve.x, curve.y))
        if not np.isfinite(y).any():
            return
        columns = {"x": x, "y": y, **{key: np.asarray(value) for key, value in curve.notes.items()}}
        if curve.has_bars:
            columns["error"] = np.asarray(curve.error, dtype=float)
            self._bars(curve, columns, keywords)
        source = ColumnDataSource(columns)
        drawn = [*self._stroke(curve, source, keywords), *self._marks(curve, source, keywords)]
        self._named(curve, *drawn)
        extra = tuple(name for name in columns if name not in ("x", "y"))
        self.readings[curve.is_right].setdefault(extra, []).append(drawn[-1])

    def _stroke(self, curve, source, keywords):
        if not curve.dash:
            return []
        return [self.plot.line("x", "y", source=source, **bokeh_looks.stroke_of(curve), **keywords)]

    def _marks(self, curve, source, keywords):
        marker = bokeh_looks.MARKERS.get(curve.marker)
        if marker is None:
            return []
        face, edge = bokeh_looks.mark_colours(curve)
        marks = self.plot.scatter(
            "x",
            "y",
            source=source,
            marker="circle" if marker == "dot" else marker,  # Bokeh's own dot is hardly to be seen
            size=1.45 * curve.size * (bokeh_looks.DOT if marker == "dot" else 1),
            fill_color=face,
            line_color=edge,
            line_width=curve.edge,
            alpha=curve.alpha,
            **keywords,
        )
        return [marks]

    def _bars(self, curve, columns, keywords):
        known = np.isfinite(columns["error"])
        x, y, error = (columns[name][known] for name in ("x", "y", "error"))
        low, high, colour = y - error, y + error, to_hex(curve.colour)
        self._named(
            curve,
            self.plot.segment(x, low, x, high, line_color=colour, **keywords),
            self.plot.scatter(np.tile(x, 2), np.append(low, high), marker="dash", size=7, line_color=colour, **keywords),
        )

    def guide(self, guide, keywords):
        span = Span(location=float(guide.at), dimension="height" if guide.is_upright else "width", **bokeh_looks.stroke_of(guide), **keywords)
        self.plot.add_layout(span)
        self._named(guide, span)

    def text(self, text, keywords):
        if text.y is not None:  # above a panel there is no room
            look = {"text_font_size": "12px", "text_color": to_hex(text.colour), "x_offset": 8, "y_offset": 4}
            self.plot.add_layout(Label(x=float(text.x), y=float(text.y), text=plain(text.text), **look, **keywords))

    def _named(self, item, *models):
        for model in models:
            model.name = plain(item.label)
            model.tags = [f"{self.name}:{model.name}"] if model.name else []


_DRAW = {chart.Curve: _Panel.curve, chart.Band: _Panel.band, chart.Guide: _Panel.guide, chart.Text: _Panel.text}


def _runs(known):
    """Slices of what is known without a gap."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], known, [False]]).astype(int)))
    return [slice(start, stop) for start, stop in edges.reshape(-1, 2)]


def _dress(plot):
    plot.toolbar.logo = None
    plot.toolbar.active_scroll = None
    plot.toolbar.autohide = False
    plot.outline_line_color = None
    plot.min_border = 8
    plot.min_border_left = LEFT_BORDER  # axes of panels on top of each other begin at one place
    plot.title.text_font_size = "13px"
    plot.grid.grid_line_color = "#e8e8e8"
