"""How the heights of one surface are distributed: their histogram and the material ratio curve (Abbott-Firestone)."""

import numpy as np

from tabor.report import chart, style
from tabor.report.figures import Drawn
from tabor.report.output import table_text


def draw(single):
    """None for a surface without two different heights."""
    found = single.distribution
    if found is None:
        return None
    unit, density, ratio, curve = found.unit, found.density, found.ratio, found.curve
    label = f"{single.heading_of_heights} ({unit})" if single.is_difference else f"height $z$ about the mean ({unit})"
    middles = (found.edges[:-1] + found.edges[1:]) / 2
    bins = chart.Curve(np.repeat(density, 2), np.repeat(found.edges, 2)[1:-1], "share of the area", style.COLOURS[0])
    of_area = chart.Curve(ratio, curve, "material ratio", style.COLOURS[1])
    left = chart.Panel(chart.from_zero(f"share of the area per {unit}", air=1), chart.Axis(label), [bins])
    right = chart.Panel(chart.Axis("material ratio (% of the area above $z$)", low=0, high=100), chart.Axis(label), [of_area])
    figure = chart.Figure([[left, right]], 3.2, 7.4, shares_y="all", legend=())
    ascii_unit = unit.replace("\N{MICRO SIGN}", "u")
    return Drawn(
        "heights",
        "Distribution of heights",
        f"Of {single.title}: left, how much of the area lies at which height ({len(density)} bins); right, the material ratio curve (Abbott and "
        "Firestone): the share of the area above each height.",
        figure,
        {
            "": table_text({f"height_{ascii_unit}": middles, f"share_per_{ascii_unit}": density}),
            "_material_ratio": table_text({"material_ratio_percent": ratio, f"height_{ascii_unit}": curve}),
        },
    )
