"""Results out of the files that ``save`` and the command line write (docs/results.md)."""

from __future__ import annotations

import os
import pathlib
from typing import Any

from ._arguments import File, typed
from ._combine import Combination, combination_of
from ._errors import InputError, require_file
from ._files import is_open_file, name_of, named_file
from ._groups import numbers_of, plain, texts_of
from ._optional import needs
from ._parameters import parameters_in
from ._read import read
from ._stored_films import solution_in, sweep_in
from ._stored_slides import slide_in
from ._stored_states import Opened, state_of
from ._study import Results

_TAKEN = ("load takes contacts, films, frictions, slides, combinations, parameters, solutions and sweeps of tabor.ehl, folders of "
          "studies, and surfaces")


def _combination_in(file: Any, path: Any) -> Combination:
    """Map, numbers and warnings of two scans put together."""
    opened = Opened(file, path)
    return combination_of(opened.surface, numbers_of(file["combination"]), texts_of(file, "warnings"))


def _states_in(file: Any, path: Any, name: str) -> Any:
    states = list(file["states"].values())
    if not any(hasattr(one, "shape") for one in states[0].values()):
        raise InputError(f"{name}: it holds numbers alone (fields=\"none\"); expected maps")
    if "spectra" in file:
        return slide_in(file, path)
    opened = Opened(file, path)
    found = [state_of(opened, one, i == 0) for i, one in enumerate(states)]
    return found[0] if len(found) == 1 else found


def _loaded(file: Any, path: Any, name: str) -> Any:
    kind = str(plain(file.attrs.get("kind", "")))
    if "sweep" in file and kind.endswith(" sweep"):
        return sweep_in(file)
    if kind.startswith("ehl ") and "result" in file:
        return solution_in(file, kind.removeprefix("ehl ").partition(" ")[0])
    if "combination" in file:
        return _combination_in(file, path)
    if "states" in file:
        return _states_in(file, path, name)
    if "table" in file and "scans" in file:
        return Results(pathlib.Path(name).parent)
    if list(file) == ["surface"]:
        return read(path)
    raise InputError(f"{name}: it holds {kind or ', '.join(file)}; {_TAKEN}")


def _begins_as_json(path: Any) -> bool:
    with open(path, "rb") as file:
        return file.read(1) == b"{"


@typed
def load(file: File) -> Any:
    """Takes results out of the file that ``save``, or the command line with ``-o``, wrote, or out of the folder of a
    study; needs h5py for all but parameters and studies.

    Parameters
    ----------
    file : its name, or an open binary file; or the folder of a study.

    Returns
    -------
    Contact, Film, Friction, FluidFilm, Slide, Combination, Parameters, Solution, Sweep, Results or Surface
        What was saved, with its surface, settings, warnings and references; a list where the file holds several. Maps
        are rounded to single precision unless they were saved with ``double=True``. ``values`` are those that the file
        holds: of the contact and the film of a friction, those that its table has.

    Raises
    ------
    FileNotFoundError
        Where there is no such file.
    ValueError
        For another file, and for one without maps.
    ImportError
        Without h5py.

    Examples
    --------
    >>> import pathlib, tempfile, tabor as tb
    >>> contact = tb.contact(tb.generate("edt", pixels=32, seed=1), "7 MPa", "aluminium-6016")
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     contact.save(pathlib.Path(folder, "contact.h5"))
    ...     again = tb.load(pathlib.Path(folder, "contact.h5"))
    >>> again.area_fraction == contact.area_fraction, again.solid == contact.solid
    (True, True)
    """
    if not is_open_file(file) and os.path.isdir(file):
        return Results(file)
    name = name_of(file) if is_open_file(file) else os.fspath(file)
    with named_file(file) as path:
        require_file(path)
        if _begins_as_json(path):
            return parameters_in(path, name)
        h5py = needs("h5py", "load()")
        try:
            opened = h5py.File(path, "r")
        except OSError as error:
            if not h5py.is_hdf5(path):
                raise InputError(f"{name}: no result file, which is HDF5 or JSON; tabor.read reads scans, tabor.Study a study file") from error
            raise InputError(f"{name}: no result file: {error}") from error
        with opened:
            if str(plain(opened.attrs.get("format", ""))) != "tabor":
                raise InputError(f"{name}: no result file of tabor; tabor.read reads scans")
            return _loaded(opened, path, name)
