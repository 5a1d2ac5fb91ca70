"""Curves that Matplotlib drew as Bokeh figures: the same numbers, colours and axes, with readings under the pointer."""

import re

import numpy as np
from bokeh.models import (
    BoxZoomTool,
    ColumnDataSource,
    CustomJSTickFormatter,
    FixedTicker,
    HoverTool,
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
from matplotlib.collections import LineCollection, PolyCollection, QuadMesh
from matplotlib.colors import to_hex, to_rgba
from matplotlib.container import ErrorbarContainer
from matplotlib.contour import ContourSet

from tabor.report import style

PIXELS_PER_INCH = 106
SCREEN_WIDTH = 900  # of all panels of a row
LEFT_BORDER = 68  # for an axis with its label and four digits
LOW_PANEL = 2.2  # inches, in which six labels of an axis stand on each other
DOT = 0.5  # of the size of a mark: as Matplotlib draws a '.'
_DASHES = {"-": "solid", "--": "dashed", ":": "dotted", "-.": "dashdot"}
_MARKERS = {
    "o": "circle", "s": "square", "^": "triangle", "D": "diamond", "d": "diamond", "v": "inverted_triangle",
    "P": "plus", "X": "x", "x": "x", ".": "dot", "p": "hex", "h": "hex", "*": "star", "<": "triangle", ">": "triangle", "8": "hex",
}  # fmt: skip
# Paths of the marks in a legend's picture of 28 x 12 pixels.
_SHAPES = {
    "circle": "M10 6a4 4 0 1 0 8 0a4 4 0 1 0-8 0z", "dot": "M12.5 6a1.5 1.5 0 1 0 3 0a1.5 1.5 0 1 0-3 0z", "square": "M10.3 2.3h7.4v7.4h-7.4z",
    "triangle": "M14 1.5l4.5 8h-9z", "inverted_triangle": "M14 10.5l-4.5-8h9z", "diamond": "M14 .8l3.8 5.2l-3.8 5.2l-3.8-5.2z",
    "plus": "M12.6 1.8h2.8v2.8h2.8v2.8h-2.8v2.8h-2.8v-2.8h-2.8v-2.8h2.8z", "x": "M10.5 2.5l7 7M10.5 9.5l7-7", "hex": "M14 1.8l3.7 2.1v4.2l-3.7 2.1l-3.7-2.1v-4.2z",
    "star": "M14 1l1.5 3.3l3.5.4l-2.6 2.4l.7 3.6l-3.1-1.8l-3.1 1.8l.7-3.6l-2.6-2.4l3.5-.4z",
}  # fmt: skip
_LOG_LABELS = """
if (tick >= 0.001 && tick < 10000) return String(Number(tick.toPrecision(6)))
const power = Math.floor(Math.log10(tick) + 1e-9), digits = Number((tick / 10 ** power).toPrecision(3))
const small = "\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079"
const raised = String(power).replace(/./g, (d) => d == "-" ? "\u207b" : small[d])
return (digits == 1 ? "" : digits + "\u00d7") + "10" + raised
"""
_RAISED = str.maketrans("0123456789+-D", "⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻ᴰ")
_LOWERED = dict(zip("0123456789aehijklmnoprstuvx", "₀₁₂₃₄₅₆₇₈₉ₐₑₕᵢⱼₖₗₘₙₒₚᵣₛₜᵤᵥₓ"))


def convert(drawing, name):
    """(rows of Bokeh figures, legend) of a Matplotlib figure; None where it holds what only Matplotlib draws.

    legend: [{"label", "colour", "dash", "marker", "shape", "face", "edge"}], the marks as they are plotted; what a label names has the tag `label` of the page's figure `name`.
    """
    panels = [axes for axes in drawing.axes if axes.get_visible()]
    if not panels or any(_is_picture(axes) for axes in panels):
        return None
    drawing.draw_without_rendering()  # limits and places are settled
    return _Converter(panels, name).run()


def plain(text):
    """A label without Matplotlib's mathematics: $A_{real}$ -> Aᵣₑₐₗ."""
    text = text.replace(r"\$", "\0")
    text = re.sub(r"\$([^$]*)\$", lambda match: _formula(match.group(1)), text)
    return text.replace("\0", "$").replace("\n", " ")


def _formula(text):
    text = text.replace("\\mu", "μ").replace("\\tau", "τ").replace("\\,", " ")
    text = re.sub(r"_\{([^}]*)\}|_(.)", lambda match: _lowered(match.group(1) or match.group(2)), text)
    return re.sub(r"\^\{([^}]*)\}|\^(.)", lambda match: (match.group(1) or match.group(2)).translate(_RAISED), text)


def _lowered(text):
    return "".join(_LOWERED[letter] for letter in text) if set(text) <= set(_LOWERED) else "_" + text


def _is_picture(axes):
    """Whether Bokeh has nothing to match: maps, their bars, axes that are linear about zero and logarithmic beyond."""
    scales = {axes.get_xscale(), axes.get_yscale()}
    return bool(axes.images or axes.child_axes or not scales <= {"linear", "log"} or _has_contours(axes))


def _has_contours(axes):
    return any(isinstance(artist, (ContourSet, QuadMesh)) or hasattr(artist, "levels") for artist in axes.get_children())


class _Converter:
    def __init__(self, panels, name):
        self.panels, self.name = panels, name
        self.places = []  # one list of axes per panel: those on top of each other
        for axes in panels:
            place = next((place for place in self.places if _overlap(place[0], axes)), None)
            self.places.append([axes]) if place is None else place.append(axes)
        self.labels = _Labels(panels)
        self.ranges = {}

    def run(self):
        rows = {}
        for place in self.places:
            rows.setdefault(round(place[0].get_position().y0, 2), []).append(place)
        ordered = [sorted(rows[y], key=lambda place: place[0].get_position().x0) for y in sorted(rows, reverse=True)]
        return [[self._panel(place, len(row)) for place in row] for row in ordered], self.labels.legend()

    def _panel(self, place, n_columns):
        first = place[0]
        plot = new_figure(
            width=min(SCREEN_WIDTH // n_columns, 760),
            height=max(240, round(PIXELS_PER_INCH * first.get_position().height * first.figure.get_figheight() + 60)),
            x_range=self._range(first, "x"),
            y_range=self._range(first, "y"),
            x_axis_type=first.get_xscale(),
            y_axis_type=first.get_yscale(),
            title=_title(first),
            tools=[PanTool(), BoxZoomTool(), WheelZoomTool(), ResetTool(), SaveTool()],
            toolbar_location="above",
            sizing_mode="scale_width" if n_columns == 1 else None,
            max_width=760,
        )
        _dress(plot, first)
        for number, axes in enumerate(place):
            self._draw(plot, axes, None if number == 0 else self._second_axis(plot, axes, number))
        return plot

    def _second_axis(self, plot, axes, number):
        name = f"right{number}"
        plot.extra_y_ranges[name] = self._range(axes, "y")
        log = axes.get_yscale() == "log"
        plot.extra_y_scales[name] = LogScale() if log else LinearScale()  # not that of the first axis
        axis = (LogAxis if log else LinearAxis)(y_range_name=name, axis_label=plain(axes.get_ylabel()))
        plot.add_layout(axis, "right")
        _dress_axis(axis, axes, "y")
        return name

    def _range(self, axes, which):
        """One for all axes that share it."""
        shared = axes.get_shared_x_axes() if which == "x" else axes.get_shared_y_axes()
        for other, known in self.ranges.items():
            if other[1] == which and shared.joined(axes, other[0]):
                return known
        start, end = axes.get_xlim() if which == "x" else axes.get_ylim()
        found = self.ranges[axes, which] = Range1d(float(start), float(end))
        return found

    def _draw(self, plot, axes, y_range):
        self.keywords = {} if y_range is None else {"y_range_name": y_range}
        self.readings = {}
        self._areas(plot, axes)
        bars = [item for item in axes.containers if isinstance(item, ErrorbarContainer)]
        parts = {part for item in bars for part in item.lines[1]}
        errors = {item.lines[0]: item for item in bars if item.lines[0] is not None}
        for line in sorted(axes.lines, key=lambda line: line.get_zorder()):
            if line not in parts and line.get_visible():
                self._line(plot, axes, line, errors.get(line))
        for columns, renderers in self.readings.items():
            plot.add_tools(_hover(axes, columns, renderers))

    def _areas(self, plot, axes):
        for area in axes.collections:
            if not isinstance(area, PolyCollection) or isinstance(area, LineCollection):
                continue
            paths = [path.vertices for path in area.get_paths() if len(path.vertices) > 2]
            colour = area.get_facecolor()[0]
            drawn = plot.patches(
                [path[:, 0] for path in paths],
                [path[:, 1] for path in paths],
                fill_color=to_hex(colour),
                fill_alpha=float(colour[3]),
                line_width=0,
                line_alpha=0,
                **self.keywords,
            )
            self._name(drawn, area)

    def _line(self, plot, axes, line, error):
        if line.get_transform() != axes.transData:
            self._guide(plot, axes, line)
            return
        x, y = (np.asarray(values, dtype=float) for values in (line.get_xdata(), line.get_ydata()))
        if not len(x) or not np.isfinite(y).any():
            return
        notes = {key: np.asarray(value) for key, value in getattr(line, "tabor_notes", {}).items()}
        columns = {"x": x, "y": y, **notes}
        if error is not None and error.has_yerr:
            columns["error"] = self._bars(plot, error, y, line)
        source = ColumnDataSource(columns)
        drawn = [*self._stroke(plot, line, source), *self._marks(plot, line, source)]
        for renderer in drawn:
            self._name(renderer, line)
        extra = tuple(name for name in columns if name not in ("x", "y"))
        self.readings.setdefault(extra, []).append(drawn[-1]) if drawn else None

    def _stroke(self, plot, line, source):
        if line.get_linestyle() in ("None", "none", "", " "):
            return []
        look = {**_stroke_of(line), **self.keywords}
        if line.get_drawstyle() == "steps-mid":
            return [plot.step("x", "y", mode="center", source=source, **look)]
        return [plot.line("x", "y", source=source, **look)]

    def _marks(self, plot, line, source):
        marker = _MARKERS.get(line.get_marker())
        if marker is None:
            return []
        face, edge = _mark_colours(line)
        size = 1.45 * line.get_markersize() * (DOT if marker == "dot" else 1)
        return [
            plot.scatter(
                "x",
                "y",
                source=source,
                marker="circle" if marker == "dot" else marker,  # Bokeh's own dot is hardly to be seen
                size=size,
                fill_color=face,
                line_color=edge,
                line_width=line.get_markeredgewidth(),
                alpha=line.get_alpha() or 1.0,
                **self.keywords,
            )
        ]

    def _bars(self, plot, error, y, line):
        """Draws the error bars; the half length of each, NaN where there is none."""
        lengths = np.full(len(y), np.nan)
        for place, ends in enumerate(error.lines[2][-1].get_segments()):
            if len(ends) != 2 or not np.isfinite(ends).all():
                continue
            (x, low), (_, high) = ends
            index = int(np.argmin(np.abs(y - (low + high) / 2) + 1e300 * (np.asarray(line.get_xdata()) != x)))
            lengths[index] = (high - low) / 2
        known = np.isfinite(lengths)
        x = np.asarray(line.get_xdata(), dtype=float)[known]
        low, high = y[known] - lengths[known], y[known] + lengths[known]
        colour = to_hex(line.get_color())
        for renderer in (
            plot.segment(x, low, x, high, line_color=colour, **self.keywords),
            plot.scatter(np.tile(x, 2), np.append(low, high), marker="dash", size=7, line_color=colour, **self.keywords),
        ):
            self._name(renderer, line)
        return lengths

    def _guide(self, plot, axes, line):
        """A line across the panel at one place of an axis."""
        across = {
            "width": (axes.get_yaxis_transform(), line.get_ydata),
            "height": (axes.get_xaxis_transform(), line.get_xdata),
        }
        for dimension, (transform, values) in across.items():
            if line.get_transform() == transform:
                span = Span(location=float(values()[0]), dimension=dimension, **_stroke_of(line), **self.keywords)
                plot.add_layout(span)
                self._name(span, line)

    def _name(self, model, artist):
        model.name = self.labels.of(artist)
        model.tags = [f"{self.name}:{model.name}"] if model.name else []


class _Labels:
    """What each artist is called: its own label, else that of one in its look."""

    def __init__(self, panels):
        self.known, self.entries = {}, {}
        for handles, labels in [axes.get_legend_handles_labels() for axes in panels] + _figure_legends(panels[0].figure):
            for handle, label in zip(handles, labels):
                artist = handle.lines[0] if isinstance(handle, ErrorbarContainer) else handle
                if plain(label) in self.entries:
                    continue
                for look in (_look(artist), _look(artist)[:1]):
                    self.known.setdefault(look, plain(label))
                self.entries.setdefault(plain(label), artist)

    def of(self, artist):
        label = getattr(artist, "tabor_label", artist.get_label())
        if isinstance(label, str) and plain(label) in self.entries:
            return plain(label)
        if _look(artist) in self.known:
            return self.known[_look(artist)]
        return self.known.get(_look(artist)[:1], "")

    def legend(self):
        found = []
        for label, artist in self.entries.items():
            is_line = hasattr(artist, "get_linestyle") and not isinstance(artist, PolyCollection)
            marker = _MARKERS.get(artist.get_marker(), "") if is_line and hasattr(artist, "get_marker") else "area"
            stroke = _stroke_of(artist)["line_dash"] if is_line and artist.get_linestyle() not in ("None", "") else ""
            entry = {"label": label, "colour": _look(artist)[0], "dash": stroke, "marker": marker}
            if marker in _SHAPES:
                face, edge = _mark_colours(artist)
                entry.update(shape=_SHAPES[marker], face=face or "none", edge=edge)
            found.append(entry)
        return found


def _handles_of(legend):
    """Matplotlib 3.6, Debian's, has another name for them."""
    return legend.legend_handles if hasattr(legend, "legend_handles") else legend.legendHandles


def _figure_legends(drawing):
    """[(handles, labels)] of the legends above a figure, which name more than their panels do."""
    texts = [[text.get_text() for text in legend.get_texts()] for legend in drawing.legends]
    return [(_handles_of(legend), labels) for legend, labels in zip(drawing.legends, texts)]


def _look(artist):
    """(colour, dashes), by which a curve and its bands and guides know each other."""
    if isinstance(artist, PolyCollection):
        return (to_hex(artist.get_facecolor()[0]),)
    if artist.get_linestyle() in ("None", "none", "") and artist.get_marker() not in ("None", "", None):
        return to_hex(artist.get_markeredgecolor()), "none"
    return to_hex(artist.get_color()), str(_dash(artist))


def _mark_colours(line):
    """(face or None, edge)"""
    face = line.get_markerfacecolor()
    return None if isinstance(face, str) and face == "none" else to_hex(face), to_hex(line.get_markeredgecolor())


def _stroke_of(line):
    width = max(1.0, 1.3 * line.get_linewidth())
    return {"line_color": to_hex(line.get_color()), "line_width": width, "line_dash": _dash(line)}


def _dash(line):
    pattern = getattr(line, "_unscaled_dash_pattern", (0, None))[1]
    plain_name = _DASHES.get(line.get_linestyle(), "solid")
    return [max(1, round(1.4 * length)) for length in pattern] if pattern and plain_name == "dashed" else plain_name


def _overlap(one, other):
    return np.allclose(one.get_position().bounds, other.get_position().bounds, atol=1e-3)


def _title(axes):
    return plain(axes.get_title(loc="left") or axes.get_title())


def _dress(plot, axes):
    plot.toolbar.logo = None
    plot.toolbar.active_scroll = None
    plot.toolbar.autohide = False
    plot.outline_line_color = None
    plot.min_border = 8
    plot.min_border_left = LEFT_BORDER  # axes of panels on top of each other begin at one place
    plot.title.text_font_size = "13px"
    plot.grid.grid_line_color = "#e8e8e8"
    for axis, which in ((plot.xaxis[0], "x"), (plot.yaxis[0], "y")):
        axis.axis_label = plain(axes.get_xlabel() if which == "x" else axes.get_ylabel())
        _dress_axis(axis, axes, which)


def _dress_axis(axis, axes, which):
    axis.axis_label_text_font_style = "normal"
    axis.axis_label_text_font_size = "14px"
    axis.major_label_text_font_size = "12px"
    axis.minor_tick_line_color = None
    if (axes.get_xscale() if which == "x" else axes.get_yscale()) == "log":
        is_low = which == "y" and axes.get_position().height * axes.figure.get_figheight() < LOW_PANEL
        axis.ticker = LogTicker(mantissas=[1, 2, 5], desired_num_ticks=4 if is_low else 6)
        axis.formatter = CustomJSTickFormatter(code=_LOG_LABELS)
    elif names := getattr(axes, f"tabor_{which}_names", None):
        axis.ticker = FixedTicker(ticks=[float(place) for place in names])
        axis.major_label_overrides = {float(place): name for place, name in names.items()}


def _hover(axes, extra, renderers):
    """What is under the pointer, with names and units as on the axes."""
    lines = [("", "$name"), (plain(axes.get_xlabel()), "@x{%.4g}"), (plain(axes.get_ylabel()), "@y{%.4g}")]
    formats = {"@x": "printf", "@y": "printf"}
    for name in extra:
        if name == "error":
            lines.append(("\u00b1", "@error{%.2g}"))
            formats["@error"] = "printf"
        else:
            lines.append((name, f"@{{{name}}}"))
    return HoverTool(renderers=renderers, tooltips=lines, formatters=formats, visible=False, line_policy="nearest")
