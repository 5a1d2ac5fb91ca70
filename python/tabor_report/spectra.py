"""A result file of `tabor psd`: spectra along x, along y and radial of one scan, or of scans and means of groups."""

import shlex
from dataclasses import dataclass, field
from pathlib import Path

import h5py
import numpy as np

from tabor_report import hdf
from tabor_report.errors import readable

NAMES = {"x": "along x", "y": "along y", "radial": "radial"}
UNITS = {"x": "m3", "y": "m3", "radial": "m4"}


@dataclass
class Curves:
    """Of one scan, or the mean of a group of them."""

    name: str
    curves: dict  # {"x", "y" or "radial": (q [rad/m], density [m^3 or m^4])}
    deviations: dict = field(default_factory=dict)  # {axis: standard deviation at each q}, of a group alone
    n_scans: int = 1

    @property
    def is_mean(self):
        return bool(self.deviations)

    @property
    def trusted(self):
        """(lowest, highest) wavevector [rad/m] of a quarter of the side and of 4 pixels, as `tabor psd` names them."""
        q, _ = next(iter(self.curves.values()))  # that along x, if there is one: bins of the radial one begin elsewhere
        return 4 * q[0], q[-1] / 2


@dataclass
class Spectra:
    path: Path
    file: object
    facts: dict
    sets: list  # of Curves: scans, then means of groups
    warnings: list = field(default_factory=list)

    kind = "psd"

    @property
    def title(self):
        names = [one.name for one in self.sets if not one.is_mean]
        if len(names) > 1:
            return f"Power spectra of {len(names)} scans"
        return f"Power spectra: {readable((names and names[0]) or self.path.stem)}"

    @property
    def axes(self):
        """Those that any scan has, in the order of NAMES."""
        return [axis for axis in NAMES if any(axis in one.curves for one in self.sets)]

    @property
    def trusted(self):
        """What every scan can be trusted with; None where they share no range."""
        ranges = [one.trusted for one in self.sets if one.curves and not one.is_mean]
        low, high = max(low for low, _ in ranges), min(high for _, high in ranges)
        return (low, high) if low < high else None


def is_one(file):
    return _has_curves(file.get("curves")) or any(_has_curves(node) for node in _members(file, "scans"))


def load(path, file):
    facts = hdf.attributes(file)
    if "curves" in file:
        sets = [Curves(_scan(facts.get("command", "")), *_read(file["curves"]))]
    else:
        sets = [Curves(_name(node, "file"), *_read(node)) for node in _members(file, "scans")]
        sets += [_mean(node) for node in _members(file, "groups")]
    return Spectra(path, file, facts, sets, hdf.text_list(facts.get("warnings")))


def _members(file, name):
    node = file.get(name)
    return [node[key] for key in node] if isinstance(node, h5py.Group) else []


def _has_curves(node):
    return node is not None and any(f"psd_{axis}_{unit}" in node for axis, unit in UNITS.items())


def _mean(node):
    curves, deviations = _read(node, "_mean")
    return Curves(_name(node, "group"), curves, deviations, len(hdf.text_list(hdf.attributes(node).get("scans"))))


def _name(node, attribute):
    return readable(Path(str(hdf.attributes(node).get(attribute, node.name))).name)


def _read(node, ending=""):
    """({axis: (q, density)}, {axis: standard deviation}) without what no logarithm has."""
    curves, deviations = {}, {}
    for axis, unit in UNITS.items():
        key = f"psd_{axis}_{unit}"
        names = f"q_{axis}_rad_per_m", key + ending
        if all(name in node for name in names):
            q, density = (np.asarray(node[name][()], dtype=float) for name in names)
            shown = np.isfinite(q) & np.isfinite(density) & (q > 0) & (density > 0)
            if shown.sum() > 1:
                curves[axis] = q[shown], density[shown]
                if ending and key + "_std" in node:
                    deviations[axis] = np.asarray(node[key + "_std"][()], dtype=float)[shown]
    return curves, deviations


def _scan(command):
    """The scan that a command 'tabor psd SCAN ...' names."""
    try:
        words = shlex.split(command)
    except ValueError:
        return ""
    return Path(words[2]).name if len(words) > 2 and words[1] == "psd" and not words[2].startswith("-") else ""
