"""Maps of a scan: heights with their colours, histogram and section; contact, pressure, gap and oil."""

from __future__ import annotations

from typing import Any

import numpy as np
from bokeh.models import BasicTicker, ColumnDataSource, CustomJS, LinearColorMapper, PanTool, PointDrawTool, Range1d
from bokeh.models.annotations import ColorBar
from bokeh.models.widgets import Div, RangeSlider
from bokeh.palettes import Cividis256, Greys256, Viridis256
from bokeh.plotting import figure

from .._maps import Array
from .._surface import Surface
from .answers import Answer
from .looks import CURVES, DRY, HOLE, LIQUID, SOLID, STYLE, WET, Unit, limits, ordinal, shown, unit_for
from .pictures import add_saving

FRAME = (340, 320)  #: largest width and height of a map [px of the screen]
_TOOLS = "box_zoom,wheel_zoom,reset"


def frame_of(lengths: tuple[float, float]) -> tuple[int, int]:
    """Width and height of a map of these sides whose pixels are square on the screen [px]."""
    lx, ly = lengths
    width, height = FRAME
    scale = min(width / lx, height / ly)
    return max(120, round(lx * scale)), max(90, round(ly * scale))


class Axes:
    """Ranges along x and y that maps share, in one unit of length."""

    def __init__(self, lengths: tuple[float, float]) -> None:
        self.unit = unit_for(max(lengths))
        self.x, self.y = Range1d(), Range1d()
        self.ranges: tuple[Any, Any] = (self.x, self.y)
        self.lengths: tuple[float, float] = (0.0, 0.0)
        self.show(lengths)

    def show(self, lengths: tuple[float, float]) -> None:
        """Shows a whole surface of these sides if they are others than before."""
        if self.lengths == lengths:
            return
        self.lengths = lengths
        lx, ly = map(self.unit.of, lengths)
        self.x.update(start=0, end=lx, reset_start=0, reset_end=lx)
        self.y.update(start=ly, end=0, reset_start=ly, reset_end=0)

    def figure(self, file: str, **look: Any) -> Any:
        """An empty map with these axes; pictures of it are saved under the name of a file."""
        width, height = frame_of(self.lengths)
        plot = figure(x_range=self.x, y_range=self.y, frame_width=width, frame_height=height, tools=_TOOLS,
                      toolbar_location="right", x_axis_label=f"x [{self.unit.name}]", y_axis_label=f"y [{self.unit.name}]", **look)
        plot.toolbar.logo = None
        plot.toolbar.active_scroll = None
        plot.grid.visible = False
        add_saving(plot, file)
        return plot


class Image:
    """The picture of one map in a figure."""

    def __init__(self, plot: Any, axes: Axes, mapper: Any) -> None:
        self._axes = axes
        self._source = ColumnDataSource({"image": [], "x": [], "y": [], "dw": [], "dh": []})
        self.glyph = plot.image("image", x="x", y="y", dw="dw", dh="dh", source=self._source, color_mapper=mapper, level="image")

    def show(self, values: Array, surface: Surface, corner: tuple[float, float] = (0.0, 0.0)) -> int:
        """Shows a map, whose upper left corner is at a place [m]; of how many pixels along a side one is shown."""
        pixels, step = shown(values)
        (x, y), (lx, ly) = map(self._axes.unit.of, corner), map(self._axes.unit.of, surface.lengths)
        self._source.data = {"image": [pixels], "x": [x], "y": [y], "dw": [lx], "dh": [ly]}
        return step

    def clear(self) -> None:
        """Shows nothing."""
        self._source.data = {name: [] for name in ("image", "x", "y", "dw", "dh")}


def colour_bar(plot: Any, mapper: Any) -> Any:
    bar = ColorBar(color_mapper=mapper, width=12, ticker=BasicTicker(desired_num_ticks=5), padding=4)
    plot.add_layout(bar, "right")
    return bar


