"""Pictures of the page as files: each figure has a button for PNG and one for SVG."""

from __future__ import annotations

import base64
from typing import Any

from bokeh.models import CustomAction, CustomJS

_SAVE = """const view = plot.document.views_manager.find_one(plot)
view.export(kind).to_blob().then((blob) => {
  const link = document.createElement("a")
  link.href = URL.createObjectURL(blob)
  link.download = name + "." + kind
  link.click()
  setTimeout(() => URL.revokeObjectURL(link.href), 10000) })"""
_ICON = """<svg xmlns="http://www.w3.org/2000/svg" width="30" height="20" viewBox="0 0 30 20"><rect x="1" y="3" width="28" height="14"
 rx="2" fill="none" stroke="#888"/><text x="15" y="14" font-family="sans-serif" font-size="10" font-weight="bold" text-anchor="middle"
 fill="#444">TEXT</text></svg>"""


def _icon(text: str) -> str:
    return "data:image/svg+xml;base64," + base64.b64encode(_ICON.replace("TEXT", text).encode()).decode()


def add_saving(plot: Any, name: str) -> None:
    """Adds the buttons that save a figure as ``name``.png and ``name``.svg, as it is shown."""
    for kind in ("png", "svg"):
        plot.add_tools(CustomAction(icon=_icon(kind.upper()), description=f"Save as {kind.upper()}",
                                    callback=CustomJS(args={"plot": plot, "kind": kind, "name": name}, code=_SAVE)))
