"""How the heights of one surface are distributed: their histogram and the material ratio curve (Abbott-Firestone)."""

import numpy as np

from tabor.report import chart, map_axes, style
from tabor.report.figures import Drawn
from tabor.report.output import table_text
from tabor.report.surface_numbers import sorted_heights

BINS = 80
POINTS = 201  # of the material ratio curve
ENOUGH = 500_000  # heights that tell their unit


def _at(ratio, z):
    """Heights above which these percentages of them lie; few of them are looked at."""
    step = 100 / (z.size - 1)
    before = np.minimum((ratio / step).astype(int), z.size - 2)
    places = np.unique(np.clip([before - 1, before, before + 1, before + 2], 0, z.size - 1))
    shares = places * step
    shares[-1] = 100.0
    return np.interp(ratio, shares, z[places])


def draw(single):
    """None for a surface without two different heights."""
    z = sorted_heights(single.raw_height(), mean=not single.is_difference)
    if z.size < 2 or z[0] == z[-1]:
        return None
    factor, unit = map_axes.height_unit(z[:: 1 + z.size // ENOUGH])
    z *= factor
    share, edges = np.histogram(z, bins=BINS)
    density = share / (z.size * np.diff(edges))
    ratio = np.linspace(0, 100, POINTS)
    curve = _at(ratio, z)
    label = f"{single.heading_of_heights} ({unit})" if single.is_difference else f"height $z$ about the mean ({unit})"
    middles = (edges[:-1] + edges[1:]) / 2
    bins = chart.Curve(np.repeat(density, 2), np.repeat(edges, 2)[1:-1], "share of the area", style.COLOURS[0])
    of_area = chart.Curve(ratio, curve, "material ratio", style.COLOURS[1])
    left = chart.Panel(chart.from_zero(f"share of the area per {unit}", air=1), chart.Axis(label), [bins])
    right = chart.Panel(chart.Axis("material ratio (% of the area above $z$)", low=0, high=100), chart.Axis(label), [of_area])
    figure = chart.Figure([[left, right]], 3.2, 7.4, shares_y="all", legend=())
    ascii_unit = unit.replace("\N{MICRO SIGN}", "u")
    return Drawn(
        "heights",
        "Distribution of heights",
        f"Of {single.title}: left, how much of the area lies at which height ({BINS} bins); right, the material ratio curve (Abbott and "
        "Firestone): the share of the area above each height.",
        figure,
        {
            "": table_text({f"height_{ascii_unit}": middles, f"share_per_{ascii_unit}": density}),
            "_material_ratio": table_text({"material_ratio_percent": ratio, f"height_{ascii_unit}": curve}),
        },
    )
