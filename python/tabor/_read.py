"""Surfaces out of scan files."""

from __future__ import annotations

import os
from typing import Unpack

from . import _tabor
from ._arguments import File
from ._errors import require_file
from ._files import name_of, named_file
from ._heights import pixel_sides
from ._progress import Progress, watching
from ._setting_types import ReadSettings
from ._settings import READ, complete, filled, takes
from ._surface import Surface


@takes(READ)
def read(file: File, *, channel: str | int | None = None, progress: Progress = None, **settings: Unpack[ReadSettings]) -> Surface:
    """Reads a scan file, recognised by its content (docs/formats.md).

    Parameters
    ----------
    file : its name, or an open binary file.
    **settings
    progress : see ``tabor.Progress``.

    Returns
    -------
    Surface
        With heights [m], NaN where there is none, source and warnings.

    Raises
    ------
    ValueError
        What is wrong with the file, or which of these it leaves open.
    InputFileNotFound
        Where there is no such file; a FileNotFoundError and a ValueError.

    Examples
    --------
    >>> import pathlib, tempfile, tabor as tb
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     tb.generate("edt", pixels=32, seed=1).save(pathlib.Path(folder, "sheet.sdf"))
    ...     sheet = tb.read(pathlib.Path(folder, "sheet.sdf"))
    >>> sheet.shape, sheet.format
    ((32, 32), 'sdf')
    """
    options = _tabor.ReadOptions()
    values = complete(READ, {**settings, "channel": None if channel is None else str(channel)})
    pixel = values.pop("pixel")
    if pixel is not None:
        options.pixel_x, options.pixel_y = pixel_sides(pixel)
    filled(options, values)
    with watching(progress) as told, named_file(file) as path:
        require_file(path)
        found = Surface._of(*_tabor.read(os.fspath(path), options, told))
    return found if path is file else found._named(name_of(file))
