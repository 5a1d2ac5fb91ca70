"""Surfaces that are made, and the formats of those that are read."""

from __future__ import annotations

from typing import NamedTuple, Unpack

from . import _tabor
from ._arguments import Seed
from ._setting_types import GenerateSettings, RecipeKind
from ._settings import PIXELS, RECIPE, complete, takes
from ._surface import Surface


@takes(PIXELS + RECIPE)
def generate(kind: RecipeKind, *, seed: Seed = 1, **settings: Unpack[GenerateSettings]) -> Surface:
    """Makes a surface; the same arguments give the same bits, on any number of threads.

    Parameters
    ----------
    kind : "self-affine", "edt", "ground", "sinusoid", "sphere" or "bump".
    **settings
    seed : of random numbers.

    Returns
    -------
    Surface
        With heights [m] on the grid that was asked for.

    Raises
    ------
    ValueError
        For an unknown kind, and for settings that do not belong to it, are missing or out of range.

    Examples
    --------
    >>> import tabor as tb
    >>> tb.generate("sinusoid", pixels=64, pixel="1 um", amplitude="1 um", wavelength_x="16 um").periodic
    True
    """
    request = _tabor.GenerateRequest()
    given = complete(PIXELS + RECIPE, settings)
    request.set_grid(given["pixels"], given["pixel"])
    request.kind = kind
    request.seed = seed
    for one in RECIPE:
        value = given[one.name]
        says_nothing = value is None or (one.kind in ("flag", "word") and value == one.default)
        if one.argument in settings and not says_nothing:
            request.set(one.name, value)
    return Surface._of(_tabor.generate(request))


class Format(NamedTuple):
    """A format of scan files."""

    name: str
    description: str
    extensions: tuple[str, ...]
    reads: bool
    writes: bool
    via_gwyddion: bool  #: only where Gwyddion is installed


def formats() -> tuple[Format, ...]:
    """The formats that ``read`` and ``Surface.save`` know, as ``tabor formats`` lists them.

    Returns
    -------
    tuple of Format
        With names, extensions and whether they are read and written.

    Examples
    --------
    >>> import tabor as tb
    >>> [one.name for one in tb.formats() if ".x3p" in one.extensions]
    ['x3p']
    """
    return tuple(Format(name, text, tuple(extensions), *can) for name, text, extensions, *can in _tabor.formats())
