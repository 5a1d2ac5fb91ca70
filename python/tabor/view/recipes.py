"""Recipes: named treatment chains, printed as the steps they stand for."""

from __future__ import annotations

import difflib
from typing import NamedTuple


class Recipe(NamedTuple):
    """A treatment chain with a name. It stands for its steps and for nothing else."""

    name: str
    purpose: str  #: one sentence: which surfaces it is for, and why these steps
    steps: tuple[str, ...]  #: as ``Surface.treat`` takes them


RECIPES = (
    Recipe("sheet", "a flat sheet: spikes become holes, holes are closed from their rims, the plane is subtracted",
           ("despike=auto", "fill=harmonic", "level=plane")),
    Recipe("part", "a curved part, cut out of a larger one: the same with a form of second order; mirror images continue it",
           ("despike=auto", "fill=harmonic", "level=poly2", "edges=cut")),
    Recipe("pad", "a pad whose body ends at the edges of the scan: pores are no spikes, so that heights stay; edges carry load",
           ("fill=nearest", "level=plane", "edges=end")),
)


def recipe(name: str) -> Recipe:
    """The recipe of a name. Raises ValueError that names the nearest one."""
    known = {one.name: one for one in RECIPES}
    if name not in known:
        near = difflib.get_close_matches(name, known, 1)
        hint = f"; did you mean {near[0]!r}?" if near else ""
        raise ValueError(f"recipe: got {name!r}; expected {', '.join(known)}{hint}")
    return known[name]


def said(one: Recipe) -> str:
    """The recipe as it is printed: its name and the steps it stands for."""
    return f"recipe {one.name}: {', '.join(one.steps)}"
