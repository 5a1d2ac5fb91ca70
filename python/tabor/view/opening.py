"""What a workbench begins with: a scan, a result file with its settings, or a file that first asks for its unit."""

from __future__ import annotations

import os
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from .._contact import Contact, Solid
from .._errors import InputError, InputIncomplete
from .._friction import Film, FluidFilm, Friction
from .._load import load
from .._read import read
from .._surface import Surface
from .._values import si
from .settings import Given, different
from .state import State

SI_UNITS = {"pressure": "Pa", "areal_density": "kg/m^2"}


@dataclass(frozen=True)
class Opened:
    """A scan with the state that its workbench begins with; without a scan where ``asks`` says what is missing."""

    scan: Surface | None
    state: State
    asks: str = ""
    note: str = ""  #: what was taken over from a result file

    @property
    def name(self) -> str:
        """Of the file, without folders."""
        source = "" if self.scan is None else self.scan.source
        return os.path.basename(self.state.scan or source) or "surface"


def opened(state: State) -> Opened:
    """The file of a state. Raises ValueError where it cannot be read, whatever is said about it."""
    reading: dict[str, Any] = {name: True if value == "True" else value for name, value in state.reading}
    if "," in reading.get("pixel", ""):
        reading["pixel"] = tuple(reading["pixel"].split(","))
    try:
        scan = read(state.scan, **reading)
    except InputIncomplete as error:
        return Opened(None, state, asks=str(error))
    return _with_results(Opened(scan, state)) if state.scan.lower().endswith((".h5", ".hdf5")) else Opened(scan, state)


def _with_results(found: Opened) -> Opened:
    """With the settings of the first state of a result file; a file of a surface alone stays as it is."""
    try:
        results = load(found.state.scan)
    except (InputError, ImportError, KeyError):
        return found
    first = results[0] if isinstance(results, list) else results
    if not isinstance(first, (Contact, Film, Friction)) or isinstance(first, FluidFilm):
        return found
    state = _state_of(first, found.state)
    more = f"the first of {len(results)} states" if isinstance(results, list) else "its state"
    return replace(found, state=state, note=f"A result file: the surface as it was treated, and the settings of {more}.")


def _state_of(result: Any, state: State) -> State:
    pressed = result if isinstance(result, Contact) else getattr(result, "contact", None)
    film = result if isinstance(result, Film) else getattr(result, "film", None)
    state = state if pressed is None else _pressed(state, pressed)
    state = state if film is None else _oiled(state, film)
    return _rubbed(state, result) if isinstance(result, Friction) else state


def _adding(state: State, settings: Given) -> State:
    return replace(state, settings=state.settings + settings)


def _pressed(state: State, pressed: Contact) -> State:
    material, own = _solid_of(pressed.solid)
    others = {name: value for name, value in pressed._options.items() if name not in ("tool", "load_path")}
    pressure = shortest(pressed.values["mean_pressure_Pa"], "MPa", "pressure")
    return _adding(replace(state, pressure=pressure, material=material, tool=str(pressed._options.get("tool") or "")),
                   own + different(others, "contact"))


def _solid_of(solid: Solid) -> tuple[str, Given]:
    """The name of the material, and what of the solid is not that of the library."""
    usual = {} if not solid.material else vars(Solid(solid.material))
    return solid.material, different({**vars(solid), "shear_strength": None}, "solid", {**usual, "shear_strength": None})


def _oiled(state: State, film: Film) -> State:
    return _adding(replace(state, density=shortest(film.lubricant_density, "g/m^2", "areal_density")), different(film._options, "film"))


def _rubbed(state: State, result: Friction) -> State:
    others = {**result._options, **(result._oil or {})}
    others.pop("trapped", None)
    strength = others.pop("shear_strength", None) or result.contact.solid.shear_strength
    is_own = strength is not None and (not state.material or strength != Solid(state.material).shear_strength)
    return _adding(replace(state, shear_strength=shortest(strength, "MPa", "pressure") if is_own and strength is not None else "", trapped=result._trapped is not None),
                   different(others, "friction"))


def shortest(value: float, unit: str, dimension: str) -> str:
    """The shortest text in a unit that is exactly this value [SI]."""
    plain = value / si(f"1 {unit}", dimension, "")
    texts = (f"{np.format_float_positional(plain, digits, unique=False, fractional=False, trim='-')} {unit}" for digits in range(1, 18))
    exact = (text for text in texts if si(text, dimension, "") == value)
    return next(exact, f"{value!r} {SI_UNITS[dimension]}")
