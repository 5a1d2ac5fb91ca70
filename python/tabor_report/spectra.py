"""A result file of `tabor psd`: spectra of one scan along x, along y and radial."""

import shlex
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from tabor_report import hdf
from tabor_report.errors import readable

NAMES = {"x": "along x", "y": "along y", "radial": "radial"}
UNITS = {"x": "m3", "y": "m3", "radial": "m4"}


@dataclass
class Spectra:
    path: Path
    file: object
    facts: dict
    curves: dict  # {"x", "y" or "radial": (q [rad/m], density [m^3 or m^4])}
    warnings: list = field(default_factory=list)

    kind = "psd"

    @property
    def title(self):
        return f"Power spectra: {readable(_scan(self.facts.get('command', '')) or self.path.stem)}"

    @property
    def trusted(self):
        """(lowest, highest) wavevector [rad/m] of a quarter of the side and of 4 pixels, as `tabor psd` names them."""
        q, _ = next(iter(self.curves.values()))  # that along x, if there is one: bins of the radial one begin elsewhere
        return 4 * q[0], q[-1] / 2


def is_one(file):
    return "curves" in file and any(f"psd_{axis}_{unit}" in file["curves"] for axis, unit in UNITS.items())


def load(path, file):
    node, curves = file["curves"], {}
    for axis, unit in UNITS.items():
        names = f"q_{axis}_rad_per_m", f"psd_{axis}_{unit}"
        if all(name in node for name in names):
            q, density = (np.asarray(node[name][()], dtype=float) for name in names)
            shown = np.isfinite(q) & np.isfinite(density) & (q > 0) & (density > 0)
            if shown.sum() > 1:
                curves[axis] = q[shown], density[shown]
    facts = hdf.attributes(file)
    return Spectra(path, file, facts, curves, hdf.text_list(facts.get("warnings")))


def _scan(command):
    """The scan that a command 'tabor psd SCAN ...' names."""
    try:
        words = shlex.split(command)
    except ValueError:
        return ""
    return Path(words[2]).name if len(words) > 2 and words[1] == "psd" and not words[2].startswith("-") else ""
