"""One figure per file. Each `draw` returns what the page and the disk need, or None if there is no data."""

from dataclasses import dataclass, field


@dataclass
class Drawn:
    name: str  # file name without ending
    title: str
    caption: str
    figure: object
    data: dict = field(default_factory=dict)  # {suffix of the CSV's name: its text, or a function that makes a large one}
    is_map: bool = False  # a raster: the page embeds the PNG, not the SVG
    is_viewed: bool = False  # part of the interactive maps, which show it in its place

    def tables(self):
        """{file name: text, or a function that makes a large one}"""
        return {f"{self.name}{suffix}.csv": text for suffix, text in self.data.items()}
