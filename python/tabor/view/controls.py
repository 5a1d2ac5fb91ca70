"""Material, tool, pressure and oil: what one moves to see contact and friction."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from bokeh.models import Column, CustomJSTickFormatter, Row
from bokeh.models.widgets import Checkbox, Div, RadioButtonGroup, Select, Slider, TextInput

from .._contact import materials
from .._values import si
from .looks import STYLE, failure_html
from .maps import KINDS
from .settings import PARTS
from .state import State

TOOLS = {"flat": "", "ground tool, Sa 0.05 µm": "ground:Sa=0.05um", "ground tool, Sa 0.1 µm": "ground:Sa=0.1um",
         "ground tool, Sa 0.2 µm": "ground:Sa=0.2um", "ground tool, Sa 0.4 µm": "ground:Sa=0.4um"}
OWN_SOLID = "as given"  #: a solid that is not of the library
DENSITIES = (-2.0, 2.0)  #: powers of ten of the slider [g/m^2]
DRY = "0 g/m^2"
Change = Callable[[State], None]


def pressure_range(state: State) -> tuple[float, float]:
    """Powers of ten between which the pressure slider runs [MPa]: up to a little below the pressure at which the whole
    surface yields or, of elastic solids, to a twentieth of the effective modulus."""
    solid = state.solid
    top = 0.9 * solid.saturation_pressure if solid.saturation_pressure else 0.05 * solid.effective_modulus
    high = math.floor(100 * math.log10(top / 1e6)) / 100
    return high - 3, high


def _label(power: float, unit: str) -> str:
    return f"{10.0**power:.3g} {unit}"


def _formatter(unit: str) -> CustomJSTickFormatter:
    """Shows the number of a power of ten with its unit."""
    return CustomJSTickFormatter(code=f"return String(Number((10 ** tick).toPrecision(3))) + ' {unit.replace('^2', '²')}'")


class Quantity:
    """A slider with logarithmic steps, and a field for exact values beside it."""

    def __init__(self, name: str, title: str, unit: str, dimension: str, ends: tuple[float, float], take: Callable[[str], None]) -> None:
        self._title, self._unit, self._dimension, self._take, self._is_showing = title, unit, dimension, take, False
        self.slider = Slider(start=ends[0], end=ends[1], value=ends[0], step=0.01, title=title, format=_formatter(unit), width=430,
                             name=name)
        self.field = TextInput(width=110, name=f"{name}_field", align="end")
        self.failure = Div(stylesheets=[STYLE], visible=False)
        self.slider.on_change("value", lambda _a, _o, power: self._given(_label(power, unit)))
        self.field.on_change("value", lambda _a, _o, text: self._given(text))
        self.view = Column(children=[Row(children=[self.slider, self.field]), self.failure])

    def _given(self, text: str) -> None:
        if self._is_showing:
            return
        try:
            if si(text, self._dimension, self._title) < 0:
                raise ValueError(f"{self._title}: got {text}; expected no negative value")
        except ValueError as error:
            self.failure.update(text=failure_html(str(error)), visible=True)
            return
        self.failure.visible = False
        self._take(text)

    def show(self, text: str, ends: tuple[float, float] | None = None) -> None:
        """Shows a value without telling of it."""
        self._is_showing = True
        try:
            start, end = ends or (self.slider.start, self.slider.end)
            plain = si(text, self._dimension, "") / si(f"1 {self._unit}", self._dimension, "")
            power = math.log10(plain) if plain > 0 else start
            if (start, end) != (self.slider.start, self.slider.end):
                self.slider.update(start=start, end=end)
            if _label(float(self.slider.value), self._unit) != text:  # else it is the slider that moves: it may be further already
                self.slider.value = min(max(power, start), end)
            self.field.value = text
        finally:
            self._is_showing = False


class Controls:
    """Shows what a state says of the contact and the oil, and tells of the state that a move gives."""

    def __init__(self, state: State, tools: Mapping[str, str], change: Change, choose_map: Callable[[str], None]) -> None:
        self._state, self._change, self._is_showing = state, change, False
        names: list[Any] = [one.name for one in materials()] + ([] if state.material else [OWN_SOLID])
        self._tools = {**TOOLS, **tools}
        if state.tool not in self._tools.values():
            self._tools[state.tool] = state.tool
        self._material = Select(options=names, title="Material", width=160, name="material")
        self._shear = TextInput(title="Shear strength", placeholder="of the material", width=130, name="shear")
        tools_there: list[Any] = [*self._tools]
        self._tool = Select(options=tools_there, title="Pressed by", width=190, name="tool")
        self._oil = Checkbox(label="Oil", width=60, name="oil")
        self._trapped = Checkbox(label="Oil in closed pockets carries load", width=260, name="trapped")
        self._pressure = Quantity("pressure", "Pressure", "MPa", "pressure", pressure_range(state), self._press)
        self._density = Quantity("density", "Oil", "g/m^2", "areal_density", DENSITIES, self._wet)
        self._wetness = state.density if state.density != DRY else "0.9 g/m^2"  # that comes back with the switch
        self._maps = RadioButtonGroup(labels=list(KINDS), active=0, name="maps")
        self._material.on_change("value", lambda _a, _o, name: self._of_material(name))
        self._shear.on_change("value", lambda _a, _o, text: self._rubbed(text.strip()))
        self._tool.on_change("value", lambda _a, _o, name: self._tell(replace(self._state, tool=self._tools[name])))
        self._oil.on_change("active", lambda _a, _o, is_on: self._tell(replace(self._state, density=self._wetness if is_on else DRY)))
        self._trapped.on_change("active", lambda _a, _o, is_on: self._tell(replace(self._state, trapped=is_on)))
        self._maps.on_change("active", lambda _a, _o, place: choose_map(KINDS[place]))
        self._failure = Div(stylesheets=[STYLE], visible=False)
        self.contact = Column(children=[Row(children=[self._material, self._tool, self._shear]), self._failure, self._pressure.view])
        self.oil = Column(children=[self._density.view, Row(children=[self._oil, self._trapped])])
        self.maps: Any = self._maps

    def _tell(self, state: State) -> None:
        if not self._is_showing:
            self._change(state)

    def _press(self, text: str) -> None:
        self._tell(replace(self._state, pressure=text))

    def _wet(self, text: str) -> None:
        self._tell(replace(self._state, density=text))

    def _rubbed(self, text: str) -> None:
        try:
            if text and not self._is_showing:
                si(text, "pressure", "Shear strength")
        except ValueError as error:
            self._failure.update(text=failure_html(str(error)), visible=True)
            return
        self._failure.visible = False
        self._tell(replace(self._state, shear_strength=text))

    def _of_material(self, name: str) -> None:
        """Another material; a pressure beyond its range moves into it."""
        if self._is_showing or name == OWN_SOLID:
            return
        solid = {one.name for one in PARTS["solid"]}  # values of its own belong to the solid before
        state = replace(self._state, material=name, settings=tuple(one for one in self._state.settings if one[0] not in solid))
        low, high = pressure_range(state)
        power = math.log10(si(state.pressure, "pressure", "pressure") / 1e6)
        if not low <= power <= high:
            state = replace(state, pressure=_label((low + 2 * high) / 3, "MPa"))
        self._tell(state)

    def show(self, state: State) -> None:
        """Shows what the state says, without telling of it."""
        self._state, self._is_showing = state, True
        try:
            is_wet = si(state.density, "areal_density", "density") > 0
            self._wetness = state.density if is_wet else self._wetness
            self._material.value, self._shear.value = state.material or OWN_SOLID, state.shear_strength
            known = {text: name for name, text in self._tools.items()}
            self._tool.value = known.get(state.tool, "flat")
            self._oil.active, self._trapped.active = is_wet, state.trapped
            self._pressure.show(state.pressure, pressure_range(state))
            self._density.show(self._wetness)
            self._density.slider.disabled = self._density.field.disabled = not is_wet
        finally:
            self._is_showing = False
