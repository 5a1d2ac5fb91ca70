"""Scans of a study, as the tables of its file."""

from __future__ import annotations

import glob
import hashlib
import json
import os
import pathlib
import re
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Literal, Unpack

from . import _tabor
from ._arguments import Path, mapping, path, wrong
from ._guesses import Named
from ._setting_types import ScanSettings
from ._settings import OF_SCANS, Setting, complete, documented, is_surface, takes
from ._surface import Surface
from ._values import Value, si_list


def text(value: str) -> str:
    """As a text of TOML, whose escapes are those of JSON."""
    return json.dumps(value)


def texts(values: Sequence[str]) -> str:
    """As a list of texts."""
    return "[" + ", ".join(map(text, values)) + "]"


def quantity(value: float, unit: str) -> str:
    """A number with its unit, all its digits."""
    return text(f"{value!r} {unit}".strip())


def line(setting: Setting, value: Any) -> str:
    """A plain value of a setting as a study file has it."""
    if is_surface(value):
        raise TypeError(f"{setting.argument}: a study reads it from a file: surface.save('tool.h5'), then the name of the file")
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        is_file = setting.name == "tool" and os.path.exists(value)
        return text(os.path.abspath(value) if is_file else value)
    if isinstance(value, list):
        return quantities(value, setting.unit) if len(value) > 1 else quantity(value[0], setting.unit)
    return quantity(value, setting.unit) if setting.unit else repr(value)


def quantities(values: Sequence[float], unit: str) -> str:
    """The same of a list."""
    return "[" + ", ".join(quantity(value, unit) for value in values) + "]"


def pressures(values: Value | Iterable[Value] | None) -> str | None:
    """Mean pressures in Pa; None if there are none."""
    return None if values is None else quantities(si_list(values, "pressure", "pressure")[0], "Pa")


def densities(values: Value | Iterable[Value] | None) -> str | None:
    """Areal densities in kg/m^2; None if there are none."""
    return None if values is None else quantities(si_list(values, "areal_density", "density")[0], "kg/m^2")


def speeds(values: Value | Iterable[Value] | None) -> str | None:
    """Sliding speeds in m/s; None if there are none."""
    return None if values is None else quantities(si_list(values, "speed", "speed")[0], "m/s")


def table(name: str, lines: Mapping[str, str | None]) -> str:
    """A table with the keys that have a value."""
    body = "".join(f"{key} = {value}\n" for key, value in lines.items() if value is not None)
    return f"\n{name}\n{body}" if name else body


class SurfaceFiles:
    """Files of surfaces in memory, for as long as a study needs them; those of the same surface have the same name."""

    def __init__(self) -> None:
        self._folder: tempfile.TemporaryDirectory[str] | None = None

    def add(self, surface: Surface) -> str:
        """Writes the file of a surface; returns its name."""
        if self._folder is None:
            self._folder = tempfile.TemporaryDirectory()
        draft = pathlib.Path(self._folder.name, "surface.h5")
        surface.save(draft)
        stem = re.sub(r"[^\w.-]+", "_", pathlib.Path(surface.name).stem) or "surface"
        content = repr((_tabor.digest_of(surface._topography), surface.source, surface.history, surface.edges))
        name = f"{stem}-{hashlib.sha256(content.encode()).hexdigest()[:12]}.h5"  # not of the file, which says when it was written
        return os.fspath(draft.rename(draft.with_name(name)))

    def move(self, lines: str, folder: pathlib.Path) -> str:
        """Copies the files into the folder ``surfaces`` beside a study file, and returns its lines, which name them there."""
        if self._folder is None:
            return lines
        place = folder / "surfaces"
        for file in sorted(pathlib.Path(self._folder.name).iterdir()):
            place.mkdir(exist_ok=True)
            if not (place / file.name).exists():
                _tabor.write_file(place / file.name, file.read_bytes())
        return lines.replace(text(self._folder.name + os.sep)[1:-1], "surfaces/")


