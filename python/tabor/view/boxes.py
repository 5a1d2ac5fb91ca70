"""Nothing is trapped: the state in three languages to copy, and its files to take away."""

from __future__ import annotations

from collections.abc import Callable

from bokeh.models import Column, CustomJS, Row, TabPanel, Tabs
from bokeh.models.widgets import Button, Div, PreText

from . import texts
from .looks import STYLE
from .state import State

_COPY = """navigator.clipboard.writeText(text.text).then(() => { button.label = "Copied"
  setTimeout(() => { button.label = "Copy" }, 1200) })"""
_PRE = ":host { overflow-x: auto; } pre { background: #F4F4F2; border: 1px solid #DDD; padding: 8px; margin: 0; font: 13px/1.4 ui-monospace, monospace; white-space: pre-wrap; overflow-wrap: anywhere; }"
WRITTEN = {"scan": "Treated scan", "result": "Result file", "report": "Report page"}


class Boxes:
    """Shows a state as a command line, as Python and as a study file, each with a button that copies it."""

    def __init__(self, write: Callable[[str], None]) -> None:
        self._makers = {"Command line": texts.command_line, "Python": texts.python, "Study file": texts.study}
        self._texts = {title: PreText(text="", stylesheets=[_PRE], width=1180, name=f"text_{place}")
                       for place, title in enumerate(self._makers)}
        panels = []
        for place, (title, text) in enumerate(self._texts.items()):
            button = Button(label="Copy", width=70, name=f"copy_{place}")
            button.js_on_click(CustomJS(args={"text": text, "button": button}, code=_COPY))
            panels.append(TabPanel(title=title, child=Column(children=[text, button])))
        self.links = Div(stylesheets=[STYLE], name="links", width=700)
        buttons = [self._button(kind, label, write) for kind, label in WRITTEN.items()]
        self.view = Column(children=[Div(text="<h2>Exactly this, elsewhere</h2>", stylesheets=[STYLE]),
                                     Row(children=[*buttons, self.links]), Tabs(tabs=panels, name="texts")])

    def _button(self, kind: str, label: str, write: Callable[[str], None]) -> Button:
        button = Button(label=f"Write: {label.lower()}", width=150, name=f"write_{kind}")
        button.on_click(lambda: write(kind))
        return button

    def show(self, state: State) -> None:
        """Shows the texts of a state; files of the one before are no longer offered."""
        for title, make in self._makers.items():
            self._texts[title].text = make(state)
        self.links.text = ""
