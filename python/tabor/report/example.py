"""Which scan, pressure, density and window the maps show."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from tabor.report import names
from tabor.report.errors import InputError
from tabor.report.maps import Window

MIN_WINDOW, MAX_WINDOW = 64, 720  # pixels


@dataclass
class Example:
    """Maps of one scan at one pressure and density; contact or film is None where there is none."""

    scan: object
    contact: object
    film: object
    suffix: str = ""

    @cached_property
    def height(self):
        return self.scan.height()

    @cached_property
    def state(self):
        return self.contact.state()

    @cached_property
    def gap(self):
        return self.contact.gap()

    @cached_property
    def thickness(self):
        return self.film.thickness()

    @cached_property
    def window(self):
        """The fifth of a side that holds the most wet contact; else the most contact."""
        return richest_window(self._interest)

    @cached_property
    def row(self):
        """Row of the section (in the whole map): the one of the window with the most wet contact."""
        counts = self.window.of(self._interest).sum(axis=1)
        row = int(np.argmax(counts)) if counts.max() > 0 else len(counts) // 2
        return self.window.y0 + row

    @cached_property
    def _interest(self):
        if self.contact is None:
            return (
                np.zeros(self.thickness.shape, dtype=bool)
                if self.film
                else np.zeros(self.height.shape, dtype=bool)
            )
        touching = self.state > 0
        wet = touching & (self.thickness > 0) if self.film is not None else touching
        return wet if wet.any() else touching


def choose(scan, pressure=None, density=None, suffix=""):
    """The stored states nearest to what is asked; the middle pressure and lowest density if nothing is."""
    return Example(
        scan,
        _nearest(scan.contacts(), "pressure", pressure, middle=True),
        _nearest(_wetting(scan.films()), "density", density, middle=False),
        suffix,
    )


def check(study, options):
    """Raises InputError where the study has no such scan."""
    if options.scan is not None and not 0 <= options.scan < len(study.scans):
        raise InputError(f"--scan {options.scan}: the study has scans 0 to {len(study.scans) - 1}")


def examples(study, options):
    """One example per scan asked for: the first that has maps, all, or a given one."""
    if options.all_scans:
        called = names.in_files([scan.name for scan in study.scans])
        return [choose(scan, options.pressure, options.density, f"_{name}") for scan, name in zip(study.scans, called)]
    if options.scan is not None:
        return [choose(study.scans[options.scan], options.pressure, options.density)]
    candidates = (choose(scan, options.pressure, options.density) for scan in study.scans)
    found = next((item for item in candidates if item.contact and item.height is not None), None)
    return [found] if found else [choose(scan) for scan in study.scans[:1]]


def others(study, options, shown):
    """Yields examples of further scans, which a page without choice of a scan has room for."""
    if options.all_scans or options.scan is not None:
        return
    for scan in study.scans:
        if all(scan is not item.scan for item in shown):
            item = choose(scan, options.pressure, options.density)
            if item.height is not None:
                yield item


def richest_window(interest):
    """The window with the most marked pixels among overlapping ones half a side apart; of several the one next to the middle."""
    rows, columns = interest.shape
    side = min(max(min(rows, columns) // 5, MIN_WINDOW), MAX_WINDOW, rows, columns)
    step = max(1, side // 2)
    starts = _starts(rows, side, step), _starts(columns, side, step)
    inside = _inside(interest, starts, side)
    y, x = max(inside, key=lambda start: (inside[start], -_from_middle(start, side, interest.shape), -start[0], -start[1]))
    return Window(y, y + side, x, x + side)


def shores(wet):
    """Wet pixels whose right neighbour is dry: where pools end there is most to see."""
    return wet & ~np.roll(wet, -1, axis=1)


def _from_middle(start, side, shape):
    return max(abs(2 * begin + side - length) for begin, length in zip(start, shape))


def _starts(length, side, step):
    return sorted({*range(0, length - side + 1, step), length - side})


def _inside(interest, starts, side):
    """{(y, x): marked pixels of the window that starts there}: sums of the tiles between all edges, of which each is counted once."""
    rows, columns = (sorted({*begins, *(begin + side for begin in begins)}) for begins in starts)
    tiles = [[np.count_nonzero(interest[y:y_end, x:x_end]) for x, x_end in zip(columns, columns[1:])] for y, y_end in zip(rows, rows[1:])]
    counts = np.pad(np.cumsum(np.cumsum(tiles, axis=0), axis=1), ((1, 0), (1, 0)))
    row, column = ({edge: place for place, edge in enumerate(edges)} for edges in (rows, columns))

    def below(y, x):
        return counts[row[y], column[x]]

    return {(y, x): below(y + side, x + side) - below(y, x + side) - below(y + side, x) + below(y, x) for y in starts[0] for x in starts[1]}


def _wetting(films):
    return [film for film in films if film.density > 0]


def _nearest(states, name, wanted, middle):
    if not states:
        return None
    if wanted is None:
        return states[len(states) // 2 if middle else 0]
    return min(states, key=lambda state: abs(getattr(state, name) - wanted))
