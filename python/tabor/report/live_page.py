"""What makes a page interactive: its Bokeh document, the maps that it holds, and the texts of its scripts."""

import math
from pathlib import Path

from tabor.report import encoding, example, interactive, units, viewer

MOST_TICKS = 6  # of a still map
MOST_SCANS = 16  # of a page that was asked for none: each takes half a second
ROOM = 6.0e6  # bytes of the maps of these scans together
_DRAWN_THINNED = {"pressure": "the pressure", "film": "the lubricant"}  # where other maps are pictures of every pixel


class Live:
    def __init__(self, source, options):
        found = _maps_of(source, options)
        self.document = interactive.Document()
        self.maps = [self._maps(maps, *viewer.encoded(maps, 1 / len(found))) for maps in found]
        self.n_other_scans = 0
        if source.kind == "study" and not options.all_scans and self.maps:
            self._add_scans(source, options)
            self.n_other_scans = len(source.scans) - len(self.maps)

    def curves(self, drawn):
        """{"rows": ids of the elements that show a figure's panels, "legend"}; None where it stays as it is."""
        from tabor.report import bokeh_looks, chart_bokeh

        rows = chart_bokeh.draw(drawn.figure, drawn.name) if drawn.is_declared else None
        if rows is None:
            return None
        ids = []
        for number, row in enumerate(rows):
            ids.append([f"{drawn.name}_{number}_{place}" for place in range(len(row))])
            for name, plot in zip(ids[-1], row):
                self.document.add(plot, name)
        return {"rows": ids, "legend": bokeh_looks.legend(drawn.figure)}

    def scripts(self):
        """{"library", "documents", "places", "viewer"}"""
        folder = Path(__file__).resolve().parent / "templates"
        return {**self.document.texts(), "viewer": (folder / "viewer.js").read_text(encoding="utf-8")}

    def _add_scans(self, study, options):
        """More scans to choose from, as far as there is room for each as it is alone."""
        largest = _size(self.maps[0]["data"], self.maps[0]["pictures"])
        room = ROOM - largest
        for item in example.others(study, options, example.examples(study, options)):
            if room < largest or len(self.maps) == MOST_SCANS:
                return
            maps = viewer.of_example(item, study.table.rows(), f"maps_scan{item.scan.index:04d}")
            data, pictures = viewer.encoded(maps, budget=room)
            size = _size(interactive.script_json(data), pictures)
            if size > room or data["left_out"]:
                return
            self.maps.append(self._maps(maps, data, pictures))
            largest, room = max(largest, size), room - size

    def _maps(self, maps, data, pictures):
        """What the template shows of one scan's maps."""
        figures = interactive.map_figures(maps, data)
        for panel, plot in figures.items():
            self.document.add(plot, f"{maps.name}_{panel}_plot")
        return {
            "name": maps.name,
            "title": maps.title,
            "group": maps.group,
            "heading": maps.heading,
            "of_contact": maps.of_contact,
            "has_gap": any("gap" in choice.load for choice in maps.contacts),
            "panels": [_panel(panel, data) for panel in figures if panel != "section"],
            "contacts": [choice.label for choice in maps.contacts],
            "films": [choice.label for choice in maps.films],
            "first": data["first"],
            "left_out": data["left_out"],
            "of_grid": " and ".join(f"the map of {word}" for panel, word in _DRAWN_THINNED.items() if panel in figures),
            "saturates": data["saturates"],
            "classes": _classes(data),
            "nth": units.nth(data["step"]) if data["step"] > 1 else "",
            "thinned": thinning if (thinning := encoding.thinning(maps.shape)) > 1 else 0,
            "axes": _axes(maps),
            "pictures": pictures,
            "data": interactive.script_json(data),
        }


def _maps_of(source, options):
    if source.kind in ("single", "slide"):
        return [viewer.of_single(source)]
    if source.kind == "study":
        example.check(source, options)
        shown = [item for item in example.examples(source, options) if item.height is not None]
        called = [f"maps_scan{item.scan.index:04d}" if options.all_scans else "maps" for item in shown]
        return [viewer.of_example(item, source.table.rows(), name) for item, name in zip(shown, called)]
    return []


def _size(data, pictures):
    """Bytes in the page."""
    return len(data) + sum(map(len, pictures.values()))


def _classes(data):
    """[(text, colour)] of what the contacts of these maps have."""
    texts = {1: "dry, elastic", 2: "dry, saturated", 3: "wet, elastic", 4: "wet, saturated"}
    if not data["films"]:
        texts = {1: "elastic", 2: "saturated"}
    return [(text, data["classes"][place]) for place, text in texts.items() if place % 2 or data["saturates"]]


def _axes(maps):
    """Of a still map: {"x" and "y": [(text, share of the side)], "unit", "shape": width over height}."""
    sides = [count * pixel for count, pixel in zip(reversed(maps.shape), maps.pixel)]
    factor, unit = units.length_scale(max(sides))
    return {**{axis: _ticks(side * factor) for axis, side in zip("xy", sides)}, "unit": unit, "shape": sides[0] / sides[1]}


def _ticks(length):
    """[(text, share of the length)] of round numbers from zero on."""
    step = next(step for step in _round_steps(length) if length / step < MOST_TICKS)
    return [(units.number(place * step), place * step / length) for place in range(int(length / step * (1 + 1e-9)) + 1)]


def _round_steps(length):
    """1, 2, 5 times powers of ten, rising."""
    power = math.floor(math.log10(length)) - 2
    return (digit * 10.0**exponent for exponent in range(power, power + 5) for digit in (1, 2, 5))


def _first_parts(data):
    """{panel: the part that it shows at first}"""
    contact, film = data["first"]
    parts = {"height": data["height"]}
    if data["contacts"]:
        parts["state"] = data["contacts"][contact]
        parts["gap"] = data["contacts"][contact].get("gap")
        parts["pressure"] = data["contacts"][contact].get("pressure")
    if data["films"]:
        parts["film"] = data["films"][film]
    return {panel: part for panel, part in parts.items() if part}


def _panel(panel, data):
    part = _first_parts(data).get(panel, {})
    return {"panel": panel, "layers": interactive.layers(panel, data), **({} if panel == "state" else _bar(panel, part))}


def _bar(panel, part):
    """The colours from low to high with their ends and middle."""
    low, high = part.get("limits", (0.0, 0.0))
    factor, unit = part.get("unit", (1, "m"))
    middle = (low + high) / 2
    ends = [f"{units.number(value * factor, 3)}" for value in (low, middle, high)]
    return {"gradient": viewer.css_gradient(viewer.COLOURS[panel]), "ends": ends, "unit": unit}
