"""Studies: scans x pressures x densities into a store that can be resumed."""

from __future__ import annotations

import csv
import os
import pathlib
from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from typing import Any

from . import _tabor
from ._contact import Solid
from ._friction import Lubricant
from ._friction_table import FrictionTable
from ._optional import needs
from ._parts import run as run_parts
from ._progress import Progress, watching
from ._scans import Path, Scans, densities, pressures, quantity, scan_tables, speeds, table, text, texts
from ._values import Value, optional_si, si


def _flowing(oil: Lubricant | None) -> dict[str, str | None]:
    """The keys of oil that flows."""
    if oil is None:
        return {}
    coefficient, stress = oil.pressure_viscosity, oil.eyring_stress
    return {"fluid": text("reynolds"), "viscosity": quantity(oil.viscosity, "Pa s"),
            "pressure_viscosity": None if coefficient is None else quantity(coefficient, "1/Pa"),
            "eyring_stress": None if stress is None else quantity(stress, "Pa")}


class Study:
    """Friction of many scans under many pressures with many densities of oil; the same as a study file
    of ``tabor sweep``.

    Parameters
    ----------
    scans : mapping
        Groups with a file, a pattern, ``Scans`` with settings of their own, or a list of them each;
        averages are taken over a group.
    solid : Solid
        That the surfaces are of.
    pressure : mean pressures [Pa]; needed unless all scans have their own.
    density : areal densities of the oil [kg/m^2]; without any, dry friction alone.
    treatment : steps that each scan goes through, "level=plane".
    shear_strength, boundary_shear_strength : see ``friction``.
    oil_density, droplet_height, model, reading, edge, seed : see ``rain``.
    lubricant, speed : oil that flows while the flat slides at each of these speeds [m/s]; see ``fluid_film``.
    boundary, tolerance : see ``contact``.
    title : of the study.

    Raises
    ------
    ValueError
        For scans that are not there, and as the functions named do.
    """

    _study: _tabor.Study

    def __init__(self, scans: Mapping[str, Path | Scans | Sequence[Path | Scans]], solid: Solid, *,
                 pressure: Value | Sequence[Value] | None = None, density: Value | Sequence[Value] = 0.0,
                 treatment: Sequence[str] = (), shear_strength: Value | None = None,
                 boundary_shear_strength: Value | None = None, area: str | None = None,
                 oil_density: Value = 900.0, droplet_height: Value = 1e-7, model: str = "droplets",
                 reading: str = "conserving", edge: str = "closed", seed: int = 1, lubricant: Lubricant | None = None,
                 speed: Value | Sequence[Value] | None = None, boundary: str = "periodic",
                 tolerance: float = 1e-6, title: str = "study") -> None:
        if (lubricant is None) != (speed is None):
            raise ValueError("Study: oil that flows needs both a lubricant and a speed")
        strength = solid.shear_strength if shear_strength is None else shear_strength
        wet = optional_si(boundary_shear_strength, "pressure", "boundary_shear_strength")
        counter = solid.counter_youngs_modulus
        lines = table("", {
            "title": text(title), "area": None if area is None else text(area),
            "shear_strength": None if strength is None else quantity(si(strength, "pressure", "shear_strength"), "Pa"),
            "boundary_shear_strength": None if wet is None else quantity(wet, "Pa")})
        lines += table("[material]", {
            "youngs_modulus": quantity(solid.youngs_modulus, "Pa"), "poissons_ratio": repr(float(solid.poissons_ratio)),
            "saturation_pressure": None if solid.saturation_pressure is None else quantity(solid.saturation_pressure, "Pa"),
            "counter_youngs_modulus": None if counter is None else quantity(counter, "Pa"),
            "counter_poissons_ratio": None if counter is None else repr(float(solid.counter_poissons_ratio or 0))})
        lines += table("[treatment]", {"steps": texts(treatment) if treatment else None})
        lines += table("[contact]", {"boundary": text(boundary), "tolerance": repr(float(tolerance))})
        lines += table("[sweep]", {
            "mean_pressure": pressures(pressure), "lubricant_density": densities(density), "sliding_speed": speeds(speed)})
        lines += table("[lubricant]", {
            "oil_density": quantity(si(oil_density, "density", "oil_density"), "kg/m^3"), "model": text(model),
            "reading": text(reading), "edge": text(edge), "seed": str(int(seed)),
            "droplet": quantity(si(droplet_height, "length", "droplet_height"), "m"), **_flowing(lubricant)})
        self._text = lines + scan_tables(scans)
        self._study = _tabor.parse_study(self._text, "study")
        self._file: pathlib.Path | None = None

    @classmethod
    def read(cls, file: Path) -> Study:
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

    def run(self, folder: Path, *, jobs: int = 0, retry: bool = False, executor: Executor | None = None,
            threads: int = 1, store: str = "shared", progress: Progress = None) -> Results:
        """Computes what the store in the folder does not hold yet. Ctrl-C keeps what is finished; the same
        call, or ``tabor sweep FOLDER/study.toml -o FOLDER``, continues.

        Parameters
        ----------
        jobs : cases at the same time [as many as there are threads and room for].
        retry : what failed or did not converge is computed again.
        executor : any executor of concurrent.futures, whose workers compute one scan under one pressure at a
            time: ProcessPoolExecutor (started by "spawn"), ``client.get_executor()`` of Dask, MPIPoolExecutor
            of mpi4py.
        threads : of each worker.
        store : "shared" where workers see the folder; "return" where they do not: scans go to them and
            results come back.

        Raises
        ------
        ValueError
            For scans that cannot be read.
        OSError
            Where the folder cannot be written.

        What a worker raises is raised when all others are done; their results are kept.
        """
        if jobs < 0 or threads < 0:
            raise ValueError(f"jobs, threads: got {jobs}, {threads}; expected zero or more")
        if store not in ("shared", "return"):
            raise ValueError(f"store: got {store!r}; expected 'shared' or 'return'")
        path = os.path.abspath(folder)
        os.makedirs(path, exist_ok=True)
        study = self._study if self._file else self._write(pathlib.Path(path, "study.toml"))
        n_contacts = 0
        warnings: list[str] = []
        with watching(progress) as told:
            if executor is not None:
                parts, warnings = _tabor.missing_parts(study, path, retry, told)
                n_contacts = run_parts(executor, parts, os.path.abspath(study.file), path, retry=retry,
                                       threads=threads, returns=store == "return", told=told)
                retry = False
            outcome = _tabor.run_study(study, path, jobs, retry, told)
        return Results(folder, outcome, n_contacts, tuple(warnings))


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

    def __init__(self, folder: Path, outcome: _tabor.Outcome | None = None, n_contacts: int = 0,
                 warnings: tuple[str, ...] = ()) -> None:
        self.folder = pathlib.Path(folder)
        if not (self.folder / "results.csv").is_file():
            raise ValueError(f"{self.folder}: no results.csv; expected a folder of Study.run or tabor sweep")
        self.warnings: tuple[str, ...] = warnings + (tuple(outcome.warnings) if outcome else ())
        self.failures: tuple[str, ...] = tuple(outcome.failures) if outcome else ()
        self.n_contacts = n_contacts + (outcome.n_contacts if outcome else 0)  #: that the run computed

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
    def density_curves(self) -> list[dict[str, float | bool | str]]:
        """Lubricated share and friction of each scan under each pressure over the density of the oil; empty
        where no oil runs downhill (docs/lubrication.md)."""
        return self._rows("density_curves.csv") if (self.folder / "density_curves.csv").is_file() else []

    @property
    def answers(self) -> tuple[str, ...]:
        """What the mean curves say, one sentence for each group and pressure."""
        return tuple(_tabor.result_texts(os.fspath(self.folder / "results.h5"), "answers"))

    def friction_table(self, *, group: str | None = None, density: Value | Sequence[Value] | None = None,
                       keep: Sequence[str] = ()) -> FrictionTable:
        """Friction for forming codes; see ``FrictionTable``."""
        return FrictionTable(self.folder, group=group, density=density, keep=keep)

    @property
    def table(self) -> Any:
        """The rows as a DataFrame; needs pandas."""
        return needs("pandas", "table").read_csv(self.folder / "results.csv")

    def __repr__(self) -> str:
        return f"Results in {self.folder}: {len(self.rows)} rows"
