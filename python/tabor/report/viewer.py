"""What the interactive maps of a page hold: height, every contact and film of a scan, and gaps as far as they fit."""

import math
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, field

import numpy as np

from tabor.report import encoding, map_axes, names, oil, units
from tabor.report.example import richest_window, shores

BUDGET = 7.6e6  # bytes of the maps of a page of at most 10 MB
TRIED = 92  # quality of the pictures that tell how large others are
QUALITIES = {TRIED: 1.0, 80: 0.5, 60: 0.34, 40: 0.26}  # of WebP, with the size of a picture by that of the tried one
SMALLEST_GRID = 128  # pixels along a side, where several scans share a page
LOW, HIGH = 0.5, 99.5  # percentiles at which colours end

COLOURS = {
    "height": map_axes.HEIGHT_COLOURS,
    "pressure": map_axes.PRESSURE_COLOURS,
    "gap": map_axes.GAP_COLOURS,
    "film": map_axes.FILM_COLOURS,
}
HOLE, DRY = (191, 191, 191), (244, 240, 230)
GROUNDS = {"height": HOLE, "pressure": (255, 255, 255), "gap": HOLE, "film": DRY}


@dataclass
class Choice:
    """One contact or one film: `load` reads its maps, by name.

    "contact": called with a step, returns (state, every step-th pressure or None); "gap" and "film".
    """

    label: str
    load: dict


@dataclass
class Maps:
    """A scan with its contacts and films; pixel (x, y) [m]; heights [m]."""

    name: str
    title: str
    file: str  # in names of files
    pixel: tuple
    shape: tuple
    load_height: Callable
    contacts: list = field(default_factory=list)
    films: list = field(default_factory=list)
    first: tuple = (0, 0)  # contact and film shown at first
    is_difference: bool = False  # heights about zero, not about their mean
    heading: str = "Height about the mean"
    group: str = ""  # of the scan of a study, where its title does not say it
    of_contact: str = ""  # after "Contact" and "Gap": oil.BEFORE where oil carries load


def of_single(single):
    contacts, films = {}, {}
    for state in single.states:
        if state.has("pressure") and state.pressure_label not in contacts:
            gap = {"gap": (lambda state=state: state.raw("gap"))} if state.has("gap") and single.is_solved_on(state) else {}
            contacts[state.pressure_label] = Choice(state.pressure_label, {"contact": state.contact, **gap})
        if state.has("film_thickness") and state.density_label not in films:
            films[state.density_label] = Choice(
                state.density_label, {"film": lambda state=state: state.raw("film_thickness")}
            )
    chosen = 0 if single.kind == "slide" else len(contacts) // 2, 0
    file = names.in_a_file(single.title if single.combination else names.short([single.title])[single.title])
    shape = single.surface["height"].shape
    maps = Maps("maps", single.title, file, single.pixel, shape, single.raw_height, [*contacts.values()], [*films.values()], chosen)
    maps.is_difference, maps.heading = single.is_difference, single.heading_of_heights
    if single.kind != "slide" and oil.carries([state.facts for state in single.states]):
        maps.of_contact = oil.BEFORE
    return maps


def of_example(example, rows, name="maps"):
    """All states of the scan that a study's example shows, the example's own at first; `rows` are those of the study."""
    scan = example.scan
    contacts, films = scan.contacts(), [film for film in scan.films() if film.density > 0]
    chosen = [
        next((place for place, state in enumerate(states) if shown and state.node == shown.node), 0)
        for states, shown in ((contacts, example.contact), (films, example.film))
    ]
    return Maps(
        name,
        scan.name,
        names.in_a_file(scan.name),
        scan.pixel,
        example.height.shape,
        lambda: example.height,
        [
            Choice(f"P = {units.pressure(item.pressure)}", {"contact": (lambda step, item=item: (item.state(), None)), "gap": item.gap})
            for item in contacts
        ],
        [Choice(units.density(item.density), {"film": item.thickness}) for item in films],
        tuple(chosen),
        group="" if scan.name.endswith(f"({scan.group})") else scan.group,
        of_contact=oil.BEFORE if oil.carries(rows) else "",
    )


