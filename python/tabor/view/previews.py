"""Previews: the same computation on larger pixels, for the time until the full answer is there."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator
from contextlib import contextmanager

from .._surface import Surface

LIVE = 0.2  #: a move that takes no longer than this is computed at once [s]
#: Seconds for a pixel until a stage was timed on this machine; at most one of these is far off for one move.
_FIRST = {"contact": 3e-7, "oil": 1e-6, "friction": 5e-7, "parameters": 1e-6, "treatment": 1e-7}
_LEAST_SIDE = 32  #: pixels of a preview


class Pace:
    """How long each stage takes for a pixel, as it was timed last."""

    def __init__(self) -> None:
        self._seconds = dict(_FIRST)  # for a pixel

    @contextmanager
    def of(self, stage: str, surface: Surface) -> Iterator[None]:
        """Times a stage; one that is stopped teaches nothing."""
        begin = time.monotonic()
        yield
        self._seconds[stage] = (time.monotonic() - begin) / surface.size

    def expected(self, stage: str, surface: Surface) -> float:
        """[s]"""
        return self._seconds[stage] * surface.size


def coarser(surface: Surface, seconds: float, limit: float = LIVE) -> Surface | None:
    """The surface with pixels so large that what takes ``seconds`` on it stays within the limit; None where it does so
    as it is, or has holes."""
    if seconds <= limit or surface.n_holes:
        return None
    by = math.ceil(math.sqrt(seconds / limit))
    ny, nx = (max(side // by, min(side, _LEAST_SIDE)) for side in surface.shape)
    return None if (ny, nx) == surface.shape else surface.treat(f"resample={nx},{ny}")
