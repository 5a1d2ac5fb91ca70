"""Nothing is trapped: the state in three languages to copy, and its files to take away."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from bokeh.models import Column, CustomJS, Row, TabPanel, Tabs
from bokeh.models.widgets import Button, Div, PreText, Select

from . import texts
from .looks import STYLE
from .state import State
from .written import scan_extensions

_COPY = """navigator.clipboard.writeText(text.text).then(() => { button.label = "Copied"
  setTimeout(() => { button.label = "Copy" }, 1200) })"""
_PRE = ":host { overflow-x: auto; } pre { background: #F4F4F2; border: 1px solid #DDD; padding: 8px; margin: 0; font: 13px/1.4 ui-monospace, monospace; white-space: pre-wrap; overflow-wrap: anywhere; }"
WRITTEN = {"result": "Write: result file", "report": "Write: report page"}


def copied_texts(titles: Mapping[str, str]) -> tuple[Any, dict[str, Any]]:
    """Tabs with a text and a button that copies it each, and the texts by their titles; ``titles`` says their names in
    the document."""
    found: dict[str, Any] = {}
    panels = []
    for title, name in titles.items():
        found[title] = PreText(text="", stylesheets=[_PRE], width=1180, name=f"text_{name}")
        button = Button(label="Copy", width=70, name=f"copy_{name}")
        button.js_on_click(CustomJS(args={"text": found[title], "button": button}, code=_COPY))
        panels.append(TabPanel(title=title, child=Column(children=[found[title], button])))
    return Tabs(tabs=panels), found


class ScanWriter:
    """A button that writes a scan file, and the format that it has."""

    def __init__(self, label: str, name: str, write: Callable[[str], None]) -> None:
        extensions: list[Any] = [*scan_extensions()]
        self._format = Select(options=extensions, value=extensions[0], width=75, name=f"{name}_format")
        button = Button(label=label, width=150, name=name)
        button.on_click(lambda: write(str(self._format.value)))
        self.view = Row(children=[button, self._format])


class Boxes:
    """Shows a state as a command line, as Python and as a study file, and writes its files. ``write`` is told the kind
    and, of a scan, the extension."""

    def __init__(self, write: Callable[[str, str], None]) -> None:
        self._makers = {"Command line": texts.command_line, "Python": texts.python, "Study file": texts.study}
        tabs, self._texts = copied_texts({title: str(place) for place, title in enumerate(self._makers)})
        self.links = Div(stylesheets=[STYLE], name="links", width=560)
        scan = ScanWriter("Write: treated scan", "write_scan", lambda extension: write("scan", extension))
        buttons = [self._button(kind, label, write) for kind, label in WRITTEN.items()]
        self.view = Column(children=[Div(text="<h2>Exactly this, elsewhere</h2>", stylesheets=[STYLE]),
                                     Row(children=[scan.view, *buttons, self.links]), tabs])

    def _button(self, kind: str, label: str, write: Callable[[str, str], None]) -> Button:
        button = Button(label=label, width=150, name=f"write_{kind}")
        button.on_click(lambda: write(kind, ""))
        return button

    def show(self, state: State) -> None:
        """Shows the texts of a state; files of the one before are no longer offered."""
        for title, make in self._makers.items():
            self._texts[title].text = make(state)
        self.links.text = ""
