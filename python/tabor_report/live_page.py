"""What makes a page interactive: its Bokeh document, the maps that it holds, and the texts of its scripts."""

from pathlib import Path

from tabor_report import example, interactive, units, viewer

_COLOURS = {"height": "HEIGHT_COLOURS", "gap": "GAP_COLOURS", "film": "FILM_COLOURS"}


class Live:
    def __init__(self, source, options):
        found = _maps_of(source, options)  # before Bokeh is imported: a file that lacks something is soon rejected
        self.document = interactive.Document()
        self.maps = [self._maps(maps, 1 / len(found)) for maps in found]

    def curves(self, drawn):
        """{"rows": ids of the elements that show a figure's panels, "legend"}; None where it stays as it is."""
        from tabor_report import bokeh_curves

        found = None if drawn.is_map else bokeh_curves.convert(drawn.figure, drawn.name)
        if found is None:
            return None
        rows, legend = found
        ids = []
        for number, row in enumerate(rows):
            ids.append([f"{drawn.name}_{number}_{place}" for place in range(len(row))])
            for name, plot in zip(ids[-1], row):
                self.document.add(plot, name)
        return {"rows": ids, "legend": legend}

    def scripts(self):
        """{"library", "documents", "places", "viewer"}"""
        folder = Path(__file__).resolve().parent / "templates"
        return {**self.document.texts(), "viewer": (folder / "viewer.js").read_text(encoding="utf-8")}

    def _maps(self, maps, share):
        """What the template shows of one scan's maps."""
        data, pictures = viewer.encoded(maps, share * viewer.BUDGET)
        figures = interactive.map_figures(maps, data)
        for panel, plot in figures.items():
            self.document.add(plot, f"{maps.name}_{panel}_plot")
        return {
            "name": maps.name,
            "title": maps.title,
            "has_gap": any("gap" in choice.load for choice in maps.contacts),
            "panels": [_panel(panel, data) for panel in figures if panel != "section"],
            "contacts": [choice.label for choice in maps.contacts],
            "films": [choice.label for choice in maps.films],
            "first": data["first"],
            "left_out": data["left_out"],
            "thinned": data["thinning"] if data["thinning"] > 1 else 0,
            "size": _size(maps),
            "samples": f"{data['height']['array']['columns']} × {data['height']['array']['rows']}",
            "pictures": pictures,
            "data": interactive.script_json(data),
        }


def _maps_of(source, options):
    if source.kind == "single":
        return [viewer.of_single(source)]
    if source.kind == "study":
        example.check(source, options)
        shown = [item for item in example.examples(source, options) if item.height is not None]
        return [viewer.of_example(item) for item in shown]
    return []


def _size(maps):
    """'1.2 mm × 0.8 mm; x to the right, y downwards'"""
    sides = (units.length(count * pixel) for count, pixel in zip(reversed(maps.height.shape), maps.pixel))
    return f"{' × '.join(sides)}; x to the right, y downwards"


def _first_parts(data):
    """{panel: the part that it shows at first}"""
    contact, film = data["first"]
    parts = {"height": data["height"]}
    if data["contacts"]:
        parts["state"] = data["contacts"][contact]
        parts["gap"] = data["contacts"][contact].get("gap")
    if data["films"]:
        parts["film"] = data["films"][film]
    return {panel: part for panel, part in parts.items() if part}


def _panel(panel, data):
    part = _first_parts(data).get(panel, {})
    return {"panel": panel, **({} if panel == "state" else _bar(panel, part))}


def _bar(panel, part):
    """The colours from low to high with their ends and middle."""
    from tabor_report import map_axes

    low, high = part.get("limits", (0.0, 0.0))
    factor, unit = part.get("unit", (1, "m"))
    middle = (low + high) / 2
    ends = [f"{units.number(value * factor, 3)}" for value in (low, middle, high)]
    return {"gradient": viewer.css_gradient(getattr(map_axes, _COLOURS[panel])), "ends": ends, "unit": unit}
