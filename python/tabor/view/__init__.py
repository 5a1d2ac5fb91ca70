"""A workbench for scans in the browser: treatment, contact, oil and friction, each seen before it is computed."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from .._arguments import Count, typed, wrong
from .._optional import needs
from .._surface import Surface

if TYPE_CHECKING:
    from .server import View

__all__ = ["view"]
_LAST_PORT = 65535


def _surfaces(given: Any) -> list[Surface]:
    found = [given] if isinstance(given, Surface) else list(given) if isinstance(given, Iterable) else []
    if not found or not all(isinstance(one, Surface) for one in found):
        raise wrong("surface", given, "a Surface, as tabor.read returns it, or a list of them")
    return found


@typed
def view(surface: Any, *, port: Count = 0, browser: bool = True, keep: bool = False, recipe: str | None = None) -> View:
    """Opens a workbench in the browser: the surface with its treatment, contact under a pressure, oil and friction, as
    they change while one moves (docs/view.md). Needs Bokeh: ``pip install tabor[report]``.

    Parameters
    ----------
    surface : Surface, or several side by side.
    port : of 127.0.0.1 [any that is free].
    browser : open the page. Its address is printed either way.
    keep : go on when the last page closes.
    recipe : treatment to begin with: "sheet", "part" or "pad" [none].

    Returns
    -------
    View
        with ``url``, ``wait()`` and ``close()``. The interpreter ends when it does.

    Examples
    --------
    >>> import tabor as tb
    >>> tb.view(tb.read("surfaces/edt_before.x3p"), recipe="sheet")  # doctest: +SKIP
    """
    surfaces = _surfaces(surface)
    if port > _LAST_PORT:
        raise ValueError(f"port: got {port}; expected at most {_LAST_PORT}, or 0 for any that is free")
    needs("bokeh", "view()")
    from .opening import Opened
    from .server import View, can_show
    from .state import State

    start = State("") if recipe is None else State("").following(recipe)
    found = View([Opened(one, start) for one in surfaces], port, keep)
    print(found.url, flush=True)
    if browser and can_show():
        found.show()
    return found
