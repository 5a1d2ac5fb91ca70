"""Reasons to doubt a number as warnings of Python, which a user filters as those of other packages."""

from __future__ import annotations

import os
import sys
import threading
import warnings
from collections.abc import Iterable
from typing import Any

from ._records import Warning

_PACKAGE = os.path.dirname(__file__) + os.sep
_told: set[str] = set()  #: codes that were told under these filters
_filters: tuple[Any, list[Any]] = (None, [])  #: the list of Python's filters, and what was in it
_silent = threading.local()  #: .here: True on threads whose doubts are shown otherwise


class Doubt(UserWarning):
    """A reason to doubt a number, given to ``warnings.warn`` when a result with it is computed.

    Each ``code`` is told once, and again after the filters of warnings have changed; the ``warnings`` of a result list
    all of its own. ``docs/warnings.md`` says what each means.

    Examples
    --------
    >>> import warnings, tabor as tb
    >>> warnings.simplefilter("ignore", tb.Doubt)  # tell none; "error" makes them errors
    """

    code: str  #: "clamp", as in docs/warnings.md; "" for one without

    def __init__(self, text: str, code: str = "") -> None:
        super().__init__(text)
        self.code = code


def _level_of_user() -> int:
    """The ``stacklevel`` at which the caller of the package stands."""
    frame, level = sys._getframe(1), 1
    while frame.f_back is not None and frame.f_code.co_filename.startswith(_PACKAGE):
        frame, level = frame.f_back, level + 1
    return level


def tell_none_here() -> None:
    """Ends the warnings of this thread: a page shows its doubts beside the numbers."""
    _silent.here = True


def tell(found: Iterable[Warning]) -> None:
    """Gives doubts that were not told yet to ``warnings.warn``."""
    global _filters
    if getattr(_silent, "here", False):
        return
    if _filters[0] is not warnings.filters or _filters[1] != warnings.filters:
        _filters = warnings.filters, list(warnings.filters)
        _told.clear()
    for one in found:
        key = one.code or one.text
        if one.kind != "doubt" or key in _told:
            continue
        warnings.warn(Doubt(f"{one.text} [{one.code}]" if one.code else one.text, one.code), stacklevel=_level_of_user())
        _told.add(key)  # where a filter makes it an error, it is told each time