def _files(pattern: Path) -> list[str]:
    found = sorted(glob.glob(os.fspath(pattern)))
    if not found:
        raise ValueError(f"scans: no file '{os.fspath(pattern)}' in {os.getcwd()}")
    return [os.path.abspath(file) for file in found]


@documented(OF_SCANS)
class Scans(Named):
    """Scan files of a study with settings of their own, in place of those of the study.

    Parameters
    ----------
    files : file, pattern, Surface or list of them.
    pressure : mean pressures [Pa].
    density : areal densities of the oil [kg/m^2].
    treatment : steps, "level=plane".
    contact : "elastic", whatever the solid's saturation pressure, or "saturated".
    reading : "conserving" or "literal"; see ``rain``.
    **settings

    Raises
    ------
    ValueError, TypeError
        For values that are none; the study says the rest.
    """

    @takes(OF_SCANS)
    def __init__(self, files: Path | Surface | Sequence[Path | Surface], *, pressure: Value | Iterable[Value] | None = None,
                 density: Value | Iterable[Value] | None = None, treatment: Sequence[str] | None = None,
                 contact: Literal["elastic", "saturated"] | None = None, reading: Literal["conserving", "literal"] | None = None, channel: str | int | None = None,
                 **settings: Unpack[ScanSettings]) -> None:
        given: Any = (files,) if isinstance(files, (str, os.PathLike, Surface)) else files
        if not isinstance(given, Iterable) or isinstance(given, bytes):
            raise wrong("files", files, "the name of a file, a pattern, a Surface, or a list of them")
        self.files: tuple[Path | Surface, ...] = tuple(one if isinstance(one, Surface) else path(one, "files") for one in given)
        values = complete(OF_SCANS, {**settings, "channel": None if channel is None else str(channel)})
        self._lines: dict[str, str | None] = {
            "pressure": pressures(pressure), "density": densities(density),
            "treatment": None if treatment is None else texts(treatment),
            "contact": None if contact is None else text(contact),
            "reading": None if reading is None else text(reading),
            **{one.study_name: None if values[one.name] is None else line(one, values[one.name]) for one in OF_SCANS}}

    def __repr__(self) -> str:
        own = "".join(f", {key}={value}" for key, value in self._lines.items() if value is not None)
        names = (one.name if isinstance(one, Surface) else str(one) for one in self.files)
        return f"Scans({', '.join(names)}{own})"

    def _tables(self, group: str, surfaces: SurfaceFiles) -> str:
        files = [file for one in self.files for file in ([surfaces.add(one)] if isinstance(one, Surface) else _files(one))]
        return "".join(table("[[scan]]", {"file": text(file), "group": text(group), **self._lines}) for file in files)


def scan_tables(scans: Mapping[str, Any], surfaces: SurfaceFiles, *, needs_pressure: bool = False) -> str:
    """The [[scan]] tables of groups with a file, a pattern, a Surface, ``Scans``, or a list of them each. With
    ``needs_pressure`` each must have its own."""
    if not isinstance(scans, Mapping):
        more = "; tabor.Study.read takes a study file" if isinstance(scans, (str, os.PathLike)) else ""
        raise wrong("scans", scans, f'groups with their files, {{"before": "before_*.x3p"}}{more}')
    tables = ""
    for group, members in mapping(scans, "scans").items():
        for one in _members(members, group):
            several = one if isinstance(one, Scans) else Scans(one)
            if needs_pressure and several._lines["pressure"] is None:
                raise ValueError(f"pressure: missing for group {group!r}; give Study a pressure, or each of its Scans one of its own")
            tables += several._tables(group, surfaces)
    return tables


def _members(members: Any, group: str) -> list[Any]:
    single = isinstance(members, (str, os.PathLike, Scans, Surface))
    several = [members] if single or not isinstance(members, (list, tuple)) else list(members)
    for one in several:
        if not isinstance(one, (str, os.PathLike, Scans, Surface)):
            raise wrong("scans", one, f"a file, a pattern, a Surface or tabor.Scans in group {group!r}, or a list of them")
    return several
