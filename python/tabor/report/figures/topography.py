"""The treated surface as a height map (Figure 3 of the seed paper)."""

import numpy as np

from tabor.report import map_axes, maps, style
from tabor.report.figures import Drawn


def draw(height, pixel, name, scan_name, suffix="", zero=None):
    """height [m], shape (ny, nx); pixel (x, y) [m]; zero: what its zero means, where heights are not shown about their mean."""
    view = map_axes.MapView(maps.whole(height), pixel)
    values = view.reduced(height)
    factor, unit = map_axes.height_unit(values)
    mean = np.nanmean(height) if zero is None and np.isfinite(values).any() else 0.0
    values = (values - mean) * factor
    label = zero or "height about the mean"
    figure, axes = style.new_figure(_height(view), width=6.0)
    map_axes.colour_map(axes[0][0], view, values, f"{label} ({unit})", map_axes.HEIGHT_COLOURS)
    axes[0][0].set_title(style.literal(scan_name))
    caption = (
        f"{label.capitalize() if zero is None else label} of {scan_name} ({unit}); x is the sliding direction, row 0 on "
        f"top. {view.note}Colours span the 0.5th to 99.5th percentile of what is drawn; grey: missing pixels."
    )
    return Drawn(
        name + suffix,
        f"Topography: {scan_name}",
        caption,
        figure,
        {"": view.csv(values, f"height_{_ascii(unit)}")},
        is_map=True,
        is_viewed=True,
    )


def _height(view):
    """Inches for a 6-inch wide figure with its colour bar."""
    rows, columns = view.window.shape
    ratio = rows * view.pixel[1] / (columns * view.pixel[0])
    return float(np.clip(4.6 * ratio + 0.8, 2.2, 9.0))


def _ascii(unit):
    return unit.replace("µ", "u")
