"""Results of `tabor ehl` that need no picture of their own: a roller's history, sweeps."""

import numpy as np

from tabor.report import chart, ehl, hdf, style, units
from tabor.report.columns import Column
from tabor.report.figures import Drawn
from tabor.report.output import table_text


def squeeze(source):
    """Force and film of a roller against time."""
    history = source.curves("history")
    if not history:
        return
    time = history["time"] * 1e3
    late = time[history["force"] > 0.01 * history["force"].max()]
    panel = chart.Panel(
        chart.Axis("time (ms)", low=late[0] if len(late) else time[0], high=time[-1]),
        chart.Axis("force per width (kN/m)"),
        [
            chart.Curve(time, history["force"] * 1e-3, "force", style.COLOURS[1]),
            chart.Curve(time, history["min_film"] * 1e6, "smallest film", style.COLOURS[0], is_right=True),
        ],
        right=chart.Axis("film thickness (µm)", "log"),
    )
    yield Drawn(
        "squeeze",
        "Force and film against time",
        _squeeze_caption(source, history),
        chart.Figure([[panel]], 3.2),
        {"": table_text({f"{name}": values for name, values in history.items()})},
    )


def _squeeze_caption(source, history):
    """When the force is largest and the film thinnest: the numbers of the result, which may lie between steps."""
    time = history["time"]
    force = 1e3 * source.scalars.get("time_max_force_s", time[np.argmax(history["force"])])
    film = 1e3 * source.scalars.get("time_min_film_s", time[np.argmin(history["min_film"])])
    text = f"The force is largest after {units.number(force)} ms, the film thinnest after {units.number(film)} ms"
    return text + (": it goes on closing under a falling force." if film > force else ".")


def sweep(source):
    """One figure per computed number: curves over one swept value, a map over two."""
    node = source.file["sweep"]
    keys = swept_keys(node)
    shape = [len(node["axes"][key]) for key in keys]
    for name, numbers in source.numbers.items():
        if name == "newton_iterations":
            continue
        values = numbers[()].reshape(shape)
        if np.isfinite(values).any() and values[np.isfinite(values)].any():  # a column of zeros says it in the table
            yield _drawn(node, source.column[name], keys, values)


def swept_keys(node):
    """Of a sweep, the last one fastest."""
    return [hdf.text(key) for key in np.atleast_1d(node.attrs["axes"])]


def curves_along(node, keys, key):
    """(index of one curve in an array over all axes, what tells it from the others)."""
    others = [other for other in keys if other != key]
    for place in np.ndindex(*[len(node["axes"][other]) for other in others]):
        words = ", ".join(_word(node["axes"][other], index) for other, index in zip(others, place))
        index = list(place)
        index.insert(keys.index(key), slice(None))
        yield tuple(index), words


def _word(axis, index):
    if "words" in axis.attrs:
        return hdf.text(axis.attrs["words"][index])
    return f"{hdf.text(axis.attrs['long_name']).split('.')[-1]} {axis[index]:g}"


def _drawn(node, column, keys, values):
    factor, unit = column.scale(values)
    label = column.title(unit)
    axes_values = [node["axes"][key][()] for key in keys]
    is_map = len(keys) == 2 and min(values.shape) > 1 and not _has_words(node)
    draw = _map if is_map else _curves
    figure = draw(node, keys, values * factor, label)
    data = {key: points.ravel() for key, points in zip(keys, np.meshgrid(*axes_values, indexing="ij"))}
    own = {column.key: values.ravel()}
    if codes := ehl.codes_of(node):
        own["warnings"] = codes
    return Drawn(
        f"sweep_{column.key}",
        column.heading[:1].upper() + column.heading[1:],
        f"Over {' and '.join(keys)}.",
        figure,
        {"": table_text({**data, **own})},
    )


def _scaled_axis(node, key):
    """(values, label) of what a sweep varies."""
    axis = node["axes"][key]
    column = Column(key, key, hdf.text(axis.attrs.get("units", "SI")))
    factor, unit = column.scale(axis[()])
    return axis[()] * factor, column.title(unit)


def _has_words(node):
    return any("words" in axis.attrs for axis in node["axes"].values())


def _curves(node, keys, values, label):
    """Returns curves over the axis with most numbers, one for every value of the others."""
    numeric = [key for key in keys if "words" not in node["axes"][key].attrs] or keys
    key = max(numeric, key=lambda key: len(node["axes"][key]))
    place, place_label = _scaled_axis(node, key)
    curves = list(curves_along(node, keys, key))
    are_ordered = all("words" not in node["axes"][other].attrs for other in keys)
    styles = style.ordered_styles if are_ordered and len(curves) > 1 else style.curve_styles
    finite = values[np.isfinite(values)]
    x = chart.Axis(place_label, _scale(place))
    y = chart.Axis(label, "log" if x.scale == "log" and finite.min() > 0 and finite.max() > 10 * finite.min() else "linear")
    items = [chart.Curve(place, values[index], words, **look) for (index, words), look in zip(curves, styles(len(curves)))]
    return chart.Figure([[chart.Panel(x, y, items)]], 3.2, legend=None if len(curves) > 1 else ())


def _map(node, keys, plane, label):
    """Returns a figure of Matplotlib."""
    figure, ((axes,),) = style.new_figure(3.6, width=5.6)
    (y, y_label), (x, x_label) = (_scaled_axis(node, key) for key in keys)
    mesh = axes.contourf(x, y, plane, levels=16, cmap="viridis")
    figure.colorbar(mesh, ax=axes).set_label(label)
    for set_scale, side, values in ((axes.set_yscale, axes.yaxis, y), (axes.set_xscale, axes.xaxis, x)):
        set_scale(_scale(values))
        if _scale(values) == "log":
            style.log_axis(side)
    axes.set_ylabel(y_label)
    axes.set_xlabel(x_label)
    if np.nanmax(plane) > np.nanmin(plane):
        lines = axes.contour(x, y, plane, levels=8, colors="white", linewidths=0.6)
        _label(lines, axes)
    return figure


def _label(lines, axes):
    """Writes values on contour lines, where they lie whole within the axes."""
    labels = axes.clabel(lines, fontsize=7, fmt="%.3g")
    axes.figure.canvas.draw()
    frame = axes.get_window_extent()
    for one in list(labels):
        box = one.get_window_extent()
        if not (frame.contains(*box.min) and frame.contains(*box.max)):
            one.remove()


def _scale(values):
    """Logarithmic where the values are."""
    if len(values) > 2 and (values > 0).all():
        steps = np.diff(np.log(values))
        if np.allclose(steps, steps[0], rtol=1e-3):
            return "log"
    return "linear"
