"""Contact of a rigid flat with a rough surface."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple, Unpack, overload

import numpy as np
import numpy.typing as npt

from . import _tabor
from ._arguments import Axes, typed
from ._doubts import tell
from ._progress import Progress, watching
from ._records import Record, attributes
from ._setting_types import ContactSettings, SolidSettings, SolidValues
from ._settings import CONTACT, SOLID, complete, documented, filled, takes
from ._guesses import missing_key
from ._maps import Array, Kind, Window, chosen, maps_to_xarray, plot_map
from ._surface import Surface
from ._values import Value, si_list


#: What lies beyond the boundary of a surface.
Edges = Literal["tile", "cut", "end"]
#: Maps that ``Contact.plot`` draws.
ContactField = Literal["pressure", "gap", "displacement", "height", "touching", "saturated", "patches", "tool"]

Flags = npt.NDArray[np.bool_]
Labels = npt.NDArray[np.int32]


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


class Materials(tuple[Material, ...]):
    """Solids of the library in their order, also by name: ``materials()["aluminium-6016"]``."""

    __slots__ = ()

    def __getitem__(self, key: Any) -> Any:
        if not isinstance(key, str):
            return super().__getitem__(key)
        for one in self:
            if one.name == key:
                return one
        raise missing_key("materials()", key, (one.name for one in self))


def materials() -> Materials:
    """The solids that ``Solid`` knows by name, as ``tabor materials`` lists them.

    Returns
    -------
    tuple of Material
        With moduli and pressures [Pa] and their source, also by name.

    Raises
    ------
    KeyError
        Of the result, for a name that is not there, with the nearest.

    Examples
    --------
    >>> import tabor as tb
    >>> tb.materials()["aluminium-6016"].youngs_modulus
    70000000000.0
    """
    return Materials(Material(*row) for row in _tabor.materials())


@documented(SOLID)
@dataclass(frozen=True, init=False)
class Solid(SolidValues):
    """The rough body, and what it is pressed on: rigid unless a counter body is given.

    Parameters
    ----------
    material : str, optional
        Name in the library (``materials()``), or "aluminium" for "aluminium-6016" as long as there is one
        alone: what is not given is taken from there.
    **settings

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

    material: str

    @takes(SOLID)
    def __init__(self, material: str | None = None, **settings: Unpack[SolidSettings]) -> None:
        given: Mapping[str, Any] = settings
        known = Material(*_tabor.material(material)) if material is not None else None
        if known is None and (given.get("youngs_modulus") is None or given.get("poissons_ratio") is None):
            raise ValueError("Solid: give youngs_modulus and poissons_ratio, or the name of a material")
        for one in SOLID:
            value = given.get(one.argument)
            is_none = isinstance(value, str) and value == one.none != ""
            plain = getattr(known, one.name, None) if value is None else None if is_none else one.taken(value)
            object.__setattr__(self, one.name, plain)
        object.__setattr__(self, "material", known.name if known is not None else "")
        _tabor.check_contact(self._settings(), [])

    @property
    def effective_modulus(self) -> float:
        """E* [Pa], 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2 (Johnson 1985, section 4.2)."""
        return self._settings().effective_modulus

    def _settings(self) -> _tabor.ContactSettings:
        settings = _tabor.ContactSettings()
        settings.material = self.material
        return filled(settings, {one.name: getattr(self, one.name) for one in SOLID if one.table == "contact"})


