"""The sheet before and after sliding: maps, their difference, a section along x."""

import dataclasses

import numpy as np

from tabor.report import chart, map_axes, maps, names, style, units
from tabor.report.example import richest_window
from tabor.report.figures import Drawn, single_maps, topography
from tabor.report.output import table_text

CHANGE_COLOURS = "RdBu_r"


def draw(slide, with_maps=True):
    """Yields sheet and change of the last state with maps, a section, then the contact maps of all."""
    if not slide.with_maps:
        return
    last = slide.with_maps[-1]
    before, after = slide.height(), last.map("sheet")
    sheet = topography.draw(after, slide.pixel, f"sheet_{names.of_state(last.name)}", f"{slide.title}, {last.name}")
    yield dataclasses.replace(sheet, is_viewed=False)  # the interactive maps show the sheet before
    yield _change(slide, last, after - before)
    yield _section(slide, last, before, after)
    yield from single_maps.draw(slide) if with_maps else single_maps.draw_beside_the_viewer(slide)


def _change(slide, state, change):
    view = map_axes.MapView(maps.whole(change), slide.pixel)
    shown = view.reduced(change)
    factor, unit = map_axes.height_unit(shown)
    high = max(abs(end) for end in map_axes.robust_limits(shown * factor))
    figure, grid = style.new_figure(single_maps.contact_map.figure_height(view, 4.6), width=6.0)
    map_axes.colour_map(grid[0][0], view, shown * factor, f"change of height ({unit})", CHANGE_COLOURS, (-high, high))
    grid[0][0].set_title(state.name)
    return Drawn(
        f"change_{names.of_state(state.name)}",
        f"Change of the sheet: {state.name}",
        f"Height of {slide.title} {state.name} less that before ({unit}): blue is displaced or worn, red has risen. {view.note}Colours end at the 99.5th "
        "percentile of what is drawn.",
        figure,
        {"": view.csv(shown * factor, f"change_{unit.replace('µ', 'u')}")},
        is_map=True,
    )


def _section(slide, state, before, after):
    """Along x, where most has been displaced."""
    taken = np.where(np.isfinite(after - before), np.maximum(before - after, 0.0), 0.0)
    window = richest_window(taken > 0.1 * taken.max(initial=0.0))
    row = window.y0 + int(np.argmax(window.of(taken).sum(axis=1)))
    beside = (window.x1 - window.x0) // 2
    first, end = max(0, window.x0 - beside), min(before.shape[1], window.x1 + beside)
    columns = slice(first, end)
    x = (np.arange(first, end) + 0.5) * slide.pixel[0]
    length, length_unit = units.length_scale(x[-1] - x[0])
    level = float(np.nanmean(before))
    lines = [field[row, columns] - level for field in (before, after)]
    factor, unit = map_axes.height_unit(np.concatenate(lines))
    items = [
        chart.Curve(x * length, lines[0] * factor, "before", "0.4", "--", 1.2),
        chart.Curve(x * length, lines[1] * factor, state.name, style.COLOURS[1], width=1.4),
    ]
    panel = chart.Panel(chart.Axis(f"$x$ ({length_unit})"), chart.Axis(f"$z$ about the mean ({unit})"), items)
    return Drawn(
        "section_before_and_after",
        "Section of the sheet before and after",
        f"Along x, the direction of sliding, at y = {units.length((row + 0.5) * slide.pixel[1])}, where most has been displaced.",
        chart.Figure([[panel]], 3.0, 7.2),
        {"": table_text({"x_m": x, "before_m": lines[0] + level, "after_m": lines[1] + level})},
    )
