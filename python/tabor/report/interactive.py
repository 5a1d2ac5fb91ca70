"""The interactive parts of a page: Bokeh figures of curves and maps in one document, and what the scripts need."""

import importlib.util
import json
from pathlib import Path

JS_FILES = ("bokeh.min.js",)
MAP_SIDE = 370  # pixels of a map's longer side on the screen
TALLEST = 620
NOT_ON_PAPER = "@media print { :host { display: none !important; } }"  # the page's own styles do not reach into a figure


def is_asked_for(options):
    """True for a page that is to be interactive, if this Python can make it so."""
    return options.html and not options.static and is_possible()


def load():
    """Imports what takes long and has to be imported for a page."""
    from bokeh import document, models, plotting  # noqa: F401


def is_possible():
    """Whether this Python has Bokeh, and a Pillow that writes WebP."""
    if any(importlib.util.find_spec(name) is None for name in ("bokeh", "PIL")):
        return False
    from PIL import features

    return features.check("webp")


class Document:
    """Collects Bokeh figures by the ids of the elements that show them."""

    def __init__(self):
        from bokeh.document import Document as BokehDocument

        self._document = BokehDocument()
        self._models, self._roots = [], {}

    def add(self, model, element):
        self._models.append(model)
        self._roots[model.id] = element

    def __bool__(self):
        return bool(self._roots)

    def texts(self):
        """{"library", "documents", "places"}: script and JSON, the same for the same figures."""
        with self._document.models.freeze():  # each root would have Bokeh follow the references of all before it
            for model in self._models:
                self._document.add_root(model)
        self._models = []
        items = [{"docid": "page", "roots": self._roots, "root_ids": list(self._roots)}]
        return {
            "library": _library(),
            "documents": script_json({"page": self._document.to_json(deferred=False)}),
            "places": script_json(items),
        }


def script_json(value):
    """JSON that may stand in a script element."""
    return json.dumps(value, separators=(",", ":"), ensure_ascii=False).replace("<", "\\u003c")


def _library():
    import bokeh

    folder = Path(bokeh.__file__).resolve().parent / "server/static/js"
    text = "\n".join((folder / name).read_text(encoding="utf-8") for name in JS_FILES)
    return text.replace("</script", "<\\/script")


def map_figures(maps, data):
    """{panel: Bokeh figure} of the maps and the section of viewer.encoded's data, zoomed and moved together."""
    return _MapFigures(maps, data).run()


class _MapFigures:
    def __init__(self, maps, data):
        from tabor.report import units

        self.maps, self.data, self.name = maps, data, data["name"]
        (nx, ny), (px, py) = data["size"], data["pixel"]
        self.factor, self.unit = units.length_scale(max(nx * px, ny * py))
        data["length"] = [self.factor, self.unit]
        self.sides = nx * px * self.factor, ny * py * self.factor

    def run(self):
        from bokeh.models import ColumnDataSource, Range1d, Span

        self.x_range = Range1d(0, self.sides[0], name=f"{self.name}_x")
        self.y_range = Range1d(self.sides[1], 0, name=f"{self.name}_y")
        self.cross = [Span(dimension=side, line_color="#444444", line_width=1) for side in ("width", "height")]
        self.line = ColumnDataSource({"x": [0, 1], "y": [0, 1]}, name=f"{self.name}_line")
        figures = {panel: self._map(panel) for panel in self.panels()}
        return {**figures, "section": self._section()}

    def panels(self):
        """Names of the maps there are."""
        found = ["height"]
        found += ["state"] if self.data["contacts"] else []
        found += ["pressure"] if any("pressure" in contact for contact in self.data["contacts"]) else []
        found += ["gap"] if any(contact and "gap" in contact for contact in self.data["contacts"]) else []
        return found + (["film"] if self.data["films"] else [])

    def _map(self, panel):
        from bokeh.events import MouseMove
        from bokeh.models import BoxZoomTool, ColumnDataSource, CrosshairTool, CustomJS, PanTool, ResetTool, WheelZoomTool
        from bokeh.plotting import figure

        width, height = self._frame()
        wheel = WheelZoomTool(modifiers={"ctrl": True})
        plot = figure(
            name=f"{self.name}_{panel}_plot",
            frame_width=width,
            frame_height=height,
            x_range=self.x_range,
            y_range=self.y_range,
            tools=[PanTool(), BoxZoomTool(match_aspect=True), wheel, ResetTool(), CrosshairTool(overlay=self.cross)],
            active_scroll=wheel,
            background_fill_color="#bfbfbf",
            toolbar_location="above",
        )
        for layer in layers(panel, self.data):
            source = ColumnDataSource({"url": [""], "w": [self.sides[0]], "h": [self.sides[1]]}, name=f"{self.name}_{layer}")
            plot.image_url("url", x=0, y=0, w="w", h="h", anchor="top_left", source=source)
        plot.line("x", "y", source=self.line, line_color="white", line_width=4, line_alpha=0.8)
        plot.line("x", "y", source=self.line, line_color="#c1121f", line_width=2)
        plot.scatter("x", "y", source=self.line, size=12, fill_color="white", line_color="#c1121f", line_width=2)
        _dress(plot, f"x ({self.unit})", f"y ({self.unit})")
        plot.grid.visible = False
        told = CustomJS(args={"plot": plot}, code=f"tabor.moved({json.dumps(self.name)}, cb_obj, plot.inner_width)")
        plot.js_on_event(MouseMove, told)
        return plot

    def _frame(self):
        """Pixels of a map on the screen, in the shape of the scan."""
        width, height = self.sides
        shape = height / width
        return (MAP_SIDE, round(MAP_SIDE * shape)) if MAP_SIDE * shape <= TALLEST else (round(TALLEST / shape), TALLEST)

    def _section(self):
        from bokeh.models import ColumnDataSource, DataRange1d
        from bokeh.plotting import figure

        from tabor.report import style

        empty = {key: [0, 1] for key in ("s", "bottom", "solid", "level", "counter", "flattened")}
        source = ColumnDataSource(empty, name=f"{self.name}_section")
        plot = figure(
            name=f"{self.name}_section_plot",
            height=300,
            width=940,
            x_range=DataRange1d(range_padding=0),
            toolbar_location="above",
            tools="pan,box_zoom,wheel_zoom,reset,save",
            active_scroll=None,
        )
        plot.toolbar.stylesheets = [NOT_ON_PAPER]
        plot.varea("s", "bottom", "solid", source=source, fill_color=style.SOLID)
        plot.varea("s", "solid", "level", source=source, fill_color=style.LIQUID)
        plot.varea("s", "flattened", "solid", source=source, fill_color=style.FLATTENED)
        plot.line("s", "solid", source=source, line_color="#4d4d4d")
        plot.line("s", "counter", source=source, line_color=style.WARNING, line_width=1.6)
        _dress(plot, f"along the line ({self.unit})", "z")
        return plot


def layers(panel, data):
    """Names of the pictures of a panel, the lowest first: one, and of a contact that has a picture of every pixel two."""
    return ("state_wet", "state") if panel == "state" and data["step"] > 1 else (panel,)


def _dress(plot, x_label, y_label):
    plot.toolbar.logo = None
    plot.outline_line_color = None
    plot.min_border = 6
    for axis, label in ((plot.xaxis, x_label), (plot.yaxis, y_label)):
        axis.axis_label = label
        axis.axis_label_text_font_style = "normal"
        axis.axis_label_text_font_size = "14px"
        axis.major_label_text_font_size = "12px"
        axis.minor_tick_line_color = None