class Contact(Record):
    """One solved contact. Maps are read-only views of shape (ny, nx)."""

    _facts = (("pressure", "mean_pressure_Pa", "Pa"), ("contact area", "contact_area_fraction", ""),
              ("mean gap", "mean_gap_m", "m"), ("certificate", "certificate", ""))

    surface: Surface  #: that was pressed on
    solid: Solid  #: what it is of
    _record: _tabor.ContactRecord
    _options: dict[str, Any]

    def __init__(self, record: _tabor.ContactRecord, surface: Surface, solid: Solid, options: dict[str, Any]) -> None:
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
        """Gap between the deformed surface and what presses on it [m]; below zero only where the contact saturates,
        by the residual plastic indentation."""
        return self._record.gap

    @property
    def tool(self) -> Array | None:
        """Heights of the tool over the surface [m], towards it; None under a flat."""
        return self._record.tool

    @property
    def mean_pressure(self) -> float:
        """Load over nominal area [Pa]."""
        return float(self.values["mean_pressure_Pa"])

    @property
    def area_fraction(self) -> float:
        """Contact area: real over nominal, perimeter-corrected (Yastrebov, Anciaux & Molinari 2017)."""
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

    @property
    def force(self) -> float:
        """Load on the whole surface [N]: mean pressure times nominal area."""
        lx, ly = self.surface.lengths
        return self.mean_pressure * lx * ly

    @property
    def max_pressure(self) -> float:
        """The highest contact pressure [Pa]."""
        return float(self.values["max_pressure_Pa"])

    @property
    def touching(self) -> Flags:
        """True where the solids touch, shape (ny, nx)."""
        return self._record.touching()

    @property
    def saturated(self) -> Flags:
        """True where the pressure has reached the saturation pressure, shape (ny, nx)."""
        return self._record.saturated(self._settings())

    @property
    def patches(self) -> Labels:
        """Number of the patch of each pixel, shape (ny, nx), from 1 on; 0 where nothing touches. Pixels of one patch
        share edges, across the border too if the contact is periodic; ``patches.max()`` counts them, and
        ``numpy.bincount(patches.ravel())[1:]`` is the number of pixels of each."""
        return self._record.patches(self._settings())

    def _kinds(self) -> dict[str, Kind]:
        """The maps of ``to_xarray``."""
        tool = {} if self.tool is None else {"tool": Kind("tool", "m", "tool")}
        return {"pressure": Kind("pressure", "Pa", "pressure"), "displacement": Kind("displacement", "m", "displacement"),
                "gap": Kind("gap", "m", "gap"), "touching": Kind("touching", "", "touching"),
                "saturated": Kind("saturated", "", "saturated"), **tool}

    def to_xarray(self) -> Any:
        """Pressure, displacement, gap and the masks ``touching`` and ``saturated`` as a Dataset with coordinates x and y
        [m], numbers and warnings as its attributes, to be written as NetCDF; needs xarray."""
        return maps_to_xarray(self.surface, self, self._kinds(), attributes(self))

    @typed
    def plot(self, field: ContactField = "pressure", ax: Axes = None, *, window: Window = None, cmap: str | None = None) -> Any:
        """Draws one map in µm; needs matplotlib. Returns the axes. Drawn again into the same axes, it takes the place of
        the picture before.

        Parameters
        ----------
        field : "pressure", "gap", "displacement", "height", "touching", "saturated", "patches" or "tool".
        ax : axes of matplotlib [the current ones].
        window : part that is shown: x0, y0, width and height [m] from the upper left corner [all].
        cmap : name of a colour map of matplotlib [that of its settings].

        Raises
        ------
        ValueError
            For another field, and for a window without a pixel.
        """
        kinds = {**self._kinds(), "height": Kind("surface.height", "m", "height"), "patches": Kind("patches", "", "patch")}
        return plot_map(self.surface, chosen(self, kinds, field), ax, window, cmap)

    def _settings(self) -> _tabor.ContactSettings:
        return _settings(self.solid, self._options)


def solid_of(solid: Solid | str) -> Solid:
    """A solid, or that of a name in the library."""
    return Solid(solid) if isinstance(solid, str) else solid


def _settings(solid: Solid, options: Mapping[str, Any]) -> _tabor.ContactSettings:
    return filled(solid._settings(), options)


def _controls(given: Mapping[str, Any]) -> tuple[dict[str, list[float]], bool]:
    """Pressures [Pa], separations [m] and forces [N], one of which is given, and whether that is one value alone."""
    controls: dict[str, list[float]] = {name: [] for name in given}
    single = True
    for (name, value), dimension in zip(given.items(), ("pressure", "length", "force")):
        if value is not None:
            controls[name], single = si_list(value, dimension, name)
    return controls, single


@overload  # a text is a list of texts, too
def contact(  # type: ignore[overload-overlap]
        surface: Surface, pressure: Value, solid: Solid | str, *, edges: Edges | None = ..., check: bool = ...,
        progress: Progress = ..., **settings: Unpack[ContactSettings]) -> Contact: ...
