"""A file that leaves its unit, pixel or channel open: the page asks for what is missing."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from bokeh.models import Column
from bokeh.models.widgets import Button, Div, TextInput

from .._settings import READ
from .looks import STYLE, failure_html
from .opening import Opened, opened


class Asking:
    """Fields for what a file does not say; ``found`` is told once it can be read."""

    def __init__(self, asked: Opened, found: Callable[[Opened], None]) -> None:
        self._asked, self._found = asked, found
        given = dict(asked.state.reading)
        self._fields = {one.name: TextInput(title=f"{one.help[0].upper()}{one.help[1:]}", value=given.get(one.name, ""), width=360,
                                            placeholder=f"such as {one.example}", name=f"ask_{one.name}") for one in READ if one.kind != "flag"}
        self._said = Div(text=failure_html(asked.asks), stylesheets=[STYLE], width=900, name="asks")
        open_button = Button(label="Open", width=100, name="open", button_type="primary")
        open_button.on_click(self._try)
        self.view: Any = Column(children=[self._said, *self._fields.values(), open_button])

    def _try(self) -> None:
        typed = tuple((name, str(field.value).strip()) for name, field in self._fields.items() if str(field.value).strip())
        switches = tuple(one for one in self._asked.state.reading if one[0] not in self._fields)
        try:
            result = opened(replace(self._asked.state, reading=typed + switches))
        except (ValueError, OSError) as error:
            self._said.text = failure_html(str(error))
            return
        if result.scan is None:
            self._said.text = failure_html(result.asks)
        else:
            self._found(result)
