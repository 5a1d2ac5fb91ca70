"""What the interactive maps of a page hold: height, and every contact and film of a scan as far as the page's size allows."""

import math
from dataclasses import dataclass, field

import numpy as np

from tabor_report import encoding, map_axes, units
from tabor_report.example import richest_window

BUDGET = 7.2e6  # bytes of the maps of a page of at most 10 MB
QUALITIES = (80, 60)  # of WebP; the second where the first would leave states out
RESERVE = 0.45  # of the budget, for gaps: contact states stop there
SHRINKS = 0.72  # a picture of the second quality, by that of the first
LARGEST_COARSE = 850  # samples along a side
SMALLEST_COARSE = 400
FULL_COARSE = 3  # as many arrays have the largest side
LOW, HIGH = 0.5, 99.5  # percentiles at which colours end

GROUND = {"hole": (191, 191, 191), "dry": (244, 240, 230)}


@dataclass
class Choice:
    """One contact (state and gap) or one film: `load` reads its maps, by name."""

    label: str
    load: dict


@dataclass
class Maps:
    """A scan with its contacts and films; pixel (x, y) [m]; heights [m]."""

    name: str
    title: str
    pixel: tuple
    height: np.ndarray
    contacts: list = field(default_factory=list)
    films: list = field(default_factory=list)
    first: tuple = (0, 0)  # contact and film shown at first


