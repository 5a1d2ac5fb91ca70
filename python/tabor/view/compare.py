"""Several scans side by side on linked axes, and the difference of two of them."""

from __future__ import annotations

import html
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, Protocol

import numpy as np
from bokeh.models import Column, CustomJS, LinearColorMapper, Row
from bokeh.models.widgets import Button, Checkbox, Div, RangeSlider, Select
from bokeh.palettes import Blues256, Reds256, Viridis256, diverging_palette

from .._combine import Combination, combine
from .._surface import Surface
from .boxes import ScanWriter, copied_texts
from .looks import HOLE, STYLE, Unit, failure_html, limits, si_text, table_html, unit_for
from .maps import Axes, Image, colour_bar
from .state import State
from .texts import Combined, combined_command, combined_python
from .worker import Watching, Worker
from .written import Folder, link_html, stem_of

MODES = {"difference with volumes": "wear", "difference": "difference"}
MATCHES = {"tilt and offset removed": "plane", "offset removed": "offset", "as measured": "none"}
_ACROSS = 2  #: maps in a row
_CHANGED = diverging_palette(Reds256, Blues256, n=256)
Later = Callable[[Callable[[], Any]], Any]


class Treated(Protocol):
    """A workbench, of which the comparison takes the treated surface."""

    name: str

    @property
    def state(self) -> State:
        """What it shows."""

    @property
    def surface(self) -> Surface | None:
        """Its treated surface; None where the treatment fails."""


@dataclass(frozen=True)
class Beside:
    """One of the scans and its map."""

    of: Treated
    plot: Any
    image: Image


