"""Recipes: named treatment chains, printed as the steps they stand for."""

from __future__ import annotations

import difflib
from typing import NamedTuple

from .. import _tabor


class Recipe(NamedTuple):
    """A treatment chain with a name. It stands for its steps and for nothing else."""

    name: str
    purpose: str  #: one sentence: which surfaces it is for, and why these steps
    steps: tuple[str, ...]  #: as ``Surface.treat`` takes them


RECIPES = tuple(Recipe(name, purpose, tuple(steps)) for name, purpose, steps in _tabor.recipes())


def recipe(name: str) -> Recipe:
    """The recipe of a name. Raises ValueError that names the nearest one."""
    known = {one.name: one for one in RECIPES}
    if name not in known:
        near = difflib.get_close_matches(name, known, 1)
        hint = f"; did you mean {near[0]!r}?" if near else ""
        raise ValueError(f"recipe: got {name!r}; expected {', '.join(known)}{hint}")
    return known[name]
