"""What the numbers of a result are called and how they are shown: as its file says, of older files as their keys and the table here do."""

import math
import re
from dataclasses import dataclass

import h5py
import numpy as np

from tabor.report import hdf, units

BY_UNIT, UNSCALED, PERCENT, EXPONENT = "by_unit", "unscaled", "percent", "exponent"  # styles, as src/tabor/core/column.hpp has them

# Endings of keys and their units; of those that fit, the longest counts.
_UNITS = {
    "_m3_per_m2": "m³/m²", "_m_per_s": "m/s", "_N_per_m": "N/m", "_Pa_per_m": "Pa/m", "_rad_per_m": "rad/m", "_kg_per_m": "kg/m", "_per_m": "1/m",
    "_per_Pa": "1/Pa", "_Pa_s": "Pa s", "_kg_per_m3": "kg/m³", "_kg_per_m2": "kg/m²", "_g_per_m2": "g/m²", "_J_per_m2": "J/m²",
    "_bytes": "bytes", "_m4": "m⁴", "_m3": "m³", "_m2": "m²", "_Pa": "Pa", "_kg": "kg", "_N": "N", "_K": "K", "_m": "m", "_s": "s",
}  # fmt: skip
_SWITCHES = ("converged", "dry_at_bound", "flooded", "gap_closing_at_turning", "load_path")  # ends of keys that are yes or no

# Of files that do not say it: those whose heading is not in their key.
_HEADINGS = {
    "mean_pressure_Pa": "pressure", "lubricant_density_g_per_m2": "lubricant", "sliding_speed_m_per_s": "sliding speed",
    "contact_area_fraction": "contact area", "contact_area_fraction_pixels": "counted contact", "saturated_area_fraction": "saturated",
    "contact_gap_error_m": "gap error", "n_patches": "patches", "n_pools": "pools", "wet_fraction": "wet", "lubricated_share": "wet share",
    "spill_over_fraction": "spill-over", "friction_lubricated": "friction wet", "fluid_load_share": "oil carries", "liquid_load_share": "oil carries", "friction_viscous": "viscous",
    "seconds": "time", "youngs_modulus_Pa": "Young's modulus E", "poissons_ratio": "Poisson's ratio ν", "effective_modulus_Pa": "effective modulus E*",
    "shear_strength_Pa": "shear strength τ_y", "saturation_pressure_Pa": "saturation pressure p_sat", "viscosity_Pa_s": "oil viscosity η",
    "pressure_viscosity_per_Pa": "pressure-viscosity coefficient α", "eyring_stress_Pa": "Eyring stress", "area": "area used for friction",
    "reading": "reading of the droplet rule",
}  # fmt: skip
_STYLES = {
    "contact_area_fraction": PERCENT, "contact_area_fraction_pixels": PERCENT, "saturated_area_fraction": PERCENT, "wet_fraction": PERCENT,
    "lubricated_share": PERCENT, "spill_over_fraction": PERCENT, "fluid_load_share": PERCENT, "liquid_load_share": PERCENT, "certificate": EXPONENT,
}  # fmt: skip
# Words of keys of films under load, as the program prints them.
_PRINTED = {
    "max": "largest", "min": "smallest", "hertz": "Hertz", "moes": "Moes", "nijenbanning": "Nijenbanning", "hamrock dowson": "Hamrock\N{EN DASH}Dowson",
    "friction fluid": "fluid friction", "friction solid": "solid friction", "n products": "products of the operator", "n steps": "steps",
    "newton iterations": "iterations",
}  # fmt: skip
_CURVES = {"time": "s", "force": "N", "friction": "", "share": ""}  # ends of names
_TO_PRINT = re.compile(rf"\b({'|'.join(_PRINTED)})\b")


