"""A rough tool that slides over a sheet."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Unpack

import numpy as np

from . import _tabor
from ._contact import NotConverged, Solid, _settings, solid_of
from ._friction import film_settings, shear_settings
from ._progress import Progress, watching
from ._records import Warning, warnings_of
from ._setting_types import SlideSettings
from ._settings import CONTACT, DRY_BELOW, RAIN, SHEAR, SLIDE, complete, filled, takes
from ._surface import Array, Surface
from ._values import Value, si


@dataclass(frozen=True)
class Slide:
    """A sheet before, along and after sliding."""

    states: Mapping[str, Array]  #: numbers of the states by their keys, as of ``tabor slide --json``; docs/sliding.md
    after: Surface  #: the sheet after sliding, unloaded
    step: float  #: [m]
    steps: int  #: so many
    converged: bool  #: every contact along the way
    warnings: tuple[Warning, ...]
    references: tuple[str, ...]  #: to cite

    def __repr__(self) -> str:
        return f"<Slide: {_tabor.format_si(float(self.states['distance_m'][-1]), 'm')} in {self.steps} steps, {len(self.states['distance_m'])} states>"


def _case(solid: Solid, options: Mapping[str, object], density: float | None) -> _tabor.CaseSettings:
    settings = _tabor.CaseSettings()
    settings.contact = _settings(solid, {one.name: options[one.name] for one in CONTACT if one.name in options})
    shear = {one.name: options[one.name] for one in SHEAR + DRY_BELOW}
    shear["shear_strength"] = shear["shear_strength"] or solid.shear_strength
    settings.friction = shear_settings(shear)
    settings.film = film_settings({one.name: options[one.name] for one in RAIN}, [] if density is None else [density])
    return settings


@takes(SLIDE)
def slide(surface: Surface, pressure: Value, solid: Solid | str, distance: Value, *, density: Value | None = None,
          check: bool = True, progress: Progress = None, **settings: Unpack[SlideSettings]) -> Slide:
    """Slides a rough tool over a sheet that yields (docs/sliding.md).

    Parameters
    ----------
    surface : the sheet, without holes.
    pressure : mean pressure [Pa].
    solid : Solid with a saturation pressure that the sheet is of, or the name of a material.
    distance : of sliding along x [m].
    density : of oil that is rained on the sheet before and stays on its pixels [kg/m^2].
    **settings
    check : raise NotConverged where a contact does not reach the tolerance; its ``result`` is what was reached.
    progress : see ``tabor.Progress``.

    Raises
    ------
    ValueError
        Without a tool or a saturation pressure, for lengths that do not fit, for what ``contact`` rejects.
    NotConverged
        Unless ``check`` is False.
    """
    options = complete(SLIDE, settings)
    solid = solid_of(solid)
    case = _case(solid, options, None if density is None else si(density, "areal_density", "density"))
    case.contact.take_edges(surface._topography)
    names = ("step", "every", "displaced", "reach")
    sliding = filled(_tabor.SlideSettings(), {"distance": si(distance, "length", "distance"), **{name: options[name] for name in names}})
    _tabor.require_no_holes(surface._topography)
    with watching(progress) as told:
        result = _tabor.slide(surface._topography, case, sliding, si(pressure, "pressure", "pressure"), told)
    states = {key: np.array(values, dtype=bool if key == "converged" else float) for key, values in result.states.items()}
    found = Slide(states, Surface._of(result.after), result.step, result.steps, result.converged, warnings_of(result.warnings),
                  tuple(result.references))
    if check and not found.converged:
        raise NotConverged("slide: a contact did not converge; check=False returns it all the same", found)
    return found