class Comparison:
    """Maps of all scans with one range of colours, and the difference of two."""

    def __init__(self, desks: Sequence[Treated], later: Later, folder: Folder, address: str) -> None:
        self._desks, self._later, self._folder, self._address = tuple(desks), later, folder, address
        self._found: Combination | None = None
        self._combined: Combined | None = None
        surfaces = [one.surface for one in desks if one.surface is not None]
        self._axes = Axes((max(one.lengths[0] for one in surfaces), max(one.lengths[1] for one in surfaces)))
        heights = [limits(one.height) for one in surfaces]
        self.unit: Unit = unit_for(max(largest - least for least, largest, _, _ in heights))
        self.worker = Worker(lambda stage, share: self._later(partial(self._show_progress, stage, share)))
        self._make_maps()
        self._make_controls()
        self.view = self._layout()

    def _make_maps(self) -> None:
        self._mapper = LinearColorMapper(palette=Viridis256, nan_color=HOLE, low=-1, high=1)
        self._places = []
        for place, desk in enumerate(self._desks):
            plot = self._axes.figure(f"{stem_of(desk.name)}_heights", name=f"beside_{place}", output_backend="canvas")
            plot.title.text = desk.name
            self._places.append(Beside(desk, plot, Image(plot, self._axes, self._mapper)))
            colour_bar(plot, self._mapper)
        self._changes = LinearColorMapper(palette=_CHANGED, nan_color=HOLE, low=-1, high=1)
        self.plot = self._axes.figure("difference", name="difference", output_backend="canvas")
        self._image = Image(self.plot, self._axes, self._changes)
        colour_bar(self.plot, self._changes)
        self._colours = RangeSlider(start=-1, end=1, value=(-1, 1), step=0.001, width=460, format="0.000",
                                    title=f"Colour range, height over its mean [{self.unit.name}]", name="beside_colours")
        self._colours.js_on_change("value", CustomJS(args={"mapper": self._mapper, "slider": self._colours},
                                                     code="mapper.low = slider.value[0]; mapper.high = slider.value[1]"))

    def _make_controls(self) -> None:
        names: list[Any] = [(str(place), one.name) for place, one in enumerate(self._desks)]
        modes: list[Any] = [*MODES]
        matches: list[Any] = [*MATCHES]
        self._first = Select(title="A", options=names, value="0", width=170, name="first")
        self._second = Select(title="B", options=names, value="1", width=170, name="second")
        self._mode = Select(title="A - B as", options=modes, value=modes[0], width=205, name="mode")
        self._match = Select(title="Mounting of B", options=matches, value=matches[0], width=235, name="match")
        self._search = Checkbox(label="search for the shift of B", active=True, name="search", width=180)
        for one in (self._first, self._second, self._mode, self._match):
            one.on_change("value", lambda _a, _o, _n: self.refresh())
        self._search.on_change("active", lambda _a, _o, _n: self.refresh())
        self._stop = Button(label="Stop", width=60, name="stop_difference", disabled=True)
        self._stop.on_click(self._stopped)
        self._status = Div(stylesheets=[STYLE], width=250, name="difference_status")
        self._numbers = Div(stylesheets=[STYLE], width=560, name="difference_numbers")
        self._links = Div(stylesheets=[STYLE], width=400, name="difference_links")
        self._writer = ScanWriter("Write: difference", "write_difference", self._write)
        tabs, self._texts = copied_texts({"Command line": "combine", "Python": "combine_python"})
        self._copied = tabs

    def _layout(self) -> Any:
        heading = partial(Div, stylesheets=[STYLE])
        plots = [one.plot for one in self._places]
        rows = [Row(children=plots[first:first + _ACROSS]) for first in range(0, len(plots), _ACROSS)]
        choice = Row(children=[self._first, self._second, self._mode, self._match])
        aside = Column(children=[Row(children=[self._search, self._stop, self._status]), self._numbers,
                                 Row(children=[self._writer.view, self._links])])
        return Column(children=[self._colours, *rows, heading(text="<h2>Difference of two, as <code>tabor combine</code></h2>"), choice,
                                Row(children=[self.plot, aside]), self._copied])

    def refresh(self) -> None:
        """Shows the scans as they are treated now, and computes the difference."""
        known = [(one, one.of.surface) for one in self._places]
        heights = {id(place): self.unit.of(surface.height - np.nanmean(surface.height)) for place, surface in known
                   if surface is not None and np.isfinite(surface.height).any()}
        for place, surface in known:
            if surface is not None and id(place) in heights:
                place.image.show(heights[id(place)], surface)
            else:
                place.image.clear()
        self._range(list(heights.values()))
        first, second = (self._desks[int(str(one.value))] for one in (self._first, self._second))
        self._combined = Combined(first.state, second.state, MODES[str(self._mode.value)], MATCHES[str(self._match.value)],
                                  bool(self._search.active))
        self._texts["Command line"].text = combined_command(self._combined)
        self._texts["Python"].text = combined_python(self._combined)
        self._links.text = ""
        if first.surface is None or second.surface is None:
            self._show(None, "A treatment fails: there is no difference")
        else:
            self.worker.ask(partial(self._compute, first.surface, second.surface, self._combined))

    def _range(self, heights: list[Any]) -> None:
        """One range of colours for all maps."""
        if not heights:
            return
        ends = [limits(one) for one in heights]
        low, high = min(one[2] for one in ends), max(one[3] for one in ends)
        least, largest = min(one[0] for one in ends), max(one[1] for one in ends)
        self._colours.update(start=least, end=largest, value=(low, high), step=(largest - least) / 500)
        self._mapper.update(low=low, high=high)

    def _compute(self, first: Surface, second: Surface, asked: Combined, told: Watching) -> None:
        told("combine", math.nan, math.nan)
        try:
            mode: Any = asked.mode
            match: Any = asked.match
            found = combine(first, second, mode, match=match, search=asked.search, progress=told)
        except ValueError as error:
            self._later(partial(self._show_if, asked, None, str(error)))
            return
        self._later(partial(self._show_if, asked, found, ""))

    def _show_if(self, asked: Combined, found: Combination | None, failure: str) -> None:
        if asked == self._combined:  # else a move came between
            self._show(found, failure)

    def _show(self, found: Combination | None, failure: str) -> None:
        self._found = found
        self.plot.visible = found is not None
        if found is None:
            self._numbers.text = failure_html(failure)
            return
        heights = found.surface.height
        _, _, low, high = limits(heights)
        most = max(abs(low), abs(high))
        unit = unit_for(most)
        self._changes.update(low=-unit.of(most), high=unit.of(most))
        self.plot.title.text = f"A - B [{unit.name}]"
        along_x, along_y = found.shift
        self._image.show(unit.of(heights), found.surface, (max(0.0, -along_x), max(0.0, -along_y)))
        self._numbers.text = difference_html(found)

    def _show_progress(self, stage: str, share: float) -> None:
        self._stop.disabled = not stage
        done = f" {100 * share:.0f} %" if math.isfinite(share) else ""
        self._status.text = f"<span class='note'>Computing: {stage}{done}</span>" if stage else "<span data-name='compared'></span>"

    def _stopped(self) -> None:
        self.worker.stop()

    def _write(self, extension: str) -> None:
        if self._found is None:
            self._links.text = failure_html("There is no difference to write")
            return
        try:
            name = self._folder.write(f"difference{extension}", self._found.surface.save)
        except (ValueError, OSError) as error:
            self._links.text = failure_html(str(error))
            return
        self._links.text = link_html(f"{self._address}/file/{name}", name)


def difference_html(found: Combination) -> str:
    """Numbers of a difference, with its warnings."""
    values = found.values
    rows = [(f"shift of B along {axis}", f"shift_{axis}_m", repr(values[f"shift_{axis}_m"]), si_text(values[f"shift_{axis}_m"], "m"))
            for axis in ("x", "y")]
    rows += [("correlation", "correlation", repr(values["correlation"]), f"{values['correlation'] or math.nan:.4f}"),
             ("overlap", "nx", repr(values["nx"]), f"{values['nx']} x {values['ny']} pixels")]
    rows += [(f"Sq of {name}", key, repr(values[key]), si_text(values[key], "m")) for name, key in
             (("A", "rms_height_first_m"), ("B", "rms_height_second_m"), ("A - B", "rms_height_m"))]
    for name, heading in (("worn", "worn, A above B"), ("piled_up", "piled up"), ("net", "net")):
        volume = getattr(found, name)
        if volume is not None:
            rows.append((heading, name, repr(volume.volume), volume._text()))
    return table_html(rows, 2) + "".join(f"<p class='doubt'>Warning: {html.escape(text)}</p>" for text in found.warnings)
