"""Results as the files that the command line writes."""

from __future__ import annotations

import os
import pathlib
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from . import _tabor
from ._arguments import Path, typed, wrong
from ._combine import Combination
from ._contact import Contact
from ._friction import Film, FluidFilm, Friction, film_settings, shear_settings
from ._parameters import Parameters
from ._progress import Progress, watching
from ._records import Fields, Record
from ._settings import filled
from ._slide import Slide
from ._surface import Surface
from ._sweep import Sweep
from .ehl import Solution


def _target(file: Path, surface: Surface, fields: str, double: bool) -> _tabor.Target:
    path = pathlib.Path(file)
    if path.suffix not in (".h5", ".hdf5", ".vti"):
        raise ValueError(f"{path}: expected a name that ends with .h5, .hdf5 or .vti")
    if path.exists() and os.path.exists(surface.source) and os.path.samefile(path, surface.source):
        raise ValueError(f"{path}: it is the scan that the results are of; choose another name")
    return _tabor.Target(path, fields, double, surface._sha256)


def _shared(results: Sequence[Any], what: str, *names: str) -> Any:
    """What all have in common by these names; ValueError where they differ."""
    parts = list(results)
    for name in names:
        parts = [getattr(one, name) for one in parts]
    if any(part is not parts[0] and part != parts[0] for part in parts):
        raise ValueError(f"save: got results of several {what}; a file holds those of one")
    return parts[0]


def _save_frictions(target: _tabor.Target, surface: Surface, results: Sequence[Friction], told: Any) -> None:
    _shared(results, "solids", "contact", "solid")
    settings = _tabor.CaseSettings()
    settings.contact = results[0].contact._settings()
    densities = list(dict.fromkeys(one.film.lubricant_density for one in results))
    settings.film = film_settings(_shared(results, "rains", "film", "_options"), densities)
    settings.friction = shear_settings(_shared(results, "shear strengths", "_options"))
    trapped = [one._trapped for one in results if one._trapped is not None]
    if trapped:
        oil = _shared(results, "settings of trapped oil", "_oil")
        settings.trapped = filled(_tabor.TrappedSettings(), oil)
    fluids = [one for one in results if isinstance(one, FluidFilm)]
    if fluids:
        _shared(fluids, "speeds", "speed")
        settings.fluid = _shared(fluids, "lubricants", "lubricant")._settings(fluids[0].speed)
    _tabor.save_frictions(target, surface._topography, settings, [one._record for one in results],
                          [one.contact._record for one in results], [one.film._record for one in results],
                          trapped, [one._fluid for one in fluids], told)


def _records(results: Any) -> Sequence[Any]:
    """Records of one kind."""
    expected = ("a Contact, Film, Friction or FluidFilm, a list of one kind of these, "
                "or a Slide, Combination, Solution, Sweep or Parameters")
    if isinstance(results, Surface):
        raise wrong("results", results, f"{expected}; Surface.save writes a surface")
    if not isinstance(results, (Record, Iterable)) or isinstance(results, (str, bytes, Mapping)):
        raise wrong("results", results, expected)
    several = [results] if isinstance(results, Record) else list(results)
    for one in several:
        if not isinstance(one, (Contact, Film, Friction)):
            raise wrong("results", several, expected)
    kinds = dict.fromkeys(type(one).__name__ for one in several)
    if len(kinds) != 1:
        raise ValueError(f"results: got {' and '.join(kinds) or 'an empty list'}; expected contacts, films or frictions, of one kind")
    return several


def _surface(results: Sequence[Any]) -> Surface:
    """The one that all are of, by its heights."""
    pressed = [one.contact if isinstance(one, Friction) else one for one in results]
    if any(one._record.surface != pressed[0]._record.surface for one in pressed):
        raise ValueError("save: got results of several surfaces; a file holds those of one")
    found: Surface = pressed[0].surface
    return found


@typed
def save(file: Path, results: Record | Iterable[Record] | Slide | Combination | Parameters | Solution | Sweep, *, fields: Fields = "all",
         double: bool = False, progress: Progress = None) -> None:
    """Writes the file that the command line writes with ``-o`` (docs/results.md): ``tabor report`` and
    ``tabor cite`` read it, and ``read`` its surface.

    Parameters
    ----------
    file : its name, which ends with .h5, or with .vti for the maps alone, for ParaView.
    results : contacts, films, frictions or films that flow, of one surface and under the same settings but
        for pressure and density; or one slide, combination, solution or sweep of ``ehl``; or parameters, whose file ends
        with .json.
    fields : "all" maps; "contact", heights, pressure and film alone; or "none".
    double : maps in double precision.
    progress : see ``tabor.Progress``.

    Raises
    ------
    ValueError
        For results that do not belong into one file.
    OSError
        Where it cannot be written; a file that is there stays as it is.

    Examples
    --------
    >>> import pathlib, tempfile, tabor as tb
    >>> sheet = tb.generate("edt", pixels=32, seed=1)
    >>> contacts = tb.contact(sheet, ["2 MPa", "7 MPa"], "aluminium-6016")
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     tb.save(pathlib.Path(folder, "contacts.h5"), contacts)
    ...     tb.read(pathlib.Path(folder, "contacts.h5")).shape
    (32, 32)
    """
    if isinstance(results, Slide):
        if results._slid is None:
            raise ValueError("save: what the file of a slide is made of does not travel with a pickle or a file; save it where it slides")
        return results._slid.save(_target(file, results.surface, fields, double))
    if isinstance(results, (Combination, Parameters, Solution, Sweep)):
        return results.save(file)
    several = _records(results)
    first = several[0]
    surface = _surface(several)
    target = _target(file, surface, fields, double)
    settings = _tabor.CaseSettings()
    if isinstance(first, Contact):
        _shared(several, "solids", "solid")
        settings.contact = first._settings()
        _tabor.save_contacts(target, surface._topography, settings, [one._record for one in several])
    elif isinstance(first, Film):
        settings.film = film_settings(_shared(several, "rains", "_options"), [one.lubricant_density for one in several])
        _tabor.save_films(target, surface._topography, settings, [one._record for one in several])
    else:
        with watching(progress) as told:
            _save_frictions(target, surface, several, told)


Record._write = Slide._write = staticmethod(save)