def of_single(single):
    contacts, films = {}, {}
    for state in single.states:
        if state.has("pressure") and state.pressure_label not in contacts:
            gap = {"gap": (lambda state=state: state.raw("gap"))} if state.has("gap") else {}
            contacts[state.pressure_label] = Choice(state.pressure_label, {"state": state.state, **gap})
        if state.has("film_thickness") and state.density_label not in films:
            films[state.density_label] = Choice(
                state.density_label, {"film": lambda state=state: state.raw("film_thickness")}
            )
    height = single.raw_height()
    return Maps("maps", single.title, single.pixel, height, [*contacts.values()], [*films.values()], (len(contacts) // 2, 0))


def of_example(example):
    """All states of the scan that a study's example shows, the example's own at first."""
    scan = example.scan
    contacts, films = scan.contacts(), [film for film in scan.films() if film.density > 0]
    chosen = [
        next((place for place, state in enumerate(states) if shown and state.node == shown.node), 0)
        for states, shown in ((contacts, example.contact), (films, example.film))
    ]
    return Maps(
        f"maps{example.suffix}",
        scan.file,
        scan.pixel,
        example.height,
        [Choice(f"P = {units.pressure(item.pressure)}", {"state": item.state, "gap": item.gap}) for item in contacts],
        [Choice(units.density(item.density), {"film": item.thickness}) for item in films],
        tuple(chosen),
    )


def encoded(maps, budget=BUDGET):
    """The JSON object that templates/viewer.js reads, and the pictures by their ids: ({...}, {id: data URI})."""
    return _Encoder(maps, budget).run()


class _Encoder:
    def __init__(self, maps, budget):
        self.maps, self.budget, self.left = maps, budget, budget
        self.interest = np.zeros(maps.height.shape, dtype=bool)
        self.last = -1, None
        self.pictures = {}
        arrays = 1 + len(maps.films) + sum("gap" in choice.load for choice in maps.contacts)
        side = LARGEST_COARSE * math.sqrt(FULL_COARSE / max(arrays, FULL_COARSE))
        self.side = int(max(side, SMALLEST_COARSE))
        self.quality = QUALITIES[0]
        self.films = [None] * len(maps.films)
        self.contacts = [None] * len(maps.contacts)
        self.left_out = []

    def run(self):
        height = self._height()
        wet = self._films()
        states = self._states(wet)
        self._gaps()
        rows, columns = self.maps.height.shape
        return {
            "name": self.maps.name,
            "size": [columns, rows],
            "pixel": list(self.maps.pixel),
            "thinning": encoding.thinning(self.maps.height.shape),
            "height": height,
            "contacts": self.contacts,
            "films": self.films,
            "states": states,
            "first": list(self.maps.first),
            "line": self._line(),
            "left_out": self.left_out,
            "reds": [colour[0] for colour in encoding.PALETTE],
        }, self.pictures

    def _height(self):
        height = self.maps.height
        centred = height - np.float32(np.nanmean(height)) if np.isfinite(height).any() else height
        limits = self._limits(centred)
        return {"array": self._array(centred), **self._picture("height", centred, limits, map_axes.HEIGHT_COLOURS, "hole")}

    def _films(self):
        """Where each film is."""
        loaded = [np.asarray(choice.load["film"]()) for choice in self.maps.films]
        for place, (choice, film) in enumerate(zip(self.maps.films, loaded)):
            shown = np.where(film > 0, film, np.float32(np.nan))
            limits = 0.0, self._limits(film[film > 0])[1]
            picture = self._picture(f"film{place}", shown, limits, map_axes.FILM_COLOURS, "dry")
            self.films[place] = {"label": choice.label, "array": self._array(film), **picture}
        return [film > 0 for film in loaded]

    def _states(self, wet):
        """{"contact,film": id of its picture} of those that fit; the film is 0 where there is none."""
        found = {}
        for place in self._order(range(len(self.maps.contacts))):
            state = self.maps.contacts[place].load["state"]()
            self.contacts[place] = {"label": self.maps.contacts[place].label}
            for number, mask in enumerate(wet or [None]):
                if found and self.left < RESERVE * self.budget:
                    self._leave_out(place)
                    continue
                classes = encoding.contact_classes(state, mask)
                found[f"{place},{number}"] = self._keep(f"state{place}_{number}", encoding.palette_picture(classes))
                if (place, number) == self.maps.first:
                    self.interest = _interest(classes)
        return found

    def _gaps(self):
        """The gap of the state shown first, then those that fit; all have the colours of the lowest pressure's."""
        places = [place for place, choice in enumerate(self.maps.contacts) if "gap" in choice.load]
        highest = self._limits(self._gap(places[0]))[1] if places else 0
        cost = 0
        for number, place in enumerate(self._order(places)):
            if self.left < cost:
                self._leave_out(place)
                continue
            before = self.left
            picture = self._picture(f"gap{place}", self._gap(place), (0.0, highest), map_axes.GAP_COLOURS, "hole")
            self.contacts[place]["gap"] = {"array": self._array(self._gap(place)), **picture}
            cost = before - self.left
            if number == 0 and self.left < cost * (len(places) - 1):
                self.quality, cost = QUALITIES[1], cost * SHRINKS

    def _gap(self, place):
        """Read once: it is asked for twice in a row."""
        if self.last[0] != place:
            self.last = place, np.asarray(self.maps.contacts[place].load["gap"]())
        return self.last[1]

    def _leave_out(self, place):
        if self.maps.contacts[place].label not in self.left_out:
            self.left_out.append(self.maps.contacts[place].label)

    def _order(self, places):
        """That shown first, then the ends, then those between."""
        places = list(places)
        preferred = [self.maps.first[0], *places[:1], *places[-1:], *places]
        return [place for place in dict.fromkeys(preferred) if place in places]

    def _picture(self, name, values, limits, colours, ground):
        text = encoding.coloured(values, limits, _table(colours), GROUND[ground], self.quality)
        factor, unit = units.length_scale(max(map(abs, limits)))
        return {"picture": self._keep(name, text), "limits": list(limits), "unit": [factor, unit]}

    def _array(self, values):
        array = encoding.coarse(values, self.side)
        self.left -= len(array["data"])
        return array

    def _keep(self, name, picture):
        self.left -= len(picture)
        name = f"{self.maps.name}_{name}"
        self.pictures[name] = picture
        return name

    def _limits(self, values):
        """Percentiles of a sample: all pixels would take long."""
        picked = values.ravel()[:: max(1, values.size // 500_000)]
        finite = picked[np.isfinite(picked)]
        if not finite.size:
            return 0.0, 1e-9
        low, high = (float(value) for value in np.percentile(finite, [LOW, HIGH]))
        return (low, high) if high > low else (low, low + 1e-9)

    def _line(self):
        """Ends of the first section, in pixels: along x through the most wet contact of the richest window."""
        window = richest_window(self.interest)
        counts = window.of(self.interest).sum(axis=1)
        row = window.y0 + (int(np.argmax(counts)) if counts.max() > 0 else len(counts) // 2)
        return [[window.x0, row], [window.x1 - 1, row]]


def _interest(classes):
    wet = classes >= encoding.WET
    return wet if wet.any() else classes > 0


def _table(colours):
    """uint8 (256, 3)"""
    from matplotlib import colormaps

    colour_map = colormaps[colours] if isinstance(colours, str) else colours
    return np.rint(255 * colour_map(np.linspace(0, 1, 256))[:, :3]).astype(np.uint8)


def css_gradient(colours):
    """The colours from low to high for a style sheet."""
    table = _table(colours)[::32].tolist() + [_table(colours)[-1].tolist()]
    return f"linear-gradient(to right, {', '.join('rgb(' + ','.join(map(str, colour)) + ')' for colour in table)})"
