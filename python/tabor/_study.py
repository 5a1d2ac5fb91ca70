"""Studies: scans x pressures x densities into a store that can be resumed."""

from __future__ import annotations

import csv
import os
import pathlib
from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import Executor
from typing import Any, Literal, Unpack

from . import _tabor
from ._arguments import Count, Path, typed, wrong
from ._cases import study_to_xarray
from ._contact import Edges, Solid, solid_of
from ._doubts import tell
from ._errors import InputFileNotFound, require_file
from ._friction import Lubricant
from ._friction_table import FrictionTable
from ._guesses import Named
from ._optional import needs
from ._parts import run as run_parts
from ._progress import Progress, watching
from ._records import warnings_of
from ._scans import Scans, SurfaceFiles, densities, line, pressures, scan_tables, speeds, table, text, texts
from ._setting_types import StudySettings
from ._settings import OF_STUDIES, OF_STUDY_SLIDES, OIL, SOLID, STUDY, complete, documented, takes
from ._surface import Surface
from ._values import Value


def _tables(values: Mapping[str, Any]) -> dict[str, dict[str, str | None]]:
    """Tables of a study file with the settings that have a value, each at the key that it has there."""
    tables: dict[str, dict[str, str | None]] = {"": {}, "material": {}, "treatment": {}, "contact": {}, "sweep": {}, "lubricant": {}}
    for one in OF_STUDIES:
        if values.get(one.name) is not None:
            tables.setdefault(one.study_table, {})[one.study_name] = line(one, values[one.name])
    return tables


def _slide_lines(slide: Mapping[str, Any]) -> dict[str, str | None]:
    """The table [slide] of a study file."""
    if not isinstance(slide, Mapping):
        raise wrong("slide", slide, 'settings by their names, such as {"distance": "20 um"}')
    known = {one.argument: one for one in OF_STUDY_SLIDES}
    for name in slide:
        if name not in known:
            raise ValueError(f"slide: got {name!r}; expected settings of sliding: {', '.join(known)}")
    return {known[name].study_name: line(known[name], known[name].taken(value)) for name, value in slide.items() if value is not None}


@documented(STUDY)
class Study(Named):
    """Friction of many scans under many pressures with many densities of oil; the same as a study file
    of ``tabor sweep``.

    Parameters
    ----------
    scans : mapping
        Groups with a file, a pattern, a Surface, ``Scans`` with settings of their own, or a list of them each;
        averages are taken over a group. Surfaces are written into the folder of the results, as scan files.
    solid : Solid
        That the surfaces are of, or the name of a material.
    pressure : mean pressures [Pa]; needed unless all scans have their own.
    density : areal densities of the oil [kg/m^2]; without any, dry friction alone.
    treatment : steps that each scan goes through, "level=plane".
    **settings
    lubricant, speed : oil that flows while the flat slides at each of these speeds [m/s]; see ``fluid_film``.
    slide : settings of sliding by their names, {"distance": "20 um", "step": "1 um"}: a rough tool slides over every
        sheet under each pressure and density; see ``slide`` and ``Results.slides``.
    edges : see ``contact``.
    title : of the study.

    Raises
    ------
    ValueError
        For scans that are not there, and as the functions named do.
    """

    _study: _tabor.Study

    @takes(STUDY)
    def __init__(self, scans: Mapping[str, Path | Surface | Scans | Sequence[Path | Surface | Scans]], solid: Solid | str, *,
                 pressure: Value | Iterable[Value] | None = None, density: Value | Iterable[Value] = 0.0,
                 treatment: Sequence[str] = (), lubricant: Lubricant | None = None,
                 speed: Value | Iterable[Value] | None = None,
                 slide: Mapping[str, Any] | None = None, edges: Edges | None = None, title: str = "study",
                 **settings: Unpack[StudySettings]) -> None:
        if (lubricant is None) != (speed is None):
            raise ValueError("Study: oil that flows needs both a lubricant and a speed")
        self._surfaces = SurfaceFiles()
        tables = scan_tables(scans, self._surfaces, needs_pressure=pressure is None)
        solid = solid_of(solid)
        values = complete(STUDY, settings)
        for one in SOLID:
            if values.get(one.name) is None:
                values[one.name] = getattr(solid, one.name)
        if lubricant is not None:
            values.update({"fluid": "reynolds"}, **{one.name: getattr(lubricant, one.name) for one in OIL})
        found = _tables(values)
        found[""]["title"] = text(title)
        found["treatment"]["steps"] = texts(treatment) if treatment else None
        found["contact"]["edges"] = None if edges is None else text(edges)
        found["sweep"].update(mean_pressure=pressures(pressure), lubricant_density=densities(density), sliding_speed=speeds(speed))
        if slide is not None:
            found["slide"] = _slide_lines(slide)
        lines = "".join(table(f"[{name}]" if name else "", keys) for name, keys in found.items())
        self._text = lines + tables
        self._study = _tabor.parse_study(self._text, "study")
        self._file: pathlib.Path | None = None

    @classmethod
    @typed
    def read(cls, file: Path) -> Study:
        """A study file of ``tabor sweep``. Raises ValueError with file, line and key."""
        require_file(file)
        study = cls.__new__(cls)
        study._study = _tabor.read_study(os.fspath(file))
        study._file = pathlib.Path(file)
        return study

    def _write(self, file: pathlib.Path) -> _tabor.Study:
        file.write_text(self._surfaces.move(self._text, file.parent), "utf-8")
        return _tabor.read_study(os.fspath(file))

    @property
    def n_cases(self) -> int:
        """Scans times pressures times densities."""
        return self._study.n_cases

    def __repr__(self) -> str:
        return f"Study {self._study.title}: {self._study.n_scans} scans, {self.n_cases} cases"

    @typed
    def run(self, folder: Path, *, jobs: Count = 0, retry: bool = False, executor: Executor | None = None,
            threads: Count = 1, store: Literal["shared", "return"] = "shared", progress: Progress = None) -> Results:
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
        tell(warnings_of(outcome.findings))
        return Results(folder, outcome, n_contacts, tuple(warnings))