class Heights:
    """The heights of the treated scan: map, colour range, histogram and the section along a line."""

    def __init__(self, scan: Surface, axes: Axes, file: str) -> None:
        self._axes, self.surface, self._file = axes, scan, file
        least, largest, _, _ = limits(scan.height)
        self.unit: Unit = unit_for(largest - least)
        self._mapper = LinearColorMapper(palette=Viridis256, nan_color=HOLE)
        self.plot = axes.figure(f"{file}_heights", name="height", output_backend="canvas")
        self._image = Image(self.plot, axes, self._mapper)
        self.plot.title.text = f"height z [{self.unit.name}]"
        colour_bar(self.plot, self._mapper)
        self.surface = scan
        self._add_line()
        self.colours = RangeSlider(start=0, end=1, value=(0, 1), step=0.001, title=f"Colour range [{self.unit.name}]", width=460,
                                   format="0.000", name="colours")
        self.colours.js_on_change("value", CustomJS(args={"mapper": self._mapper, "slider": self.colours},
                                                    code="mapper.low = slider.value[0]; mapper.high = slider.value[1]"))
        self.note = Div(stylesheets=[STYLE], visible=False)
        self._bars = ColumnDataSource({"left": [], "right": [], "top": []})
        self.histogram = self._small("histogram", f"z [{self.unit.name}]", "share of pixels [%]", 240)
        self.histogram.quad(left="left", right="right", top="top", bottom=0, source=self._bars, color="#6B7A8F")
        self._profile = ColumnDataSource({"s": [], "z": []}, name="profile")
        self.section = self._small("section", f"along the line [{axes.unit.name}]", f"z [{self.unit.name}]", 325)
        self.section.line("s", "z", source=self._profile, color=CURVES["lubricated"])

    def _small(self, name: str, x: str, y: str, width: int) -> Any:
        plot = figure(width=width, height=205, tools="box_zoom,reset", toolbar_location="right", x_axis_label=x, y_axis_label=y,
                      x_range=Range1d(), y_range=Range1d(), name=name)
        plot.toolbar.logo = None
        add_saving(plot, f"{self._file}_{name}")
        plot.xaxis.ticker = BasicTicker(desired_num_ticks=4)
        plot.yaxis.ticker = BasicTicker(desired_num_ticks=4)
        return plot

    def _add_line(self) -> None:
        lx, ly = map(self._axes.unit.of, self.surface.lengths)
        self.ends = ColumnDataSource({"x": [0.0, lx], "y": [ly / 2, ly / 2]}, name="ends")
        self.plot.line("x", "y", source=self.ends, color="white", line_width=2.5, alpha=0.8)
        self.plot.line("x", "y", source=self.ends, color="black", line_width=1)
        handles = self.plot.scatter("x", "y", source=self.ends, size=11, fill_color="white", line_color="black")
        tool = PointDrawTool(renderers=[handles], add=False, num_objects=2, description="Move the ends of the section")
        self.plot.add_tools(PanTool(), tool)
        self.plot.toolbar.active_drag = tool
        self.ends.on_change("data", lambda _a, _o, _n: self._draw_section())

    def show(self, surface: Surface) -> None:
        """Shows the heights of a surface; the colour range follows where they changed."""
        self._axes.show(surface.lengths)
        self.surface = surface
        width, height = frame_of(surface.lengths)
        self.plot.update(frame_width=width, frame_height=height)
        step = self._image.show(self.unit.of(surface.height), surface)
        self.note.update(text=f"<p class='note'>The map shows every {ordinal(step)} pixel along x and y.</p>", visible=step > 1)
        least, largest, low, high = limits(self.unit.of(surface.height))
        self.colours.update(start=least, end=largest, value=(low, high), step=(largest - least) / 500)
        self._mapper.update(low=low, high=high)
        self._draw_histogram(surface)
        self._draw_section()

    def _draw_histogram(self, surface: Surface) -> None:
        known = self.unit.of(surface.height[np.isfinite(surface.height)])
        counts, edges = np.histogram(known, bins=80)
        _span(self.histogram.x_range, edges, 0.02)
        self.histogram.y_range.end = 105 * counts.max() / max(1, known.size) or 1.0
        self._bars.data = {"left": edges[:-1], "right": edges[1:], "top": 100 * counts / max(1, known.size)}

    def _draw_section(self) -> None:
        places, heights = section(self.surface, [tuple(map(float, end)) for end in zip(self.ends.data["x"], self.ends.data["y"])],
                                  self._axes.unit)
        _span(self.section.x_range, places, 0.0)
        _span(self.section.y_range, self.unit.of(heights), 0.08)
        self._profile.data = {"s": places, "z": self.unit.of(heights)}


def _span(axis: Any, values: Array, margin: float) -> None:
    """Lets an axis show these values, with a margin as a share of their range."""
    least, largest, _, _ = limits(values)
    room = margin * (largest - least)
    axis.update(start=least - room, end=largest + room, reset_start=least - room, reset_end=largest + room)