@dataclass(frozen=True)
class Column:
    key: str
    heading: str
    unit: str = ""  # of SI; "" of a number without one
    style: str = BY_UNIT

    def show(self, value):
        """Returns the text of a value in a readable multiple of its unit."""
        value = value.item() if isinstance(value, np.generic) else value
        if isinstance(value, list):
            return ", ".join(map(self.show, value))
        if isinstance(value, bool) or isinstance(value, int) and self.key.endswith(_SWITCHES):
            return "yes" if value else "no"
        if isinstance(value, str) or value is None or math.isnan(value):
            return units.number(value)
        if self.style == PERCENT:
            return f"{units.number(100 * value)} %"
        if self.unit == "bytes":
            return f"{units.number(value / 2**20)} MiB"
        return f"{self.number(value)} {self.unit}" if self.style == UNSCALED else units.si(float(value), self.unit) if self.unit else self.number(value)

    def number(self, value, factor=1):
        """Returns the text of a value without its unit."""
        return units.number(value * factor if factor != 1 else value, 2 if self.style == EXPONENT else 4)

    def scale(self, values):
        """(factor, unit) in which all values read well beside each other."""
        known = np.abs(np.asarray(values, dtype=float))
        known = known[np.isfinite(known)]
        if self.style == PERCENT:
            return 100, "%"
        return (1, self.unit) if self.style == UNSCALED or not known.size else units.scale(known.max(), self.unit)

    def title(self, unit):
        """'mean gap (µm)', over plain numbers."""
        return f"{self.heading} ({unit})" if unit else self.heading


class Columns(dict):
    """{key: Column} that a file describes; any other key is described by its name."""

    def __init__(self, is_ehl=False):
        super().__init__()
        self._is_ehl = is_ehl

    def __missing__(self, key):
        return Column(key, self._heading(key), _unit(key), _style(key, _unit(key)))

    def _heading(self, key):
        if key in _HEADINGS and not self._is_ehl:
            return _HEADINGS[key]
        text = words(key)
        return _TO_PRINT.sub(lambda found: _PRINTED[found[0]], text) if self._is_ehl else text

    def describe(self, key, heading="", unit="", style=""):
        """Adds a column; what is empty is taken from its key, and without a heading the unit, too: a volume over an area is no length."""
        named = self.__missing__(key)
        unit = heading and units.signs(unit) or named.unit or units.signs(unit)
        self[key] = Column(key, heading or named.heading, unit, style.replace("-", "_") or _style(key, unit))


def of_file(file):
    """The Columns of an open result: the table /columns, and the attributes of its datasets of numbers."""
    found = Columns(hdf.text(file.attrs.get("kind", "")).startswith("ehl "))
    for row in _rows(hdf.child(file, "columns")):
        found.describe(*row)
    for group in ("table", "averages", "sweep"):
        node = hdf.child(file, group)
        for name in node if isinstance(node, h5py.Group) else ():
            _describe(found, name, hdf.attributes(node[name]))
    return found


def words(key):
    """'effective_modulus_Pa' -> 'effective modulus'"""
    text = key.removesuffix(_ending(key)).replace("_", " ")
    return text.replace("youngs", "Young's").replace("poissons", "Poisson's")


def _describe(found, name, facts):
    heading = facts.get("heading") or facts.get("long_name") or ""
    texts = [heading, facts.get("units") or "", facts.get("style") or ""]
    if all(isinstance(text, str) for text in texts) and any(texts):
        found.describe(name, *texts)


def _rows(node):
    """Returns (key, heading, unit, style) of each column, nothing where the table is damaged."""
    names = ("key", "heading", "units", "style")
    if not isinstance(node, h5py.Group) or not all(isinstance(node.get(name), h5py.Dataset) for name in names):
        return []
    columns = hdf.columns({name: node[name] for name in names})
    return zip(*columns.values()) if all(column.dtype == object for column in columns.values()) else []


def _ending(key):
    return max((ending for ending in _UNITS if key.endswith(ending)), key=len, default="")


def _unit(key):
    return _UNITS.get(_ending(key), "")


def _style(key, unit):
    return _STYLES.get(key, UNSCALED if unit == "g/m²" else BY_UNIT)


def unit_of_curve(name, dataset):
    """Returns the unit of values along a curve: as its file says, else by its name."""
    if "units" in dataset.attrs:
        return hdf.text(dataset.attrs["units"]).removeprefix("1")
    return "Pa" if name.endswith("pressure") else next((unit for end, unit in _CURVES.items() if name.endswith(end)), "m")
