"""Pressure, gap, film and section of one state of a single-scan result."""

import dataclasses
from functools import cached_property

import numpy as np

from tabor.report import hdf, map_axes, maps, names, oil, section, style, units
from tabor.report.example import richest_window, shores
from tabor.report.figures import Drawn, contact_map, topography

_VIEWED = "pressure", "gap", "film"  # maps that the interactive ones hold, too


def draw(single):
    """Yields all figures that the maps allow, state by state: contact does not know the lubricant nor
    a film the pressure, so that each is drawn for the first state that shows it."""
    drawn, sections = set(), _Sections(single)
    for state in single.states:
        figures = []
        if ("contact", state.pressure_label) not in drawn:
            figures += [_pressure(single, state), _contact(single, state), _gap(single, state)]
        if ("film", state.density) not in drawn:
            figures.append(_film(single, state))
        figures += _beside_the_viewer(single, state, drawn)
        drawn.update({("contact", state.pressure_label), ("film", state.density)})
        if single.is_solved_on(state):
            figures.append(sections.draw(state))
        yield from (figure for figure in figures if figure is not None)


def draw_beside_the_viewer(single):
    """Yields the maps that interactive maps do not hold."""
    drawn = set()
    for state in single.states:
        yield from (figure for figure in _beside_the_viewer(single, state, drawn) if figure is not None)


def _beside_the_viewer(single, state, drawn):
    """The tool is drawn at each of its places once, what the sheet yields at once for each contact."""
    place, contact = ("tool", state.facts.get("tool_x_m")), ("yielding", state.pressure_label)
    figures = [] if place in drawn else [_tool(single, state)]
    figures += [] if contact in drawn else [_yielding(single, state)]
    drawn.update({place, contact})
    return [*figures, _liquid_pressure(single, state), _fluid_pressure(single, state), _fluid_fill(single, state)]


def _tool(single, state):
    """None under a flat."""
    tool = state.map("tool")
    if tool is None:
        return None
    place = units.length(state.facts["tool_x_m"]) if state.facts.get("tool_x_m") else "0 µm"
    figure = topography.draw(tool, single.pixel, f"tool_{names.of_state(place)}", f"tool at x = {place}", zero="Height towards the surface")
    return dataclasses.replace(figure, title=f"Tool at x = {place}", is_viewed=False)


def _pressure(single, state):
    pressure = state.map("pressure")
    if pressure is None:
        return None
    return _map(
        single,
        state,
        "pressure",
        np.where(pressure > 0, pressure * 1e-6, np.nan),
        "pressure (MPa)",
        map_axes.PRESSURE_COLOURS,
        f"Contact pressure{oil.of_solids(state.facts)} (MPa); white: no contact",
        "white",
        state.pressure_label,
    )


def _contact(single, state):
    touching = state.state()
    if touching is None:
        return None
    return contact_map.draw(
        touching, single.pixel, state.facts, single.title, f"contact_{names.of_state(state.pressure_label)}", pressure=state.pressure_text
    )


def _gap(single, state):
    gap = state.map("gap")
    if gap is None:
        return None
    factor, unit = map_axes.height_unit(gap)
    return _map(
        single,
        state,
        "gap",
        gap * factor,
        f"gap ({unit})",
        map_axes.GAP_COLOURS,
        f"Gap between the surfaces{oil.of_solids(state.facts)} ({unit})",
        map_axes.HOLE,
        state.pressure_label,
    )


def _yielding(single, state):
    """None on a sheet that yields at one pressure everywhere."""
    pressure = state.map("saturation_pressure")
    if pressure is None:
        return None
    factor, unit = units.scale(float(np.nanmax(pressure)), "Pa")
    lowest, highest = float(pressure.min()) * factor, float(pressure.max()) * factor
    return _map(
        single,
        state,
        "saturation_pressure",
        pressure * factor,
        f"saturation pressure ({unit})",
        map_axes.PRESSURE_COLOURS,
        f"Pressure at which the sheet yields here ({unit}): higher where it has yielded",
        map_axes.HOLE,
        state.pressure_label,
        highest=highest,
        lowest=lowest,
    )


def _film(single, state):
    film = state.map("film_thickness")
    if film is None:
        return None
    factor, unit = units.length_scale(max(float(np.nanmax(film)), 1e-9))
    return _map(
        single,
        state,
        "film",
        np.where(film > 0, film * factor, np.nan),
        f"film thickness ({unit})",
        map_axes.FILM_COLOURS,
        f"Lubricant thickness ({unit}); sand colour: dry",
        map_axes.DRY_GROUND,
        state.density_label,
    )


def _liquid_pressure(single, state):
    return _oil_pressure(
        single, state, "liquid_pressure", "pressure of the trapped oil", "Pressure of the oil in closed pockets of the gap", "white: no pressure", state.label
    )


