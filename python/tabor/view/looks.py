"""Units, colours and small pieces of HTML that the parts of the page share."""

from __future__ import annotations

import html
import math
from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np

from .. import _tabor
from .._records import Warning
from .._maps import Array

# As in the pages of `tabor report`: told apart with every common colour blindness (Okabe & Ito 2008).
SOLID, LIQUID, DRY, WET = "#B9B2A8", "#3A86C8", "#E8862E", "#000000"
CURVES = {"dry": "#D55E00", "lubricated": "#0072B2"}
HOLE = "#FFFFFF"
MOST_SHOWN = 512  #: pixels of a side that a map shows; more are left out one after the other

STYLE = """
:host, body { font: 14px/1.4 system-ui, sans-serif; color: #222; }
table { border-collapse: collapse; } th { text-align: left; font-weight: 400; color: #555; padding: 1px 14px 1px 0; white-space: nowrap; }
td { padding: 1px 12px 1px 0; font-variant-numeric: tabular-nums; white-space: nowrap; }
.doubt { color: #8A0F16; } .information { color: #555; } .failure { color: #8A0F16; font-weight: 600; }
.note { color: #555; } .preview { background: #FFF3CD; padding: 1px 6px; border-radius: 3px; }
h2 { font-size: 15px; margin: 6px 0 2px; } p { margin: 2px 0; } .key { display: inline-block; width: 12px; height: 12px; margin: 0 4px 0 10px; border: 1px solid #888; vertical-align: -1px; }
"""


class Unit(NamedTuple):
    """A unit of length in which a map reads well."""

    name: str
    factor: float  #: from metres

    def of(self, metres: Any) -> Any:
        """Lengths in this unit."""
        return metres * self.factor


def unit_for(metres: float) -> Unit:
    """The unit in which this length has few digits before and behind the point."""
    for name, factor in (("nm", 1e9), ("µm", 1e6), ("mm", 1e3)):
        if metres * factor < 2000:
            return Unit(name, factor)
    return Unit("m", 1.0)


def si_text(value: Any, unit: str) -> str:
    """A number with its unit and prefix: "1.07 µm"."""
    if value is None or not math.isfinite(value):
        return "-"
    if unit in ("", "1"):
        return f"{value:.4g}"
    return str(_tabor.format_si(float(value), unit))


def percent(share: Any) -> str:
    """A share in per cent."""
    return "-" if share is None or not math.isfinite(share) else f"{100 * share:.3g} %"


def shown(values: Array) -> tuple[np.typing.NDArray[np.float32], int]:
    """A map as it is sent to the page, and of how many pixels along a side one is shown."""
    step = max(1, -(-max(values.shape) // MOST_SHOWN))
    return np.ascontiguousarray(values[::step, ::step], dtype=np.float32), step


def ordinal(number: int) -> str:
    """2nd, 3rd, 4th: of numbers up to 20."""
    return {1: "1st", 2: "2nd", 3: "3rd"}.get(number, f"{number}th")


def limits(values: Array) -> tuple[float, float, float, float]:
    """Least and largest value, and those that all but a two-hundredth lie between; of heights that are there."""
    known = values[np.isfinite(values)]
    if not known.size:
        return 0.0, 1.0, 0.0, 1.0
    least, low, high, largest = np.percentile(known, [0, 0.5, 99.5, 100]).tolist()
    return least, largest if largest > least else least + 1.0, low, high if high > low else low + 1.0


def warnings_html(warnings: Iterable[Warning]) -> str:
    """Warnings, a line each."""
    return "".join(f"<p class='{html.escape(one.kind)}'>{'Note' if one.kind == 'information' else 'Warning'}: "
                   f"{html.escape(one.text)} <span class='note'>[{html.escape(one.code)}]</span></p>" for one in warnings)


def failure_html(text: str) -> str:
    """Why something cannot be computed."""
    return f"<p class='failure'>{html.escape(text)}</p>" if text else ""


def table_html(rows: Iterable[tuple[str, str, str, str]], columns: int = 1) -> str:
    """Rows of (heading, name, exact value, text): the name and the exact value are attributes of the cell, for whoever
    reads the page by program."""
    cells = [f"<th>{html.escape(heading)}</th><td data-name='{html.escape(name)}' data-value='{html.escape(exact)}'>"
             f"{html.escape(text)}</td>" for heading, name, exact, text in rows]
    lines = [cells[first:first + columns] for first in range(0, len(cells), columns)]
    return f"<table>{''.join('<tr>' + ''.join(line) + '</tr>' for line in lines)}</table>"
