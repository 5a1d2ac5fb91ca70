"""How the heights of one surface are distributed: their histogram and the material ratio curve (Abbott-Firestone)."""

import numpy as np

from tabor.report import map_axes, style
from tabor.report.figures import Drawn
from tabor.report.output import table_text
from tabor.report.surface_numbers import sorted_heights

BINS = 80
POINTS = 201  # of the material ratio curve


def draw(single):
    """None for a surface without two different heights."""
    z = sorted_heights(single.raw_height(), mean=not single.is_difference)
    if z.size < 2 or z[0] == z[-1]:
        return None
    factor, unit = map_axes.height_unit(z)
    share, edges = np.histogram(z * factor, bins=BINS)
    density = share / (z.size * np.diff(edges))
    ratio = np.linspace(0, 100, POINTS)
    curve = np.interp(ratio, np.linspace(0, 100, z.size), z * factor)
    label = f"{single.heading_of_heights} ({unit})" if single.is_difference else f"height $z$ about the mean ({unit})"
    figure, ((left, right),) = style.new_figure(3.2, n_columns=2, width=7.4, sharey=True)
    middles = (edges[:-1] + edges[1:]) / 2
    left.plot(density, middles, color=style.COLOURS[0], drawstyle="steps-mid", label="share of the area")
    left.set_xlabel(f"share of the area per {unit}")
    left.set_ylabel(label)
    right.plot(ratio, curve, color=style.COLOURS[1], label="material ratio")
    right.set_xlabel("material ratio (% of the area above $z$)")
    right.set_xlim(0, 100)
    for axes in (left, right):
        axes.grid(color="0.92", linewidth=0.6)
    left.set_xlim(left=0)
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
