"""A film between a cylinder and a flat: pressure and film along the flow, wear of the track."""

import numpy as np

from tabor.report import style, units
from tabor.report.figures import Drawn
from tabor.report.output import table_text

MM, UM, NM = 1e3, 1e6, 1e9
REACH = 2.2  # half widths of the dry contact
PROFILE = {"x": "m", "pressure": "Pa", "asperity_pressure": "Pa", "film": "m", "hertz_pressure": "Pa"}
FILMS_SHOWN = 6  # over the film in the contact


def draw(source):
    """Yields what the file holds."""
    profile = source.curves("profile")
    if profile:
        yield _profile(source, profile)
    wear = source.curves("wear")
    if wear:
        yield _wear_history(wear)
        yield _worn_track(wear)


def _reach(x, pressure, dry):
    """As far as either contact carries pressure worth seeing, and some inlet."""
    loaded = np.abs(x[pressure > 1e-3 * pressure.max()]).max(initial=0)
    half_width = np.abs(x[dry > 0]).max(initial=0)
    if half_width < 0.3 * loaded:  # stiff bodies: the film is wider than their contact
        return loaded
    return max(min(REACH * half_width, 1.1 * loaded), 1.3 * half_width)


def _profile(source, profile):
    x, pressure, film, dry = (profile[name] for name in ("x", "pressure", "film", "hertz_pressure"))
    factor, unit = units.scale(max(dry.max(), pressure.max()), "Pa")
    figure, grid = style.new_figure(3.4, width=5.6)
    left = grid[0][0]
    right = left.twinx()
    left.fill_between(x * UM, dry * factor, color="0.88", linewidth=0, label="Hertz, dry")
    left.plot(x * UM, pressure * factor, color=style.COLOURS[1], label="pressure of the liquid")
    solid = profile.get("asperity_pressure")
    if solid is not None and solid.any():
        left.plot(x * UM, solid * factor, color=style.COLOURS[3], linewidth=0.8, label="pressure of asperities")
    right.plot(x * UM, film * NM, color=style.COLOURS[0], label="film thickness")
    reach = _reach(x, pressure if solid is None else pressure + solid, dry)
    left.set_xlim(max(x[0], -reach) * UM, min(x[-1], reach) * UM)
    left.set_ylim(bottom=0)
    inside = np.abs(x) <= 0.5 * reach
    right.set_ylim(0, min(FILMS_SHOWN * np.median(film[inside]), film.max()) * NM)
    left.set_xlabel("position along the flow (µm), inlet on the left")
    left.set_ylabel(f"pressure ({unit})")
    right.set_ylabel("film thickness (nm)")
    right.spines["right"].set_visible(True)
    style.legend_on_top(figure, style.entries(left, right))
    return Drawn(
        "line_profile",
        "Pressure and film along the flow",
        f"Grey: the pressure of the same cylinder without liquid. {_thinnest(profile, source.scalars.get('min_film_m'))}",
        figure,
        {"": table_text({f"{name}_{unit}": profile[name] for name, unit in PROFILE.items() if name in profile})},
    )


def _thinnest(profile, least=None):
    """Where the film is thinnest, and where it ends; least: the smallest film [m] of the result, which may lie between nodes."""
    x, film, pressure = profile["x"], profile["film"], profile["pressure"]
    place = np.argmin(film)
    shown = units.length(film[place] if least is None else least)
    text = f"The film is thinnest, {shown}, at {_place(x[place])}"
    if np.count_nonzero(film <= 1.001 * film[place]) > 1:
        text = f"The film is nowhere thinner than {shown}, first at {_place(x[place])}"
    loaded = x[pressure > 1e-6 * pressure.max()]
    return text + (f"; its pressure ends at {_place(loaded[-1])}." if loaded.size else ".")


def _place(x):
    return f"{units.number(x * UM, 3)} µm"


def _time(seconds):
    """Values and unit that a reader likes."""
    for factor, unit in ((3600, "h"), (60, "min")):
        if seconds[-1] >= 2 * factor:
            return seconds / factor, unit
    return seconds, "s"


def _length(metres):
    largest = np.abs(metres).max()
    return (metres * UM, "µm") if largest >= 1e-6 else (metres * NM, "nm")


def _wear_history(wear):
    time, unit = _time(wear["time"])
    depths, depth_unit = _length(np.stack([wear["mean_depth"], wear["max_depth"]]))
    film, film_unit = _length(wear["min_film"])
    figure, grid = style.new_figure(4.8, n_rows=2, width=5.6, sharex=True)
    top, bottom = grid[0][0], grid[1][0]
    top.plot(time, depths[0], color=style.COLOURS[0], label="mean over the track")
    top.plot(time, depths[1], color=style.COLOURS[1], linestyle="--", label="deepest place")
    bottom.plot(time, film, color=style.COLOURS[2], label="smallest film")
    for axes in (top, bottom):
        axes.grid(color="0.92", linewidth=0.6)
        axes.set_ylim(0, 1.08 * axes.dataLim.y1 or 1)
    top.set_ylabel(f"worn depth ({depth_unit})")
    bottom.set_ylabel(f"film thickness ({film_unit})")
    bottom.set_xlabel(f"time ({unit})")
    bottom.set_xlim(time[0], time[-1])
    style.legend_on_top(figure, style.entries(top, bottom))
    names = {
        "time": "time_s",
        "distance": "distance_m",
        "mean_depth": "mean_depth_m",
        "max_depth": "max_depth_m",
        "min_film": "min_film_m",
        "friction": "friction",
    }
    return Drawn(
        "line_wear",
        "Wear and film against time",
        "By Archard's law the mean depth grows with load and distance alone; the film follows the worn shape.",
        figure,
        {"": table_text({heading: wear[name] for name, heading in names.items() if name in wear})},
    )


def _worn_track(wear):
    depth, unit = _length(wear["depth"])
    figure, grid = style.new_figure(2.6, width=5.6)
    axes = grid[0][0]
    axes.plot(wear["track"] * MM, depth, color=style.COLOURS[0], linewidth=1)
    axes.grid(color="0.92", linewidth=0.6)
    axes.set_xlim(0, wear["track"][-1] * MM)
    axes.set_ylim(max(1.15 * depth.max(), 1e-12), 0)  # downwards, as it is worn
    axes.set_xlabel("place along the track (mm)")
    axes.set_ylabel(f"worn depth ({unit})")
    return Drawn(
        "line_track",
        "The track at the end",
        "Depth below the unworn surface.",
        figure,
        {"": table_text({"track_m": wear["track"], "depth_m": wear["depth"]})},
    )
