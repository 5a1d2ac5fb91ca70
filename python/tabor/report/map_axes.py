"""Drawing one map: physical axes, equal aspect, a colour bar with its unit, the data that was drawn."""

import numpy as np
from matplotlib import colormaps
from matplotlib.colors import LinearSegmentedColormap, ListedColormap
from matplotlib.transforms import offset_copy

from tabor.report import maps, units
from tabor.report.output import map_table

HEIGHT_COLOURS = "viridis"  # perceptually uniform
PRESSURE_COLOURS = "inferno_r"
GAP_COLOURS = "cividis"
_blues = colormaps["Blues"](np.linspace(0.25, 1.0, 256))
FILM_COLOURS = ListedColormap(_blues, name="film")
INK = LinearSegmentedColormap.from_list("ink", ["white", "black"])
HOLE, DRY_GROUND = "0.75", "#F4F0E6"


class MapView:
    """A window of a map with pixel size [m], shown in the length unit that suits it."""

    def __init__(self, window, pixel):
        self.window = window
        self.pixel = pixel
        self.block = maps.block_size(window.shape)
        self.factor, self.unit = units.length_scale(
            max(window.shape[1] * pixel[0], window.shape[0] * pixel[1])
        )

    @property
    def extent(self):
        return maps.extent(self.window, self.pixel, self.factor)

    def reduced(self, field):
        return maps.block_mean(self.window.of(field), self.block)

    def csv(self, values, what):
        """The printed map as a matrix; what names the quantity and its unit."""
        x = maps.tile_centres(self.window.x0, self.window.x1, self.block, self.pixel[0], self.factor)
        y = maps.tile_centres(self.window.y0, self.window.y1, self.block, self.pixel[1], self.factor)
        return map_table(f"{what} (row: y_{self.unit}; column: x_{self.unit})", x, y, values)

    def label(self, axes, y_label=True):
        axes.set_xlabel(f"$x$ ({self.unit})")
        if y_label:
            axes.set_ylabel(f"$y$ ({self.unit})")
        for side in ("top", "right"):
            axes.spines[side].set_visible(True)

    @property
    def note(self):
        """What the reader must know about the reduction."""
        if self.block == 1:
            return "Every pixel is drawn. "
        return f"Each printed point is the mean of {self.block} × {self.block} pixels. "


def colour_map(axes, view, values, label, colours, limits=None, ground=HOLE):
    """Shows `values` (reduced, in print units) and its colour bar; returns nothing to keep."""
    low, high = limits or robust_limits(values)
    image = axes.imshow(
        np.ma.masked_invalid(values),
        extent=view.extent,
        cmap=colours,
        vmin=low,
        vmax=high,
        interpolation="nearest",
        aspect="equal",
    )
    axes.set_facecolor(ground)
    view.label(axes)
    # Inset, so that it is as high as the map whatever the map's shape.
    beside = axes.inset_axes([1.03, 0, 0.045 * _narrowness(view), 1])
    bar = axes.figure.colorbar(image, cax=beside, extend=_extend(values, low, high))
    bar.set_label(label)
    bar.outline.set_linewidth(0.5)


def robust_limits(values):
    """0.5th and 99.5th percentile: a few spikes must not take the colours of the whole map."""
    finite = values[np.isfinite(values)]
    if finite.size == 0:
        return 0.0, 1.0
    low, high = np.percentile(finite, [0.5, 99.5])
    return (low, high) if high > low else (low - 0.5, low + 0.5)


def ink_map(axes, view, touching):
    """Real contact in black; returns the share of contact of every printed point."""
    share = view.reduced(touching)
    axes.imshow(
        maps.ink(share), extent=view.extent, cmap=INK, vmin=0, vmax=1, interpolation="nearest", aspect="equal"
    )
    view.label(axes)
    return share


def scale_bar(axes, view):
    """A bar of a round length below the lower right corner, where it covers nothing."""
    left, right, _, _ = view.extent
    length = round_length((right - left) / 4)
    share = length / (right - left)
    below = offset_copy(axes.transAxes, fig=axes.figure, y=-27, units="points")
    axes.plot(
        [1 - share, 1],
        [0, 0],
        transform=below,
        color="black",
        linewidth=2.5,
        solid_capstyle="butt",
        clip_on=False,
    )
    axes.annotate(
        f"{length:g} {view.unit}",
        (1 - share / 2, 0),
        xycoords=below,
        xytext=(0, -3),
        textcoords="offset points",
        ha="center",
        va="top",
        fontsize=8,
    )


def round_length(largest):
    """The greatest of 1, 2, 5 x 10^k that is not above `largest`."""
    power = 10.0 ** np.floor(np.log10(largest))
    return max(step * power for step in (1, 2, 5) if step * power <= largest * (1 + 1e-9))


def ink_note(view):
    if view.block == 1:
        return "Every pixel is drawn. "
    return (
        f"Each printed point stands for {view.block} × {view.block} pixels and is the darker the more of them are "
        "in contact, never lighter than 35% grey where any is, so that small contacts stay visible. "
    )


def height_unit(values):
    finite = values[np.isfinite(values)]
    return units.length_scale(float(np.ptp(np.percentile(finite, [0.5, 99.5]))) if finite.size else 1e-6)


def _narrowness(view):
    """1 for a square or wide map, more for a tall one, so that the bar keeps its width."""
    rows, columns = view.window.shape
    return max(1.0, rows * view.pixel[1] / (columns * view.pixel[0]))


def _extend(values, low, high):
    finite = values[np.isfinite(values)]
    below, above = bool((finite < low).any()), bool((finite > high).any())
    return {(True, True): "both", (True, False): "min", (False, True): "max"}.get((below, above), "neither")
