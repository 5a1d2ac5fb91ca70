"""Names that users of NumPy, xarray and other packages try, and what the package has in their place.

A name that does not exist is an AttributeError, and a key a KeyError, that says what to write. The tables below are
the one place where such names stand; ``Named`` gives them to a class, and ``missing_name`` to a module.
"""

from __future__ import annotations

import difflib
from abc import ABCMeta
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

_NUMBERS = "values has all numbers by name"
_ON_SURFACE = "surface.{name} has it"

#: What to write in place of a name: {class: {name: remedy}}. "{name}" is the name itself.
GUESSES: Mapping[str, Mapping[str, str]] = {
    "Surface": {
        **dict.fromkeys(("heights", "z", "data", "values"), "height is the array of heights"),
        **dict.fromkeys(("pixel_size", "spacing", "step"), "pixel is (dx, dy)"),
        **dict.fromkeys(("nx", "ny", "nb_grid_pts"), "shape is (ny, nx)"),
        **dict.fromkeys(("Lx", "Ly", "lx", "ly", "physical_sizes"), "lengths is (lx, ly)"),
        **dict.fromkeys(("std", "Sq", "rms_height"), 'parameters("Sq").Sq is the root mean square height'),
        "Sa": 'parameters("Sa").Sa is the mean absolute height',
        **dict.fromkeys(("mean", "min", "max", "ptp"), "numpy.nan{name}(surface.height) computes it"),
        **dict.fromkeys(("detrend", "remove_form"), 'level("plane") or level("poly2") does it'),
        **dict.fromkeys(("gaussian", "filter", "smooth"), 'lowpass("gauss:8um") and highpass("gauss:250um") filter'),
        **dict.fromkeys(("rotate", "rot90"), "flip mirrors along an axis; apply(numpy.rot90, note) turns a square map"),
        **dict.fromkeys(("T", "transpose"), 'Surface(surface.height.T, pixel=surface.pixel[::-1]) exchanges x and y'),
        **dict.fromkeys(("downsample", "resize", "zoom"), 'resample("256,256") changes the pixels'),
        "tile": 'mirror() doubles a surface into a tile; edges("tile") says that it is one',
        "copy": "a surface does not change and needs no copy; surface.height.copy() is an array of its own",
        "hist": "numpy.histogram(surface.height[~surface.mask]) counts heights",
        "profile": "section(p, q) is the profile between two points",
        **dict.fromkeys(("acf", "autocorrelation"), 'parameters("Sal") is the autocorrelation length, psd() the spectrum'),
        **dict.fromkeys(("plot_3d", "show"), "plot() draws the heights"),
        "write": "save(file) writes a scan file",
        "attrs": "history, source and metadata say what it is; to_xarray() has them as attributes",
        "to_dataframe": "to_xarray().to_dataframe() is one",
        **dict.fromkeys(("read", "load", "from_file"), "tabor.read(file) reads a scan"),
    },
    "Contact": {
        **dict.fromkeys(("p", "pressures"), "pressure is the map, mean_pressure the load over the area"),
        "load": "mean_pressure is the load over the area, force the load",
        "approach": 'values["approach_m"] is how far the flat has come since it first touched',
        **dict.fromkeys(("contact", "mask", "contact_map"), "touching is the contact mask"),
        "iterations": 'values["iterations"] counts them',
        **dict.fromkeys(("shape", "x", "y", "pixel"), _ON_SURFACE),
        **dict.fromkeys(("area", "contact_area"), "area_fraction is the share of the nominal area"),
        "to_dict": "dict(contact.values) is one", "to_dataframe": "to_xarray().to_dataframe() is one",
        **dict.fromkeys(("read", "load"), "tabor.load(file) reads a result"),
    },
    "Film": {
        "mean_thickness": 'values["mean_film_m"] is the mean thickness',
        **dict.fromkeys(("h", "film"), "thickness is the map"),
        "density": "lubricant_density is the areal density, kg/m^2",
        "mask": "thickness > 0 is the mask of the wet pixels",
        "oil_density": 'tabor.rain(..., oil_density=...) takes it',
        **dict.fromkeys(("shape", "x", "y", "pixel"), _ON_SURFACE),
    },
    "Friction": {
        **dict.fromkeys(("mu", "cof", "friction", "coefficient"), "dry and lubricated are the coefficients of friction"),
        "mixed": "tabor.fluid_film(...).friction_mixed is that of solids and oil",
        "surface": "contact.surface is what was pressed, film.surface what the oil lies on",
    },
    "FluidFilm": {"mu": "friction_mixed is the coefficient of friction", "mixed": "friction_mixed is the coefficient of friction"},
    "Parameters": {
        "to_dict": "{{key: float(one) for key, one in parameters.items()}} is one",
        "to_series": "pandas.Series(parameters) is one",
    },
    "DensityCurve": {
        "density": "lubricant_density is the areal density, kg/m^2",
        "friction": "friction_lubricated is friction along the curve, friction_dry that without oil",
        "to_dataframe": "to_xarray().to_dataframe() is one",
        "interp": "numpy.interp(density, curve.lubricant_density, curve.friction_lubricated) does it",
    },
    "Results": {
        **dict.fromkeys(("values", "data"), "rows has the numbers of each case, averages those of each group"),
        **dict.fromkeys(("to_dataframe", "to_pandas", "df"), "table is a DataFrame of the rows"),
        "plot": "tabor.report(folder) draws it", "errors": "failures says what failed",
    },
    "FrictionTable": {
        **dict.fromkeys(("values", "rows", "table"), "entries has the coefficients"),
        **dict.fromkeys(("save", "write"), 'to_csv(file) and to_abaqus(file, units="mm,s,t") write it'),
    },
    "Slide": {
        "plot": "save(file) and tabor.report(file, folder) draw it; after.plot() draws the sheet after sliding",
        **dict.fromkeys(("values", "rows"), "states has the numbers of each state, over states[\"distance_m\"]"),
    },
    "Solution": {
        "plot": "tabor.report(solution, folder) draws it", "film": 'values has "central_film_m" and "min_film_m"; save(file) writes the map',
        "pressure": 'values has "max_pressure_Pa"; save(file) writes the map',
        **dict.fromkeys(("central_film", "min_film", "max_pressure"), 'values["{name}_..."] has it, with its unit at the end of the name'),
    },
    "Sweep": {"values": "rows has the numbers of each case, axes the values that were varied"},
    "Case": {"replace": "point(case.toml, **settings) with tabor.ehl.Template changes keys"},
    "tabor": {
        **dict.fromkeys(("open", "read_surface", "load_surface"), "read(file) reads a scan, load(file) a result"),
        **dict.fromkeys(("read_result", "load_result", "open_result"), "load(file) reads a result"),
        "hertz": 'generate("bump", ...) makes a cap to press on; contact(..., boundary="free") presses it',
        "datasets": "the folder surfaces of the source has scans, generate(kind) makes surfaces",
        **dict.fromkeys(("lubricants", "oils", "Oil"), 'Lubricant("0.1 Pa s") makes an oil'),
        **dict.fromkeys(("compare", "difference", "subtract", "wear"), "combine(first, second) registers two scans and subtracts them"),
        **dict.fromkeys(("psd", "spectrum"), "Surface.psd() is the power spectrum of a surface"),
        **dict.fromkeys(("plot", "imshow"), "Surface.plot() draws a surface, Contact.plot(field) a map of a contact"),
        **dict.fromkeys(("press", "solve"), "contact(surface, pressure, solid) presses a flat on a surface"),
        "film": "rain(surface, density) lays a film of oil on a surface",
        "write": "save(file, results) writes results, Surface.save(file) a scan",
        **dict.fromkeys(("set_num_threads", "get_threads", "threads", "get_num_threads"), "set_threads(n) limits the threads"),
        "stribeck": 'fluid_film(...) at several speeds, or ehl.point(...).sweep({{"motion.speed": [...]}}), is a Stribeck curve',
        "Quantity": 'a value is an SI number, a text with its unit or a quantity of pint',
    },
    "tabor.ehl": {"solve": "point(case).solve() solves a case", "read": 'point("case.toml") reads a case'},
}

