"""Friction of a contact against the density of the oil."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, NamedTuple, Unpack, overload

import numpy as np

from . import _tabor
from ._arguments import Axes, typed, wrong
from ._contact import Contact
from ._friction import Friction, film_settings, shear_of, shear_settings
from ._maps import Array
from ._optional import needs
from ._progress import Progress, watching
from ._records import Shown
from ._setting_types import CurveSettings
from ._settings import CURVE, complete, takes
from ._values import Value, si_list


class Plateau(NamedTuple):
    """Densities of the oil over which friction hardly changes: from the one that fills the pockets under the
    contacts to the one whose level reaches the contacts."""

    first: float  #: [kg/m^2]
    last: float  #: [kg/m^2]
    dry_share: float  #: mean share of the contact that stays dry
    below: float | None = None  #: [kg/m^2] next density of the curve before it: the lower edge lies between
    beyond: float | None = None  #: [kg/m^2] next density behind it: the upper edge lies between


@dataclass(frozen=True, eq=False, repr=False)
class DensityCurve(Shown):
    """Friction of one contact against the areal density of the oil, in steps of at most 5 %, for vanishing
    droplets."""

    mean_pressure: float  #: [Pa]
    friction_dry: float
    lubricant_density: Array  #: [kg/m^2], rising
    lubricated_share: Array  #: of the contact
    friction_lubricated: Array
    plateau: Plateau | None  #: None where friction changes throughout

    def says(self, density: Value | Friction | Iterable[Value | Friction] = ()) -> str:
        """The curve in one sentence, and where densities [kg/m^2] lie on it, by the wet share that it has there; of
        frictions, by theirs."""
        is_one = isinstance(density, (str, Friction)) or not isinstance(density, Iterable)
        given: Any = [density] if is_one else density
        several = list(given)
        asked: list[tuple[float, float | None]] = []
        if any(isinstance(one, Friction) for one in several):
            asked = [(one.film.lubricant_density, one.lubricated_share) for one in several]
        elif several:
            asked = [(one, None) for one in si_list(several, "areal_density", "density")[0]]
        return _tabor.density_sentence((self.mean_pressure, self.friction_dry, self.lubricant_density.tolist(),
                                        self.lubricated_share.tolist(), self.friction_lubricated.tolist(),
                                        self.plateau), asked)

    @typed
    def plot(self, ax: Axes = None, **style: Any) -> Any:
        """Draws friction over the density; needs matplotlib. Returns the axes."""
        ax = ax or needs("matplotlib.pyplot", "plot()").gca()
        ax.semilogx(self.lubricant_density * 1e3, self.friction_lubricated, **style)
        ax.set_xlabel("lubricant density [g/m²]")
        ax.set_ylabel("friction")
        return ax

    def to_xarray(self) -> Any:
        """Friction and wet share as a Dataset over ``lubricant_density`` [kg/m^2], pressure, dry friction and plateau
        as its attributes, to be written as NetCDF; needs xarray."""
        xarray = needs("xarray", "to_xarray()")
        dim = "lubricant_density"
        facts = {"mean_pressure_Pa": self.mean_pressure, "friction_dry": self.friction_dry}
        if self.plateau is not None:
            facts.update({f"plateau_{name}": float(value) for name, value in self.plateau._asdict().items() if value is not None})
        return xarray.Dataset({"friction_lubricated": (dim, self.friction_lubricated, {"long_name": "friction"}),
                               "lubricated_share": (dim, self.lubricated_share, {"long_name": "wet share of the contact"})},
                              {dim: (dim, self.lubricant_density, {"units": "kg/m^2"})}, facts)

    def _lines(self) -> list[tuple[str, str]]:
        density, friction = 1e3 * self.lubricant_density, self.friction_lubricated
        lines = [("pressure", _tabor.format_si(self.mean_pressure, "Pa")),
                 ("density", f"{density[0]:.4g} to {density[-1]:.4g} g/m², {density.size} points"),
                 ("friction", f"{self.friction_dry:.4g} dry, {friction.min():.4g} to {friction.max():.4g} with oil")]
        if self.plateau is not None:
            lines.append(("plateau", f"{1e3 * self.plateau.first:.4g} to {1e3 * self.plateau.last:.4g} g/m²"))
        return lines


def _contacts(contact: Any) -> list[Contact]:
    if isinstance(contact, Contact):
        return [contact]
    expected = "a Contact, as tabor.contact returns it, or a list of them"
    if not isinstance(contact, Iterable):
        raise wrong("contact", contact, expected)
    contacts = list(contact)
    for one in contacts:
        if not isinstance(one, Contact):
            raise wrong("contact", contacts, expected)
    if not contacts:
        raise ValueError("contact: got an empty list; expected at least one contact")
    return contacts


@overload
def density_curve(contact: Contact, *, density: Value | Iterable[Value] = ..., progress: Progress = ...,
                  **settings: Unpack[CurveSettings]) -> DensityCurve: ...
@overload
def density_curve(contact: Iterable[Contact], *, density: Value | Iterable[Value] = ..., progress: Progress = ...,
                  **settings: Unpack[CurveSettings]) -> list[DensityCurve]: ...
@takes(CURVE)
def density_curve(contact: Any, *, density: Value | Iterable[Value] = (), progress: Progress = None,
                  **settings: Unpack[CurveSettings]) -> Any:
    """Friction against the density of the oil, from one pass of vanishing droplets (docs/lubrication.md).

    Parameters
    ----------
    contact : Contact, or a list of contacts of one surface and solid, which gives a list.
    density : densities [kg/m^2] that become points of the curve beside its round ones.
    **settings
    progress : see ``tabor.Progress``.

    Returns
    -------
    DensityCurve
        Friction and wet share over the density [kg/m^2]; a list of curves for a list of contacts.

    Raises
    ------
    ValueError
        As ``friction`` and ``rain`` do; for a surface without heights, and for contacts that differ in more
        than the pressure.

    Examples
    --------
    >>> import tabor as tb
    >>> sheet = tb.generate("edt", pixels=64, seed=1)
    >>> curve = tb.density_curve(tb.contact(sheet, "7 MPa", "aluminium-6016"), boundary_shear_strength="5 MPa")
    >>> bool(curve.friction_lubricated.min() < curve.friction_dry)
    True
    """
    contacts = _contacts(contact)
    first = contacts[0]
    if any(one._record.surface != first._record.surface or one.solid != first.solid for one in contacts):
        raise ValueError("contact: got contacts of several surfaces or solids; expected those of one")
    given: Any = density
    asked = complete(CURVE, settings)
    film = film_settings({"model": "limit", **{one.name: asked[one.name] for one in CURVE if one.table == "film"}},
                         si_list(given, "areal_density", "density")[0] if np.size(given) else [])
    shear = shear_settings(shear_of(first, settings))
    with watching(progress) as told:
        rows = _tabor.density_curves(first.surface._topography, [one._record for one in contacts], first._settings(),
                                     film, shear, told)
    if not rows:
        raise ValueError("surface: got one without heights; expected a rough one, on which oil runs downhill")
    curves = [DensityCurve(pressure, dry, np.array(density), np.array(share), np.array(wet),
                           None if plateau is None else Plateau(*plateau))
              for pressure, dry, density, share, wet, plateau in rows]
    return curves[0] if isinstance(contact, Contact) else curves
