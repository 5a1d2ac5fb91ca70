"""The page: a workbench for each scan, with axes that move together."""

from __future__ import annotations

import html
import os
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple, cast

from bokeh.application.application import SessionContext
from bokeh.document import Document
from bokeh.models import Column, TabPanel, Tabs
from bokeh.models.widgets import Div

from .._surface import Surface
from .desk import Desk
from .looks import STYLE
from .maps import Axes
from .state import State
from .written import Folder

#: Nothing but this server is asked for anything, whatever the page holds.
_POLICY = ("default-src 'self'; script-src 'self' 'unsafe-inline' 'unsafe-eval'; style-src 'self' 'unsafe-inline'; "
           "img-src 'self' data: blob:; connect-src 'self' ws://127.0.0.1:*; object-src 'none'; base-uri 'none'; form-action 'none'")
_TEMPLATE = """{% block preamble %}
<meta http-equiv="Content-Security-Policy" content="POLICY"><meta name="referrer" content="no-referrer"><link rel="icon" href="data:,">
<style>html, body { margin: 0; background: #FFF; } body { width: 1250px; margin: 0 auto; font: 14px/1.4 system-ui, sans-serif; }</style>
{% endblock %}""".replace("POLICY", _POLICY)


class Opened(NamedTuple):
    """A scan with the state that its workbench begins with."""

    scan: Surface
    state: State

    @property
    def name(self) -> str:
        """Of the file, without folders."""
        return os.path.basename(self.state.scan or self.scan.source) or "surface"


def fill(document: Document, opened: Sequence[Opened], folder: Folder, address: str) -> None:
    """Puts the workbenches into the document of one page."""
    document.title = "tabor view: " + ", ".join(one.name for one in opened)
    document.template = cast(Any, _TEMPLATE)  # a text is one, too
    shared: dict[tuple[float, float], Axes] = {}  # maps of one size move together
    desks = [Desk(one.scan, one.state, shared.setdefault(one.scan.lengths, Axes(one.scan)), _later(document), folder, address) for one in opened]
    title = "".join(f"<b>{html.escape(one.name)}</b>" for one in opened[:1]) if len(opened) == 1 else f"<b>{len(opened)} scans</b>"
    head = Div(text=f"<p>tabor view &nbsp; {title}</p>", stylesheets=[STYLE], name="head")
    body: Any = desks[0].view
    if len(desks) > 1:
        body = Tabs(tabs=[TabPanel(title=one.name, child=desk.view) for one, desk in zip(opened, desks)], name="scans")
    document.add_root(Column(children=[head, body], name="workbench"))

    def close(_: SessionContext) -> None:
        for desk in desks:
            desk.worker.close()

    document.on_session_destroyed(close)
    for desk in desks:
        desk.refresh()


def _later(document: Document) -> Callable[[Callable[[], Any]], Any]:
    return document.add_next_tick_callback