#: Arguments that users try: {what was tried: what it is called}.
ARGUMENTS: Mapping[str, str] = {
    "E": "youngs_modulus", "young": "youngs_modulus", "nu": "poissons_ratio", "poisson": "poissons_ratio",
    "hardness": "saturation_pressure", "tol": "tolerance", "rtol": "tolerance", "p": "pressure", "load": "pressure",
    "normal_force": "force", "n_threads": "n", "material": "solid", "dx": "pixel", "pixel_size": "pixel",
    "mu": "shear_strength", "eta": "viscosity", "eta0": "viscosity", "velocity": "speed", "u": "speed",
}


class NameNotFound(KeyError):
    """A key that is not there; its text is a sentence, without the quotes of KeyError."""

    def __str__(self) -> str:
        return str(self.args[0])


def _nearest(name: str, known: Iterable[str]) -> str:
    """"; did you mean 'x'?" of the names that are there, or nothing."""
    names = sorted(one for one in known if not one.startswith("_"))
    small = {one.lower(): one for one in names}
    near = difflib.get_close_matches(name.lower(), small, 1)
    return f"; did you mean {small[near[0]]!r}?" if near else ""


def missing_key(title: str, key: Any, known: Iterable[str]) -> NameNotFound:
    """The KeyError for a key, with the nearest or all that there are."""
    names = list(known)
    small = {one.lower(): one for one in names}
    near = difflib.get_close_matches(str(key).lower(), small, 3)
    near += [low for low in small if key and str(key).lower() in low and low not in near]
    listed = ", ".join(repr(small[one]) for one in near[:4])
    text = f"did you mean {listed}?" if near else f"it has {', '.join(names[:40])}" + (", ..." if len(names) > 40 else "")
    return NameNotFound(f"{title} has no {key!r}; {text}")