#: Columns that stay texts, even where one is empty or looks like a number.
_TEXTS = ("case_id", "scan", "group", "left_out")


def _value(key: str, cell: str) -> float | bool | str:
    """A cell as Python's own: texts, switches, whole numbers of counts, numbers; NaN where a number is missing."""
    if key in _TEXTS:
        return cell
    if cell in ("true", "false"):
        return cell == "true"
    is_count = key == "n" or key.startswith("n_") or key == "tool_places"
    try:
        return int(cell) if is_count and cell else float(cell or "nan")
    except ValueError:
        return cell


class Results(Named):
    """The tables in a folder of ``Study.run`` or ``tabor sweep``. ``warnings`` are reasons to doubt their numbers,
    ``failures`` the cases without; where ``run`` made it, what it met on the way is among them."""

    @typed
    def __init__(self, folder: Path, outcome: _tabor.Outcome | None = None, n_contacts: int = 0,
                 warnings: tuple[str, ...] = ()) -> None:
        self.folder = pathlib.Path(folder)
        if not (self.folder / "results.csv").is_file():
            raise InputFileNotFound(f"{self.folder}: no results.csv; expected a folder of Study.run or tabor sweep", str(self.folder))
        told, failures = (outcome.warnings, outcome.failures) if outcome else self._remarks()
        self.warnings: tuple[str, ...] = (*warnings, *told)
        self.failures: tuple[str, ...] = tuple(failures)
        self.n_contacts = n_contacts + (outcome.n_contacts if outcome else 0)  #: that the run computed

    def _remarks(self) -> tuple[list[str], list[str]]:
        """Warnings and failures that the folder keeps."""
        file = self.folder / "results.h5"
        return _tabor.result_remarks(file) if file.is_file() else ([], [])

    def _rows(self, name: str) -> list[dict[str, float | bool | str]]:
        with open(self.folder / name, newline="", encoding="utf-8") as file:
            return [{key: _value(key, cell) for key, cell in row.items()} for row in csv.DictReader(file)]

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
    def slides(self) -> list[dict[str, float | bool | str]]:
        """One for each state of each slide (docs/sliding.md); empty where nothing slid."""
        return self._rows("slides.csv") if (self.folder / "slides.csv").is_file() else []

    @property
    def answers(self) -> tuple[str, ...]:
        """What the mean curves say, one sentence for each group and pressure."""
        return tuple(_tabor.result_texts(os.fspath(self.folder / "results.h5"), "answers"))

    @typed
    def friction_table(self, *, group: str | None = None, density: Value | Iterable[Value] | None = None,
                       keep: Sequence[str] = ()) -> FrictionTable:
        """Friction for forming codes; see ``FrictionTable``."""
        return FrictionTable(self.folder, group=group, density=density, keep=keep)

    @property
    def table(self) -> Any:
        """The rows as a DataFrame; needs pandas."""
        read = needs("pandas", "table").read_csv
        return read(self.folder / "results.csv", dtype={key: str for key in _TEXTS}, keep_default_na=False, na_values=[""])

    def to_xarray(self) -> Any:
        """The rows as a Dataset over ``scan``, pressure, density and, where oil flows, speed, by the names of the columns
        and with their units; ``group`` stands along the scans, what was not computed is NaN. Warnings and failures are
        attributes, so that it can be written as NetCDF; needs xarray.

        Raises
        ------
        ValueError
            Where there is no row.
        """
        rows = self.rows
        if not rows:
            raise ValueError(f"{self.folder}: no row to make an array of")
        found = study_to_xarray(rows, _tabor.column_units())
        lines = {"warnings": "\n".join(self.warnings), "failures": "\n".join(self.failures)}
        return found.assign_attrs({key: text for key, text in lines.items() if text})

    def __repr__(self) -> str:
        counts = ((len(self.rows), "row"), (len(self.failures), "failure"), (len(self.warnings), "warning"))
        said = (f"{n} {word}{'' if n == 1 else 's'}" for n, word in counts if n or word == "row")
        return f"Results in {self.folder}: {', '.join(said)}"