def _oil_pressure(single, state, name, axis_label, text, rest, label):
    pressure = state.map(name)
    if pressure is None:
        return None
    factor, unit = units.scale(float(np.nanmax(pressure)), "Pa")
    return _map(
        single,
        state,
        name,
        np.where(pressure > 0, pressure * factor, np.nan),
        f"{axis_label} ({unit})",
        map_axes.PRESSURE_COLOURS,
        f"{text} ({unit}); {rest}",
        "white",
        label,
    )


def _flow_label(state):
    speed = state.facts.get("sliding_speed_m_per_s")
    return state.label if speed is None else f"{state.label}, {units.si(speed, 'm/s')}"


def _fluid_pressure(single, state):
    return _oil_pressure(
        single, state, "fluid_pressure", "pressure of the oil", "Pressure of the oil while it slides along x", "white: none", _flow_label(state)
    )


def _fluid_fill(single, state):
    fill = state.map("fluid_fill")
    if fill is None:
        return None
    return _map(
        single,
        state,
        "fluid_fill",
        np.where(fill > 0, 100 * fill, np.nan),
        "share of the gap filled with oil (%)",
        map_axes.FILM_COLOURS,
        "How much of the gap oil fills while it slides (%); sand colour: dry",
        map_axes.DRY_GROUND,
        _flow_label(state),
        highest=100.0,
    )


def _map(single, state, what, values, axis_label, colours, text, ground, label, highest=None, lowest=0.0):
    view = map_axes.MapView(maps.whole(values), single.pixel)
    shown = view.reduced(values)
    high = highest or map_axes.robust_limits(shown)[1]
    figure, grid = style.new_figure(contact_map.figure_height(view, 4.6), width=6.0)
    map_axes.colour_map(grid[0][0], view, shown, axis_label, colours, (lowest, high), ground)
    grid[0][0].set_title(label.replace("P =", "$P$ ="))
    end = "" if highest else "Colours end at the 99.5th percentile of what is drawn."
    return Drawn(
        f"{what}_{names.of_state(label)}",
        f"{what.replace('_', ' ').capitalize()} map: {label}",
        f"{text}, at {label}. {view.note}{end}",
        figure,
        {"": view.csv(shown, axis_label.replace("µ", "u"))},
        is_map=True,
        is_viewed=what in _VIEWED,
    )


class _Sections:
    """Draws sections of states; what states share is read once."""

    def __init__(self, single):
        self.single = single
        self.touching = None, None  # of the last pressure: (its label, mask)
        self.wet = {}  # {density: mask}

    @cached_property
    def mean_height(self):
        return np.nanmean(self.single.raw_height(), dtype=float)

    def draw(self, state):
        """None for a state without gap and film."""
        gap, film = hdf.child(state.node, "gap"), hdf.child(state.node, "film_thickness")
        if gap is None and film is None:
            return None
        row, columns = self._place(state)
        pixel = self.single.pixel
        return _section(state, section.cut(row, columns, pixel[0], self.single.surface["height"], film, gap, self.mean_height),
                        (row + 0.5) * pixel[1])  # fmt: skip

    def _place(self, state):
        """Row and columns of the section: where most of the (wet) contact is, else the middle."""
        touching, wet = self._touching(state), self._wet(state)
        interest = touching if touching is not None else shores(wet)
        if touching is not None and wet is not None and (touching & wet).any():
            interest = touching & wet
        window = richest_window(interest)
        counts = window.of(interest).sum(axis=1)
        row = int(np.argmax(counts)) if counts.max() > 0 else len(counts) // 2
        return window.y0 + row, (window.x0, window.x1)

    def _touching(self, state):
        if self.touching[0] != state.pressure_label:
            found = state.state()
            self.touching = state.pressure_label, None if found is None else found > 0
        return self.touching[1]

    def _wet(self, state):
        if state.density_label not in self.wet:
            film = state.raw("film_thickness")
            self.wet[state.density_label] = None if film is None else film > 0
        return self.wet[state.density_label]


def _section(state, lines, y):
    length, length_unit = units.length_scale(lines["x_m"][-1] - lines["x_m"][0])
    factor, unit = map_axes.height_unit(lines["solid_m"])
    figure, grid = style.new_figure(3.0)
    section.draw(grid[0][0], lines, length, length_unit, factor, unit)
    style.legend_above(grid[0][0], 4)
    stretch = section.exaggeration(grid[0][0], length, factor)
    caption = (
        f"Section along x at y = {units.number(y * length)} {length_unit}, {state.label}: solid (grey), lubricant before the "
        "surfaces close (blue), counterface (red) as undeformed solid plus gap (what stands above it has been flattened: pink), whichever the file holds. "
        f"Heights are stretched {units.number(stretch, 2)} times against lengths."
    )
    return Drawn(
        f"section_{names.of_state(_flow_label(state))}",
        f"Section: {state.label}",
        caption,
        figure,
        {"": section.csv(lines)},
        is_viewed=True,
    )
