"""Studies: scans x pressures x densities into a store that can be resumed."""

from __future__ import annotations

import csv
import glob
import json
import os
import pathlib
import tempfile
from collections.abc import Mapping, Sequence
from typing import Any, Union

from . import _tabor
from ._contact import Solid
from ._optional import needs
from ._progress import Progress, watching
from ._values import Value, optional_si, si, si_list

_Path = Union[str, "os.PathLike[str]"]


def _text(value: str) -> str:
    """As a text of TOML, whose escapes are those of JSON."""
    return json.dumps(value)


def _quantity(value: float, unit: str) -> str:
    return _text(f"{value!r} {unit}".strip())


def _quantities(values: Sequence[float], unit: str) -> str:
    return "[" + ", ".join(_quantity(value, unit) for value in values) + "]"


def _table(name: str, lines: Mapping[str, str | None]) -> str:
    body = "".join(f"{key} = {value}\n" for key, value in lines.items() if value is not None)
    return f"\n{name}\n{body}" if name else body


def _files(pattern: _Path) -> list[str]:
    found = sorted(glob.glob(os.fspath(pattern)))
    if not found:
        raise ValueError(f"scans: no file '{os.fspath(pattern)}' in {os.getcwd()}")
    return [os.path.abspath(file) for file in found]


def _scan_tables(scans: Mapping[str, Any]) -> str:
    tables = ""
    for group, patterns in scans.items():
        for pattern in [patterns] if isinstance(patterns, (str, os.PathLike)) else patterns:
            for file in _files(pattern):
                tables += _table("[[scan]]", {"file": _text(file), "group": _text(group)})
    return tables


class Study:
    """Friction of many scans under many pressures with many densities of oil; the same as a study file
    of ``tabor sweep``.

    Parameters
    ----------
    scans : mapping
        Groups with a file, a pattern or a list of them each; averages are taken over a group.
    solid : Solid
        That the surfaces are of.
    pressure : mean pressures [Pa].
    density : areal densities of the oil [kg/m^2]; without any, dry friction alone.
    treatment : steps that each scan goes through, "level=plane".
    shear_strength, boundary_shear_strength : see ``friction``.
    oil_density, droplet_height, model, reading, edge, seed : see ``rain``.
    boundary, tolerance : see ``contact``.
    title : of the study.

    Raises
    ------
    ValueError
        For scans that are not there, and as the functions named do.
    """

    _study: _tabor.Study

    def __init__(self, scans: Mapping[str, _Path | Sequence[_Path]], solid: Solid, *,
                 pressure: Value | Sequence[Value], density: Value | Sequence[Value] = 0.0,
                 treatment: Sequence[str] = (), shear_strength: Value | None = None,
                 boundary_shear_strength: Value | None = None, area: str | None = None,
                 oil_density: Value = 900.0, droplet_height: Value = 1e-7, model: str = "droplets",
                 reading: str = "conserving", edge: str = "closed", seed: int = 1, boundary: str = "periodic",
                 tolerance: float = 1e-6, title: str = "study") -> None:
        strength = solid.shear_strength if shear_strength is None else shear_strength
        wet = optional_si(boundary_shear_strength, "pressure", "boundary_shear_strength")
        counter = solid.counter_youngs_modulus
        text = _table("", {
            "title": _text(title), "area": None if area is None else _text(area),
            "shear_strength": None if strength is None else _quantity(si(strength, "pressure", "shear_strength"), "Pa"),
            "boundary_shear_strength": None if wet is None else _quantity(wet, "Pa")})
        text += _table("[material]", {
            "youngs_modulus": _quantity(solid.youngs_modulus, "Pa"), "poissons_ratio": repr(float(solid.poissons_ratio)),
            "saturation_pressure": None if solid.saturation_pressure is None else _quantity(solid.saturation_pressure, "Pa"),
            "counter_youngs_modulus": None if counter is None else _quantity(counter, "Pa"),
            "counter_poissons_ratio": None if counter is None else repr(float(solid.counter_poissons_ratio or 0))})
        text += _table("[treatment]", {"steps": "[" + ", ".join(map(_text, treatment)) + "]" if treatment else None})
        text += _table("[contact]", {"boundary": _text(boundary), "tolerance": repr(float(tolerance))})
        text += _table("[sweep]", {
            "mean_pressure": _quantities(si_list(pressure, "pressure", "pressure")[0], "Pa"),
            "lubricant_density": _quantities(si_list(density, "areal_density", "density")[0], "kg/m^2")})
        text += _table("[lubricant]", {
            "oil_density": _quantity(si(oil_density, "density", "oil_density"), "kg/m^3"), "model": _text(model),
            "reading": _text(reading), "edge": _text(edge), "seed": str(int(seed)),
            "droplet": _quantity(si(droplet_height, "length", "droplet_height"), "m")})
        self._text = text + _scan_tables(scans)
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "study.toml")
            try:
                self._study = self._write(file)
            except ValueError as error:
                raise ValueError(str(error).replace(str(file), "study")) from None
        self._file: pathlib.Path | None = None

    @classmethod
    def read(cls, file: _Path) -> Study:
        """A study file of ``tabor sweep``. Raises ValueError with file, line and key."""
        study = cls.__new__(cls)
        study._study = _tabor.read_study(os.fspath(file))
        study._file = pathlib.Path(file)
        return study

    def _write(self, file: pathlib.Path) -> _tabor.Study:
        file.write_text(self._text, "utf-8")
        return _tabor.read_study(os.fspath(file))

    @property
    def n_cases(self) -> int:
        """Scans times pressures times densities."""
        return self._study.n_cases

    def __repr__(self) -> str:
        return f"Study {self._study.title}: {self._study.n_scans} scans, {self.n_cases} cases"

    def run(self, folder: _Path, *, jobs: int = 0, retry: bool = False, progress: Progress = None) -> Results:
        """Computes what the store in the folder does not hold yet. Ctrl-C keeps what is finished; the same
        call, or ``tabor sweep FOLDER/study.toml -o FOLDER``, continues.

        ``jobs``: cases at the same time [as many as there are threads and room for]; ``retry``: what failed
        or did not converge is computed again. Raises ValueError for scans that cannot be read, OSError where
        the folder cannot be written.
        """
        if jobs < 0:
            raise ValueError(f"jobs: got {jobs}; expected zero or more")
        os.makedirs(folder, exist_ok=True)
        study = self._study if self._file else self._write(pathlib.Path(folder).absolute() / "study.toml")
        with watching(progress) as told:
            outcome = _tabor.run_study(study, os.fspath(folder), jobs, retry, told)
        return Results(folder, outcome)


