"""One figure per file. Each `draw` returns what the page and the disk need, or None if there is no data."""

from dataclasses import dataclass, field
from functools import cached_property

from tabor.report import chart, chart_matplotlib, style


@dataclass
class Drawn:
    name: str  # file name without ending
    title: str
    caption: str
    figure: object  # a chart.Figure; of a map, or what only Matplotlib draws, one of Matplotlib
    data: dict = field(default_factory=dict)  # {suffix of the CSV's name: its text, or a function that makes a large one}
    is_map: bool = False  # a raster: the page embeds the PNG, not the SVG
    is_viewed: bool = False  # part of the interactive maps, which show it in its place

    @property
    def is_declared(self):
        return isinstance(self.figure, chart.Figure)

    @cached_property
    def drawing(self):
        """The figure of Matplotlib."""
        return chart_matplotlib.draw(self.figure) if self.is_declared else self.figure

    def close(self):
        """Frees what Matplotlib drew."""
        drawing = self.__dict__.pop("drawing", None if self.is_declared else self.figure)
        if drawing is not None:
            style.close(drawing)
        if not self.is_declared:
            self.figure = None

    def tables(self):
        """{file name: text, or a function that makes a large one}"""
        return {f"{self.name}{suffix}.csv": text for suffix, text in self.data.items()}
