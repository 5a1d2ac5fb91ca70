"""What the interactive maps of a page hold: height, every contact and film of a scan, and gaps as far as they fit."""

import math
from dataclasses import dataclass, field

import numpy as np

from tabor_report import encoding, map_axes, units
from tabor_report.example import richest_window, shores

BUDGET = 7.6e6  # bytes of the maps of a page of at most 10 MB
QUALITIES = {92: 2.0, 80: 1.0, 60: 0.68, 40: 0.52}  # of WebP, with the size of a picture by that of the second
LARGEST_COARSE = 850  # samples along a side
FOR_SAMPLES = 0.4  # of the budget
BYTES_A_SAMPLE = 2.17  # packed
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
    chosen = len(contacts) // 2, 0
    return Maps("maps", single.title, single.pixel, height, [*contacts.values()], [*films.values()], chosen)


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
    """First what must be there, then quality, then as many gaps as fit."""

    def __init__(self, maps, budget):
        self.maps, self.left = maps, budget
        self.pictures = {}
        self.last = -1, None
        self.with_gap = [place for place, choice in enumerate(maps.contacts) if "gap" in choice.load]
        arrays = 1 + len(maps.films) + len(self.with_gap)
        self.side = int(min(LARGEST_COARSE, max(2, math.sqrt(FOR_SAMPLES * budget / arrays / BYTES_A_SAMPLE))))

    def run(self):
        height = self.maps.height
        self.height = height - np.float32(np.nanmean(height)) if np.isfinite(height).any() else height
        self.films = [np.asarray(choice.load["film"]()) for choice in self.maps.films]
        contacts, wets, line = self._contacts()
        self.quality = self._plan()
        rows, columns = height.shape
        return {
            "name": self.maps.name,
            "size": [columns, rows],
            "pixel": list(self.maps.pixel),
            "thinning": encoding.thinning(height.shape),
            "height": self._part("height", *self._of_height()),
            "films": [self._film(place, wet) for place, wet in enumerate(wets)],
            "contacts": contacts,
            "first": list(self.maps.first),
            "line": line,
            "left_out": self._add_gaps(contacts),
        }, self.pictures

    def _contacts(self):
        """([{"label", "picture"}], ids of the pictures of what is wet, the ends of the first section)."""
        contacts, line = [], None
        touched = np.zeros(self.maps.height.shape, dtype=bool)
        for place, choice in enumerate(self.maps.contacts):
            state = choice.load["state"]()
            picture = encoding.contact_layer(state, (state > 1).any())
            contacts.append({"label": choice.label, "picture": self._keep(f"contact{place}", picture)})
            touched |= state > 0
            if place == self.maps.first[0]:
                line = self._line(state > 0)
        layers = (encoding.wet_layer(touched & (film > 0)) for film in self.films)
        wets = [self._keep(f"wet{place}", layer) for place, layer in enumerate(layers)]
        if contacts and not wets:
            self._keep("wet", encoding.wet_layer(np.zeros((1, 1))))
        return contacts, wets, line or self._line(touched)

    def _plan(self):
        """The best quality with which all pictures fit, else the least."""
        second = 80
        samples = [(1, self._of_height())]
        if self.films:
            samples.append((len(self.films), self._of_film(0)))
        if self.with_gap:
            samples.append((len(self.with_gap), self._of_gap(self.with_gap[0])))
        pictures = sum(count * len(_picture(*sample, second)) for count, sample in samples)
        arrays = sum(count for count, _ in samples) * len(encoding.coarse(self.height, self.side)["data"])
        fitting = [quality for quality, size in QUALITIES.items() if size * pictures + arrays <= self.left]
        return max(fitting, default=min(QUALITIES))

    def _film(self, place, wet):
        return {"label": self.maps.films[place].label, "wet": wet, **self._part(f"film{place}", *self._of_film(place))}

    def _add_gaps(self, contacts):
        """The gap shown first, then those that fit; labels of the contacts whose gap does not."""
        cost, left_out = 0, []
        for place in self._order(self.with_gap):
            if self.left < cost:
                left_out.append(place)
                continue
            before = self.left
            contacts[place]["gap"] = self._part(f"gap{place}", *self._of_gap(place))
            cost = before - self.left
        return [contacts[place]["label"] for place in sorted(left_out)]

    def _order(self, places):
        """That shown first, then the ends, then those between."""
        preferred = [self.maps.first[0], *places[:1], *places[-1:], *places]
        return [place for place in dict.fromkeys(preferred) if place in places]

    def _of_height(self):
        """(values, limits, colours, ground)"""
        return self.height, self._limits(self.height), map_axes.HEIGHT_COLOURS, "hole"

    def _of_film(self, place):
        film = self.films[place]
        shown = np.where(film > 0, film, np.float32(np.nan))
        return shown, (0.0, self._limits(film[film > 0])[1]), map_axes.FILM_COLOURS, "dry"

    def _of_gap(self, place):
        """The gap is read once: it is asked for twice in a row."""
        if self.last[0] != place:
            self.last = place, np.asarray(self.maps.contacts[place].load["gap"]())
        return self.last[1], (0.0, self._limits(self.last[1])[1]), map_axes.GAP_COLOURS, "hole"

    def _part(self, name, values, limits, colours, ground):
        """A picture, its colours' ends, their unit, and the samples; a film's dry ground is zero in these."""
        factor, unit = units.length_scale(max(map(abs, limits)))
        array = encoding.coarse(np.nan_to_num(values) if ground == "dry" else values, self.side)
        self.left -= len(array["data"])
        picture = self._keep(name, _picture(values, limits, colours, ground, self.quality))
        return {"picture": picture, "limits": list(limits), "unit": [factor, unit], "array": array}

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

    def _line(self, touching):
        """Ends of the first section, in pixels: along x through the most wet contact, without contact the most shores, of the richest window."""
        wet = touching & (self.films[self.maps.first[1]] > 0) if self.films else touching
        interest = wet if wet.any() else touching
        if self.films and not interest.any():
            interest = shores(self.films[self.maps.first[1]] > 0)
        window = richest_window(interest)
        counts = window.of(interest).sum(axis=1)
        row = window.y0 + (int(np.argmax(counts)) if counts.max() > 0 else len(counts) // 2)
        return [[window.x0, row], [window.x1 - 1, row]]


def _picture(values, limits, colours, ground, quality):
    return encoding.coloured(values, limits, _table(colours), GROUND[ground], quality)


def _table(colours):
    """uint8 (256, 3)"""
    from matplotlib import colormaps

    colour_map = colormaps[colours] if isinstance(colours, str) else colours
    return np.rint(255 * colour_map(np.linspace(0, 1, 256))[:, :3]).astype(np.uint8)


def css_gradient(colours):
    """The colours from low to high for a style sheet."""
    table = _table(colours)[::32].tolist() + [_table(colours)[-1].tolist()]
    return f"linear-gradient(to right, {', '.join('rgb(' + ','.join(map(str, colour)) + ')' for colour in table)})"
