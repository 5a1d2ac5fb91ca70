"""A film between a cylinder and a flat: pressure and film along the flow, wear of the track."""

import numpy as np

from tabor.report import chart, style, units
from tabor.report.figures import Drawn
from tabor.report.output import table_text

MM, UM, NM = 1e3, 1e6, 1e9
REACH = 2.2  # half widths of the dry contact
PROFILE = ("x", "pressure", "asperity_pressure", "film", "hertz_pressure")
WEAR = ("time", "distance", "mean_depth", "max_depth", "min_film", "friction")
FILMS_SHOWN = 6  # over the film in the contact


def draw(source):
    """Yields what the file holds."""
    profile = source.curves("profile")
    if profile:
        yield _profile(source, profile)
    wear = source.curves("wear")
    if wear:
        yield _wear_history(source, wear)
        yield _worn_track(source, wear)


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
    items = [
        chart.Band(x * UM, 0, dry * factor, "Hertz, dry", "0.88"),
        chart.Curve(x * UM, pressure * factor, "pressure of the liquid", style.COLOURS[1]),
    ]
    solid = profile.get("asperity_pressure")
    if solid is not None and solid.any():
        items.append(chart.Curve(x * UM, solid * factor, "pressure of asperities", style.COLOURS[3], width=0.8))
    items.append(chart.Curve(x * UM, film * NM, "film thickness", style.COLOURS[0], is_right=True))
    reach = _reach(x, pressure if solid is None else pressure + solid, dry)
    highest = min(FILMS_SHOWN * np.median(film[np.abs(x) <= 0.5 * reach]), film.max()) * NM
    panel = chart.Panel(
        chart.Axis("position along the flow (µm), inlet on the left", low=max(x[0], -reach) * UM, high=min(x[-1], reach) * UM),
        chart.from_zero(f"pressure ({unit})", air=1),
        items,
        right=chart.Axis("film thickness (nm)", low=0.0, high=float(highest)),
    )
    return Drawn(
        "line_profile",
        "Pressure and film along the flow",
        f"Grey: the pressure of the same cylinder without liquid. {_thinnest(profile, source.scalars.get('min_film_m'))}",
        chart.Figure([[panel]], 3.4),
        {"": table_text(source.table("profile", PROFILE))},
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


def _wear_history(source, wear):
    time, unit = _time(wear["time"])
    depths, depth_unit = _length(np.stack([wear["mean_depth"], wear["max_depth"]]))
    film, film_unit = _length(wear["min_film"])
    x = chart.Axis(f"time ({unit})", low=time[0], high=time[-1])
    mean = chart.Curve(time, depths[0], "mean over the track", style.COLOURS[0])
    deepest = chart.Curve(time, depths[1], "deepest place", style.COLOURS[1], "--")
    smallest = chart.Curve(time, film, "smallest film", style.COLOURS[2])
    rows = [
        [chart.Panel(x, chart.Axis(f"{what} ({unit})", low=0.0, high=1.08 * np.nanmax(values) or 1.0), curves)]
        for what, unit, values, curves in (("worn depth", depth_unit, depths, [mean, deepest]), ("film thickness", film_unit, film, [smallest]))
    ]
    return Drawn(
        "line_wear",
        "Wear and film against time",
        "By Archard's law the mean depth grows with load and distance alone; the film follows the worn shape.",
        chart.Figure(rows, 4.8, shares_x=True),
        {"": table_text(source.table("wear", WEAR))},
    )


def _worn_track(source, wear):
    depth, unit = _length(wear["depth"])
    panel = chart.Panel(
        chart.Axis("place along the track (mm)", low=0.0, high=wear["track"][-1] * MM),
        chart.Axis(f"worn depth ({unit})", low=max(1.15 * depth.max(), 1e-12), high=0.0),  # downwards, as it is worn
        [chart.Curve(wear["track"] * MM, depth, colour=style.COLOURS[0], width=1.0)],
    )
    return Drawn(
        "line_track",
        "The track at the end",
        "Depth below the unworn surface.",
        chart.Figure([[panel]], 2.6),
        {"": table_text(source.table("wear", ("track", "depth")))},
    )
