"""A result file of `tabor slide`: states along the way, maps of some of them, spectra of the sheet."""

from dataclasses import dataclass, field

import h5py
import numpy as np

from tabor.report import hdf, single, units
from tabor.report.states import SingleState

BEFORE = "before"
AXES = ("x", "y")


class SlideState(SingleState):
    """A state after some distance."""

    @property
    def distance(self):
        """[m]"""
        return self.facts["distance_m"]

    @property
    def name(self):
        """'after 20 µm'"""
        return f"after {units.length(self.distance)}" if self.distance > 0 else "pressed"

    label = name

    @property
    def pressure_text(self):
        """'10 MPa, after 20 µm'"""
        return f"{units.pressure(self.facts.get('mean_pressure_Pa'))}, {self.name if self.distance > 0 else 'before sliding'}"

    @property
    def pressure_label(self):
        """'20 µm', of a contact."""
        return units.length(self.distance) if self.distance > 0 else "0 µm"

    @property
    def density_label(self):
        return "oil as rained"

    @property
    def has_maps(self):
        return self.has("sheet")


@dataclass
class Slide(single.Single):
    spectra: dict = field(default_factory=dict)  # {"before" or the key of a state: {"x" or "y": (q [rad/m], density [m^3])}}

    kind = "slide"

    def is_solved_on(self, state):
        return not state.distance > 0

    @property
    def with_maps(self):
        """States whose maps are kept."""
        return [state for state in self.states if state.has_maps]

    def column_of(self, key):
        """The numbers of all states, NaN where there is none."""
        return np.array([float(state.facts.get(key, np.nan)) for state in self.states])


def is_one(file):
    states = file.get("states")
    return isinstance(states, h5py.Group) and "spectra" in file and any("distance_m" in states[key].attrs for key in states)


def load(path, file):
    found = single.load(path, file, Slide, SlideState)
    found.spectra = {key: _curves(file["spectra"][key]) for key in file["spectra"]}
    return found


def _curves(node):
    curves = {}
    for axis in AXES:
        q, density = (hdf.child(node, name) for name in (f"q_{axis}_rad_per_m", f"psd_{axis}_m3"))
        if q is not None and density is not None:
            curves[axis] = np.asarray(q[()], dtype=float), np.asarray(density[()], dtype=float)
    return curves
