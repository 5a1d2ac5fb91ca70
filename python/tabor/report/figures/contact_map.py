"""Real contact in black (Figure 5 of the seed paper)."""

import numpy as np

from tabor.report import map_axes, maps, oil, style, units
from tabor.report.figures import Drawn


def draw(state, pixel, facts, scan_name, name="contact_map", suffix="", pressure=""):
    """state: uint8 (ny, nx), 0 none, 1 contact, 2 saturated; facts: attributes of that contact state; pressure: how it is called, if not as it is."""
    view = map_axes.MapView(maps.whole(state), pixel)
    figure, axes = style.new_figure(figure_height(view), width=5.6)
    share = map_axes.ink_map(axes[0][0], view, state > 0)
    map_axes.scale_bar(axes[0][0], view)
    pressure = pressure or units.pressure(facts.get("mean_pressure_Pa"))
    axes[0][0].set_title(_title(state, facts, pressure))
    return Drawn(
        name + suffix,
        f"Contact map: {scan_name}, {pressure}",
        _caption(view, facts, scan_name, pressure),
        figure,
        {"": view.csv(share, "contact_share")},
        is_map=True,
        is_viewed=True,
    )


def figure_height(view, width=4.8):
    rows, columns = view.window.shape
    return float(np.clip(width * rows * view.pixel[1] / (columns * view.pixel[0]) + 0.9, 2.2, 9.0))


def _title(state, facts, pressure):
    touching = np.count_nonzero(state)
    title = f"$P$ = {pressure}, {touching / state.size:.2%} of the pixels in contact"
    saturated = np.count_nonzero(state == 2)
    title += f", {saturated / touching:.0%} of them saturated" if saturated else ""
    return title + ("" if facts.get("converged", True) else "\nNOT CONVERGED")


def _caption(view, facts, scan_name, pressure):
    warning = "" if facts.get("converged", True) else "This state did not converge. "
    return (
        f"Real contact{oil.of_solids(facts)} (black) of {scan_name} under the mean pressure "
        f"{pressure}. {warning}{map_axes.ink_note(view)}"
        "The share in the title is the counted contact. As Figure 5 of Costagliola et al."
    )
