"""Results of `tabor ehl` that need no picture of their own: a roller's history, sweeps."""

import numpy as np

from tabor_report import style
from tabor_report.figures import Drawn
from tabor_report.output import table_text


def squeeze(source):
    """Force and film of a roller against time."""
    history = source.curves("history")
    if not history:
        return
    figure, grid = style.new_figure(3.2, width=5.6)
    left = grid[0][0]
    right = left.twinx()
    time = history["time"] * 1e3
    left.plot(time, history["force"] * 1e-3, color=style.COLOURS[1], label="force")
    right.plot(time, history["min_film"] * 1e6, color=style.COLOURS[0], label="smallest film")
    right.set_yscale("log")
    late = time[history["force"] > 0.01 * history["force"].max()]
    left.set_xlim(late[0] if len(late) else time[0], time[-1])
    left.set_xlabel("time (ms)")
    left.set_ylabel("force per width (kN/m)")
    right.set_ylabel("film thickness (µm)")
    right.spines["right"].set_visible(True)
    style.legend_on_top(figure, {**style.entries(left), **style.entries(right)})
    yield Drawn(
        "squeeze",
        "Force and film against time",
        "The film goes on closing after the force has passed its maximum and after the roller has turned.",
        figure,
        {"": table_text({f"{name}": values for name, values in history.items()})},
    )


def sweep(source):
    """One figure per computed number: a curve over one swept value, a map over two."""
    node = source.file["sweep"]
    keys = [key.decode() if isinstance(key, bytes) else str(key) for key in np.atleast_1d(node.attrs["axes"])]
    axes_values = [node["axes"][key][()] for key in keys]
    for name in node:
        if name in ("axes", "shape", "converged"):
            continue
        values = node[name][()].reshape([len(axis) for axis in axes_values])
        if not np.isfinite(values).any():
            continue
        yield _drawn(node[name], name, keys, axes_values, values)


def _drawn(dataset, name, keys, axes_values, values):
    heading, unit = dataset.attrs["long_name"], dataset.attrs["units"]
    label = f"{heading} ({unit})" if unit else str(heading)
    figure, grid = style.new_figure(3.6 if len(keys) > 1 else 3.2, width=5.6)
    axes = grid[0][0]
    if len(keys) == 1:
        axes.plot(axes_values[0], values, marker="o", color=style.COLOURS[0])
        axes.set_ylabel(label)
        if _scale(axes.set_xscale, axes_values[0]) and values.min() > 0 and values.max() > 10 * values.min():
            axes.set_yscale("log")
        axes.grid(color="0.92", linewidth=0.6)
    else:
        plane = values.reshape(len(axes_values[0]), len(axes_values[1]), -1)[:, :, 0]
        mesh = axes.contourf(axes_values[1], axes_values[0], plane, levels=16, cmap="viridis")
        lines = axes.contour(axes_values[1], axes_values[0], plane, levels=8, colors="white", linewidths=0.6)
        axes.clabel(lines, fontsize=7, fmt="%.3g")
        figure.colorbar(mesh, ax=axes).set_label(label)
        _scale(axes.set_yscale, axes_values[0])
        axes.set_ylabel(f"{keys[0]} (SI)")
    _scale(axes.set_xscale, axes_values[min(len(keys), 2) - 1])
    axes.set_xlabel(f"{keys[min(len(keys), 2) - 1]} (SI)")
    mesh_grid = np.meshgrid(*axes_values, indexing="ij")
    data = {key: points.ravel() for key, points in zip(keys, mesh_grid)}
    return Drawn(f"sweep_{name}", str(heading).capitalize(), f"Over {' and '.join(keys)}.", figure,
                 {"": table_text({**data, name: values.ravel()})})


def _scale(set_scale, values):
    """Logarithmic, and true, where the values are."""
    if len(values) > 2 and (values > 0).all():
        steps = np.diff(np.log(values))
        if np.allclose(steps, steps[0], rtol=1e-3):
            set_scale("log")
            return True
    return False
