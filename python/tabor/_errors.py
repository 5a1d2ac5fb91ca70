"""Errors that are both what the library says and what users of NumPy expect."""

from __future__ import annotations

import errno
import os
from typing import Any

from . import _tabor


class InputError(ValueError):
    """What is given cannot be read or makes no sense; a ValueError."""


class InputIncomplete(InputError):
    """A file that is sound but leaves open what only the user knows: a unit, the side of a pixel, which channel."""


class OutputError(OSError):
    """A result cannot be written; an OSError."""


class InputFileNotFound(InputError, FileNotFoundError):
    """A file that is not there: a FileNotFoundError, and a ValueError as other faults of input are."""

    def __init__(self, text: str, file: str = "") -> None:
        super().__init__(text)
        self.errno = errno.ENOENT
        self.filename = file or None

    def __str__(self) -> str:
        return str(self.args[0])

    def __reduce__(self) -> tuple[Any, ...]:
        return InputFileNotFound, (self.args[0], self.filename or "")


def require_file(file: Any) -> None:
    """InputFileNotFound where a name is that of no file."""
    name = os.fspath(file)
    if not os.path.exists(name):
        raise InputFileNotFound(f"{name}: no such file", name)


_tabor.take_errors(InputError, InputIncomplete, OutputError)
