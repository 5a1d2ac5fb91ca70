"""A film between a ball and a flat: centre lines, maps, slice-plane graph."""

import numpy as np
from matplotlib import patheffects

from tabor.report import chart, map_axes, style, units
from tabor.report.figures import Drawn
from tabor.report.output import matrix_text, table_text

UM, NM, GPA, MS = 1e6, 1e9, 1e-9, 1e3
REACH = 1.8  # shown, in half axes of the dry contact
FILMS_SHOWN = 4  # over the film in the contact
LINE_LIMIT = 400  # rows or columns of a printed map
REFRACTION = 1.5  # of an oil
LIGHT = (630e-9, 530e-9, 460e-9)  # m, red, green, blue
COHERENCE = 1.2e-6  # m of film, beyond which the fringes fade


def draw(source):
    """Yields what the file holds."""
    if "contact" not in source.file:
        return
    yield _centre_line(source, "along", "position along the flow (µm), inlet on the left")
    yield _centre_line(source, "across", "place across the flow (µm)")
    contact = _Contact(source)
    yield _film_maps(contact)
    yield _pressure_map(contact)
    if contact.has("plastic_depth") and contact.of("plastic_depth").max() > 0:
        yield _plastic_map(contact)
    if contact.has("roughness"):
        yield _roughness_map(contact)
    yield _slice_plane(source, source.curves("slice_plane"))
    if history := source.curves("history"):
        yield _transient(source, history)


