"""Contact of a rigid flat with a rough surface."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple, overload

from . import _tabor
from ._optional import needs
from ._progress import Progress, watching
from ._records import Record
from ._surface import Array, Surface, map_to_xarray, plot_map
from ._values import Value, optional_si, si_list


class NotConverged(RuntimeError):
    """A contact or a film that flows did not reach its tolerance; ``result`` is what was reached."""

    def __init__(self, text: str, result: Any = None) -> None:
        super().__init__(text)
        self.result = result

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.args[0], self.result)


class Material(NamedTuple):
    """A solid of the library; None where it is not known."""

    name: str
    description: str
    youngs_modulus: float  #: [Pa]
    poissons_ratio: float
    saturation_pressure: float | None  #: [Pa]
    shear_strength: float | None  #: of dry contacts [Pa]
    source: str  #: of the Young's modulus


def materials() -> tuple[Material, ...]:
    """The solids that ``Solid`` knows by name, as ``tabor materials`` lists them."""
    return tuple(Material(*row) for row in _tabor.materials())


@dataclass(frozen=True, init=False)
class Solid:
    """The rough body, and what it is pressed on: rigid unless a counter body is given.

    Parameters
    ----------
    material : str, optional
        Name in the library (``materials()``), or "aluminium" for "aluminium-6016" as long as there is one
        alone: what is not given is taken from there.
    youngs_modulus, poissons_ratio : value
        E [Pa] and nu of the rough body.
    saturation_pressure : value, optional
        Cap on the contact pressure [Pa], for metals that yield; "none" is elastic whatever the library says.
    shear_strength : value, optional
        Of its dry contacts [Pa]; friction takes it where it is not given one.
    counter_youngs_modulus, counter_poissons_ratio : value, optional
        Of the counter body.

    Raises
    ------
    ValueError
        For an unknown name, with the nearest one; without modulus and ratio; for solids that do not exist.

    Examples
    --------
    >>> import tabor as tb
    >>> tb.Solid(youngs_modulus="70 GPa", poissons_ratio=0.33).effective_modulus
    78554595443.83347
    """

    youngs_modulus: float
    poissons_ratio: float
    saturation_pressure: float | None
    shear_strength: float | None
    counter_youngs_modulus: float | None
    counter_poissons_ratio: float | None
    material: str

    def __init__(self, material: str | None = None, *, youngs_modulus: Value | None = None,
                 poissons_ratio: Value | None = None, saturation_pressure: Value | None = None,
                 shear_strength: Value | None = None, counter_youngs_modulus: Value | None = None,
                 counter_poissons_ratio: Value | None = None) -> None:
        known = Material(*_tabor.material(material)) if material is not None else None
        if known is None and (youngs_modulus is None or poissons_ratio is None):
            raise ValueError("Solid: give youngs_modulus and poissons_ratio, or the name of a material")
        given = {"youngs_modulus": optional_si(youngs_modulus, "pressure", "youngs_modulus"),
                 "poissons_ratio": optional_si(poissons_ratio, "none", "poissons_ratio"),
                 "saturation_pressure": None if saturation_pressure == "none" else
                 optional_si(saturation_pressure, "pressure", "saturation_pressure"),
                 "shear_strength": optional_si(shear_strength, "pressure", "shear_strength")}
        for name, value in given.items():
            if value is None and known is not None and not (name == "saturation_pressure" and saturation_pressure):
                value = getattr(known, name)
            object.__setattr__(self, name, value)
        object.__setattr__(self, "counter_youngs_modulus",
                           optional_si(counter_youngs_modulus, "pressure", "counter_youngs_modulus"))
        object.__setattr__(self, "counter_poissons_ratio",
                           optional_si(counter_poissons_ratio, "none", "counter_poissons_ratio"))
        object.__setattr__(self, "material", known.name if known is not None else "")
        _tabor.check_contact(self._settings(), [])

    @property
    def effective_modulus(self) -> float:
        """E* [Pa], 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2 (Johnson 1985, section 4.2)."""
        return self._settings().effective_modulus

    def _settings(self) -> _tabor.ContactSettings:
        settings = _tabor.ContactSettings()
        settings.material = self.material
        settings.youngs_modulus = self.youngs_modulus
        settings.poissons_ratio = self.poissons_ratio
        settings.saturation_pressure = self.saturation_pressure
        settings.counter_youngs_modulus = self.counter_youngs_modulus
        settings.counter_poissons_ratio = self.counter_poissons_ratio
        return settings


@dataclass(frozen=True)
class _Options:
    boundary: str
    solver: str
    tolerance: float
    load_path: bool


class Contact(Record):
    """One solved contact. Maps are read-only views of shape (ny, nx)."""

    _facts = (("pressure", "mean_pressure_Pa", "Pa"), ("area", "contact_area_fraction", ""),
              ("mean gap", "mean_gap_m", "m"), ("certificate", "certificate", ""))

    surface: Surface  #: that was pressed on
    solid: Solid  #: what it is of
    _record: _tabor.ContactRecord
    _options: _Options

    def __init__(self, record: _tabor.ContactRecord, surface: Surface, solid: Solid, options: _Options) -> None:
        self.__dict__.update(_record=record, surface=surface, solid=solid, _options=options)

    @property
    def pressure(self) -> Array:
        """Contact pressure [Pa]; above zero where the solids touch."""
        return self._record.pressure

    @property
    def displacement(self) -> Array:
        """Displacement of the surface, into the body [m]."""
        return self._record.displacement

    @property
    def gap(self) -> Array:
        """Gap between the deformed surface and the flat [m]; below zero only where the contact saturates,
        by the residual plastic indentation."""
        return self._record.gap

    @property
    def mean_pressure(self) -> float:
        """Load over nominal area [Pa]."""
        return float(self.values["mean_pressure_Pa"])

    @property
    def area_fraction(self) -> float:
        """Real over nominal contact area, perimeter-corrected (Yastrebov, Anciaux & Molinari 2017)."""
        return float(self.values["contact_area_fraction"])

    @property
    def mean_gap(self) -> float:
        """Mean of the gap, residual indentation counted as zero [m]."""
        return float(self.values["mean_gap_m"])

    @property
    def certificate(self) -> float:
        """Relative bound of the error (docs/theory.md, "Certificate")."""
        return float(self.values["certificate"])

    @property
    def converged(self) -> bool:
        """The certificate is within the tolerance."""
        return self._record.converged

    def to_xarray(self) -> Any:
        """Pressure, displacement and gap as a Dataset with coordinates x and y [m]; needs xarray."""
        xarray = needs("xarray", "to_xarray()")
        maps = {"pressure": (self.pressure, "Pa"), "displacement": (self.displacement, "m"), "gap": (self.gap, "m")}
        numbers = {key: value for key, value in self.values.items() if isinstance(value, (int, float))}
        return xarray.Dataset({name: map_to_xarray(self.surface, values, name, unit)
                               for name, (values, unit) in maps.items()}, attrs=numbers)

    def plot(self, ax: Any = None) -> Any:
        """Draws the pressure; needs matplotlib. Returns the axes."""
        return plot_map(self.surface, self.pressure * 1e-6, "pressure [MPa]", ax)

    def _settings(self) -> _tabor.ContactSettings:
        return _settings(self.solid, self._options)


def _settings(solid: Solid, options: _Options) -> _tabor.ContactSettings:
    settings = solid._settings()
    settings.boundary = options.boundary
    settings.solver = options.solver
    settings.tolerance = options.tolerance
    settings.load_path = options.load_path
    return settings


@overload
def contact(surface: Surface, pressure: Value, solid: Solid, *, boundary: str = ..., tolerance: float = ...,
            solver: str = ..., load_path: bool = ..., check: bool = ...,
            progress: Progress = ...) -> Contact: ...
@overload
def contact(surface: Surface, pressure: Sequence[Value], solid: Solid, *, boundary: str = ...,
            tolerance: float = ..., solver: str = ..., load_path: bool = ..., check: bool = ...,
            progress: Progress = ...) -> list[Contact]: ...
def contact(surface: Surface, pressure: Any, solid: Solid, *, boundary: str = "periodic",
            tolerance: float = 1e-6, solver: str = "fast", load_path: bool = False, check: bool = True,
            progress: Progress = None) -> Any:
    """Presses a rigid flat on a rough surface (docs/theory.md).

    Parameters
    ----------
    surface : Surface without holes.
    pressure : mean pressure [Pa], load over nominal area; several give a list of contacts.
    solid : Solid that the surface is of.
    boundary : "periodic", the scan repeats; "free", it is loaded alone.
    tolerance : certificate to reach, 1e-12 to 1e-4.
    solver : "fast", or "polonsky-keer", the textbook baseline.
    load_path : the plastic indentation that a pressure leaves is kept for the next.
    check : raise NotConverged where the tolerance is not reached; its ``result`` is what was.
    progress : see ``tabor.Progress``.

    Raises
    ------
    ValueError
        For holes, a pressure that is not positive or that reaches the saturation pressure, unknown names.
    NotConverged
        Unless ``check`` is False.
    """
    pressures, single = si_list(pressure, "pressure", "pressure")
    options = _Options(boundary, solver, float(tolerance), load_path)
    settings = _settings(solid, options)
    _tabor.require_no_holes(surface._topography)
    with watching(progress) as told:
        records = _tabor.contacts(surface._topography, settings, pressures, told)
    found = [Contact(record, surface, solid, options) for record in records]
    for one in found if check else []:
        if not one.converged:
            raise NotConverged(f"contact at {_tabor.format_si(one.mean_pressure, 'Pa')}: {one.values['status']} at "
                               f"certificate {one.certificate:.2g}, asked for {tolerance:g}; check=False returns "
                               "it all the same", found[0] if single else found)
    return found[0] if single else found