def section(surface: Surface, ends: list[Any], unit: Unit) -> tuple[Array, Array]:
    """Places along the line between two ends [unit], and the heights of the pixels there [m]."""
    (x0, y0), (x1, y1) = ends
    (dx, dy), (ny, nx) = surface.pixel, surface.shape
    length = np.hypot(x1 - x0, y1 - y0)
    n = max(2, int(np.hypot((x1 - x0) / unit.of(dx), (y1 - y0) / unit.of(dy))))
    share = (np.arange(n) + 0.5) / n
    columns = np.floor((x0 + share * (x1 - x0)) / unit.of(dx)).astype(int)
    rows = np.floor((y0 + share * (y1 - y0)) / unit.of(dy)).astype(int)
    inside = (columns >= 0) & (columns < nx) & (rows >= 0) & (rows < ny)
    heights = np.where(inside, surface.height[np.clip(rows, 0, ny - 1), np.clip(columns, 0, nx - 1)], np.nan)
    return share * length, heights


KINDS = ("contact and oil", "pressure", "gap", "oil film")
_LEGEND = "".join(f"<span class='key' style='background:{colour}'></span>{text}" for colour, text in
                  ((DRY, "dry contact"), (WET, "wet contact"), (LIQUID, "oil"), (SOLID, "neither")))


class Results:
    """One map of what was computed: contact and oil, pressure, gap or oil film."""

    def __init__(self, axes: Axes, file: str) -> None:
        self._axes = axes
        self._mapper = LinearColorMapper(palette=[SOLID, LIQUID, DRY, WET], low=-0.5, high=3.5, nan_color=HOLE)
        self.plot = axes.figure(f"{file}_result", name="result", output_backend="canvas")
        self._image = Image(self.plot, axes, self._mapper)
        self._bar = colour_bar(self.plot, self._mapper)
        self.legend = Div(text=_LEGEND, stylesheets=[STYLE], name="legend")
        self.kind = KINDS[0]

    def show(self, answer: Answer) -> None:
        """Shows the map of the answer, or nothing where it has none."""
        surface, maps = answer.pressed, {KINDS[0]: _states, KINDS[1]: _pressure, KINDS[2]: _gap, KINDS[3]: _film}
        found = None if surface is None else maps[self.kind](answer)
        whole = answer.contact.surface if answer.contact is not None else surface
        self.plot.visible = found is not None
        if found is None or whole is None:
            return
        width, height = frame_of(whole.lengths)
        self.plot.update(frame_width=width, frame_height=height)
        values, title, palette, low, high = found
        is_legend = not title
        self._mapper.update(palette=palette, low=low, high=high)
        self.plot.title.text = title or KINDS[0]
        self._bar.visible = not is_legend
        self.legend.visible = is_legend
        self._image.show(values, whole)


def _states(answer: Answer) -> Any:
    """0 neither, 1 oil, 2 dry contact, 3 wet contact."""
    if answer.contact is None:
        return None
    states = np.where(answer.contact.pressure > 0, 2.0, 0.0)
    if answer.film is not None:
        states += answer.film.thickness > 0
    return states, "", [SOLID, LIQUID, DRY, WET], -0.5, 3.5


def _scaled(values: Array, name: str, palette: Any, unit: Unit) -> Any:
    least, largest, _, high = limits(values)
    top = high if high > 0 else largest
    return unit.of(values), f"{name} [{unit.name}]", palette, unit.of(min(0.0, least)), unit.of(top)


def _pressure(answer: Answer) -> Any:
    if answer.contact is None:
        return None
    pressure = answer.contact.pressure
    unit = Unit("MPa", 1e-6) if pressure.max() > 1e5 else Unit("kPa", 1e-3)
    return unit.of(pressure), f"contact pressure p [{unit.name}]", Greys256[::-1], 0.0, unit.of(float(pressure.max())) or 1.0


def _gap(answer: Answer) -> Any:
    contact = answer.contact
    return None if contact is None else _scaled(contact.gap, "gap g", Cividis256, unit_for(float(contact.gap.max())))


def _film(answer: Answer) -> Any:
    film = answer.film
    return None if film is None else _scaled(film.thickness, "oil film h", Cividis256, unit_for(float(film.thickness.max())))
