"""Impact of a ball on a lubricated flat: force, central pressure and film against time, profiles."""

import numpy as np
from matplotlib.colors import LogNorm

from tabor.report import hdf, style, units
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


def _axes(height=3.2, y=""):
    figure, grid = style.new_figure(height, width=5.6)
    axes = grid[0][0]
    axes.grid(color="0.92", linewidth=0.6)
    axes.set_xlabel("time since the ball touched the liquid (µs)")
    axes.set_ylabel(y)
    return figure, axes


def _force(source, history):
    time = history["time"]
    dry = hdf.attributes(source.file["dry"])
    dry_time = np.linspace(0, max(time[-1], dry["begin_s"] + 1.05 * dry["impact_time_s"]), 400)
    figure, axes = _axes(y="force $w$ (N)")
    axes.plot(time * US, history["force"], color=style.WET, label="lubricated")
    axes.plot(dry_time * US, dry_force(dry, dry_time), color=style.DRY, linestyle="--", label="dry (Hertz)")
    _mark_turning(axes, source)
    style.limits_from_zero(axes)
    style.legend_on_top(figure, style.entries(axes))
    return Drawn(
        "impact_force",
        "Force against time",
        "Force on the ball with and without the liquid. The dry ball touches the flat where the layer would end.",
        figure,
        {"": table_text({"time_s": time, "force_N": history["force"], "dry_force_N": dry_force(dry, time)})},
    )


def _mark_turning(axes, source):
    turning = source.scalars.get("turning_time_s")
    if turning is not None and np.isfinite(turning):
        axes.axvline(turning * US, color="0.6", linewidth=0.8, linestyle=":", label="ball turns")


def _central_pressure(source, history):
    pressure = history["central_pressure"]
    figure, axes = _axes(y="pressure in the centre (GPa)")
    axes.plot(history["time"] * US, pressure * GPA, color=style.COLOURS[0], label="in the centre")
    # The spike at the end is as high as the grid is fine: it may leave the picture.
    first = source.scalars.get("primary_center_pressure_Pa")
    has_first = first is not None and np.isfinite(first)
    if has_first:
        axes.set_ylim(0, min(3 * first, 1.05 * pressure.max()) * GPA)
        axes.axhline(first * GPA, color="0.6", linewidth=0.8, linestyle=":", label="first peak")
    axes.set_xlim(left=0)
    style.legend_on_top(figure, style.entries(axes))
    return Drawn(
        "impact_central_pressure",
        "Pressure in the centre against time",
        _peaks(first if has_first else None, pressure.max()),
        figure,
        {"": table_text({"time_s": history["time"], "central_pressure_Pa": pressure})},
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


def _thinnest(history):
    """Where the film was thinnest, and how thick in the centre then."""
    at = np.argmin(history["min_film"])
    least, centre = history["min_film"][at], history["central_film"][at]
    text = f"The film is thinnest, {units.length(least)}, after {units.number(history['time'][at] * US)} µs"
    if centre > 1.01 * least:
        return f"{text}, in a ring around liquid that is {units.length(centre)} thick in the centre."
    return f"{text}, in the centre."


def _film(source, history):
    time = history["time"]
    figure, axes = _axes(y="film thickness (µm)")
    axes.plot(time * US, history["central_film"] * UM, color=style.COLOURS[0], label="in the centre")
    axes.plot(time * US, history["min_film"] * UM, color=style.COLOURS[1], label="smallest")
    _mark_turning(axes, source)
    axes.set_ylim(0, min(4 * history["central_film"][len(time) // 2], history["central_film"].max()) * UM)
    axes.set_xlim(left=0)
    style.legend_on_top(figure, style.entries(axes))
    return Drawn(
        "impact_film",
        "Film thickness against time",
        _thinnest(history),
        figure,
        {
            "": table_text(
                {"time_s": time, "central_film_m": history["central_film"], "min_film_m": history["min_film"]}
            )
        },
    )


def _shown_rows(times, history):
    """Rows at about equal times while the ball carries at least a thousandth of the largest force."""
    loaded = history["time"][history["force"] > 1e-3 * history["force"].max()]
    wanted = np.linspace(loaded[0], loaded[-1], N_PROFILES + 2)[1:-1]
    return sorted({int(np.argmin(np.abs(times - time))) for time in wanted})


def _profiles(source):
    node, history = source.file["profiles"], source.curves("history")
    times, radius = node["time"][()], node["radius"][()]
    pressure, film = node["pressure"][()], node["film"][()]
    rows = _shown_rows(times, history)
    figure, grid = style.new_figure(5.4, n_rows=2, width=5.6, sharex=True)
    top, bottom = grid[0][0], grid[1][0]
    colours = style.plt.get_cmap("viridis")(np.linspace(0, 0.92, len(rows)))
    for row, colour in zip(rows, colours):
        label = f"{times[row] * US:.0f} µs"
        _mirrored(top, radius, pressure[row] * GPA, colour, label)
        _mirrored(bottom, radius, film[row] * UM, colour, label)
    reach = _reach(source, radius, pressure[rows])
    bottom.set_xlim(-reach * UM, reach * UM)
    bottom.set_ylim(0, 1.15 * max(film[rows][:, radius <= reach].max(axis=1).min(), film[rows, 0].max()) * UM)
    top.set_ylabel("pressure (GPa)")
    bottom.set_ylabel("film thickness (µm)")
    bottom.set_xlabel("radius (µm)")
    for axes in (top, bottom):
        axes.grid(color="0.92", linewidth=0.6)
    top.set_ylim(bottom=0)
    style.legend_on_top(figure, style.entries(top))
    data = {"radius_m": radius}
    for row in rows:
        data[f"pressure_{times[row] * US:.1f}_us_Pa"] = pressure[row]
        data[f"film_{times[row] * US:.1f}_us_m"] = film[row]
    return Drawn(
        "impact_profiles",
        "Pressure and film along the radius",
        "At about equal times while the ball is carried.",
        figure,
        {"": table_text(data)},
    )


def _mirrored(axes, radius, values, colour, label):
    x = np.concatenate([-radius[::-1], radius[1:]]) * UM
    axes.plot(x, np.concatenate([values[::-1], values[1:]]), color=colour, linewidth=1.1, label=label)


def _reach(source, radius, pressure):
    """As far as there is pressure worth seeing."""
    loaded = (pressure > 1e-3 * pressure.max()).any(axis=0)
    return min(1.15 * radius[loaded][-1], radius[-1])


def _film_map(source, history):
    node = source.file["profiles"]
    times, radius, film = node["time"][()], node["radius"][()], node["film"][()]
    figure, axes = _axes(height=3.6, y="radius (µm)")
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
    axes.grid(False)
    return Drawn(
        "impact_film_map",
        "Film against radius and time",
        "White: the edge of the film that has not torn.",
        figure,
        {"": matrix_text("time_us \\ radius_um", radius * UM, times * US, film * UM)},
    )