class _Contact:
    """Maps around the dry contact, at most LINE_LIMIT points wide."""

    def __init__(self, source):
        self.node = source.file["contact"]
        x, y = self.node["x"][()], self.node["y"][()]
        self.half_axes = _half_axes(source)
        self.columns = self._chosen(x, self.half_axes[0])
        self.rows = self._chosen(y, self.half_axes[1])
        self.x, self.y = x[self.columns], y[self.rows]

    @staticmethod
    def _chosen(place, half_axis):
        inside = np.flatnonzero(np.abs(place) <= REACH * half_axis)
        return slice(inside[0], inside[-1] + 1, 1 + len(inside) // LINE_LIMIT)

    def has(self, name):
        return name in self.node

    def of(self, name):
        return self.node[name][self.rows, self.columns]

    def inside(self):
        """True in the dry contact."""
        x, y = self.x[None, :] / self.half_axes[0], self.y[:, None] / self.half_axes[1]
        return x**2 + y**2 <= 1

    def pressure(self):
        """Of liquid and solids together [Pa]."""
        return self.of("pressure") + (self.of("contact_pressure") if self.has("contact_pressure") else 0)

    def csv(self, values, what):
        return {"": matrix_text(f"{what} (row: y_um; column: x_um)", self.x * UM, self.y * UM, values)}

    def show(self, axes, image, **keywords):
        """An image in micrometres with the edge of the dry contact on it."""
        step = self.x[1] - self.x[0], self.y[1] - self.y[0]
        ends = np.array([self.x[0], self.x[-1], self.y[-1], self.y[0]])
        extent = UM * (ends + 0.5 * np.array([-step[0], step[0], step[1], -step[1]]))
        shown = axes.imshow(image, extent=extent, aspect="equal", interpolation="nearest", **keywords)
        angle = np.linspace(0, 2 * np.pi, 181)
        axes.plot(
            self.half_axes[0] * UM * np.cos(angle),
            self.half_axes[1] * UM * np.sin(angle),
            color="black",
            linestyle="--",
            linewidth=0.8,
            path_effects=[patheffects.withStroke(linewidth=1.8, foreground="white", alpha=0.7)],
        )
        axes.set_xlabel("$x$ (µm), flow to the right")
        axes.set_ylabel("$y$ (µm)")
        for side in ("top", "right"):
            axes.spines[side].set_visible(True)
        return shown

    def height(self, width):
        """Inches of a figure with a map of this width."""
        return float(np.clip(width * np.ptp(self.y) / np.ptp(self.x) + 0.7, 2.0, 7.5))


def _half_axes(source):
    """Of the dry contact [m], where the pressure of Hertz, p0 sqrt(1 - x^2/a^2), ends on the centre lines."""
    axes = []
    for group in ("along", "across"):
        place, pressure = (source.curves(group)[name] for name in ("place", "hertz_pressure"))
        top = int(np.argmax(pressure))
        outer = int(np.argmax(np.where(pressure > 0, np.abs(place), -1)))
        x2, p2 = place[[top, outer]] ** 2, pressure[[top, outer]] ** 2
        axes.append(np.sqrt((x2[1] * p2[0] - x2[0] * p2[1]) / (p2[0] - p2[1])))
    return axes


def _centre_line(source, group, label):
    curves = source.curves(group)
    x, film, pressure = curves["place"], curves["film"], curves["pressure"]
    is_rough = "smooth_film" in curves
    pressure_look, film_look = {"colour": style.COLOURS[1]}, {"colour": style.COLOURS[0], "is_right": True}
    items = [chart.Band(x * UM, 0, curves["hertz_pressure"] * GPA, "Hertz, dry", "0.90")]
    if is_rough:
        dotted = {"dash": ":", "width": 1.0}
        items.append(chart.Curve(x * UM, curves["smooth_pressure"] * GPA, "pressure, smooth", **pressure_look, **dotted))
        items.append(chart.Curve(x * UM, curves["smooth_film"] * NM, "film, smooth", **film_look, **dotted))
    items.append(chart.Curve(x * UM, pressure * GPA, "pressure of the liquid", width=1.1, **pressure_look))
    if curves["contact_pressure"].any():
        solids = np.where(curves["contact_pressure"] > 0, curves["contact_pressure"], np.nan) * GPA
        items.append(chart.Curve(x * UM, solids, "pressure of solids", style.COLOURS[6], "", marker=".", size=3))
    items.append(chart.Curve(x * UM, film * NM, "film", width=1.1, **film_look))
    half_axis = np.abs(x[curves["hertz_pressure"] > 0]).max()
    inside = np.abs(x) <= 0.8 * half_axis
    behind = curves["smooth_film"][inside] if is_rough else film[inside]
    highest = min(max(FILMS_SHOWN * np.median(behind), 1.1 * film[inside].max()), film.max()) * NM
    panel = chart.Panel(
        chart.Axis(label, low=max(x[0], -REACH * half_axis) * UM, high=min(x[-1], REACH * half_axis) * UM),
        chart.from_zero("pressure (GPa)", air=1),
        items,
        right=chart.Axis("film thickness (nm)", low=0.0, high=float(highest)),
    )
    return Drawn(
        f"point_{group}",
        f"Pressure and film {group} the flow",
        "Through the centre. Grey: the pressure of the same smooth bodies without liquid."
        + (" Dotted: the film without the roughness." if is_rough else ""),
        chart.Figure([[panel]], 3.4),
        {"": table_text(source.table(group))},
    )


def _transient(source, history):
    """What a moving rough surface does to the film."""
    time = history["time"] * MS
    film_look = {"colour": style.COLOURS[0], "is_right": True}
    panel = chart.Panel(
        chart.Axis("time (ms)", low=time[0], high=time[-1]),
        chart.from_zero("pressure (GPa)", air=1),
        [
            chart.Curve(time, history["max_pressure"] * GPA, "largest pressure", style.COLOURS[1]),
            chart.Curve(time, history["central_film"] * NM, "film in the centre", **film_look),
            chart.Curve(time, history["min_film"] * NM, "smallest film", dash="--", **film_look),
        ],
        right=chart.from_zero("film thickness (nm)", air=1),
    )
    return Drawn(
        "point_history",
        "Film and pressure against time",
        "While the rough surface moves through the contact; the maps are of the last instant.",
        chart.Figure([[panel]], 3.2),
        {"": table_text(source.table("history"))},
    )


def interference(film):
    """Colours (ny, nx, 3) of the two beams that a film [m] splits, red, green and blue; dark at zero film.

    Fringes narrower than two points are averaged away, as a camera does.
    """
    colours = []
    for wavelength in LIGHT:
        phase = 4 * np.pi * REFRACTION * film / wavelength
        down, along = np.gradient(phase)
        seen = np.sinc(down / (2 * np.pi)) * np.sinc(along / (2 * np.pi)) * np.exp(-((film / COHERENCE) ** 2))
        colours.append(0.5 - 0.5 * seen * np.cos(phase))
    return np.stack(colours, axis=-1)


def _is_smooth(film, step):
    """Whether lines of equal film a step apart show more than noise: neighbours differ by less."""
    return np.median(np.abs(np.diff(film))) < step


def _film_maps(contact):
    film = contact.of("film")
    figure, grid = style.new_figure(contact.height(3.0), n_columns=2)
    left, right = grid[0]
    highest = min(FILMS_SHOWN * max(np.median(film[contact.inside()]), 1e-10), film.max())
    factor, unit = units.length_scale(highest)
    shown = contact.show(left, film * factor, cmap="viridis", vmin=0, vmax=highest * factor)
    levels = np.linspace(0, highest * factor, 9)[1:-1]
    has_lines = bool(_is_smooth(film[contact.inside()], levels[0] / factor))
    if has_lines:
        left.contour(contact.x * UM, contact.y * UM, film * factor, levels=levels, colors="white", linewidths=0.4)
    bar = figure.colorbar(shown, cax=left.inset_axes([1.03, 0, 0.05, 1]), extend="max")
    bar.set_label(f"film thickness ({unit})")
    contact.show(right, interference(film))
    right.set_ylabel("")
    right.set_title("as an interferometer sees it")
    left.set_title("film thickness")
    return Drawn(
        "point_film",
        "Film",
        f"Dashed: the edge of the dry contact.{' White: lines of equal film.' * has_lines} Right: colours of interference for a film of refractive index "
        f"{REFRACTION} between a dark and a clear body; they fade beyond {COHERENCE * UM:g} µm.",
        figure,
        contact.csv(film * NM, "film_nm"),
        is_map=True,
    )


def _one_map(contact, name, title, caption, values, what, label, **keywords):
    figure, grid = style.new_figure(contact.height(3.6), width=4.6)
    axes = grid[0][0]
    shown = contact.show(axes, values, **keywords)
    bar = figure.colorbar(shown, cax=axes.inset_axes([1.03, 0, 0.05, 1]))
    bar.set_label(label)
    return Drawn(name, title, caption, figure, contact.csv(values, what), is_map=True)


def _pressure_map(contact):
    return _one_map(
        contact,
        "point_pressure",
        "Pressure",
        "Of liquid and touching solids together.",
        contact.pressure() * GPA,
        "pressure_GPa",
        "pressure (GPa)",
        cmap=map_axes.PRESSURE_COLOURS,
        vmin=0,
    )


def _plastic_map(contact):
    depth = contact.of("plastic_depth")
    return _one_map(
        contact,
        "point_plastic",
        "Plastic deformation",
        "How deep asperities are pressed in for good.",
        np.where(depth > 0, depth, np.nan) * NM,
        "plastic_depth_nm",
        "plastic depth (nm)",
        cmap="magma_r",
        vmin=0,
    )


def _roughness_map(contact):
    heights = contact.of("roughness") * NM
    return _one_map(
        contact,
        "point_roughness",
        "Roughness",
        "As the grid of the film holds it, asperities up.",
        heights,
        "roughness_nm",
        "height (nm)",
        cmap=map_axes.HEIGHT_COLOURS,
    )


def _slice_plane(source, curves):
    level, share = curves["level"], curves["share"]
    is_rough = "smooth_share" in curves
    factor, unit = units.length_scale(_shown_level(level, share))
    x, y = level * factor, 100 * share
    items = [
        chart.Band(x, y, 100, "thicker film", style.LIQUID, 0.25),
        chart.Band(x, 0, y, "thinner film or solid contact", style.SOLID),
        chart.Curve(x, y, width=1.2),
    ]
    if is_rough:
        items.append(chart.Curve(x, 100 * curves["smooth_share"], "smooth", dash=":", width=1.2))
    panel = chart.Panel(
        chart.Axis(f"film thickness $h^*$ ({unit})", low=0.0, high=_shown_level(level, share) * factor),
        chart.Axis("share of the dry contact's area (%)", low=0.0, high=100.0),
        items,
        grid="none",
    )
    return Drawn(
        "point_slice_plane",
        "Slice-plane graph",
        "How much of the dry contact's area touches or has a film up to h*: at zero, solids touch. As figure 10 of "
        "Redlich et al.",
        chart.Figure([[panel]], 3.2, 5.0),
        {"": table_text(source.table("slice_plane", ("level", "share", "smooth_share")))},
    )


def _shown_level(level, share):
    """Where nearly all of the area has a thinner film."""
    return level[min(np.searchsorted(share, 0.995), len(level) - 1)]
