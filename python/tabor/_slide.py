"""A rough tool that slides over a sheet."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar, Unpack

import numpy as np

from . import _tabor
from ._arguments import Path, typed
from ._contact import NotConverged, Solid, _settings, solid_of
from ._doubts import tell
from ._friction import film_settings, shear_settings
from ._progress import Progress, watching
from ._records import Fields, Shown, Warning, said, warnings_of
from ._setting_types import SlideSettings
from ._settings import CONTACT, DRY_BELOW, OWN_OF_SLIDE, RAIN, SHEAR, SLIDE, TRAPPED, complete, filled, takes
from ._maps import Array
from ._optional import needs
from ._surface import Surface
from ._values import Value, si, si_list


@dataclass(frozen=True, repr=False)
class Slide(Shown):
    """A sheet before, along and after sliding."""

    states: Mapping[str, Array]  #: numbers of the states by their keys, as of ``tabor slide --json``; docs/sliding.md
    maps: Mapping[int, Mapping[str, Array]]  #: of the states whose maps are kept: "sheet" [m], "pressure" [Pa], "gap" [m], shape (ny, nx), ...
    before: Mapping[str, Array]  #: spectra C1D of the sheet before: "q_x_rad_per_m", "psd_x_m3", the same of y
    spectra: Sequence[Mapping[str, Array]]  #: the same of the sheet at each state
    surface: Surface  #: the sheet before
    after: Surface  #: the sheet after sliding, unloaded
    step: float  #: [m]
    steps: int  #: so many
    steady: bool | None  #: where ``until_steady`` was asked for
    converged: bool  #: every contact along the way
    warnings: tuple[Warning, ...]
    references: tuple[str, ...]  #: to cite
    _slid: _tabor.Slid | None = field(compare=False)  # what a file is made of; None out of a file or a pickle
    _write: ClassVar[Callable[..., None]]  # ``tabor.save``, which puts itself here

    def to_xarray(self) -> Any:
        """A Dataset with the numbers of the states and the spectra over ``distance``, and the kept maps over
        ``kept_distance``, y and x, all with units; warnings and references are its attributes, so that it can be written
        as NetCDF; needs xarray."""
        xarray = needs("xarray", "to_xarray()")
        m, units = {"units": "m"}, _tabor.column_units()
        found: dict[str, Any] = {}
        for key, values in self.states.items():
            if key != "distance_m":
                numbers = values.astype(np.int8) if values.dtype == bool else values
                found[key] = ("distance", numbers, {"units": units[key]} if units.get(key) else {})
        for axis in "xy":
            rows = np.array([one[f"psd_{axis}_m3"] for one in self.spectra])
            found[f"psd_{axis}"] = (("distance", f"q_{axis}"), rows, {"units": "m^3"})
            found[f"psd_{axis}_before"] = (f"q_{axis}", self.before[f"psd_{axis}_m3"], {"units": "m^3"})
        gaps = np.full(self.surface.shape, np.nan)
        for name in dict.fromkeys(name for maps in self.maps.values() for name in maps):
            layers = np.array([maps.get(name, gaps) for maps in self.maps.values()])
            found[name] = (("kept_distance", "y", "x"), layers, {"units": "Pa" if "pressure" in name else "m"})
        distance = self.states["distance_m"]
        coords = {"distance": ("distance", distance, m), "kept_distance": ("kept_distance", distance[list(self.maps)], m),
                  "x": ("x", self.surface.x, m), "y": ("y", self.surface.y, m),
                  **{f"q_{axis}": (f"q_{axis}", self.before[f"q_{axis}_rad_per_m"], {"units": "rad/m"}) for axis in "xy"}}
        facts = {"step_m": self.step, "steps": self.steps, "converged": int(self.converged)}
        return xarray.Dataset(found, coords, {**facts, **said(self.warnings, self.references)})

    def _lines(self) -> list[tuple[str, str]]:
        distance = _tabor.format_si(float(self.states["distance_m"][-1]), "m")
        kinds = {"dry friction": "friction_dry", "lubricated friction": "friction_lubricated",
                 "with squeezed oil": "friction_lubricated_squeezed", "ploughing friction": "friction_ploughing"}
        last = {words: self.states[key][-1] for words, key in kinds.items() if key in self.states}
        lines = [("distance", f"{distance} in {self.steps} steps"),
                 ("states", f"{len(self.states['distance_m'])}, {len(self.maps)} of them with maps"),
                 *((words, f"{value:.4g} at the end") for words, value in last.items() if np.isfinite(value))]
        return [*lines, *([] if self.converged else [("converged", "no")]), *(("warning", one.text) for one in self.warnings)]

    def __getstate__(self) -> dict[str, Any]:
        kept = {number: {name: np.array(one) for name, one in maps.items()} for number, maps in self.maps.items()}
        return {**self.__dict__, "maps": kept, "_slid": None}

    @typed
    def save(self, file: Path, *, fields: Fields = "all", double: bool = False) -> None:
        """Writes the file of ``tabor slide -o``, as ``tabor.save`` does. Raises ValueError for a slide out of a file or a
        pickle, which lacks what its file is made of."""
        self._write(file, self, fields=fields, double=double)


def _case(solid: Solid, options: Mapping[str, object], density: float | None) -> _tabor.CaseSettings:
    settings = _tabor.CaseSettings()
    settings.contact = _settings(solid, {one.name: options[one.name] for one in CONTACT if one.name in options})
    shear = {one.name: options[one.name] for one in SHEAR + DRY_BELOW}
    shear["shear_strength"] = shear["shear_strength"] or solid.shear_strength
    settings.friction = shear_settings(shear)
    settings.film = film_settings({one.name: options[one.name] for one in RAIN}, [] if density is None else [density])
    settings.trapped = filled(_tabor.TrappedSettings(), {one.name: options[one.name] for one in TRAPPED})
    return settings


@takes(SLIDE)
def slide(surface: Surface, pressure: Value, solid: Solid | str, distance: Value | None = None, *, density: Value | None = None,
          maps_at: Value | Sequence[Value] | None = None, checkpoint: Path | None = None, check: bool = True,
          progress: Progress = None, **settings: Unpack[SlideSettings]) -> Slide:
    """Slides a rough tool over a sheet that yields (docs/sliding.md).

    Parameters
    ----------
    surface : the sheet, without holes.
    pressure : mean pressure [Pa].
    solid : Solid with a saturation pressure that the sheet is of, or the name of a material.
    distance : of sliding along x [m]; needed unless ``until_steady``, which ends after 20 lengths of the tool at most.
    density : of oil that is rained on the sheet before [kg/m^2].
    maps_at : distances whose maps are kept, beside those of both ends [m].
    checkpoint : folder that keeps the run while it lasts: the same call goes on after it was stopped.
    **settings
    check : raise NotConverged where a contact does not reach the tolerance; its ``result`` is what was reached.
    progress : see ``tabor.Progress``.

    Returns
    -------
    Slide
        Numbers of the states along the way, maps of some of them, spectra, and the sheet after.

    Raises
    ------
    ValueError
        Without a distance, a tool or a saturation pressure, for lengths that do not fit, for what ``contact`` rejects.
    NotConverged
        Unless ``check`` is False.

    Examples
    --------
    >>> import tabor as tb
    >>> sheet = tb.generate("edt", pixels=32, seed=1)
    >>> slid = tb.slide(sheet, "7 MPa", "aluminium-6016", "2.68 um", step="0.67 um", tool="ground:Sa=0.1um")
    >>> slid.steps, slid.after.shape
    (4, (32, 32))
    """
    options = complete(SLIDE, settings)
    solid = solid_of(solid)
    case = _case(solid, options, None if density is None else si(density, "areal_density", "density"))
    case.contact.take_edges(surface._topography)
    own = {one.name: options[one.name] for one in OWN_OF_SLIDE}
    sliding = filled(_tabor.SlideSettings(), {"distance": None if distance is None else si(distance, "length", "distance"), **own})
    if maps_at is not None:
        sliding.maps_at = si_list(maps_at, "length", "maps_at")[0]
    _tabor.require_no_holes(surface._topography)
    with watching(progress) as told:
        slid = _tabor.slide(surface._topography, case, sliding, si(pressure, "pressure", "pressure"), "" if checkpoint is None else checkpoint, told)
    states = {key: np.array(values, dtype=bool if key.endswith("converged") else float) for key, values in slid.states.items()}
    kept: dict[int, Mapping[str, Array]] = {}
    for number in range(len(states["distance_m"])):
        if maps := slid.maps(number):
            kept[number] = maps
    before, *spectra = ({key: np.array(values) for key, values in one.items()} for one in slid.spectra)
    found = Slide(states, kept, before, spectra, surface, Surface._of(slid.after), slid.step, slid.steps, slid.steady, slid.converged,
                  warnings_of(slid.warnings), tuple(slid.references), slid)
    if check and not found.converged:
        raise NotConverged("slide: a contact did not converge; check=False returns it all the same", found)
    tell(found.warnings)
    return found
