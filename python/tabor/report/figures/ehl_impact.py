"""Impact of a ball on a lubricated flat: force, central pressure and film against time, profiles."""

import numpy as np
from matplotlib.colors import LogNorm

from tabor.report import chart, hdf, style, units
from tabor.report.figures import Drawn
from tabor.report.output import matrix_text, table_text

US, UM, MPA, GPA = 1e6, 1e6, 1e-6, 1e-9
N_PROFILES = 6


def draw(source):
    """Yields what the file holds, in the order of the impact papers."""
    history = source.curves("history")
    if not history:
        return
    yield _force(source, history)
    yield _central_pressure(source, history)
    yield _film(source, history)
    if "profiles" in source.file:
        yield _profiles(source)
        yield _film_map(source, history)


def dry_force(dry, time):
    """Force [N] on the ball without lubricant, the motion taken as half a sine (Johnson 1985, 11.4)."""
    phase = (time - dry["begin_s"]) / dry["impact_time_s"]
    inside = (phase > 0) & (phase < 1)
    return np.where(inside, dry["max_force_N"] * np.sin(np.pi * np.clip(phase, 0, 1)) ** 1.5, 0.0)


TIME = "time since the ball touched the liquid (µs)"


def _figure(y, items):
    """A figure of one panel against time."""
    return chart.Figure([[chart.Panel(chart.from_zero(TIME, air=1), y, items)]], 3.2)


def _force(source, history):
    time = history["time"]
    dry = hdf.attributes(source.file["dry"])
    dry_time = np.linspace(0, max(time[-1], dry["begin_s"] + 1.05 * dry["impact_time_s"]), 400)
    curves = [
        chart.Curve(time * US, history["force"], "lubricated", style.WET),
        chart.Curve(dry_time * US, dry_force(dry, dry_time), "dry (Hertz)", style.DRY, "--"),
    ]
    figure = _figure(chart.from_zero("force $w$ (N)"), curves + _turning(source))
    return Drawn(
        "impact_force",
        "Force against time",
        "Force on the ball with and without the liquid. The dry ball touches the flat where the layer would end.",
        figure,
        {"": table_text({**source.table("history", ("time", "force")), "dry_force_N": dry_force(dry, time)})},
    )


def _turning(source):
    turning = source.scalars.get("turning_time_s")
    if turning is None or not np.isfinite(turning):
        return []
    return [chart.Guide(turning * US, True, "ball turns", "0.6", width=0.8)]


def _central_pressure(source, history):
    pressure = history["central_pressure"]
    items = [chart.Curve(history["time"] * US, pressure * GPA, "in the centre", style.COLOURS[0])]
    # The spike at the end is as high as the grid is fine: it may leave the picture.
    first = source.scalars.get("primary_center_pressure_Pa")
    has_first = first is not None and np.isfinite(first)
    y = chart.Axis("pressure in the centre (GPa)")
    if has_first:
        y.low, y.high = 0.0, float(min(3 * first, 1.05 * pressure.max()) * GPA)
        items.append(chart.Guide(first * GPA, label="first peak", colour="0.6", width=0.8))
    figure = _figure(y, items)
    return Drawn(
        "impact_central_pressure",
        "Pressure in the centre against time",
        _peaks(first if has_first else None, pressure.max()),
        figure,
        {"": table_text(source.table("history", ("time", "central_pressure")))},
    )


def _peaks(first, highest):
    if first is None:
        return "There is no peak before the last one, whose height grows with the number of nodes."
    text = "The first peak is the squeeze of the closing gap."
    if highest <= 1.01 * first:
        return text
    cut = " and is cut here" if highest > 3 * first else ""
    spike = "The height of a later spike, where the front of the film runs into the centre,"
    return f"{text} {spike} grows with the number of nodes{cut}."


def _thinnest(source, history):
    """Where the film was thinnest, and how thick in the centre then: the numbers of the result, which may lie between steps."""
    at = np.argmin(history["min_film"])
    least, centre = source.scalars.get("min_film_m", history["min_film"][at]), history["central_film"][at]
    when = source.scalars.get("time_min_film_s", history["time"][at])
    text = f"The film is thinnest, {units.length(least)}, after {units.number(when * US)} µs"
    if centre > 1.01 * least:
        return f"{text}, in a ring around liquid that is {units.length(centre)} thick in the centre."
    return f"{text}, in the centre."


