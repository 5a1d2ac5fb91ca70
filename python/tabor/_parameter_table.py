"""Roughness parameters of many scans in one table."""

from __future__ import annotations

import glob
import os
import pathlib
import re
from collections.abc import Iterable, Iterator, Sequence
from typing import Any, Unpack

from ._arguments import path, texts, wrong
from ._errors import InputError
from ._optional import needs
from ._parameters import Parameters
from ._progress import Progress
from ._read import read
from ._setting_types import ReadSettings
from ._settings import READ, takes
from ._surface import Surface

_EXPECTED = 'a pattern of files ("scans/*.x3p"), or a list of files and Surfaces'


def _files(value: Any) -> Iterator[Any]:
    """Files of a pattern in the order of their names; a file or a surface as it is."""
    if isinstance(value, Surface):
        yield value
        return
    text = os.fspath(path(value, "scans"))
    if os.path.exists(text) or not glob.has_magic(text):
        yield text
        return
    found = sorted(glob.glob(text, recursive=True))
    if not found:
        raise ValueError(f"scans: got {text!r}, which no file fits; expected {_EXPECTED}")
    yield from found


def _scans(scans: Any) -> list[Any]:
    if isinstance(scans, (str, os.PathLike, Surface)):
        scans = [scans]
    if not isinstance(scans, Iterable) or isinstance(scans, (bytes, dict)):
        raise wrong("scans", scans, _EXPECTED)
    given = list(scans)
    for one in given:
        if not isinstance(one, (str, os.PathLike, Surface)):
            raise wrong("scans", given, _EXPECTED)
    found = [file for one in given for file in _files(one)]
    if not found:
        raise ValueError(f"scans: got an empty list; expected {_EXPECTED}")
    return found


def _form_of(fields: str) -> re.Pattern[str]:
    """The expression that "{group}_{place}" stands for."""
    parts = re.split(r"\{(\w*)\}", fields)
    names = parts[1::2]
    for name in names:
        if not name.isidentifier() or names.count(name) > 1:
            raise ValueError(f"fields: got {fields!r}; expected different names in braces, such as \"{{group}}_{{place}}\"")
    if not names:
        raise ValueError(f"fields: got {fields!r} without a name in braces; expected such as \"{{group}}_{{place}}\"")
    return re.compile("".join(f"(?P<{part}>.+?)" if i % 2 else re.escape(part) for i, part in enumerate(parts)))


def _fields_of(name: str, form: re.Pattern[str], fields: str) -> dict[str, Any]:
    """Fields of the name of a file, with or without its extension; whole numbers as such."""
    found = form.fullmatch(pathlib.Path(name).stem) or form.fullmatch(name)
    if found is None:
        raise ValueError(f"fields: got {fields!r}, which does not fit the name {name!r}")
    return {key: int(text) if text.isdecimal() else text for key, text in found.groupdict().items()}


def _measured(surface: Surface, steps: Sequence[str], symbols: Iterable[str] | None, progress: Progress) -> Parameters:
    """Parameters of one surface after its treatment, in whose errors the surface is named."""
    try:
        treated = surface.treat(*steps, progress=progress) if steps else surface
    except InputError as error:
        raise type(error)(f"{surface.source}: {error}") from error
    return treated.parameters(symbols, progress=progress)


@takes(READ)
def parameters(scans: Any, symbols: Iterable[str] | None = None, *, treatment: Sequence[str] = (), fields: str | None = None,
               channel: str | int | None = None, progress: Progress = None, **settings: Unpack[ReadSettings]) -> Any:
    """Roughness parameters of many scans as a DataFrame of pandas, a row for each; needs pandas.

    Parameters
    ----------
    scans : a pattern of files, ``"scans/*.x3p"``, or a list of files, patterns and Surfaces.
    symbols : those of ``Surface.parameters``: symbols, and sets such as "hybrid" [all].
    treatment : steps that each scan goes through, "level=plane".
    fields : form of the names of the files, with columns in braces: "{group}_{place}" gives the columns ``group`` and
        ``place``; whole numbers become such.
    **settings
    progress : see ``tabor.Progress``.

    Returns
    -------
    DataFrame
        Columns: the fields, then the parameters [SI]; the index ``scan`` has the names of the scans, and
        ``attrs["units"]`` the unit of each symbol.

    Raises
    ------
    ValueError
        For the first scan that cannot be read or treated, which it names; for unknown symbols, and names that the form
        does not fit.
    ImportError
        Without pandas.

    Examples
    --------
    >>> import tabor as tb
    >>> rough = [tb.generate("edt", pixels=64, seed=seed) for seed in (1, 2)]
    >>> table = tb.parameters(rough, ["Sa", "Sq"], treatment=["level=plane"])
    >>> table.shape, table.attrs["units"]
    ((2, 2), {'Sa': 'm', 'Sq': 'm'})
    """
    pandas = needs("pandas", "parameters()")
    form = None if fields is None else _form_of(fields)
    steps = texts(treatment, "treatment")
    rows: dict[str, dict[str, Any]] = {}
    units: dict[str, str] = {}
    for scan in _scans(scans):
        surface = scan if isinstance(scan, Surface) else read(scan, channel=channel, progress=progress, **settings)
        name = unique = surface.name
        while unique in rows:  # two folders may have files of one name
            unique = surface.source if unique == name != surface.source else f"{unique}'"
        found = _measured(surface, steps, symbols, progress)
        units.update({symbol: one.unit for symbol, one in found.items()})
        named = {} if form is None else _fields_of(name, form, fields or "")
        rows[unique] = {**named, **{symbol: float(one) for symbol, one in found.items()}}
    table = pandas.DataFrame(list(rows.values()), index=pandas.Index(rows, name="scan"))
    table.attrs["units"] = units
    return table
