"""Maps of one contact state or one film, whatever kind of file they come from."""

import collections

import numpy as np

from tabor.report import hdf, units

NO_CONTACT, CONTACT, SATURATED = 0, 1, 2
PRESSURE_ROUNDING = 1e-6


class StudyContact:
    """/contact of a store file: `state` and `gap`."""

    def __init__(self, node):
        self.node = node
        self.facts = hdf.attributes(node)
        self.pressure = self.facts.get("mean_pressure_Pa", float("nan"))

    def state(self):
        """uint8, shape (ny, nx): 0 none, 1 contact, 2 saturated."""
        return self.node["state"][()]

    def gap(self):
        """[m], shape (ny, nx)"""
        return self.node["gap"][()]


class Film:
    """One member of /films of a store file."""

    def __init__(self, node):
        self.node = node
        self.facts = hdf.attributes(node)
        self.density = self.facts.get("lubricant_density_g_per_m2", float("nan"))

    def thickness(self):
        """[m], shape (ny, nx)"""
        return self.node["film_thickness"][()]


class Flow:
    """/fluid of a store file: pressure, fill and gap of a film that flows."""

    def __init__(self, node):
        self.node = node
        self.facts = hdf.attributes(node)

    @property
    def label(self):
        """'2 MPa, 0.9 g/m², 0.005 m/s'"""
        pressure = units.pressure(self.facts.get("mean_pressure_Pa"))
        density = units.density(self.facts.get("lubricant_density_g_per_m2"))
        return f"{pressure}, {density}, {units.number(self.facts.get('sliding_speed_m_per_s'))} m/s"


class SingleState:
    """One member of /states of a `contact -o`, `lubricate -o` or `friction -o` file."""

    def __init__(self, key, node, saturation_pressure):
        self.key = key
        self.node = node
        self.facts = hdf.attributes(node)
        self.saturation_pressure = saturation_pressure
        self.pressure = self.facts.get("mean_pressure_Pa")
        self.density = self.facts.get("lubricant_density_g_per_m2")
        self.visit = 0  # how many states before it have its pressure, density and speed: those of a path of loads

    @property
    def label(self):
        """'P = 5 MPa, 0.9 g/m²', whichever of the two it has."""
        parts = [self.pressure_label] if self.pressure is not None else []
        parts += [self.density_label] if self.density is not None else []
        return ", ".join(parts) or f"state {self.key}"

    @property
    def name(self):
        """'7 MPa, 0.45 g/m²', with the speed where the oil flows: what tells it from the others of its file."""
        speed = self.facts.get("sliding_speed_m_per_s")
        parts = [self.pressure_text] if self.pressure is not None else []
        parts += [units.density(self.density)] if self.density is not None else []
        parts += [units.si(speed, "m/s")] if speed else []
        return ", ".join(parts) or f"state {self.key}"

    @property
    def pressure_text(self):
        """'7 MPa', or '7 MPa (2nd)' where a path of loads comes back to it."""
        return units.pressure(self.pressure) + (f" ({units.nth(self.visit + 1)})" if self.visit else "")

    @property
    def pressure_label(self):
        return f"P = {self.pressure_text}" if self.pressure is not None else f"state {self.key}"

    @property
    def density_label(self):
        return units.density(self.density) if self.density is not None else f"state {self.key}"

    @property
    def scalars(self):
        """What --json prints for this state, without the bookkeeping of NeXus and HDF5."""
        return {key: value for key, value in self.facts.items() if not _is_file_matter(key, value)}

    def has(self, name):
        """Whether this command stored such a map."""
        return name in self.node

    def raw(self, name):
        """As stored, shape (ny, nx), or None if this command stored no such map."""
        dataset = hdf.child(self.node, name)
        return None if dataset is None else dataset[()]

    def map(self, name):
        """float64, shape (ny, nx), or None if this command stored no such map."""
        values = self.raw(name)
        return None if values is None else values.astype(np.float64, copy=False)

    def state(self):
        """uint8, shape (ny, nx): 0 none, 1 elastic, 2 saturated; None without pressures."""
        return self.contact()[0]

    def contact(self, step=1):
        """(state, every step-th pressure as stored [Pa]), both None without pressures; nothing saturates without a saturation pressure."""
        dataset, stored = hdf.child(self.node, "pressure"), self.raw("state")
        if dataset is None:
            return None, None
        if stored is not None:
            return stored, hdf.thinned(dataset, step)
        pressure = dataset[()]
        return self._state_of(pressure), pressure[::step, ::step].copy()

    def _state_of(self, pressure):
        """For files that do not hold it."""
        state = np.where(pressure > 0, CONTACT, NO_CONTACT).astype(np.uint8)
        if self.saturation_pressure:
            # The solver clips at the cap, so only rounding to float32 separates a saturated pixel from it.
            state[pressure >= self.saturation_pressure * (1 - PRESSURE_ROUNDING)] = SATURATED
        return state


def count_visits(states):
    """Tells states apart that a path of loads brings to the same pressure, density and speed."""
    met = collections.Counter()
    for state in states:
        place = state.pressure, state.density, state.facts.get("sliding_speed_m_per_s")
        state.visit = met[place] if state.pressure is not None else 0
        met[place] += 1


def _is_file_matter(key, value):
    return (
        key in ("NX_class", "signal", "axes", "default")
        or key.endswith("_indices")
        or isinstance(value, list)
    )
