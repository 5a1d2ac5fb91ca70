#!/usr/bin/env python3
"""Prints the friction of several models side by side and draws it as parts.png. usage: parts.py CSV... --slid CSV..."""

import csv
import pathlib
import sys


def read(file):
    with open(file, encoding="utf-8") as lines:
        return list(csv.DictReader(lines))


def last_states(files):
    """The last state of each slide, from the lowest pressure up."""
    return sorted((read(file)[-1] for file in files), key=lambda row: float(row["mean_pressure_Pa"]))


def number(row, key):
    return float(row.get(key) or "nan")


def show(tables, slid):
    names = [*tables, "slid, oil kept", "oil squeezed out"]
    print("pressure  " + "  ".join(f"{name:>16}" for name in names))
    for *rows, last in zip(*tables.values(), slid):
        spreads = [f" ± {number(row, 'friction_lubricated_std'):.3f}" if row.get("friction_lubricated_std") else "" for row in rows]
        cells = [f"{number(row, 'friction_lubricated'):.4f}{spread}" for row, spread in zip(rows, spreads)]
        cells += [f"{number(last, key):.4f}" for key in ("friction_lubricated", "friction_lubricated_squeezed")]
        print(f"{number(last, 'mean_pressure_Pa') / 1e6:>4g} MPa  " + "  ".join(f"{cell:>16}" for cell in cells))
    carried = ", ".join(f"{100 * number(row, 'liquid_load_share'):.1f} %" for row in list(tables.values())[-1])
    print(f"With tool and trapped oil the oil carries {carried} of the load.")


def draw(tables, slid):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(5.6, 3.6), layout="constrained")
    for (name, rows), marker in zip(tables.items(), "osD^"):
        axes.plot([number(row, "mean_pressure_Pa") / 1e6 for row in rows], [number(row, "friction_lubricated") for row in rows], marker=marker, label=name)
    pressures = [number(row, "mean_pressure_Pa") / 1e6 for row in slid]
    bounds = [[number(row, key) for row in slid] for key in ("friction_lubricated", "friction_lubricated_squeezed")]
    axes.fill_between(pressures, *bounds, alpha=0.2, color="0.4", label="slid 20 µm: between oil kept and squeezed out")
    axes.set(xlabel="mean pressure (MPa)", ylabel="friction coefficient", xlim=(0, None))
    axes.set_ylim(top=0.345)  # above the legend's place
    axes.legend(fontsize=8, loc="upper right", ncols=2)
    figure.savefig("parts.png", dpi=150)


def main():
    files, slid = sys.argv[1 : sys.argv.index("--slid")], last_states(sys.argv[sys.argv.index("--slid") + 1 :])
    tables = {pathlib.Path(file).stem.replace("_", " + "): read(file) for file in files}
    show(tables, slid)
    try:
        draw(tables, slid)
    except ImportError:
        print("no figure: Matplotlib is absent")


if __name__ == "__main__":
    main()