def _remedy(titles: Iterable[str], name: str) -> str:
    """"; touching is the contact mask" of the first class that knows it, or nothing."""
    for title in titles:
        text = GUESSES.get(title, {}).get(name)
        if text is not None:
            return f"; {text.format(name=name)}"
    return ""


def _missing(kind: type, name: str, known: Iterable[str]) -> AttributeError:
    remedy = _remedy((one.__name__ for one in kind.__mro__), name) or _nearest(name, known)
    return AttributeError(f"{kind.__name__} has no {name!r}{remedy}", name=name)


def missing_name(module: str, name: str, known: Iterable[str]) -> AttributeError:
    """The AttributeError for a name that a module does not have."""
    return AttributeError(f"module {module!r} has no {name!r}{_remedy([module], name) or _nearest(name, known)}", name=name)


class _Named(ABCMeta):
    """Class of the classes: names that the class itself does not have, ``Surface.read``."""

    def __getattr__(cls, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(f"type object {cls.__name__!r} has no attribute {name!r}", name=name, obj=cls)
        raise _missing(cls, name, dir(cls))


class Named(metaclass=_Named):
    """Says what to write in place of a name that does not exist."""

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):  # protocols of NumPy, copy and notebooks ask for many
            raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}", name=name, obj=self)
        try:
            is_value = name in object.__getattribute__(self, "values")
        except (AttributeError, TypeError):
            is_value = False
        if is_value:
            raise AttributeError(f"{type(self).__name__} has no {name!r}; its number is values[{name!r}]", name=name, obj=self)
        raise _missing(type(self), name, dir(self))


class Values(Mapping[str, Any]):
    """Numbers by name, which do not change. A name that is not there is a KeyError with the nearest."""

    def __init__(self, numbers: Mapping[str, Any], title: str) -> None:
        self._numbers = dict(numbers)
        self._of = title

    def __getitem__(self, key: str) -> Any:
        try:
            return self._numbers[key]
        except KeyError:
            raise missing_key(self._of, key, self._numbers) from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._numbers)

    def __len__(self) -> int:
        return len(self._numbers)

    def __repr__(self) -> str:
        return repr(self._numbers)
