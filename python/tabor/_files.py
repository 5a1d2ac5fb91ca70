"""Open files in place of names of files."""

from __future__ import annotations

import contextlib
import os
import pathlib
import shutil
import tempfile
from collections.abc import Iterator
from typing import Any


def is_open_file(value: Any) -> bool:
    """A file that was opened, or what reads like one."""
    return callable(getattr(value, "read", None))


def name_of(file: Any) -> str:
    """What messages call an open file."""
    name = getattr(file, "name", None)
    return name if isinstance(name, str) else "file"


@contextlib.contextmanager
def named_file(file: Any) -> Iterator[Any]:
    """The file itself where it is a name; else a copy with a name, for as long as it is read. Raises TypeError for a
    file that was opened as text."""
    if not is_open_file(file):
        yield file
        return
    start = file.read(0)
    if not isinstance(start, bytes):
        raise TypeError('file: got a file opened as text; expected a binary one, open(name, "rb")')
    with tempfile.TemporaryDirectory() as folder:
        copy = pathlib.Path(folder, os.path.basename(name_of(file)) or "file")
        with open(copy, "wb") as target:
            shutil.copyfileobj(file, target)
        yield copy
