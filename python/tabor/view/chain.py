"""The treatment chain as a list: one adds steps, changes, moves, switches off and removes them, and undoes that."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

from bokeh.models import Column, Row
from bokeh.models.widgets import Button, Checkbox, Div, Select, TextInput

from .looks import STYLE
from .recipes import RECIPES
from .state import KNOWN_STEPS, State, Step

#: Steps as they are offered, with a first argument to change.
OFFERED = ("level=plane", "level=poly2", "level=rows", "despike=auto", "fill=harmonic", "fill=nearest", "lowpass=gauss:8um",
           "lowpass=hann:512/L", "highpass=gauss:250um", "edges=cut", "edges=tile", "edges=end", "trim=5um", "flip=x")
_ADD, _RECIPE = "Add a step ...", "Recipe ..."
Change = Callable[[State], None]


def crop_step(x: tuple[float, float], y: tuple[float, float], size: tuple[float, float]) -> str:
    """The step that keeps a rectangle [m], as far as the surface goes."""
    (x0, x1), (y0, y1) = ((max(0.0, min(ends)), min(side, max(ends))) for ends, side in zip((x, y), size))
    return "crop=" + ",".join(f"{1e6 * length:.6g}um" for length in (x0, y0, x1 - x0, y1 - y0))


class Chain:
    """Shows the chain of a state, and tells of the state that a change of it gives."""

    def __init__(self, change: Change, undo: Callable[[], None], redo: Callable[[], None], crop: Callable[[], str]) -> None:
        self._change, self._state = change, State("")
        self._rows = Column(children=[], name="chain")
        steps: list[Any] = [_ADD, *OFFERED]
        recipes: list[Any] = [_RECIPE, *(one.name for one in RECIPES)]
        self._add = Select(options=steps, value=_ADD, width=160, name="add")
        self._recipe = Select(options=recipes, value=_RECIPE, width=100, name="recipe")
        self._undo = Button(label="Undo", width=60, name="undo")
        self._redo = Button(label="Redo", width=60, name="redo")
        self._said = Div(stylesheets=[STYLE], width=565)
        cropping = Button(label="Crop to view", width=100, name="crop")
        self._add.on_change("value", lambda _a, _o, text: self._chosen(self._add, _ADD, text, self._state.adding))
        self._recipe.on_change("value", lambda _a, _o, name: self._follow(name))
        self._undo.on_click(lambda: undo())
        self._redo.on_click(lambda: redo())
        cropping.on_click(lambda: self._change(self._state.adding(crop())))
        self.view = Column(children=[self._rows, Row(children=[self._add, self._recipe, cropping, self._undo, self._redo]), self._said])

    def _chosen(self, select: Select, nothing: str, value: str, make: Callable[[str], State]) -> None:
        if value != nothing:
            select.value = nothing
            self._change(make(value))

    def _follow(self, name: str) -> None:
        for one in RECIPES:
            if one.name == name:
                self._said.text = f"<p class='note'>Recipe {one.name}, {one.purpose}.</p>"
        self._chosen(self._recipe, _RECIPE, name, self._state.following)

    def show(self, state: State, can_undo: bool, can_redo: bool) -> None:
        """Shows the chain of a state."""
        is_same = state.steps == self._state.steps
        self._state = state
        self._undo.disabled, self._redo.disabled = not can_undo, not can_redo
        if not is_same or not self._rows.children:
            empty = Div(text="<p class='note'>No treatment yet: heights as they are in the file.</p>", stylesheets=[STYLE])
            self._rows.children = [self._row(place, step) for place, step in enumerate(state.steps)] or [empty]

    def _row(self, place: int, step: Step) -> Any:
        placeholder, help_text = KNOWN_STEPS.get(step.name, ("", ""))
        on = Checkbox(active=step.is_on, label=step.name, width=90, align="center", name=f"on_{place}")
        on.on_change("active", lambda _a, _o, is_on: self._change(self._state.switching(place, is_on)))
        argument: Any = Div(text="", width=220)
        if placeholder:
            argument = TextInput(value=step.argument, width=220, placeholder=placeholder, name=f"argument_{place}")
            argument.on_change("value", lambda _a, _o, text: self._rewrite(place, step, text))
        buttons = [self._button("▲", f"up_{place}", lambda: self._state.moving(place, -1), place == 0),
                   self._button("▼", f"down_{place}", lambda: self._state.moving(place, 1), place + 1 == len(self._state.steps)),
                   self._button("✕", f"remove_{place}", partial(self._without, place), False)]
        return Row(children=[on, argument, *buttons], name=f"step_{place}", tags=[help_text])

    def _without(self, place: int) -> State:
        return self._state.without(place)

    def _rewrite(self, place: int, step: Step, text: str) -> None:
        words = f"{step.name}={text.strip()}" if text.strip() else step.name
        self._change(self._state.with_step(place, replace(step, text=words)))

    def _button(self, label: str, name: str, make: Callable[[], State], disabled: bool) -> Button:
        button = Button(label=label, width=34, name=name, disabled=disabled)
        button.on_click(lambda: self._change(make()))
        return button