def _number(cell: str) -> float | bool | str:
    if cell in ("true", "false"):
        return cell == "true"
    try:
        return float(cell or "nan")
    except ValueError:
        return cell


class Results:
    """The tables in a folder of ``Study.run`` or ``tabor sweep``. ``warnings`` and ``failures`` are those of
    the run that made it."""

    def __init__(self, folder: _Path, outcome: _tabor.Outcome | None = None) -> None:
        self.folder = pathlib.Path(folder)
        if not (self.folder / "results.csv").is_file():
            raise ValueError(f"{self.folder}: no results.csv; expected a folder of Study.run or tabor sweep")
        self.warnings: tuple[str, ...] = tuple(outcome.warnings) if outcome else ()
        self.failures: tuple[str, ...] = tuple(outcome.failures) if outcome else ()
        self.n_contacts = outcome.n_contacts if outcome else 0  #: that the run computed

    def _rows(self, name: str) -> list[dict[str, float | bool | str]]:
        with open(self.folder / name, newline="", encoding="utf-8") as file:
            return [{key: _number(cell) for key, cell in row.items()} for row in csv.DictReader(file)]

    @property
    def rows(self) -> list[dict[str, float | bool | str]]:
        """One for each scan, pressure and density (docs/results.md)."""
        return self._rows("results.csv")

    @property
    def averages(self) -> list[dict[str, float | bool | str]]:
        """One for each group, pressure and density."""
        return self._rows("averages.csv")

    @property
    def table(self) -> Any:
        """The rows as a DataFrame; needs pandas."""
        return needs("pandas", "table").read_csv(self.folder / "results.csv")

    def __repr__(self) -> str:
        return f"Results in {self.folder}: {len(self.rows)} rows"