@dataclass
class _FilmMap:
    """What a page has of a film, of which the rest of a large map is given back."""

    wet: encoding.Bits  # of every pixel
    thickness: np.ndarray  # on the grid [m]
    top: float  # the end of its colours [m]


@dataclass
class _GapMap:
    """What a page has of a gap."""

    place: int  # of its contact
    limits: tuple  # of its colours [m]
    array: dict  # on the grid
    steps: np.ndarray  # in which the picture of every pixel is coloured; None without one


def encoded(maps, share=1.0, budget=None):
    """The JSON object that templates/viewer.js reads, and the pictures by their ids: ({...}, {id: data URI}).

    share: of a page that several scans share; budget: bytes, where they are not that share of BUDGET.
    """
    return _Encoder(maps, share, share * BUDGET if budget is None else budget).run()


class _Encoder:
    """One grid of numbers, from which a page draws, reads and saves; where it has not every pixel, pictures that have.

    First what must be there, then the quality of pictures, then as many gaps as fit. A large map is read once, and is not held while
    others are read. Large pictures are packed by another thread meanwhile.
    """

    def __init__(self, maps, share, budget):
        self.maps, self.left = maps, budget
        self.pictures, self.tried = {}, {}
        self.last = None
        self.with_gap = [place for place, choice in enumerate(maps.contacts) if "gap" in choice.load]
        self.step = encoding.thinning(maps.shape, max(SMALLEST_GRID, int(encoding.LARGEST_GRID * math.sqrt(share))))

    def run(self):
        with ThreadPoolExecutor(1) as self.beside:
            return self._run()

    def _run(self):
        self.films = [self._film_map(np.asarray(choice.load["film"]())) for choice in self.maps.films]
        self._read_height()
        self._try_pictures()
        contacts, line = self._contacts()
        films = [self._film(place) for place in range(len(self.films))]
        height_part = self._height()
        self._paint(height_part, films)
        rows, columns = self.maps.shape
        return {
            "name": self.maps.name,
            "file": self.maps.file,
            "heading": self.maps.heading,
            "of_contact": self.maps.of_contact,
            "size": [columns, rows],
            "pixel": list(self.maps.pixel),
            "step": self.step,
            "grid": list(self.codes.shape[::-1]),
            "saturates": self.saturates,
            "classes": [_hex(colour) for colour in encoding.CLASS_COLOURS],
            "colours": {panel: _panel_colours(panel) for panel in COLOURS},
            "height": height_part,
            "films": films,
            "contacts": contacts,
            "first": list(self.maps.first),
            "line": line,
            "left_out": self._add_gaps(contacts),
        }, self.pictures

    def _film_map(self, film):
        return _FilmMap(encoding.Bits(film), self._on_grid(film).copy(), self._limits(film[film > 0])[1])

    def _on_grid(self, values):
        return values[:: self.step, :: self.step]

    @property
    def _is_thinned(self):
        return self.step > 1

    def _read_height(self):
        height = self.maps.load_height()
        has_mean = np.isfinite(height).any() and not self.maps.is_difference
        self.mean = float(np.nanmean(height, dtype=float)) if has_mean else 0.0
        self._choose_steps(self._on_grid(height))
        self.height_steps = encoding.steps_of(height, self.height_limits, self.mean) if self._is_thinned else None

    def _choose_steps(self, sample):
        """One decimal step for heights, gaps and films, which stand on another: fine enough for each; self.codes are those of the heights."""
        heights = np.asarray(sample, dtype=float) - self.mean
        self.height_limits = self._limits(heights)
        usual = [self.height_limits[1] - self.height_limits[0]]
        usual += [10 * film.top for film in self.films if film.top > 0 and film.wet.any]
        finite = heights[np.isfinite(heights)]
        self.power = encoding.power_of(min(usual), float(np.ptp(finite)) if finite.size else 0.0)
        codes, self.height_hole = encoding.codes_of(heights, self.power)
        self.codes = codes.astype(np.int32)

    def _try_pictures(self):
        """Begins the pictures that tell how large others are: they may be those of the page."""
        if not self._is_thinned:
            return
        gap = self._gap(self.with_gap[0]) if self.with_gap else None  # read before: a picture that is being packed takes much memory
        self._try("height", "height", self.height_steps)
        if gap:
            self._try(f"gap{gap.place}", "gap", gap.steps)

    def _try(self, name, panel, steps):
        self.tried[name] = self.beside.submit(self._encoded, panel, steps, TRIED)

    def _height(self):
        return self._part(self.height_limits, self._kept(encoding.packed(self.codes), self.height_hole))

    def _contacts(self):
        """([{"label", "state", "pressure", "picture"}], the ends of the first section)."""
        self.touched, self.saturates, first = encoding.Bits(np.zeros(self.maps.shape, dtype=bool)), False, None
        contacts, layers = [], []
        for place, choice in enumerate(self.maps.contacts):
            state, pressure = choice.load["contact"](self.step)
            found = {"label": choice.label, "file": names.of_state(choice.label), "state": self._classes(state)}
            if self._is_thinned:
                if layers:
                    layers[-1].result()  # no more than two contacts are held
                layers.append(self._layer(state))
            self.touched.add(state)
            self.saturates = self.saturates or bool(state.max() > 1)
            first = encoding.Bits(state) if place == self.maps.first[0] else first
            del state  # before more is made, and the next is read
            contacts.append({**found, **({} if pressure is None else {"pressure": self._pressure(pressure)})})
        for place, layer in enumerate(layers):
            contacts[place]["picture"] = self._keep(f"contact{place}", layer.result())
        return contacts, self._line((first or self.touched).mask())

    def _layer(self, state):
        """A Future of the picture of a contact: the other thread packs it where that has no large one."""
        if all(tried.done() for tried in self.tried.values()):
            return self.beside.submit(encoding.contact_layer, state)
        made = Future()
        made.set_result(encoding.contact_layer(state))
        return made

    def _classes(self, classes):
        return self._kept(encoding.packed(self._on_grid(classes)), None)

    def _pressure(self, pressure):
        """On the grid, in a step of its own [Pa]."""
        above = pressure[pressure > 0].astype(float)
        limits = 0.0, self._limits(above)[1] if above.size else 1.0
        power = encoding.power_of(limits[1], float(above.max(initial=0.0)))
        codes, hole = encoding.codes_of(pressure, power)
        return self._part(limits, self._kept(encoding.packed(codes), hole), power, units.scale(limits[1], "Pa"))

    def _film(self, place):
        """Thickness, and where there is any, however thin."""
        film = self.films[place]
        codes, hole = encoding.codes_of(film.thickness, self.power)
        part = self._part((0.0, film.top), self._kept(encoding.packed(codes, self.codes, is_level=True), hole))
        label = self.maps.films[place].label
        return {"label": label, "file": names.of_state(label), "wet": self._classes(film.wet.mask()), **part}

    def _part(self, limits, array, power=None, scale=None):
        """Numbers with the ends of their colours and their unit."""
        factor, unit = scale or units.length_scale(max(map(abs, limits)))
        return {"limits": list(limits), "unit": [factor, unit], "power": self.power if power is None else power, "array": array}

    def _paint(self, height, films):
        """Pictures of all pixels, where the grid has not all, of the best quality with which everything fits, else of the least."""
        if not self._is_thinned:
            return
        if self.maps.contacts and not films:
            self._keep("wet", encoding.wet_layer(np.zeros((1, 1))))
        for place, (part, film) in enumerate(zip(films, self.films)):
            part["wet_picture"] = self._keep(f"wet{place}", encoding.wet_layer(self.touched.mask() & film.wet.mask()))
        self.quality = self._quality()
        if self.with_gap:
            self._gap(self._order(self.with_gap)[0])  # _add_gaps asks for it first
        height["picture"] = self._keep("height", self._picture("height", "height", self.height_steps))

    def _quality(self):
        pictures, arrays, count = self._size_of_tried("height"), 0, len(self.with_gap)
        if count:
            place = self.with_gap[0]
            pictures += count * self._size_of_tried(f"gap{place}")
            arrays = count * len(self._gap(place).array["data"])
        fitting = [quality for quality, size in QUALITIES.items() if size * pictures + arrays <= self.left]
        return max(fitting, default=min(QUALITIES))

    def _size_of_tried(self, name):
        return len(self.tried[name].result())

    def _gap(self, place):
        """The last one is read once."""
        if self.last is None or self.last.place != place:
            gap = np.asarray(self.maps.contacts[place].load["gap"]())
            codes, hole = encoding.codes_of(self._on_grid(gap), self.power)
            limits = 0.0, self._limits(gap)[1]
            steps = encoding.steps_of(gap, limits) if self._is_thinned else None
            self.last = _GapMap(place, limits, {**encoding.packed(codes, self.codes), "hole": hole}, steps)
        return self.last

    def _add_gaps(self, contacts):
        """The gap shown first, whatever its size, then those that fit; labels of the contacts whose gap does not."""
        cost, left_out = 0, []
        for place in self._order(self.with_gap):
            if cost and self.left < cost:
                left_out.append(place)
                continue
            before = self.left
            gap = self._gap(place)
            part = self._part(gap.limits, gap.array)
            self.left -= len(gap.array["data"])
            if self._is_thinned:
                part["picture"] = self._keep(f"gap{place}", self._picture(f"gap{place}", "gap", gap.steps))
            contacts[place]["gap"] = part
            cost = before - self.left
        return [contacts[place]["label"] for place in sorted(left_out)]

    def _order(self, places):
        """That shown first, then the ends, then those between."""
        preferred = [self.maps.first[0], *places[:1], *places[-1:], *places]
        return [place for place in dict.fromkeys(preferred) if place in places]

    def _picture(self, name, panel, steps):
        tried = self.tried.pop(name, None)
        return tried.result() if tried and self.quality == TRIED else self._encoded(panel, steps, self.quality)

    def _encoded(self, panel, steps, quality):
        return encoding.coloured(steps, _table(COLOURS[panel]), HOLE, quality)

    def _kept(self, array, hole):
        self.left -= len(array["data"])
        return {**array, "hole": hole}

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
        film = self.films[self.maps.first[1]].wet.mask() if self.films else touching
        wet = touching & film
        interest = wet if wet.any() else touching
        if self.films and not interest.any():
            interest = shores(film)
        window = richest_window(interest)
        counts = window.of(interest).sum(axis=1)
        row = window.y0 + (int(np.argmax(counts)) if counts.max() > 0 else len(counts) // 2)
        return [[window.x0, row], [window.x1 - 1, row]]


def _table(colours):
    """uint8 (256, 3)"""
    from matplotlib import colormaps

    colour_map = colormaps[colours] if isinstance(colours, str) else colours
    return np.rint(255 * colour_map(np.linspace(0, 1, 256))[:, :3]).astype(np.uint8)


def _panel_colours(panel):
    """What viewer.js paints with: 256 colours, of which the first is that of what has no value."""
    table = _table(COLOURS[panel])
    table[0] = GROUNDS[panel]
    return table.tobytes().hex()


def _hex(colour):
    return "#" + bytes(colour).hex()


def css_gradient(colours):
    """The colours from low to high for a style sheet."""
    table = _table(colours)[::32].tolist() + [_table(colours)[-1].tolist()]
    return f"linear-gradient(to right, {', '.join('rgb(' + ','.join(map(str, colour)) + ')' for colour in table)})"
