"""Looks of a declared figure in Bokeh's words, and the entries of the legend that the page shows above it."""

from matplotlib.colors import to_hex

from tabor.report import chart
from tabor.report.plain_text import plain

DOT = 0.5  # of the size of a mark: as Matplotlib draws a '.'
_DASHES = {"--": [5, 2], "-": "solid", ":": "dotted", "-.": "dashdot", "": ""}
MARKERS = {
    "o": "circle", "s": "square", "^": "triangle", "D": "diamond", "d": "diamond", "v": "inverted_triangle",
    "P": "plus", "X": "x", "x": "x", ".": "dot", "p": "hex", "h": "hex", "*": "star", "<": "triangle", ">": "triangle", "8": "hex",
}  # fmt: skip
# Paths of the marks in a legend's picture of 28 x 12 pixels.
_SHAPES = {
    "circle": "M10 6a4 4 0 1 0 8 0a4 4 0 1 0-8 0z", "dot": "M12.5 6a1.5 1.5 0 1 0 3 0a1.5 1.5 0 1 0-3 0z", "square": "M10.3 2.3h7.4v7.4h-7.4z",
    "triangle": "M14 1.5l4.5 8h-9z", "inverted_triangle": "M14 10.5l-4.5-8h9z", "diamond": "M14 .8l3.8 5.2l-3.8 5.2l-3.8-5.2z",
    "plus": "M12.6 1.8h2.8v2.8h2.8v2.8h-2.8v2.8h-2.8v-2.8h-2.8v-2.8h2.8z", "x": "M10.5 2.5l7 7M10.5 9.5l7-7", "hex": "M14 1.8l3.7 2.1v4.2l-3.7 2.1l-3.7-2.1v-4.2z",
    "star": "M14 1l1.5 3.3l3.5.4l-2.6 2.4l.7 3.6l-3.1-1.8l-3.1 1.8l.7-3.6l-2.6-2.4l3.5-.4z",
}  # fmt: skip


def legend(figure):
    """[{"label", "colour", "dash", "marker", "shape", "face", "edge"}], the marks as they are plotted."""
    if figure.legend == ():
        return []
    return [_entry(item) for item in {**figure.labelled(), **figure.samples()}.values()]


def _entry(item):
    found = {"label": plain(item.label), "colour": to_hex(item.colour), "dash": "", "marker": "area"}
    if isinstance(item, chart.Band):
        return found
    found.update(dash=dash(item.dash), marker=MARKERS.get(getattr(item, "marker", ""), ""))
    if found["marker"] in _SHAPES:
        face, edge = mark_colours(item)
        found.update(shape=_SHAPES[found["marker"]], face=face or "none", edge=edge)
    return found


def mark_colours(curve):
    """(face or None, edge)"""
    face = curve.colour if curve.face is None else curve.face
    return None if face == "none" else to_hex(face), to_hex(curve.colour)


def stroke_of(item):
    return {"line_color": to_hex(item.colour), "line_width": max(1.0, 1.3 * item.width), "line_dash": dash(item.dash)}


def dash(dash):
    return [max(1, round(1.4 * length)) for length in dash] if isinstance(dash, tuple) else _DASHES[dash]
