"""Slides out of their files (docs/sliding.md)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from . import _tabor
from ._groups import numbers_of, plain, texts_of, warnings_in
from ._maps import Array
from ._slide import Slide
from ._stored_states import Opened
from ._surface import Surface


def _numbers_of(file: Any, states: list[Any]) -> dict[str, Array]:
    """Numbers of all states by their keys, NaN where a state has none."""
    every = [numbers_of(one) for one in states]
    keys = [str(key) for key in file["columns"]["key"].asstr()[()] if key]
    return {key: np.array([one.get(key, np.nan) for one in every], dtype=bool if key.endswith("converged") else float) for key in keys}


def _maps_of(state: Any) -> dict[str, Array]:
    return {name: np.ascontiguousarray(one[()], dtype=np.float64) for name, one in state.items()
            if getattr(one, "ndim", 0) == 2 and name != "state"}


def _spectra_of(group: Any) -> dict[str, Array]:
    return {name: one[()] for name, one in group.items()}


def _after(sheet: Surface, maps: Mapping[str, Array], note: str) -> Surface:
    """The sheet after sliding: that of the last state."""
    return Surface._of(_tabor.with_heights(sheet._topography, maps["sheet"], note, None))


def slide_in(file: Any, path: Any) -> Slide:
    """The slide with all that its file holds."""
    opened = Opened(file, path)
    group = file["states"]
    states = list(group.values())
    numbers = _numbers_of(file, states)
    kept = {i: maps for i, maps in enumerate(map(_maps_of, states)) if maps}
    steady = group.attrs.get("steady")
    note = str(plain(group.attrs.get("history", "slide")))
    return Slide(states=numbers, maps=kept, before=_spectra_of(file["spectra/before"]),
                 spectra=[_spectra_of(file[f"spectra/{name}"]) for name in group], surface=opened.surface,
                 after=_after(opened.surface, kept[max(kept)], note), step=float(group.attrs["step_m"]), steps=int(group.attrs["steps"]),
                 steady=None if steady is None else bool(steady), converged=bool(numbers["converged"][-1]),
                 warnings=warnings_in(file), references=texts_of(file, "methods"), _slid=None)