@overload
def contact(surface: Surface, pressure: Iterable[Value], solid: Solid | str, *, edges: Edges | None = ..., check: bool = ...,
            progress: Progress = ..., **settings: Unpack[ContactSettings]) -> list[Contact]: ...
@overload
def contact(surface: Surface, *, solid: Solid | str, separation: Value | None = ..., force: Value | None = ...,
            edges: Edges | None = ..., check: bool = ..., progress: Progress = ...,
            **settings: Unpack[ContactSettings]) -> Contact: ...
@overload
def contact(surface: Surface, *, solid: Solid | str, separation: Iterable[Value] | None = ...,
            force: Iterable[Value] | None = ..., edges: Edges | None = ..., check: bool = ..., progress: Progress = ...,
            **settings: Unpack[ContactSettings]) -> list[Contact]: ...
@takes(CONTACT)
def contact(surface: Surface, pressure: Any = None, solid: Solid | str | None = None, *, separation: Any = None,
            force: Any = None, edges: Edges | None = None, check: bool = True, progress: Progress = None,
            **settings: Unpack[ContactSettings]) -> Any:
    """Presses a rigid flat on a rough surface (docs/theory.md).

    Parameters
    ----------
    surface : Surface without holes.
    pressure : mean pressure [Pa], load over nominal area; several give a list of contacts.
    solid : Solid that the surface is of, or the name of a material, "aluminium-6016".
    separation : in place of a pressure, the height of the flat [m] over the zero of heights, which is their mean once
        levelled: ``values["separation_m"]`` of the contact. Below the highest point of the surface.
    force : in place of a pressure, the force [N] on the whole surface, which must end: ``boundary="free"``.
    **settings
    edges : what the boundary is in other words: "tile", the surface repeats; "cut", it is a cut-out of a larger one, and its mirror
        images continue it (the contact is that of the mirrored surface, its ``surface``); "end", the body ends there.
    check : raise NotConverged where the tolerance is not reached; its ``result`` is what was.
    progress : see ``tabor.Progress``.

    Returns
    -------
    Contact
        Pressure [Pa], gap [m], area, certificate and warnings; a list of contacts for several pressures, separations or
        forces.

    Raises
    ------
    ValueError
        For holes, a pressure that is not positive or that reaches the saturation pressure, a separation at which
        nothing touches, two of pressure, separation and force, unknown names.
    NotConverged
        Unless ``check`` is False.

    Examples
    --------
    >>> import tabor as tb
    >>> sheet = tb.generate("edt", pixels=64, seed=1)
    >>> one = tb.contact(sheet, "7 MPa", "aluminium-6016")
    >>> one.pressure.shape, 0 < one.area_fraction < 0.1
    ((64, 64), True)
    >>> several = tb.contact(sheet, ["2 MPa", "7 MPa"], "aluminium-6016")
    >>> several[1].area_fraction == one.area_fraction
    True
    """
    controls, single = _controls({"pressure": pressure, "separation": separation, "force": force})
    if not any(controls.values()):
        raise TypeError("contact: give one of pressure, separation and force")
    if solid is None:
        raise TypeError("contact: give the solid that the surface is of, or the name of a material")
    solid = solid_of(solid)
    options = complete(CONTACT, settings)
    asked = _settings(solid, options)
    if edges is not None:
        surface = surface.treat(f"edges={edges}", progress=progress)
    asked.take_edges(surface._topography)
    options["boundary"] = asked.boundary
    _tabor.require_no_holes(surface._topography)
    with watching(progress) as told:
        records = _tabor.contacts(surface._topography, asked, controls["pressure"], controls["separation"], controls["force"], told)
    found = [Contact(record, surface, solid, options) for record in records]
    for one in found if check else []:
        if not one.converged:
            raise NotConverged(f"contact at {_tabor.format_si(one.mean_pressure, 'Pa')}: {one.values['status']} at "
                               f"certificate {one.certificate:.2g}, asked for {options['tolerance']:g}; check=False returns "
                               "it all the same", found[0] if single else found)
    for one in found:
        tell(one.warnings)
    return found[0] if single else found
