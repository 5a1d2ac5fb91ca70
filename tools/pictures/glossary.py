"""Pictures of docs/glossary.md: a section through a contact, what a certificate bounds, what edges are."""

import numpy as np

import tabor as tb
from drawing import MATERIAL, UM, busiest_row, cut, draw_section, exaggeration_note, picture, sheet, show_map
from tabor.report import style

PART = (225, 300)  # columns of the section
TOLERANCES = np.geomspace(1e-4, 1e-10, 7)
POINTER = {"arrowstyle": "-", "color": "0.2", "linewidth": 0.7}


def _widest(flags):
    """Middle of the longest run of True."""
    edges = np.flatnonzero(np.diff(np.concatenate(([0], flags.astype(int), [0]))))
    first, behind = max(edges.reshape(-1, 2), key=lambda run: run[1] - run[0])
    return (first + behind - 1) // 2


def _places(lines):
    """{word: (x, z) [µm]} of what a section names."""
    x, solid, level, flat = (UM * lines[key] for key in ("x_m", "solid_m", "liquid_level_m", "counterface_m"))
    top = np.fmax(solid, np.nan_to_num(level, nan=-np.inf))
    pool, gap = _widest(level > solid), _widest(flat - top > 0.03)
    peak, over = int(np.argmax((solid - flat)[:-10])), int(np.nanargmax(np.where(solid < flat, level - flat, np.nan)))
    return {"pool": (x[pool], solid[pool] + 0.6 * (level[pool] - solid[pool])), "oil level": (x[pool + 5], level[pool + 5]),
            "gap": (x[gap], (flat[gap] + top[gap]) / 2), "saturated:\nhas yielded": (x[peak], solid[peak] - 0.01),
            "spill-over": (x[over], (level[over] + flat[over]) / 2), "flat": (x[-14], flat[-14])}


@picture("glossary_section")
def section_of_a_contact():
    one = tb.contact(sheet(), "15 MPa", MATERIAL)
    film = tb.rain(one.surface, "0.9 g/m^2")
    row = busiest_row((one.gap > 0) & (film.thickness > one.gap), PART)
    lines = cut(one, row, PART, film)
    figure, axes = style.new_figure(3.6, width=7.6)
    axes = axes[0, 0]
    draw_section(axes, lines)
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + 0.35 * (high - low))
    exaggeration_note(axes)
    places = sorted(_places(lines).items(), key=lambda place: place[1][0])
    left, right = axes.get_xlim()
    for (word, point), at in zip(places, np.linspace(left, right, 2 * len(places) + 1)[1::2]):
        axes.annotate(word, point, (0.4 * point[0] + 0.6 * at, high + 0.22 * (high - low)), fontsize=8.5, arrowprops=POINTER, ha="center", va="center")
    axes.text(left + 2, low + 0.03 * (high - low), "solid", fontsize=8.5)
    return figure


@picture("glossary_certificate")
def certificate():
    surface = sheet().lowpass("gauss:8um")
    solid = tb.Solid(MATERIAL, saturation_pressure="none")
    exact = tb.contact(surface, "7 MPa", solid, tolerance=1e-12)
    found = [tb.contact(surface, "7 MPa", solid, tolerance=one) for one in TOLERANCES]
    certificates = [one.certificate for one in found]
    scale = exact.mean_pressure * surface.height.std()
    errors = {"energy": [(_energy(one) - _energy(exact)) / scale for one in found],
              "mean gap": [abs(one.mean_gap / exact.mean_gap - 1) for one in found],
              "pressures": [np.std(one.pressure - exact.pressure) / np.std(exact.pressure) for one in found]}
    figure, axes = style.new_figure(3.0, width=5.4)
    axes = axes[0, 0]
    for (name, values), marker in zip(errors.items(), style.MARKERS):
        above_rounding = [value if value > 1e-15 else np.nan for value in values]
        axes.loglog(certificates, above_rounding, marker=marker, markersize=4, label=f"error of the {name}")
    axes.loglog(certificates, certificates, "k--", linewidth=0.9, label="certificate: bound of the energy error")
    axes.set(xlabel="certificate", ylabel="relative error", ylim=(1e-15, None))
    axes.legend(fontsize=7)
    return figure


def _energy(contact):
    """Complementary energy per pixel, whose minimum the pressure is."""
    return float(np.mean(contact.pressure * (contact.displacement / 2 - contact.surface.height)))


@picture("glossary_edges")
def edges():
    piece = sheet().crop(0, 0, 128, 128)
    figure, axes = style.plt.subplots(1, 3, figsize=(7.6, 2.9))
    heights = UM * piece.height
    rows = {"tile": np.tile(heights, (3, 3)), "cut": _mirrored(heights), "end": _alone(heights)}
    captions = {"tile": "the surface repeats", "cut": "mirror images go on", "end": "nothing lies beyond"}
    side = UM * piece.lengths[0]
    for part, (name, map_of) in zip(axes, rows.items()):
        part.imshow(map_of, cmap="cividis", extent=(-side, 2 * side, 2 * side, -side), vmin=heights.min(), vmax=heights.max())
        part.add_patch(style.plt.Rectangle((0, 0), side, side, fill=False, color=style.WARNING, linewidth=1.4))
        part.set(title=f"edges={name}:\n{captions[name]}", xlabel="$x$ (µm)")
    axes[0].set_ylabel("$y$ (µm)")
    return figure


def _mirrored(heights):
    columns = np.hstack((heights[:, ::-1], heights, heights[:, ::-1]))
    return np.vstack((columns[::-1], columns, columns[::-1]))


def _alone(heights):
    whole = np.full((3 * heights.shape[0], 3 * heights.shape[1]), np.nan)
    whole[heights.shape[0]:2 * heights.shape[0], heights.shape[1]:2 * heights.shape[1]] = heights
    return whole
