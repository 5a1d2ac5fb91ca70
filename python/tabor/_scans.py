"""Scans of a study, as the tables of its file."""

from __future__ import annotations

import glob
import json
import os
from collections.abc import Mapping, Sequence
from typing import Any, Union

from ._values import Value, si, si_list

Path = Union[str, "os.PathLike[str]"]


def text(value: str) -> str:
    """As a text of TOML, whose escapes are those of JSON."""
    return json.dumps(value)


def texts(values: Sequence[str]) -> str:
    """As a list of texts."""
    return "[" + ", ".join(map(text, values)) + "]"


def quantity(value: float, unit: str) -> str:
    """A number with its unit, all its digits."""
    return text(f"{value!r} {unit}".strip())


def quantities(values: Sequence[float], unit: str) -> str:
    """The same of a list."""
    return "[" + ", ".join(quantity(value, unit) for value in values) + "]"


def pressures(values: Value | Sequence[Value] | None) -> str | None:
    """Mean pressures in Pa; None if there are none."""
    return None if values is None else quantities(si_list(values, "pressure", "pressure")[0], "Pa")


def densities(values: Value | Sequence[Value] | None) -> str | None:
    """Areal densities in kg/m^2; None if there are none."""
    return None if values is None else quantities(si_list(values, "areal_density", "density")[0], "kg/m^2")


def speeds(values: Value | Sequence[Value] | None) -> str | None:
    """Sliding speeds in m/s; None if there are none."""
    return None if values is None else quantities(si_list(values, "speed", "speed")[0], "m/s")


def table(name: str, lines: Mapping[str, str | None]) -> str:
    """A table with the keys that have a value."""
    body = "".join(f"{key} = {value}\n" for key, value in lines.items() if value is not None)
    return f"\n{name}\n{body}" if name else body


def _files(pattern: Path) -> list[str]:
    found = sorted(glob.glob(os.fspath(pattern)))
    if not found:
        raise ValueError(f"scans: no file '{os.fspath(pattern)}' in {os.getcwd()}")
    return [os.path.abspath(file) for file in found]


class Scans:
    """Scan files of a study with settings of their own, in place of those of the study.

    Parameters
    ----------
    files : file, pattern or list of them.
    pressure : mean pressures [Pa].
    density : areal densities of the oil [kg/m^2].
    treatment : steps, "level=plane".
    contact : "elastic", whatever the solid's saturation pressure, or "saturated".
    reading : "conserving" or "literal"; see ``rain``.
    channel, pixel, unit : see ``read``.

    Raises
    ------
    ValueError, TypeError
        For values that are none; the study says the rest.
    """

    def __init__(self, files: Path | Sequence[Path], *, pressure: Value | Sequence[Value] | None = None,
                 density: Value | Sequence[Value] | None = None, treatment: Sequence[str] | None = None,
                 contact: str | None = None, reading: str | None = None, channel: str | int | None = None,
                 pixel: Value | None = None, unit: str | None = None) -> None:
        self.files: tuple[Path, ...] = (files,) if isinstance(files, (str, os.PathLike)) else tuple(files)
        self._lines: dict[str, str | None] = {
            "pressure": pressures(pressure), "density": densities(density),
            "treatment": None if treatment is None else texts(treatment),
            "contact": None if contact is None else text(contact),
            "reading": None if reading is None else text(reading),
            "channel": None if channel is None else text(str(channel)),
            "pixel": None if pixel is None else quantity(si(pixel, "length", "pixel"), "m"),
            "unit": None if unit is None else text(unit)}

    def __repr__(self) -> str:
        own = "".join(f", {key}={value}" for key, value in self._lines.items() if value is not None)
        return f"Scans({', '.join(map(str, self.files))}{own})"

    def _tables(self, group: str) -> str:
        return "".join(table("[[scan]]", {"file": text(file), "group": text(group), **self._lines})
                       for pattern in self.files for file in _files(pattern))


def scan_tables(scans: Mapping[str, Any]) -> str:
    """The [[scan]] tables of groups with a file, a pattern, ``Scans``, or a list of them each."""
    tables = ""
    for group, members in scans.items():
        for one in [members] if isinstance(members, (str, os.PathLike, Scans)) else members:
            tables += (one if isinstance(one, Scans) else Scans(one))._tables(group)
    return tables
