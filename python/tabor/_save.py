"""Results as the files that the command line writes."""

from __future__ import annotations

import os
import pathlib
from collections.abc import Sequence
from typing import Any

from . import _tabor
from ._contact import Contact
from ._friction import Film, FluidFilm, Friction
from ._progress import Progress, watching
from ._records import Record
from ._surface import Surface


def _target(file: str | os.PathLike[str], surface: Surface, fields: str, double: bool) -> _tabor.Target:
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
    settings.film = _shared(results, "rains", "film", "_options").settings(densities)
    settings.friction = _shared(results, "shear strengths", "_options").settings()
    fluids = [one for one in results if isinstance(one, FluidFilm)]
    if fluids:
        _shared(fluids, "speeds", "speed")
        settings.fluid = _shared(fluids, "lubricants", "lubricant")._settings(fluids[0].speed)
    _tabor.save_frictions(target, surface._topography, settings, [one._record for one in results],
                          [one.contact._record for one in results], [one.film._record for one in results],
                          [one._fluid for one in fluids], told)


def save(file: str | os.PathLike[str], results: Record | Sequence[Record], *, fields: str = "all",
         double: bool = False, progress: Progress = None) -> None:
    """Writes the file that the command line writes with ``-o`` (docs/results.md): ``tabor report`` and
    ``tabor cite`` read it, and ``read`` its surface.

    Parameters
    ----------
    file : its name, which ends with .h5, or with .vti for the maps alone, for ParaView.
    results : contacts, films, frictions or films that flow, of one surface and under the same settings but
        for pressure and density.
    fields : "all" maps; "contact", heights, pressure and film alone; or "none".
    double : maps in double precision.

    Raises
    ------
    ValueError
        For results that do not belong into one file.
    OSError
        Where it cannot be written; a file that is there stays as it is.
    """
    several: Sequence[Any] = [results] if isinstance(results, Record) else list(results)
    kinds = {type(one) for one in several}
    if len(kinds) != 1 or not isinstance(several[0], (Contact, Film, Friction)):
        raise ValueError("save: expected contacts, films or frictions, of one kind")
    first = several[0]
    of_contact = isinstance(first, Friction)
    surface: Surface = _shared(several, "surfaces", *(["contact", "surface"] if of_contact else ["surface"]))
    target = _target(file, surface, fields, double)
    settings = _tabor.CaseSettings()
    if isinstance(first, Contact):
        _shared(several, "solids", "solid")
        settings.contact = first._settings()
        _tabor.save_contacts(target, surface._topography, settings, [one._record for one in several])
    elif isinstance(first, Film):
        settings.film = _shared(several, "rains", "_options").settings([one.lubricant_density for one in several])
        _tabor.save_films(target, surface._topography, settings, [one._record for one in several])
    else:
        with watching(progress) as told:
            _save_frictions(target, surface, several, told)
