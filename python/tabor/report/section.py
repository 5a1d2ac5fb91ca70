"""A vertical cut through solid, liquid and the deformed counterface."""

import numpy as np

from tabor.report import style
from tabor.report.output import table_text


def cut(row, columns, pixel_x, height, film=None, gap=None, level=0.0):
    """Lines along x of one row, all [m]: pixel centres, solid above `level`, liquid level, counterface; NaN if unknown.

    Maps are arrays or datasets of a file, of which the row alone is read.
    """
    start, stop = columns
    solid = np.asarray(height[row, start:stop], dtype=float) - level
    nothing = np.full(solid.shape, np.nan)
    thickness = np.nan_to_num(np.asarray(film[row, start:stop], dtype=float)) if film is not None else None
    return {
        "x_m": (np.arange(start, stop) + 0.5) * pixel_x,
        "solid_m": solid,
        "liquid_level_m": (
            nothing if thickness is None else np.where(thickness > 0, solid + thickness, np.nan)
        ),
        "counterface_m": nothing if gap is None else solid + np.asarray(gap[row, start:stop], dtype=float),
    }


def draw(axes, lines, length_factor, length_unit, height_factor, height_unit):
    x, solid = lines["x_m"] * length_factor, lines["solid_m"] * height_factor
    level, counter = lines["liquid_level_m"] * height_factor, lines["counterface_m"] * height_factor
    bottom = _bottom(solid, level, counter)
    # Neither liquid nor metal floats over a hole of the scan.
    axes.fill_between(x, bottom, solid, color=style.SOLID, linewidth=0, step="mid", label="solid")
    _draw_flattened(axes, x, solid, counter)
    axes.plot(x, solid, color="0.3", linewidth=0.7, drawstyle="steps-mid")
    if np.isfinite(level).any():
        _fill(axes, x, solid, np.fmax(level, solid), style.LIQUID, "lubricant before closing")
    if np.isfinite(counter).any():
        axes.plot(x, counter, color=style.WARNING, linewidth=1.1, label="counterface: solid + gap")
    axes.set_xlim(x[0], x[-1])
    axes.set_ylim(bottom=bottom)
    axes.set_xlabel(f"$x$ ({length_unit})")
    axes.set_ylabel(f"$z$ ({height_unit})")


def _draw_flattened(axes, x, solid, counter):
    """Shades solid that stands above the counterface, where it cannot be any more: it has been pressed flat."""
    if (solid > counter).any():
        _fill(axes, x, np.fmin(counter, solid), solid, style.FLATTENED, "flattened")


def _fill(axes, x, low, high, colour, label):
    """Whole pixels: with `where` Matplotlib would leave out half of each at the end of a run."""
    axes.fill_between(x, low, high, color=colour, linewidth=0, step="mid", label=label)


def exaggeration(axes, length_factor, height_factor):
    """How many times heights are stretched against lengths on paper; ask after the layout is done."""
    axes.figure.draw_without_rendering()
    box = axes.get_window_extent()
    low, high = axes.get_ylim()
    left, right = axes.get_xlim()
    return (box.height / ((high - low) / height_factor)) / (box.width / ((right - left) / length_factor))


def csv(lines):
    return table_text(lines)


def _bottom(*curves):
    finite = np.concatenate([curve[np.isfinite(curve)] for curve in curves])
    if finite.size == 0:
        return 0.0
    return float(finite.min() - 0.12 * max(np.ptp(finite), 1e-12))
