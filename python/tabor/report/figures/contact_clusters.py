"""Contact clusters in orange, their wet part in black (Figure 8 of the seed paper)."""

import numpy as np
from matplotlib.colors import to_rgb
from matplotlib.patches import Patch

from tabor.report import map_axes, maps, style, units
from tabor.report.figures import Drawn
from tabor.report.figures.contact_map import figure_height


def draw(example, name="contact_clusters"):
    """None where either the contact or the film is missing."""
    if example.contact is None or example.film is None:
        return None
    view = map_axes.MapView(example.window, example.scan.pixel)
    touching, wet = example.state > 0, (example.state > 0) & (example.thickness > 0)
    dry_share, wet_share = view.reduced(touching & ~wet), view.reduced(wet)
    figure, grid = style.new_figure(figure_height(view), width=5.6)
    axes = grid[0][0]
    axes.imshow(picture(dry_share, wet_share), extent=view.extent, interpolation="nearest", aspect="equal")
    view.label(axes)
    map_axes.scale_bar(axes, view)
    axes.set_title(_title(view, example, touching, wet), pad=20)
    style.legend_above(
        axes, 2, [Patch(color=style.DRY, label="dry contact"), Patch(color=style.WET, label="wet contact")]
    )
    data = {
        "": view.csv(wet_share, "wet_share_of_pixels"),
        "_dry": view.csv(dry_share, "dry_share_of_pixels"),
    }
    return Drawn(
        name + example.suffix,
        f"Contact clusters: {example.scan.name}",
        _caption(view, example),
        figure,
        data,
        is_map=True,
        is_viewed=True,
    )


def picture(dry_share, wet_share):
    """RGB: white ground, orange for dry and black for wet contact, mixed by their share of the tile."""
    share = dry_share + wet_share
    weight = np.divide(maps.ink(share), share, out=np.zeros_like(share), where=share > 0)
    dry, wet = (np.array(to_rgb(colour)) for colour in (style.DRY, style.WET))
    ground = 1 - (share * weight)[..., None]
    return np.clip(
        ground + (dry_share * weight)[..., None] * dry + (wet_share * weight)[..., None] * wet, 0, 1
    )


def _title(view, example, touching, wet):
    inside = np.count_nonzero(view.window.of(touching))
    share = np.count_nonzero(view.window.of(wet)) / inside if inside else 0.0
    return (
        f"$P$ = {units.pressure(example.contact.pressure)}, {units.density(example.film.density)}: "
        f"{share:.1%} of the contact here is wet"
    )


def _caption(view, example):
    touching = example.state > 0
    total = np.count_nonzero(touching)
    share = np.count_nonzero(touching & (example.thickness > 0)) / total if total else 0.0
    return (
        f"Contact clusters of {example.scan.name} at {units.pressure(example.contact.pressure)} with "
        f"{units.density(example.film.density)} of lubricant, in the window of the lubricant map: dry contact "
        f"orange, contact that holds lubricant black. {map_axes.ink_note(view)}Over the whole scan {share:.2%} of the "
        "contact is wet; the window was chosen for its wet contact and is not typical. "
        "As Figure 8 of Costagliola et al."
    )
