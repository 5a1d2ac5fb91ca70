"""Oil on a surface, and friction of a contact with it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal, TypeVar, Unpack, overload

from . import _tabor
from ._arguments import Axes, typed
from ._contact import Contact, Flags, NotConverged
from ._doubts import tell
from ._progress import Progress, watching
from ._records import Record, attributes
from ._setting_types import (
    FrictionSettings,
    LubricantSettings,
    LubricantValues,
    RainSettings,
    TrappedFrictionSettings,
)
from ._settings import DRY_BELOW, OIL, RAIN, SHEAR, TRAPPED, complete, documented, filled, takes
from ._maps import Array, Kind, Map, Window, chosen, map_to_xarray, maps_to_xarray, plot_map
from ._surface import Surface
from ._values import Value, si, si_list


#: Maps that ``Friction.plot`` draws, those of trapped oil and of a film that flows included.
FrictionField = Literal["wet", "touching", "contact_pressure", "gap", "film_thickness", "liquid_pressure", "trapped_pressure",
                        "trapped_gap", "fluid_pressure", "fill", "sliding_gap", "solid_pressure"]


def film_settings(options: Mapping[str, Any], densities: Sequence[float]) -> _tabor.FilmSettings:
    """How oil is laid down until areal densities [kg/m^2] are reached."""
    settings = filled(_tabor.FilmSettings(), options)
    settings.lubricant_densities = list(densities)
    return settings


class Film(Record):
    """Oil as it was laid on a surface."""

    _facts = (("density", "lubricant_density_g_per_m2", "g/m²"), ("mean film", "mean_film_m", "m"),
              ("wet", "wet_fraction", ""))

    surface: Surface  #: that it lies on
    _record: _tabor.FilmRecord
    _options: dict[str, Any]

    def __init__(self, record: _tabor.FilmRecord, surface: Surface, options: dict[str, Any]) -> None:
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
        """The thickness as a DataArray with coordinates x and y [m], numbers and warnings as its attributes, to be
        written as NetCDF; needs xarray."""
        return map_to_xarray(self.surface, self.thickness, "film_thickness", "m", attributes(self))

    @typed
    def plot(self, ax: Axes = None, *, window: Window = None, cmap: str | None = None) -> Any:
        """Draws the thickness in µm; needs matplotlib. Returns the axes.

        Parameters
        ----------
        ax : axes of matplotlib [the current ones].
        window : part that is shown: x0, y0, width and height [m] from the upper left corner [all].
        cmap : name of a colour map of matplotlib [that of its settings].
        """
        return plot_map(self.surface, Map(self.thickness, "m", "film thickness"), ax, window, cmap)


@overload  # a text is a list of texts, too
def rain(  # type: ignore[overload-overlap]
        surface: Surface, density: Value, *, progress: Progress = ..., **settings: Unpack[RainSettings]) -> Film: ...
@overload
def rain(surface: Surface, density: Iterable[Value], *, progress: Progress = ...,
         **settings: Unpack[RainSettings]) -> list[Film]: ...
@takes(RAIN)
def rain(surface: Surface, density: Any, *, progress: Progress = None, **settings: Unpack[RainSettings]) -> Any:
    """Rains oil on a surface until areal densities are reached (docs/lubrication.md).

    Parameters
    ----------
    surface : Surface without holes.
    density : areal density as dosed [kg/m^2], "0.45 g/m^2"; several give a list of films of one rain.
    **settings
    progress : see ``tabor.Progress``.

    Returns
    -------
    Film
        Thickness [m] and wet share; a list of films for several densities.

    Raises
    ------
    ValueError
        For holes, negative densities, unknown names.

    Examples
    --------
    >>> import tabor as tb
    >>> sheet = tb.generate("edt", pixels=64, seed=1)
    >>> thin, thick = tb.rain(sheet, ["0.45 g/m^2", "0.9 g/m^2"], oil_density=900, seed=1)
    >>> f"{1e6 * thick.thickness.mean():.3f} um"
    '1.000 um'
    """
    densities, single = si_list(density, "areal_density", "density")
    options = complete(RAIN, settings)
    _tabor.require_no_holes(surface._topography)
    with watching(progress) as told:
        films = [Film(record, surface, options) for record in _tabor.rain(surface._topography, film_settings(options, densities), told)]
    tell(surface.warnings)
    for one in films:
        tell(one.warnings)
    return films[0] if single else films


def shear_settings(options: Mapping[str, Any]) -> _tabor.FrictionSettings:
    """What turns contact into friction."""
    return filled(_tabor.FrictionSettings(), options)


def shear_of(contact: Contact, settings: Mapping[str, Any]) -> dict[str, Any]:
    """The settings, with the shear strength of the solid unless one is given."""
    options = complete(SHEAR, settings)
    if options["shear_strength"] is None:
        options["shear_strength"] = contact.solid.shear_strength
    if options["shear_strength"] is None and not contact.solid.material:  # of a named one, the library says what it lacks
        raise ValueError("the solid of the contact has no shear strength; give shear_strength, such as '70 MPa'")
    return options


class Friction(Record):
    """Bowden-Tabor friction of a contact with a film."""

    _facts: tuple[tuple[str, str, str], ...] = (("dry", "friction_dry", ""), ("lubricated", "friction_lubricated", ""),
              ("wet share", "lubricated_share", ""), ("pressure", "mean_pressure_Pa", "Pa"))

    contact: Contact
    film: Film
    _record: _tabor.FrictionRecord
    _options: dict[str, Any]
    _trapped: _tabor.TrappedRecord | None  #: None unless trapped oil carries load
    _oil: dict[str, Any] | None  #: its settings

    def __init__(self, record: _tabor.FrictionRecord, contact: Contact, film: Film, options: dict[str, Any],
                 trapped: _tabor.TrappedRecord | None = None, oil: dict[str, Any] | None = None) -> None:
        self.__dict__.update(_record=record, contact=contact, film=film, _options=options, _trapped=trapped, _oil=oil)

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

    @property
    def wet(self) -> Flags:
        """True where the contact stands in oil as it was laid down, shape (ny, nx)."""
        return _tabor.wet_contact(self.contact._record, self.film._record, shear_settings(self._options))

    @property
    def liquid_pressure(self) -> Array | None:
        """Pressure of the oil in each closed pocket [Pa], shape (ny, nx), zero elsewhere; None unless trapped oil carries load."""
        return None if self._trapped is None else self._trapped.liquid_pressure

    @property
    def trapped_pressure(self) -> Array | None:
        """Pressure of solids and trapped oil together [Pa]; None unless trapped oil carries load."""
        return None if self._trapped is None else self._trapped.pressure

    @property
    def trapped_gap(self) -> Array | None:
        """Over the trapped oil [m]; None unless trapped oil carries load."""
        return None if self._trapped is None else self._trapped.gap

    @property
    def converged(self) -> bool:
        """Contact, and the oil where it carries load."""
        return bool(self.values["converged"])

    def _kinds(self) -> dict[str, Kind]:
        """The maps of ``to_xarray`` and ``plot``."""
        kinds = {"contact_pressure": Kind("contact.pressure", "Pa", "contact pressure"),
                 "gap": Kind("contact.gap", "m", "gap without oil"), "film_thickness": Kind("film.thickness", "m", "film thickness"),
                 "touching": Kind("contact.touching", "", "touching"), "wet": Kind("wet", "", "wet contact")}
        if self._trapped is not None:
            kinds.update(liquid_pressure=Kind("liquid_pressure", "Pa", "pressure of the trapped oil"),
                         trapped_pressure=Kind("trapped_pressure", "Pa", "pressure of solids and trapped oil"),
                         trapped_gap=Kind("trapped_gap", "m", "gap over the trapped oil"))
        return kinds

    def to_xarray(self) -> Any:
        """The maps that ``plot`` draws as a Dataset with coordinates x and y [m], numbers and warnings as its
        attributes, to be written as NetCDF; needs xarray."""
        return maps_to_xarray(self.contact.surface, self, self._kinds(), attributes(self))

    @typed
    def plot(self, field: FrictionField = "wet", ax: Axes = None, *, window: Window = None, cmap: str | None = None) -> Any:
        """Draws one map in µm; needs matplotlib. Returns the axes. Drawn again into the same axes, it takes the place of
        the picture before.

        Parameters
        ----------
        field : "wet", "touching", "contact_pressure", "gap" or "film_thickness"; with trapped oil "liquid_pressure",
            "trapped_pressure" and "trapped_gap"; of a film that flows "fluid_pressure", "fill", "sliding_gap" and
            "solid_pressure".
        ax : axes of matplotlib [the current ones].
        window : part that is shown: x0, y0, width and height [m] from the upper left corner [all].
        cmap : name of a colour map of matplotlib [that of its settings].

        Raises
        ------
        ValueError
            For another field, and for a window without a pixel.
        """
        return plot_map(self.contact.surface, chosen(self, self._kinds(), field), ax, window, cmap)


_AnyFriction = TypeVar("_AnyFriction", bound=Friction)


def _told(found: _AnyFriction) -> _AnyFriction:
    tell(found.warnings)
    return found


@takes(SHEAR + DRY_BELOW + TRAPPED)
def friction(contact: Contact, film: Film, *, check: bool = True, progress: Progress = None,
             **settings: Unpack[TrappedFrictionSettings]) -> Friction:
    """Friction is the real contact area times the shear strength over the load; contact that stands in oil
    carries none, or that of a boundary film (Bowden & Tabor; docs/theory.md). With ``trapped``, the oil in closed
    pockets of the gap carries part of the load (docs/trapped_liquid.md).

    Parameters
    ----------
    contact : of a surface.
    film : the oil on that surface.
    **settings
    check : raise NotConverged where trapped oil does not converge; its ``result`` is what was reached.
    progress : see ``tabor.Progress``.

    Returns
    -------
    Friction
        Coefficients of friction, dry and lubricated, and the wet share of the contact.

    Raises
    ------
    ValueError
        Without a shear strength, for one out of range, for a film on another surface.
    NotConverged
        Unless ``check`` is False.

    Examples
    --------
    >>> import tabor as tb
    >>> sheet = tb.generate("edt", pixels=64, seed=1)
    >>> pressed, oil = tb.contact(sheet, "7 MPa", "aluminium-6016"), tb.rain(sheet, "3 g/m^2")
    >>> found = tb.friction(pressed, oil, shear_strength="70 MPa", boundary_shear_strength="5 MPa")
    >>> 0 < found.lubricated <= found.dry
    True
    """
    oil = complete(TRAPPED, settings)
    options = {**shear_of(contact, settings), **complete(DRY_BELOW, settings)}
    given = (contact.surface._topography, contact._record, film._record, contact._settings())
    if not oil["trapped"]:
        _tabor.check_trapped(filled(_tabor.TrappedSettings(), oil))
        return _told(Friction(_tabor.friction(*given, shear_settings(options)), contact, film, options))
    with watching(progress) as told:
        trapped, record = _tabor.trapped_oil(*given, filled(_tabor.TrappedSettings(), oil), shear_settings(options), told)
    found = Friction(record, contact, film, options, trapped, oil)
    if check and not bool(found.values["trapped_converged"]):
        raise NotConverged("friction: the trapped oil did not converge; check=False returns it all the same", found)
    return _told(found)


@documented(OIL)
@dataclass(frozen=True, init=False)
class Lubricant(LubricantValues):
    """Oil that flows: its viscosity grows with pressure by Roelands' law where the coefficient is given, and thins by
    shear where a Ree-Eyring stress is given.

    Parameters
    ----------
    **settings

    Raises
    ------
    ValueError
        For values that no oil has.
    """

    @takes(OIL)
    def __init__(self, viscosity: Value, *more: Value | None, **settings: Unpack[LubricantSettings]) -> None:
        for name, value in complete(OIL, {**settings, "viscosity": viscosity}).items():
            object.__setattr__(self, name, value)
        _tabor.check_lubricant(self._settings(0.0))

    def _settings(self, speed: float) -> _tabor.FluidSettings:
        return filled(_tabor.FluidSettings(), {"sliding_speed": speed, **{one.name: getattr(self, one.name) for one in OIL}})


class FluidFilm(Friction):
    """A film that flows between sliding surfaces and carries part of the load."""

    _facts = Friction._facts + (("mixed", "friction_mixed", ""), ("oil carries", "fluid_load_share", ""))

    lubricant: Lubricant
    speed: float  #: of sliding [m/s]
    _fluid: _tabor.FluidRecord

    def __init__(self, record: _tabor.FrictionRecord, contact: Contact, film: Film, options: dict[str, Any],
                 fluid: _tabor.FluidRecord, lubricant: Lubricant, speed: float) -> None:
        super().__init__(record, contact, film, options)
        self.__dict__.update(_fluid=fluid, lubricant=lubricant, speed=speed)

    @property
    def pressure(self) -> Array:
        """Pressure of the oil [Pa], shape (ny, nx)."""
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

    def _kinds(self) -> dict[str, Kind]:
        return {**super()._kinds(), "fluid_pressure": Kind("pressure", "Pa", "pressure of the oil"),
                "fill": Kind("fill", "", "share of the gap that oil fills"), "sliding_gap": Kind("gap", "m", "gap while sliding"),
                "solid_pressure": Kind("solid_pressure", "Pa", "contact pressure while sliding")}

    @property
    def friction_mixed(self) -> float:
        """Coefficient of friction of solids and oil together."""
        return float(self.values["friction_mixed"])

    @property
    def load_share(self) -> float:
        """Share of the load that the oil carries."""
        return float(self.values["fluid_load_share"])


@takes(SHEAR)
def fluid_film(contact: Contact, film: Film, lubricant: Lubricant, speed: Value, *, check: bool = True,
               progress: Progress = None, **settings: Unpack[FrictionSettings]) -> FluidFilm:
    """Lets the oil flow while the flat slides along +x (docs/fluid_film.md).

    Parameters
    ----------
    contact : that repeats (is periodic).
    film : the oil on its surface.
    lubricant : what flows, Lubricant("0.1 Pa s").
    speed : of sliding [m/s], "5 mm/s".
    **settings
    check : raise NotConverged where film and load do not balance; its ``result`` is what was reached.
    progress : see ``tabor.Progress``.

    Returns
    -------
    FluidFilm
        Friction with the film that flows: pressure of the oil [Pa], gap [m], mixed friction, share of the load.

    Raises
    ------
    ValueError
        As ``friction`` does.
    NotConverged
        Unless ``check`` is False.

    Examples
    --------
    >>> import tabor as tb
    >>> tile = tb.generate("edt", pixels=32, seed=1)
    >>> pressed, oil = tb.contact(tile, "2 MPa", "aluminium-6016"), tb.rain(tile, "0.9 g/m^2")
    >>> wet = tb.fluid_film(pressed, oil, tb.Lubricant("0.1 Pa s"), "5 mm/s")
    >>> 0 <= wet.load_share < 1
    True
    """
    options = shear_of(contact, settings)
    metres_per_second = si(speed, "speed", "speed")
    with watching(progress) as told:
        fluid, record = _tabor.fluid_film(contact.surface._topography, contact._record, film._record,
                                          contact._settings(), lubricant._settings(metres_per_second),
                                          shear_settings(options), told)
    found = FluidFilm(record, contact, film, options, fluid, lubricant, metres_per_second)
    if check and not found.converged:
        raise NotConverged("fluid film: film and load do not balance; check=False returns it all the same", found)
    return _told(found)
