"""Dry topography, lubricant thickness and a section through both (Figure 7 of the seed paper)."""

import numpy as np

from tabor.report import map_axes, section, style, units
from tabor.report.figures import Drawn


def draw(example, name="lubricant_map"):
    """None where the scan has no film."""
    if example.film is None or example.height is None:
        return None
    view = map_axes.MapView(example.window, example.scan.pixel)
    figure = style.plt.figure(figsize=(style.WIDTH, 5.6))
    grid = figure.add_gridspec(2, 2, height_ratios=(1.25, 1))
    left, right = figure.add_subplot(grid[0, 0]), figure.add_subplot(grid[0, 1])
    bottom = figure.add_subplot(grid[1, :])
    height, height_unit = _draw_height(left, view, example)
    film, film_unit = _draw_film(right, view, example)
    for axes in (left, right):
        axes.axhline(
            (example.row + 0.5) * example.scan.pixel[1] * view.factor,
            color="black",
            linestyle=(0, (4, 3)),
            linewidth=1.0,
        )
    lines, stretch = _draw_section(bottom, view, example)
    data = {
        "": section.csv(lines),
        "_height": view.csv(height, f"height_{height_unit.replace('µ', 'u')}"),
        "_film": view.csv(np.nan_to_num(film), f"film_{film_unit.replace('µ', 'u')}"),
    }
    return Drawn(
        name + example.suffix,
        f"Lubricant map: {example.scan.name}",
        _caption(view, example, stretch),
        figure,
        data,
        is_map=True,
        is_viewed=True,
    )


def _draw_height(axes, view, example):
    values = view.reduced(example.height)
    factor, unit = map_axes.height_unit(values)
    values = (values - np.nanmean(example.height)) * factor
    map_axes.colour_map(axes, view, values, f"height ({unit})", map_axes.HEIGHT_COLOURS)
    axes.set_title("(a) dry topography")
    return values, unit


def _draw_film(axes, view, example):
    values = view.reduced(example.thickness)
    top = float(np.nanmax(values)) if np.isfinite(values).any() else 0.0
    factor, unit = units.length_scale(top if top > 0 else 1e-6)
    wet = np.where(values > 0, values * factor, np.nan)
    limits = (0.0, float(np.nanpercentile(wet, 99.5))) if np.isfinite(wet).any() else (0.0, 1.0)
    map_axes.colour_map(
        axes, view, wet, f"film thickness ({unit})", map_axes.FILM_COLOURS, limits, ground=map_axes.DRY_GROUND
    )
    axes.set_title(f"(b) lubricant, {units.density(example.film.density)}")
    return wet, unit


def _draw_section(axes, view, example):
    gap = example.gap if example.contact is not None else None
    height = example.height - np.nanmean(example.height)
    lines = section.cut(
        example.row, (view.window.x0, view.window.x1), example.scan.pixel[0], height, example.thickness, gap
    )
    factor, unit = map_axes.height_unit(lines["solid_m"])
    section.draw(axes, lines, view.factor, view.unit, factor, unit)
    axes.set_title("(c) section along the dashed line" + _closed(example), pad=18)
    style.legend_above(axes, 4)
    return lines, section.exaggeration(axes, view.factor, factor)


def _closed(example):
    return (
        ""
        if example.contact is None
        else f", counterface at $P$ = {units.pressure(example.contact.pressure)}"
    )


def _caption(view, example, stretch):
    where = f"{example.scan.name}, part of the surface with the most wet contact (a place chosen to show it, not a typical one)"
    text = (
        f"{where}. (a) Dry height about the mean of the scan; (b) lubricant thickness after deposition of "
        f"{units.density(example.film.density)}, sand colour: dry. {view.note}(c) Section along the dashed line: "
        "solid (grey), lubricant before the surfaces close (blue)"
    )
    if example.contact is not None:
        text += (
            " and the counterface (red), drawn as the undeformed solid plus the gap, hence the deformed flat, at "
            f"{units.pressure(example.contact.pressure)}; solid above it has been flattened (pink), liquid above it would be squeezed out"
        )
    return (
        text
        + f". Heights are stretched {units.number(stretch, 2)} times against lengths. As Figure 7 of Costagliola et al."
    )
