"""Oil on a surface, and friction of a contact with it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple, overload

import numpy as np

from . import _tabor
from ._contact import Contact, NotConverged
from ._optional import needs
from ._progress import Progress, watching
from ._records import Record
from ._surface import Array, Surface, map_to_xarray, plot_map
from ._values import Value, optional_si, si, si_list


@dataclass(frozen=True)
class _Rain:
    """How oil is laid down, in SI."""

    oil_density: float
    droplet_height: float
    model: str
    reading: str
    edge: str
    seed: int

    def settings(self, densities: Sequence[float]) -> _tabor.FilmSettings:
        settings = _tabor.FilmSettings()
        settings.lubricant_densities = list(densities)
        settings.oil_density, settings.droplet_height = self.oil_density, self.droplet_height
        settings.model, settings.reading, settings.edge = self.model, self.reading, self.edge
        settings.seed = self.seed
        return settings


class Film(Record):
    """Oil as it was laid on a surface."""

    _facts = (("density", "lubricant_density_g_per_m2", "g/m^2"), ("mean film", "mean_film_m", "m"),
              ("wet", "wet_fraction", ""))

    surface: Surface  #: that it lies on
    _record: _tabor.FilmRecord
    _options: _Rain

    def __init__(self, record: _tabor.FilmRecord, surface: Surface, options: _Rain) -> None:
        self.__dict__.update(_record=record, surface=surface, _options=options)

    @property
    def thickness(self) -> Array:
        """Thickness [m], shape (ny, nx), exactly zero where it is dry; a read-only view."""
        return self._record.thickness

    @property
    def lubricant_density(self) -> float:
        """Areal density as dosed [kg/m^2]."""
        return self._record.lubricant_density

    @property
    def wet_fraction(self) -> float:
        """Share of the pixels with oil."""
        return float(self.values["wet_fraction"])

    def to_xarray(self) -> Any:
        """The thickness as a DataArray with coordinates x and y [m]; needs xarray."""
        return map_to_xarray(self.surface, self.thickness, "film_thickness", "m")

    def plot(self, ax: Any = None) -> Any:
        """Draws the thickness; needs matplotlib. Returns the axes."""
        return plot_map(self.surface, self.thickness, "film thickness [m]", ax)


@overload
def rain(surface: Surface, density: Value, *, oil_density: Value = ..., droplet_height: Value = ...,
         model: str = ..., reading: str = ..., edge: str = ..., seed: int = ...,
         progress: Progress = ...) -> Film: ...
@overload
def rain(surface: Surface, density: Sequence[Value], *, oil_density: Value = ..., droplet_height: Value = ...,
         model: str = ..., reading: str = ..., edge: str = ..., seed: int = ...,
         progress: Progress = ...) -> list[Film]: ...
def rain(surface: Surface, density: Any, *, oil_density: Value = 900.0, droplet_height: Value = 1e-7,
         model: str = "droplets", reading: str = "conserving", edge: str = "closed", seed: int = 1,
         progress: Progress = None) -> Any:
    """Rains oil on a surface until areal densities are reached (docs/lubrication.md).

    Parameters
    ----------
    surface : Surface without holes.
    density : areal density as dosed [kg/m^2], "0.45 g/m^2"; several give a list of films of one rain.
    oil_density : of the liquid [kg/m^3].
    droplet_height : droplet volume over pixel area [m].
    model : "droplets" run downhill, "limit" of vanishing droplets, "bottom-fill", "uniform".
    reading : what a full pit does with the rest of a droplet: "conserving" or "literal".
    edge : what the border of the scan is: "closed", "periodic" or "open".
    seed : chooses where droplets fall; the same seed gives the same film.

    Raises
    ------
    ValueError
        For holes, negative densities, unknown names.
    """
    if seed < 0:
        raise ValueError(f"seed: got {seed}; expected zero or more")
    densities, single = si_list(density, "areal_density", "density")
    options = _Rain(si(oil_density, "density", "oil_density"), si(droplet_height, "length", "droplet_height"), model,
                    reading, edge, seed)
    settings = options.settings(densities)
    _tabor.require_no_holes(surface._topography)
    with watching(progress) as told:
        films = [Film(record, surface, options) for record in _tabor.rain(surface._topography, settings, told)]
    return films[0] if single else films


@dataclass(frozen=True)
class _Shear:
    """What turns contact into friction, in SI."""

    strength: float
    boundary_strength: float | None
    boundary_share: float | None
    area: str | None

    def settings(self) -> _tabor.FrictionSettings:
        settings = _tabor.FrictionSettings()
        settings.shear_strength = self.strength
        settings.boundary_shear_strength = self.boundary_strength
        settings.boundary_shear_share = self.boundary_share
        settings.area = self.area
        return settings


def _shear(contact: Contact, strength: Value | None, boundary_strength: Value | None, boundary_share: float | None,
           area: str | None) -> _Shear:
    strength = contact.solid.shear_strength if strength is None else strength
    return _Shear(0.0 if strength is None else si(strength, "pressure", "shear_strength"),
                  optional_si(boundary_strength, "pressure", "boundary_shear_strength"),
                  optional_si(boundary_share, "none", "boundary_shear_share"), area)


class Friction(Record):
    """Bowden-Tabor friction of a contact with a film."""

    _facts: tuple[tuple[str, str, str], ...] = (("dry", "friction_dry", ""), ("lubricated", "friction_lubricated", ""),
              ("wet share", "lubricated_share", ""), ("pressure", "mean_pressure_Pa", "Pa"))

    contact: Contact
    film: Film
    _record: _tabor.FrictionRecord
    _options: _Shear

    def __init__(self, record: _tabor.FrictionRecord, contact: Contact, film: Film, options: _Shear) -> None:
        self.__dict__.update(_record=record, contact=contact, film=film, _options=options)

    @property
    def dry(self) -> float:
        """Coefficient of friction without oil."""
        return float(self.values["friction_dry"])

    @property
    def lubricated(self) -> float:
        """Coefficient of friction where wet contact carries no shear, or that of its boundary film."""
        return float(self.values["friction_lubricated"])

    @property
    def lubricated_share(self) -> float:
        """Share of the contact that stands in oil."""
        return float(self.values["lubricated_share"])


def friction(contact: Contact, film: Film, *, shear_strength: Value | None = None,
             boundary_shear_strength: Value | None = None, boundary_shear_share: float | None = None,
             area: str | None = None) -> Friction:
    """Friction is the real contact area times the shear strength over the load; contact that stands in oil
    carries none, or that of a boundary film (Bowden & Tabor; docs/theory.md).

    Parameters
    ----------
    shear_strength : tau_y [Pa] of dry contact [that of the solid].
    boundary_shear_strength : of wet contact [Pa], at most tau_y [0]; or boundary_shear_share, over tau_y.
    area : "corrected" or "pixels", how contact is counted [pixels where the solid has a saturation pressure,
        else corrected].

    Raises
    ------
    ValueError
        Without a shear strength, for one out of range, for a film of another shape.
    """
    options = _shear(contact, shear_strength, boundary_shear_strength, boundary_shear_share, area)
    return Friction(_tabor.friction(contact.surface._topography, contact._record, film._record, contact._settings(),
                                    options.settings()), contact, film, options)


class Plateau(NamedTuple):
    """Densities of the oil over which friction hardly changes: from the one that fills the pockets under the
    contacts to the one whose level reaches the contacts from the valleys."""

    first: float  #: [kg/m^2]
    last: float  #: [kg/m^2]
    dry_share: float  #: mean share of the contact that stays dry


class DensityCurve(NamedTuple):
    """Friction of one contact against the areal density of the oil, ten densities a decade."""

    mean_pressure: float  #: [Pa]
    friction_dry: float
    lubricant_density: Array  #: [kg/m^2], rising
    lubricated_share: Array  #: of the contact
    friction_lubricated: Array
    plateau: Plateau | None  #: None where friction changes throughout

    def says(self, density: Value | Sequence[Value] = ()) -> str:
        """The curve in one sentence, and where densities [kg/m^2] lie on it."""
        asked = si_list(density, "areal_density", "density")[0] if np.size(density) else []
        return _tabor.density_sentence((self.mean_pressure, self.friction_dry, self.lubricant_density.tolist(),
                                        self.lubricated_share.tolist(), self.friction_lubricated.tolist(),
                                        self.plateau), asked)

    def plot(self, ax: Any = None, **style: Any) -> Any:
        """Draws friction over the density; needs matplotlib. Returns the axes."""
        ax = ax or needs("matplotlib.pyplot", "plot()").gca()
        ax.semilogx(self.lubricant_density * 1e3, self.friction_lubricated, **style)
        ax.set_xlabel("lubricant density [g/m^2]")
        ax.set_ylabel("friction")
        return ax


@overload
def density_curve(contact: Contact, *, shear_strength: Value | None = ..., boundary_shear_strength: Value | None = ...,
                  boundary_shear_share: float | None = ..., area: str | None = ..., oil_density: Value = ...,
                  reading: str = ..., edge: str = ..., progress: Progress = ...) -> DensityCurve: ...
@overload
def density_curve(contact: Sequence[Contact], *, shear_strength: Value | None = ...,
                  boundary_shear_strength: Value | None = ..., boundary_shear_share: float | None = ...,
                  area: str | None = ..., oil_density: Value = ..., reading: str = ..., edge: str = ...,
                  progress: Progress = ...) -> list[DensityCurve]: ...
def density_curve(contact: Any, *, shear_strength: Value | None = None, boundary_shear_strength: Value | None = None,
                  boundary_shear_share: float | None = None, area: str | None = None, oil_density: Value = 900.0,
                  reading: str = "conserving", edge: str = "closed", progress: Progress = None) -> Any:
    """Friction against the density of the oil, from one pass of vanishing droplets (docs/lubrication.md).

    Parameters
    ----------
    contact : Contact, or a list of contacts of one surface and solid, which gives a list.
    shear_strength, boundary_shear_strength, boundary_shear_share, area : see ``friction``.
    oil_density, reading, edge : see ``rain``.

    Raises
    ------
    ValueError
        As ``friction`` and ``rain`` do; for a surface without heights, and for contacts that differ in more
        than the pressure.
    """
    contacts: list[Contact] = [contact] if isinstance(contact, Contact) else list(contact)
    if not contacts:
        raise ValueError("contact: got an empty list; expected at least one contact")
    first = contacts[0]
    if any(one.surface is not first.surface or one.solid != first.solid for one in contacts):
        raise ValueError("contact: got contacts of several surfaces or solids; expected those of one")
    film = _Rain(si(oil_density, "density", "oil_density"), 1e-7, "limit", reading, edge, 1).settings([])
    settings = _shear(first, shear_strength, boundary_shear_strength, boundary_shear_share, area).settings()
    with watching(progress) as told:
        rows = _tabor.density_curves(first.surface._topography, [one._record for one in contacts], first._settings(),
                                     film, settings, told)
    if not rows:
        raise ValueError("surface: got one without heights; expected a rough one, on which oil runs downhill")
    curves = [DensityCurve(pressure, dry, np.array(density), np.array(share), np.array(wet),
                           None if plateau is None else Plateau(*plateau))
              for pressure, dry, density, share, wet, plateau in rows]
    return curves[0] if isinstance(contact, Contact) else curves


@dataclass(frozen=True, init=False)
class Lubricant:
    """Oil that flows: its viscosity [Pa s], that grows with pressure by Roelands' law where the coefficient
    [1/Pa] is given, and thins by shear where a Ree-Eyring stress [Pa] is given."""

    viscosity: float
    pressure_viscosity: float | None
    eyring_stress: float | None

    def __init__(self, viscosity: Value, pressure_viscosity: Value | None = None,
                 eyring_stress: Value | None = None) -> None:
        object.__setattr__(self, "viscosity", si(viscosity, "viscosity", "viscosity"))
        object.__setattr__(self, "pressure_viscosity",
                           optional_si(pressure_viscosity, "per_pressure", "pressure_viscosity"))
        object.__setattr__(self, "eyring_stress", optional_si(eyring_stress, "pressure", "eyring_stress"))

    def _settings(self, speed: float) -> _tabor.FluidSettings:
        settings = _tabor.FluidSettings()
        settings.sliding_speed = speed
        settings.viscosity = self.viscosity
        settings.pressure_viscosity = self.pressure_viscosity
        settings.eyring_stress = self.eyring_stress
        return settings


class FluidFilm(Friction):
    """A film that flows between sliding surfaces and carries part of the load."""

    _facts = Friction._facts + (("mixed", "friction_mixed", ""), ("oil carries", "fluid_load_share", ""))

    lubricant: Lubricant
    speed: float  #: of sliding [m/s]
    _fluid: _tabor.FluidRecord

    def __init__(self, record: _tabor.FrictionRecord, contact: Contact, film: Film, options: _Shear,
                 fluid: _tabor.FluidRecord, lubricant: Lubricant, speed: float) -> None:
        super().__init__(record, contact, film, options)
        self.__dict__.update(_fluid=fluid, lubricant=lubricant, speed=speed)

    @property
    def pressure(self) -> Array:
        """Of the oil [Pa], shape (ny, nx)."""
        return self._fluid.pressure

    @property
    def fill(self) -> Array:
        """Share of the gap that oil fills."""
        return self._fluid.fill

    @property
    def gap(self) -> Array:
        """While sliding [m]."""
        return self._fluid.gap

    @property
    def solid_pressure(self) -> Array:
        """Contact pressure while sliding [Pa]."""
        return self._fluid.solid_pressure

    @property
    def friction_mixed(self) -> float:
        """Coefficient of friction of solids and oil together."""
        return float(self.values["friction_mixed"])

    @property
    def load_share(self) -> float:
        """Share of the load that the oil carries."""
        return float(self.values["fluid_load_share"])

    @property
    def converged(self) -> bool:
        """Contact, film and load balance."""
        return bool(self.values["converged"])


def fluid_film(contact: Contact, film: Film, lubricant: Lubricant, speed: Value, *,
               shear_strength: Value | None = None, boundary_shear_strength: Value | None = None,
               boundary_shear_share: float | None = None, area: str | None = None, check: bool = True,
               progress: Progress = None) -> FluidFilm:
    """Lets the oil flow while the flat slides along +x (docs/fluid_film.md).

    ``speed`` is in m/s; the others are those of ``friction``. The contact must be periodic. Raises
    ValueError as ``friction`` does, and NotConverged unless ``check`` is False.
    """
    options = _shear(contact, shear_strength, boundary_shear_strength, boundary_shear_share, area)
    metres_per_second = si(speed, "speed", "speed")
    with watching(progress) as told:
        fluid, record = _tabor.fluid_film(contact.surface._topography, contact._record, film._record,
                                          contact._settings(), lubricant._settings(metres_per_second),
                                          options.settings(), told)
    found = FluidFilm(record, contact, film, options, fluid, lubricant, metres_per_second)
    if check and not found.converged:
        raise NotConverged("fluid film: film and load do not balance; check=False returns it all the same", found)
    return found
