"""Contacts, films and frictions out of the states of a result file (docs/results.md)."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np

from . import _tabor
from ._contact import Contact, Solid
from ._friction import Film, FluidFilm, Friction, Lubricant
from ._groups import numbers_of, of_a_file, texts_of, warnings_in
from ._guesses import Values
from ._heights import Array
from ._read import read
from ._settings import CONTACT, DRY_BELOW, OIL, PLACES, RAIN, SHEAR, SOLID, TRAPPED, Setting
from ._surface import Surface

#: In the order of the library.
_STATUS = ("converged", "stalled", "iteration limit", "stopped")


class Opened:
    """A result file of one surface, and what all of its states share."""

    def __init__(self, file: Any, path: Any) -> None:
        self.file = file
        self.config = tomllib.loads(str(file.attrs.get("config_toml", "")))
        found = read(path)
        origin = str(file["surface"].attrs.get("source", "")) or found.source
        self.surface = Surface._of(_tabor.from_source(found._topography, origin), str(file.attrs.get("input_sha256", "")))
        self.digest = _tabor.digest_of(self.surface._topography)
        self.warnings = warnings_in(file)
        self.references = list(texts_of(file, "methods"))
        self.parts: dict[tuple[Any, ...], Any] = {}

    def settings(self, kinds: Iterable[Setting]) -> dict[str, Any]:
        """Values of settings by their names; of those that the file does not name, the default."""
        every = [one.name for one in (*SOLID, *CONTACT, *PLACES, *RAIN, *TRAPPED, *SHEAR, *DRY_BELOW, *OIL)]
        found: dict[str, Any] = {}
        for key, value in self.config.items():
            names = [name for name in every if key == name or key.startswith(f"{name}_")]
            if names:
                found[max(names, key=len)] = value
        return {one.name: found.get(one.name, one.default) for one in kinds}

    def solid(self) -> Solid:
        """What the surface is of."""
        values = self.settings(SOLID)
        given = {one.argument: one.none if values[one.name] is None and one.name == "saturation_pressure" else values[one.name]
                 for one in SOLID}
        return Solid(self.config.get("material") or None, **given)

    def warnings_of(self, numbers: Mapping[str, Any]) -> list[tuple[str, str, float]]:
        """Warnings that a state has the codes of; the file holds their texts for all states together."""
        codes = numbers.get("warning_codes", ())
        return [(one.code, of_a_file(one).text, 0.0) for one in self.warnings if one.code in codes]

    def shared(self, key: tuple[Any, ...], make: Callable[[], Any]) -> Any:
        """What several states have in common is made once."""
        if key not in self.parts:
            self.parts[key] = make()
        return self.parts[key]

    def map(self, state: Any, name: str) -> Array:
        """A map of a state, NaN where the file lacks it."""
        if name not in state:
            return np.full(self.surface.shape, np.nan)
        return np.ascontiguousarray(state[name][()], dtype=np.float64)


def _restored(kind: Any, *state: Any) -> Any:
    """A record of the extension module."""
    record = kind.__new__(kind)
    record.__setstate__(state)
    return record


def _status(numbers: Mapping[str, Any], key: str = "converged") -> int:
    said = numbers.get("status")
    return _STATUS.index(said) if said in _STATUS else 0 if numbers.get(key) else 1


def _known(result: Any, numbers: Mapping[str, Any]) -> Any:
    """The result, with the numbers that the file holds of it."""
    result.__dict__["_values"] = Values(numbers, type(result).__name__)
    return result


def _contact(opened: Opened, state: Any, numbers: Mapping[str, Any], is_first: bool = True) -> Contact:
    """The displacement follows from the rest (docs/results.md), but for later states of a load path."""
    options = opened.settings(CONTACT)
    pressure, gap = opened.map(state, "pressure"), opened.map(state, "gap")
    tool = opened.map(state, "tool") if "tool" in state else None
    displacement = gap + opened.surface.height - numbers["separation_m"] + (0.0 if tool is None else tool)
    if options["load_path"] and not is_first:
        displacement = np.full(opened.surface.shape, np.nan)
    scalars = (_status(numbers), 0.0, numbers["contact_gap_error_m"], 0.0, 0, opened.digest)
    record = _restored(_tabor.ContactRecord, dict(numbers), scalars, opened.warnings_of(numbers), opened.references, pressure,
                       displacement, gap, tool)
    return _known(Contact(record, opened.surface, opened.shared(("solid",), opened.solid), options), numbers)  # type: ignore[no-any-return]


def _film(opened: Opened, state: Any, numbers: Mapping[str, Any]) -> Film:
    density = numbers["lubricant_density_g_per_m2"] * 1e-3
    record = _restored(_tabor.FilmRecord, dict(numbers), (density, opened.digest), opened.warnings_of(numbers), opened.references,
                       opened.map(state, "film_thickness"))
    return _known(Film(record, opened.surface, opened.settings(RAIN)), numbers)  # type: ignore[no-any-return]


def _named(numbers: Mapping[str, Any], before: str) -> dict[str, Any]:
    """The numbers of one part, whose names begin with it where others have them too."""
    found = {key.removeprefix(before): value for key, value in numbers.items() if key.startswith(before)}
    return {**numbers, **found}


def _friction(opened: Opened, state: Any, numbers: Mapping[str, Any], is_first: bool) -> Friction:
    of_contact = {key: numbers[key] for key in ("mean_pressure_Pa", "contact_area_fraction", "contact_area_fraction_pixels",
                                                "saturated_area_fraction", "mean_gap_m", "separation_m", "certificate", "contact_gap_error_m",
                                                "tool_x_m") if key in numbers}
    of_contact["converged"] = numbers["certificate"] <= opened.config.get("tolerance", np.inf)
    of_film = {key: numbers[key] for key in ("lubricant_density_g_per_m2", "mean_film_m") if key in numbers}
    codes = {"warning_codes": numbers.get("warning_codes", ())}
    contact = opened.shared(("contact", *of_contact.values()), lambda: _contact(opened, state, {**of_contact, **codes}, is_first))
    film = opened.shared(("film", *of_film.values()), lambda: _film(opened, state, of_film))
    is_trapped, is_fluid = "liquid_load_share" in numbers, "friction_mixed" in numbers
    given = {**numbers, "lubricant_density_kg_per_m2": film.lubricant_density}
    record = _restored(_tabor.FrictionRecord, given, (is_trapped, is_fluid, "tool_x_m" in numbers), numbers["area"],
                       opened.warnings_of(numbers), opened.references)
    options = opened.settings((*SHEAR, *DRY_BELOW))
    if is_fluid:
        speed = opened.config["sliding_speed_m_per_s"]
        fluid = _restored(_tabor.FluidRecord, _named(numbers, "fluid_"), speed, (_status(numbers, "fluid_converged"), opened.digest), [],
                          opened.references, *(opened.map(state, f"fluid_{name}") for name in ("pressure", "fill", "gap", "solid_pressure")))
        lubricant = Lubricant(**opened.settings(OIL))
        return _known(FluidFilm(record, contact, film, options, fluid, lubricant, speed), numbers)  # type: ignore[no-any-return]
    trapped = None
    if is_trapped:
        maps = (opened.map(state, name) for name in ("liquid_pressure", "trapped_pressure", "trapped_gap"))
        trapped = _restored(_tabor.TrappedRecord, _named(numbers, "trapped_"), (_status(numbers, "trapped_converged"), opened.digest), [],
                            opened.references, *maps)
    oil = opened.settings(TRAPPED) if is_trapped else None
    return _known(Friction(record, contact, film, options, trapped, oil), numbers)  # type: ignore[no-any-return]


def state_of(opened: Opened, state: Any, is_first: bool) -> Contact | Film | Friction:
    numbers = numbers_of(state)
    if "friction_dry" in numbers:
        return _friction(opened, state, numbers, is_first)
    if "mean_pressure_Pa" in numbers:
        return _contact(opened, state, numbers, is_first)
    return _film(opened, state, numbers)
