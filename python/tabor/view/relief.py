"""The surface in three dimensions, to be turned with the pointer: a page of its own that plotly.js draws."""

from __future__ import annotations

import base64
import importlib.util
import json
import pathlib
from typing import Any

import numpy as np
from bokeh.models import Column
from bokeh.models.widgets import Div

from .._surface import Surface
from .looks import STYLE, limits, ordinal, unit_for
from .written import Folder, stem_of

MOST = 256  #: pixels of a side that are drawn; more are left out one after the other
_PAGE = pathlib.Path(__file__).with_name("relief.html")


def plotly_script() -> pathlib.Path | None:
    """plotly.js as the package plotly has it; the package itself is not loaded."""
    found = importlib.util.find_spec("plotly")
    if found is None or found.origin is None:
        return None
    script = pathlib.Path(found.origin).parent / "package_data" / "plotly.min.js"
    return script if script.is_file() else None


def relief_page(surface: Surface, script: str) -> str:
    """The page of a surface; ``script`` is the address of plotly.js."""
    step = max(1, -(-max(surface.shape) // MOST))
    heights = surface.height[::step, ::step]
    across, up = unit_for(max(surface.lengths)), unit_for(float(np.nanmax(heights) - np.nanmin(heights)))
    least, largest, low, high = limits(up.of(heights))
    facts: dict[str, Any] = {
        "shape": heights.shape, "pixel": [across.of(side) * step for side in surface.pixel], "lengths": [across.of(side) for side in surface.lengths],
        "across": across.name, "up": up.name, "scale": up.factor / across.factor, "ends": [least, largest], "colours": [low, high],
        "said": f"; every {ordinal(step)} pixel" if step > 1 else "",
        "name": stem_of(surface.source) + "_3d", "heights": base64.b64encode(up.of(heights).astype("<f4").tobytes()).decode()}
    return _PAGE.read_text("utf-8").replace("SCRIPT", script).replace("FACTS", json.dumps(facts))


class Relief:
    """Shows surfaces in a frame, written into the folder of the server."""

    def __init__(self, folder: Folder, address: str) -> None:
        self._folder, self._address = folder, address
        self._shown: Surface | None = None
        self._name = ""
        self.frame = Div(stylesheets=[STYLE], width=565, height=400, name="relief")
        self.view = Column(children=[self.frame])

    def show(self, surface: Surface) -> None:
        """Shows a surface, unless it is there already."""
        if surface is self._shown:
            return
        self._shown = surface
        script = plotly_script()
        if script is None:
            self.frame.text = "<p class='note'>The 3-D view needs plotly: pip install 'plotly>=6'</p>"
            return
        if not np.isfinite(surface.height).any():
            self.frame.text = "<p class='note'>There is no height to show.</p>"
            return
        address = f"{self._address}/file/{self._folder.offer(script)}"
        self._folder.drop(self._name)
        self._name = self._folder.write("relief.html", lambda file: _write(file, relief_page(surface, address)))
        self.frame.text = (f"<iframe src='{self._address}/file/{self._name}' title='3-D view of the surface' "
                           "style='width:565px;height:395px;border:0'></iframe>")


def _write(file: pathlib.Path, text: str) -> None:
    file.write_text(text, encoding="utf-8")