def _film(source, history):
    time = history["time"]
    highest = min(4 * history["central_film"][len(time) // 2], history["central_film"].max()) * UM
    curves = [
        chart.Curve(time * US, history["central_film"] * UM, "in the centre", style.COLOURS[0]),
        chart.Curve(time * US, history["min_film"] * UM, "smallest", style.COLOURS[1]),
    ]
    figure = _figure(chart.Axis("film thickness (µm)", low=0.0, high=float(highest)), curves + _turning(source))
    return Drawn(
        "impact_film",
        "Film thickness against time",
        _thinnest(source, history),
        figure,
        {"": table_text(source.table("history", ("time", "central_film", "min_film")))},
    )


def _shown_rows(times, history):
    """Rows at about equal times while the ball carries at least a thousandth of the largest force, as far as there are profiles."""
    loaded = history["time"][history["force"] > 1e-3 * history["force"].max()]
    wanted = np.linspace(max(loaded[0], times[0]), min(loaded[-1], times[-1]), N_PROFILES + 2)[1:-1]
    return sorted({int(np.argmin(np.abs(times - time))) for time in wanted})


def _profiles(source):
    node, history = source.file["profiles"], source.curves("history")
    times, radius = node["time"][()], node["radius"][()]
    pressure, film = node["pressure"][()], node["film"][()]
    rows = _shown_rows(times, history)
    reach = _reach(source, radius, pressure[rows])
    highest = 1.15 * max(film[rows][:, radius <= reach].max(axis=1).min(), film[rows, 0].max()) * UM
    x = chart.Axis("radius (µm)", low=-reach * UM, high=reach * UM)
    top, bottom = chart.Panel(x, chart.from_zero("pressure (GPa)", air=1)), chart.Panel(x, chart.Axis("film thickness (µm)", low=0.0, high=highest))
    for row, colour in zip(rows, style.sequence(len(rows))):
        label = f"{times[row] * US:.0f} µs"
        top.items.append(_mirrored(radius, pressure[row] * GPA, colour, label))
        bottom.items.append(_mirrored(radius, film[row] * UM, colour, label))
    data = {"radius_m": radius}
    for row in rows:
        data[f"pressure_{times[row] * US:.1f}_us_Pa"] = pressure[row]
        data[f"film_{times[row] * US:.1f}_us_m"] = film[row]
    return Drawn(
        "impact_profiles",
        "Pressure and film along the radius",
        "At about equal times while the ball is carried.",
        chart.Figure([[top], [bottom]], 5.4, shares_x=True),
        {"": table_text(data)},
    )


def _mirrored(radius, values, colour, label):
    x = np.concatenate([-radius[::-1], radius[1:]]) * UM
    return chart.Curve(x, np.concatenate([values[::-1], values[1:]]), label, colour, width=1.1)


def _reach(source, radius, pressure):
    """As far as there is pressure worth seeing."""
    loaded = (pressure > 1e-3 * pressure.max()).any(axis=0)
    return min(1.15 * radius[loaded][-1], radius[-1])


def _film_map(source, history):
    """Returns a figure of Matplotlib."""
    node = source.file["profiles"]
    times, radius, film = node["time"][()], node["radius"][()], node["film"][()]
    figure, ((axes,),) = style.new_figure(3.6, width=5.6)
    axes.set_xlabel(TIME)
    axes.set_ylabel("radius (µm)")
    shown = film.clip(min=1e-12) * UM
    mesh = axes.pcolormesh(
        times * US, radius * UM, shown.T, norm=LogNorm(), cmap="viridis", shading="nearest", rasterized=True
    )
    bar = figure.colorbar(mesh, ax=axes)
    style.log_axis(bar.ax.yaxis)
    bar.set_label("film thickness (µm)")
    edge = history["film_radius"]
    axes.plot(history["time"] * US, edge * UM, color="white", linewidth=1.0, label="edge of the film")
    axes.set_xlim(times[0] * US, times[-1] * US)
    axes.set_ylim(0, radius[-1] * UM)
    return Drawn(
        "impact_film_map",
        "Film against radius and time",
        "White: the edge of the film that has not torn.",
        figure,
        {"": matrix_text("time_us \\ radius_um", radius * UM, times * US, film * UM)},
    )
