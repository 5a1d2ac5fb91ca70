"""A result file of `tabor psd`: spectra along x, along y and radial of one scan, or of scans and means of groups."""

import shlex
from dataclasses import dataclass, field
from pathlib import Path

import h5py
import numpy as np

from tabor.report import hdf, names, remarks
from tabor.report.errors import readable

NAMES = {"x": "along x", "y": "along y", "radial": "radial"}
UNITS = {"x": "m3", "y": "m3", "radial": "m4"}


@dataclass
class Curves:
    """Of one scan, or the mean of a group of them."""

    name: str
    curves: dict  # {"x", "y" or "radial": (q [rad/m], density [m^3 or m^4])}
    deviations: dict = field(default_factory=dict)  # {axis: standard deviation at each q}, of a group alone
    exponents: dict = field(default_factory=dict)  # {axis: (H, its standard error)}, of a scan alone
    n_scans: int = 1
    file: str = ""  # of a scan
    conditions: dict = field(default_factory=dict)  # {"treatment", "convention", "window": text}, as far as the file has them

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
        found = [one.name for one in self.sets if not one.is_mean]
        if len(found) > 1:
            return f"Power spectra of {len(found)} scans"
        return f"Power spectra: {readable((found and found[0]) or self.path.stem)}"

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
        sets = [_of_scan(_scan(facts.get("command", "")), file["curves"])]
    else:
        nodes = _members(file, "scans")
        sets = [_of_scan(_text(node, "file"), node) for node in nodes] + [_mean(node) for node in _members(file, "groups")]
    _shorten(sets)
    return Spectra(path, file, facts, sets, remarks.of_file(facts))


def _of_scan(scan, node):
    facts = hdf.attributes(node)
    known = {name: ", ".join(hdf.text_list(facts[name])) for name in ("treatment", "convention", "window") if name in facts}
    return Curves(scan, *_read(node), _exponents(node), file=scan, conditions=known)


def _shorten(sets):
    """Scans are called as on the page of a study."""
    short = names.short(one.file for one in sets if one.file)
    for one in sets:
        one.name = short.get(one.file, one.name)


def _members(file, name):
    node = file.get(name)
    return [node[key] for key in node] if isinstance(node, h5py.Group) else []


def _has_curves(node):
    return node is not None and any(f"psd_{axis}_{unit}" in node for axis, unit in UNITS.items())


def _mean(node):
    curves, deviations = _read(node, "_mean")
    scans = hdf.text_list(hdf.attributes(node).get("scans"))
    return Curves(_text(node, "group"), curves, deviations, n_scans=len(scans))


def _text(node, attribute):
    return readable(hdf.attributes(node).get(attribute, node.name))


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


def _exponents(node):
    """{axis: (H, its standard error)} of the spectra that have one."""
    found = {}
    for axis, unit in UNITS.items():
        facts = hdf.attributes(node[key]) if (key := f"psd_{axis}_{unit}") in node else {}
        hurst = facts.get("hurst")
        if isinstance(hurst, float) and np.isfinite(hurst):
            found[axis] = hurst, facts.get("hurst_standard_error", float("nan"))
    return found


def _scan(command):
    """The scan that a command 'tabor psd SCAN ...' names."""
    try:
        words = shlex.split(command)
    except ValueError:
        return ""
    return readable(words[2]) if len(words) > 2 and words[1] == "psd" and not words[2].startswith("-") else ""
