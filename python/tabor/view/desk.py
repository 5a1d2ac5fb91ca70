"""The workbench of one scan: its state, what is computed of it, and the parts of the page that show both."""

from __future__ import annotations

import html
import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from typing import Any

from bokeh.models import Column, Row
from bokeh.models.widgets import Button, Div, RadioButtonGroup

from .._surface import Surface
from . import numbers
from .answers import Answer, Bench
from .boxes import Boxes
from .chain import Chain, crop_step
from .controls import Controls, pressure_range
from .curve import N_POINTS, Curve, family
from .looks import STYLE, failure_html
from .maps import Axes, Heights, Results
from .opening import Opened
from .previews import coarser
from .relief import Relief
from .spectrum import SpectrumFigure
from .state import History, State
from .worker import Watching, Worker
from .written import Folder, link_html, stem_of, write_answer

SPECTRUM, RELIEF = "Spectrum", "3-D"
ASIDE = ("Histogram and section", SPECTRUM, RELIEF)  #: what stands below the map of heights
REMARKS = ("contact", "oil", "friction")
Later = Callable[[Callable[[], Any]], Any]  #: calls a function on the thread of the page


class Desk:
    """One scan. ``later`` brings what the worker found to the thread of the page; ``changed`` is told of another treated
    surface."""

    def __init__(self, opened: Opened, axes: Axes, tools: Mapping[str, str], later: Later, changed: Callable[[], None], folder: Folder,
                 address: str) -> None:
        scan, state = opened.scan, opened.state
        if scan is None:
            raise ValueError(opened.asks)
        self.name = opened.name
        self._later, self._changed, self._folder, self._address = later, changed, folder, address
        self._bench, self._history = Bench(scan), History(state)
        self._axes = axes
        self.answer = Answer(state, scan)
        self._drawn: Surface | None = None
        self.worker = Worker(lambda stage, share: self._on_page(partial(self._show_progress, stage, share)))
        self._make_parts(scan, state, tools)
        self.view = self._layout(opened.note)

    def _make_parts(self, scan: Surface, state: State, tools: Mapping[str, str]) -> None:
        file = stem_of(self.name)
        self._heights, self._results = Heights(scan, self._axes, file), Results(self._axes, file)
        self._spectrum, self._relief = SpectrumFigure(file), Relief(self._folder, self._address)
        self._chain = Chain(self.take, self._undo, self._redo, self._crop)
        self._controls = Controls(state, tools, self.take, self._choose_map)
        self._curve, self._boxes = Curve(file), Boxes(self._write)
        self._curve.draw.on_click(self._draw_curve)
        self._stop = Button(label="Stop", width=60, name="stop", disabled=True)
        self._stop.on_click(self._stopped)
        self._status = Div(stylesheets=[STYLE], name="status", width=290)
        self._which = Div(stylesheets=[STYLE], name="which", width=250)
        self._scan_numbers = Div(stylesheets=[STYLE], name="scan_numbers", width=565)
        self._numbers = Div(stylesheets=[STYLE], name="numbers", width=190)
        self._remarks = {name: Div(stylesheets=[STYLE], name=f"{name}_remarks", width=660, visible=False) for name in REMARKS}

    def _layout(self, note: str) -> Any:
        heading = partial(Div, stylesheets=[STYLE])
        sections = Row(children=[self._heights.histogram, self._heights.section])
        self._views: tuple[Any, ...] = (sections, self._spectrum.view, self._relief.view)
        self._aside = RadioButtonGroup(labels=[*ASIDE], active=0, name="aside")
        self._aside.on_change("active", lambda _a, _o, _n: self._look_aside())
        self._look_aside()
        left = Column(children=[*([heading(text=f"<p class='note'>{html.escape(note)}</p>", name="note")] if note else []),
                                self._heights.plot, self._heights.note, self._heights.colours, self._aside, *self._views,
                                heading(text="<h2>Treatment, in this order</h2>"), self._chain.view, self._scan_numbers], width=575)
        right = Column(children=[self._controls.contact, self._controls.oil, Row(children=[self._which, self._stop, self._status]),
                                 self._controls.maps, Row(children=[Column(children=[self._results.plot, self._results.legend]), self._numbers]),
                                 *self._remarks.values(), self._curve.view], width=670)
        return Column(children=[Row(children=[left, right]), self._boxes.view])

    @property
    def state(self) -> State:
        """What is shown."""
        return self._history.now

    @property
    def surface(self) -> Surface | None:
        """As it is treated; None where the treatment fails."""
        return self.answer.surface

    @property
    def _looks_at(self) -> str:
        """What stands beside the map of heights."""
        return ASIDE[self._aside.active or 0]

    def take(self, state: State) -> None:
        """Shows a state, and computes it; another filter is shown with its spectrum."""
        if state.filters and state.filters != self.state.filters:
            self._aside.active = ASIDE.index(SPECTRUM)
        self._history.take(state)
        self.refresh()

    def refresh(self) -> None:
        """Shows the state as it is, and computes what is not at hand."""
        state = self.state
        self._chain.show(state, self._history.can_undo, self._history.can_redo)
        self._controls.show(state)
        self._boxes.show(state)
        self.worker.ask(partial(self._compute, state))

    def _undo(self) -> None:
        self._history.undo()
        self.refresh()

    def _redo(self) -> None:
        self._history.redo()
        self.refresh()

    def _crop(self) -> str:
        """The step that keeps what the maps show."""
        factor = self._axes.unit.factor
        ends = [(float(one.start) / factor, float(one.end) / factor) for one in self._axes.ranges]
        return crop_step(ends[0], ends[1], self._heights.surface.lengths)

    def _choose_map(self, kind: str) -> None:
        self._results.kind = kind
        self._results.show(self.answer)

    def _stopped(self) -> None:
        if self.worker.stop():
            self._status.text = "<span class='note'>Stopped; numbers are those of what was reached.</span>"

    # On the worker's thread.

    def _compute(self, state: State, told: Watching) -> None:
        """The surface, then a preview if the rest takes long, then the full answer."""
        told("treatment", math.nan, math.nan)
        answer = self._bench.treated_answer(state, told)
        if answer.surface is None:
            self._found(answer)
            return
        seconds = self._bench.expected(state, answer.surface)
        coarse = coarser(answer.surface, seconds)
        if coarse is not None:
            self._found(self._bench.solved(answer, coarse, told))
        full = self._bench.solved(answer, answer.surface, told)
        self._found(replace(full, parameters=None))
        told("parameters", math.nan, math.nan)
        measured = self._bench.described(state, told)
        measured = replace(full, parameters=measured.parameters, tilt=measured.tilt, failures={**full.failures, **measured.failures})
        if self._looks_at == SPECTRUM:
            told("spectrum", math.nan, math.nan)
            measured = self._bench.analysed(measured, told)
        self._found(measured)

    def _sweep(self, state: State, told: Watching) -> None:
        """Answers at pressures over the range of the slider, then at the one that is shown."""
        low, high = pressure_range(state)
        for place in range(N_POINTS):
            told(f"pressure {place + 1} of {N_POINTS}", place / N_POINTS, math.nan)
            power = low + 1 + (high - low - 1) * place / (N_POINTS - 1)
            one = replace(state, pressure=f"{10.0**power:.3g} MPa")
            answer = self._bench.treated_answer(one, told)
            if answer.surface is not None:
                answer = self._bench.solved(answer, answer.surface, told)
                self._on_page(partial(self._add_point, answer))
        self._compute(state, told)

    def _found(self, answer: Answer) -> None:
        self._on_page(partial(self._show, answer))

    def _on_page(self, function: Callable[[], None]) -> None:
        self._later(function)

    # On the page's thread.

    def _look_aside(self) -> None:
        """Shows what stands below the map; a spectrum is computed first."""
        for title, view in zip(ASIDE, self._views):
            view.visible = title == self._looks_at
        if self._looks_at == SPECTRUM:
            self.worker.ask(partial(self._compute, self.state))
        elif self._looks_at == RELIEF and self.surface is not None:
            self._relief.show(self.surface)

    def _draw_curve(self) -> None:
        self.worker.ask(partial(self._sweep, self.state))

    def _add_point(self, answer: Answer) -> None:
        if family(answer.state) == family(self.state):
            self._curve.show(answer)

    def _show(self, answer: Answer) -> None:
        if answer.state != self.state:
            return  # a move came between
        if answer.parameters is None and answer.surface is self.answer.surface:  # of the same surface
            answer = replace(answer, parameters=self.answer.parameters, tilt=self.answer.tilt)
        is_another = answer.surface is not self.answer.surface
        self.answer = answer
        if answer.surface is not None and answer.surface is not self._drawn:
            self._drawn = answer.surface
            self._heights.show(answer.surface)
            if self._looks_at == RELIEF:
                self._relief.show(answer.surface)
        if is_another:
            self._changed()
        if answer.spectra is not None or "spectrum" in answer.failures:
            self._spectrum.show(answer)
        self._results.show(answer)
        self._curve.show(answer)
        self._which.text = numbers.preview_html(answer)
        self._scan_numbers.text = numbers.scan_html(answer)
        self._numbers.text = numbers.results_html(answer)
        for name, remarks in self._remarks.items():
            text = numbers.remarks_html(answer, name)
            remarks.update(text=text, visible=bool(text))

    def _show_progress(self, stage: str, share: float) -> None:
        self._stop.disabled = not stage
        done = f" {100 * share:.0f} %" if math.isfinite(share) else ""
        if stage:
            self._status.text = f"<span class='note' data-name='busy'>Computing: {stage}{done}</span>"
        elif "Stopped" not in self._status.text:
            self._status.text = "<span class='note' data-name='idle'></span>"

    def _write(self, kind: str, extension: str) -> None:
        try:
            name = write_answer(self._folder, kind, self.answer, extension)
        except (ValueError, OSError, ImportError, RuntimeError) as error:
            self._boxes.links.text = failure_html(str(error))
            return
        self._boxes.links.text += " " + link_html(f"{self._address}/file/{name}", name)
