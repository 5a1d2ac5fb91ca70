"""The page: a workbench for each scan, with axes that move together, and all of them side by side."""

from __future__ import annotations

import html
from collections.abc import Callable
from typing import Any, cast

from bokeh.application.application import SessionContext
from bokeh.document import Document
from bokeh.models import Column, TabPanel, Tabs
from bokeh.models.widgets import Div

from .asking import Asking
from .compare import Comparison
from .desk import Desk
from .looks import STYLE
from .maps import Axes
from .opening import Opened
from .written import Folder

#: Nothing but this server is asked for anything, whatever the page holds.
_POLICY = ("default-src 'self'; script-src 'self' 'unsafe-inline' 'unsafe-eval'; style-src 'self' 'unsafe-inline'; "
           "img-src 'self' data: blob:; connect-src 'self' ws://127.0.0.1:*; object-src 'none'; base-uri 'none'; form-action 'none'")
_TEMPLATE = """{% block preamble %}
<meta http-equiv="Content-Security-Policy" content="POLICY"><meta name="referrer" content="no-referrer"><link rel="icon" href="data:,">
<style>html, body { margin: 0; background: #FFF; } body { width: 1250px; margin: 0 auto; font: 14px/1.4 system-ui, sans-serif; }</style>
{% endblock %}""".replace("POLICY", _POLICY)
SIDE_BY_SIDE = "Side by side"


class Page:
    """The workbenches of one document. ``opened`` is that of the server: what the page was told of a file stays there."""

    def __init__(self, document: Document, opened: list[Opened], folder: Folder, address: str) -> None:
        self._later = _later(document)
        self._opened, self._folder, self._address = opened, folder, address
        self._shared: dict[tuple[float, float], Axes] = {}  # maps of one size move together
        self._desks: dict[int, Desk] = {}
        self._comparison: Comparison | None = None
        self._panels = [TabPanel(title=one.name, child=self._body(place)) for place, one in enumerate(opened)]
        self._tabs = Tabs(tabs=[*self._panels], name="scans")
        self._tabs.on_change("active", lambda _a, _o, _n: self._compare())
        self._add_comparison()
        title = html.escape(opened[0].name) if len(opened) == 1 else f"{len(opened)} scans"
        head = Div(text=f"<p>tabor view &nbsp; <b>{title}</b></p>", stylesheets=[STYLE], name="head")
        self._single = Column(children=[head, self._panels[0].child if len(opened) == 1 else self._tabs], name="workbench")
        document.add_root(self._single)

    def begin(self) -> None:
        """Computes what every workbench begins with."""
        for desk in self._desks.values():
            desk.refresh()

    def close(self) -> None:
        """Ends all computations."""
        for desk in self._desks.values():
            desk.worker.close()
        if self._comparison is not None:
            self._comparison.worker.close()

    def _body(self, place: int) -> Any:
        one = self._opened[place]
        if one.scan is None:
            return Asking(one, lambda found: self._answered(place, found)).view
        axes = self._shared.setdefault(one.scan.lengths, Axes(one.scan.lengths))
        others = {f"scan: {other.name}": other.state.scan for i, other in enumerate(self._opened) if i != place and other.state.scan}
        self._desks[place] = Desk(one, axes, others, self._later, self._compare, self._folder, self._address)
        return self._desks[place].view

    def _answered(self, place: int, found: Opened) -> None:
        """Puts the workbench of a file that is known now in the place of the questions."""
        self._opened[place] = found
        body = self._body(place)
        if len(self._opened) == 1:
            self._single.children = [self._single.children[0], body]
        else:
            self._panels[place].child = body
        self._desks[place].refresh()
        self._add_comparison()

    def _add_comparison(self) -> None:
        """Adds the tab that has all scans, once all are known."""
        if len(self._opened) < 2 or len(self._desks) < len(self._opened):
            return
        desks = [self._desks[place] for place in range(len(self._opened))]
        self._comparison = Comparison(desks, self._later, self._folder, self._address)
        self._tabs.tabs = [*self._panels, TabPanel(title=SIDE_BY_SIDE, child=self._comparison.view)]

    def _compare(self) -> None:
        """Renews the comparison, if it is what one looks at."""
        if self._comparison is not None and self._tabs.active == len(self._opened):
            self._comparison.refresh()


def _later(document: Document) -> Callable[[Callable[[], Any]], Any]:
    """Calls functions on the thread of the page, as long as there is one."""
    def call(function: Callable[[], Any]) -> None:
        try:
            document.add_next_tick_callback(function)
        except AttributeError:  # a document in pieces: its page has closed while a worker was busy
            if document.session_context is not None:
                raise
    return call


def fill(document: Document, opened: list[Opened], folder: Folder, address: str) -> None:
    """Puts the workbenches into the document of one page."""
    document.title = "tabor view: " + ", ".join(one.name for one in opened)
    document.template = cast(Any, _TEMPLATE)  # a text is one, too
    page = Page(document, opened, folder, address)

    def close(_: SessionContext) -> None:
        page.close()

    document.on_session_destroyed(close)
    page.begin()
