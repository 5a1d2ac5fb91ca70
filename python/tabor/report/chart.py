"""Figures of curves as declarations: what is drawn, in which look, along which axes, without saying by which library.

chart_matplotlib.py draws them for papers and still pages, chart_bokeh.py for interactive ones. Texts may hold formulas between dollar signs.
"""

from dataclasses import dataclass, field, replace

import numpy as np

AIR = 0.05  # of its length, between the end of an axis and the outermost values
WIDTH = 1.4  # points, of a line


@dataclass
class Axis:
    """What is None of its ends follows the values."""

    label: str = ""
    scale: str = "linear"  # "log", or "symlog": linear up to `linear_to`
    low: float = None
    high: float = None
    air: float = 1.0  # by which the upper end is multiplied where it follows the values
    names: dict = None  # {place: text} in place of numbers
    linear_to: float = None


def from_zero(label, air=1.05):
    """An axis of values above zero, with room above the highest symbol."""
    return Axis(label, low=0.0, air=air)


@dataclass
class Curve:
    """Values joined by a line, marked by symbols, or both."""

    x: object = ()
    y: object = ()
    label: str = ""  # its name in the legend, which shows and hides all that is called so
    colour: str = "black"
    dash: object = "-"  # "--", ":", "-.", "" without a line, or lengths (on, off)
    width: float = WIDTH  # points
    marker: str = ""  # of Matplotlib
    size: float = 5.0  # points, of a marker
    face: str = None  # colour within a marker, "none" of a ring; that of the line by default
    alpha: float = 1.0
    edge: float = 1.0  # points, of a marker's outline
    z: float = 2.0  # higher ones cover lower ones
    error: object = None  # half length of a bar for each value, NaN for none
    bar: tuple = (0.9, 2.5)  # points: width of a bar, length of its cap
    notes: dict = field(default_factory=dict)  # {name: what is said of each value under the pointer}
    is_right: bool = False  # along the axis on the right

    @property
    def has_bars(self):
        return self.error is not None and bool(np.isfinite(self.error).any())


@dataclass
class Band:
    """An area between two curves."""

    x: object
    low: object
    high: object
    label: str = ""
    colour: str = "black"
    alpha: float = 1.0
    is_right: bool = False


@dataclass
class Guide:
    """A line across the panel, upright at a value of x or level at one of y."""

    at: float
    is_upright: bool = False
    label: str = ""
    colour: str = "0.45"
    dash: object = ":"
    width: float = 1.0
    z: float = 2.0


@dataclass
class Text:
    """A word at a place of the data, or turned upright above the panel, where no curve runs."""

    text: str
    x: float
    y: float = None  # above the panel
    size: float = 8.0
    colour: str = "0.25"


@dataclass
class Panel:
    x: Axis
    y: Axis
    items: list = field(default_factory=list)
    right: Axis = None
    title: str = ""
    grid: str = "both"  # "y" or "none"; none where there is an axis on the right


@dataclass
class Figure:
    """Rows of panels; size in inches."""

    rows: list
    height: float
    width: float = 5.6
    heights: tuple = None  # of the rows, in proportion
    shares_x: bool = False
    shares_y: str = ""  # "row" or "all"
    legend: tuple = None  # samples in place of the labels in their order; () for none

    @property
    def panels(self):
        return [panel for row in self.rows for panel in row]

    def labelled(self):
        """{label: what has it first}, in the order of the items."""
        found = {}
        for item in (item for panel in self.panels for item in panel.items):
            if getattr(item, "label", ""):
                found.setdefault(item.label, item)
        return found

    def samples(self):
        """{label: a sample of its look}, as the legend shows them; labels without a sample are left out."""
        return self.labelled() if self.legend is None else {item.label: item for item in self.legend}

    def settled(self, panel, which):
        """The Axis "x", "y" or "right" of a panel with its ends."""
        axis = getattr(panel, which)
        low, high = _ends(axis, np.concatenate([_values(other, which) for other in self._sharing(panel, which)]))
        return replace(axis, low=low, high=high)

    def is_named(self, row, column, which):
        """True where a panel says what its axis is: of shared ones the lowest, or the leftmost."""
        if which == "x":
            return not self.shares_x or all(column >= len(below) for below in self.rows[row + 1 :])
        return not self.shares_y or column == 0

    def _sharing(self, panel, which):
        if which == "x" and self.shares_x or which == "y" and self.shares_y == "all":
            return self.panels
        if which == "y" and self.shares_y == "row":
            return next(row for row in self.rows if any(other is panel for other in row))
        return [panel]


def rows(panels, most_columns):
    """Panels in rows of at most so many."""
    return [panels[start : start + most_columns] for start in range(0, len(panels), most_columns)]


def _values(panel, which):
    """All values along an axis of a panel, as one array."""
    parts = [np.empty(0)]
    for item in panel.items:
        if which != "x" and which != ("right" if getattr(item, "is_right", False) else "y"):
            continue
        parts += _values_of(item, "x" if which == "x" else "y")
    return np.concatenate([np.asarray(part, dtype=float).ravel() for part in parts])


def _values_of(item, which):
    if isinstance(item, Guide):
        return [item.at] if item.is_upright == (which == "x") else []
    if isinstance(item, Band):
        return [item.x] if which == "x" else [item.low, item.high]
    if not isinstance(item, Curve):
        return []
    if which == "x" or not item.has_bars:
        return [item.x if which == "x" else item.y]
    return [item.y, item.y - item.error, item.y + item.error]


def _ends(axis, values):
    """(low, high): as the axis says, else beyond the outermost values by AIR."""
    if axis.low is not None and axis.high is not None:
        return axis.low, axis.high
    is_log = axis.scale == "log"
    known = values[np.isfinite(values) & ((values > 0) | (not is_log))]
    low, high = (known.min(), known.max()) if known.size else (1.0, 10.0) if is_log else (0.0, 1.0)
    if is_log:
        room = (high / low) ** AIR if high > low else 2.0
        low, high = low / room, high * room
    else:
        room = AIR * (high - low) or AIR * abs(high) or AIR
        low, high = low - room, high + room
    return float(low if axis.low is None else axis.low), float(high * axis.air if axis.high is None else axis.high)
