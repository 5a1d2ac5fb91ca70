"""Pressure, gap, film and section of one state of a single-scan result."""

import numpy as np

from tabor_report import map_axes, maps, section, style, units
from tabor_report.example import richest_window
from tabor_report.figures import Drawn, contact_map


def draw(single, state):
    """All figures that the maps of this state allow."""
    figures = [
        _pressure(single, state),
        _contact(single, state),
        _gap(single, state),
        _film(single, state),
        _section(single, state),
    ]
    return [figure for figure in figures if figure is not None]


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
        "Contact pressure (MPa); white: no contact",
        "white",
        (0.0, None),
    )


def _contact(single, state):
    touching = state.state()
    if touching is None:
        return None
    return contact_map.draw(touching, single.pixel, state.facts, single.title, f"state{state.key}_contact")


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
        f"Gap between the surfaces ({unit})",
        map_axes.HOLE,
        (0.0, None),
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
        (0.0, None),
    )


def _map(single, state, what, values, axis_label, colours, text, ground, limits):
    view = map_axes.MapView(maps.whole(values), single.pixel)
    shown = view.reduced(values)
    low, high = map_axes.robust_limits(shown)
    low = low if limits[0] is None else limits[0]
    figure, grid = style.new_figure(contact_map.figure_height(view, 4.6), width=6.0)
    map_axes.colour_map(grid[0][0], view, shown, axis_label, colours, (low, high), ground)
    grid[0][0].set_title(state.label.replace("P =", "$P$ ="))
    caption = f"{text}, at {state.label}. {view.note}Colours end at the 99.5th percentile of what is drawn."
    return Drawn(
        f"state{state.key}_{what}",
        f"{what.capitalize()} map: {state.label}",
        caption,
        figure,
        {"": view.csv(shown, axis_label.replace("µ", "u"))},
        is_map=True,
    )


def _section(single, state):
    gap, film = state.map("gap"), state.map("film_thickness")
    if gap is None and film is None:
        return None
    height = single.height()
    height = height - np.nanmean(height)
    row, columns = _place(state, film, height)
    lines = section.cut(row, columns, single.pixel[0], height, film, gap)
    length, length_unit = units.length_scale((columns[1] - columns[0]) * single.pixel[0])
    factor, unit = map_axes.height_unit(lines["solid_m"])
    figure, grid = style.new_figure(3.0)
    section.draw(grid[0][0], lines, length, length_unit, factor, unit)
    style.legend_above(grid[0][0], 3)
    stretch = section.exaggeration(grid[0][0], length, factor)
    where = units.number((row + 0.5) * single.pixel[1] * length)
    caption = (
        f"Section along x at y = {where} {length_unit}, {state.label}: solid (grey), lubricant before the "
        "surfaces close (blue), counterface (red) as undeformed solid plus gap (solid above it is flattened), whichever the file holds. "
        f"Heights are stretched {units.number(stretch, 2)} times against lengths."
    )
    return Drawn(
        f"state{state.key}_section", f"Section: {state.label}", caption, figure, {"": section.csv(lines)}
    )


def _shores(film):
    """Wet pixels whose right neighbour is dry: where pools end there is most to see."""
    wet = film > 0
    return wet & ~np.roll(wet, -1, axis=1)


def _place(state, film, height):
    """Row and columns of the section: where most of the (wet) contact is, else the middle."""
    touching = state.state()
    interest = touching > 0 if touching is not None else _shores(film)
    if touching is not None and film is not None and (interest & (film > 0)).any():
        interest = interest & (film > 0)
    window = richest_window(interest)
    counts = window.of(interest).sum(axis=1)
    row = int(np.argmax(counts)) if counts.max() > 0 else len(counts) // 2
    return window.y0 + row, (window.x0, window.x1)
