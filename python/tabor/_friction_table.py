"""Friction of a study or a result for forming codes."""

from __future__ import annotations

import os
import pathlib
from collections.abc import Iterable, Sequence
from typing import Any, Literal, NamedTuple

from . import _tabor
from ._arguments import Count, Path, typed, whole
from ._cases import table_to_xarray
from ._errors import require_file
from ._guesses import Named
from ._values import Value, si_list


#: Programs that decks are written for.
ForProgram = Literal["abaqus", "lsdyna", "ansys", "openradioss", "csv"]


class FrictionEntry(NamedTuple):
    """One coefficient of friction: the mean over scans."""

    mean_pressure: float  #: [Pa]
    lubricant_density: float  #: [kg/m^2]; 0 is dry
    sliding_speed: float | None  #: [m/s]; None where friction does not depend on it
    friction: float
    standard_deviation: float  #: NaN for one scan
    n: int  #: scans


class FrictionTable(Named):
    """Coefficients of friction over pressure, density of the oil and sliding speed (docs/friction_tables.md).

    Parameters
    ----------
    results : folder of a study, or a file of ``tabor friction -o`` or ``save``.
    group : of scans; needed where there are several.
    density : densities [kg/m^2]; 0 is dry friction [those of the result].
    keep : codes of warnings whose numbers stay in.

    Raises
    ------
    ValueError
        For what is no such result, a group or a density that is not there, and where nothing remains.
    """

    @typed
    def __init__(self, results: Path, *, group: str | None = None,
                 density: Value | Iterable[Value] | None = None, keep: Sequence[str] = ()) -> None:
        densities = [] if density is None else si_list(density, "areal_density", "density")[0]
        require_file(results)
        self._results = os.fspath(results)
        self._choice = _tabor.FrictionTableChoice(group, densities, list(keep))
        rows, self.left_out = _tabor.friction_table(self._results, self._choice)
        self.entries: tuple[FrictionEntry, ...] = tuple(FrictionEntry(*row) for row in rows)

    @typed
    def deck(self, program: ForProgram, units: str, first_id: Count = 1) -> str:
        """The text of a deck for "abaqus", "lsdyna", "ansys", "openradioss" or "csv", with the numbers in the
        units that follow from a length, a time and a mass or a force: "mm,s,t"."""
        number = whole(first_id, "first_id", 1, 99_999_999)
        return _tabor.deck(self._results, self._choice, program, units, number)

    def _write(self, file: Path, program: ForProgram, units: str, first_id: Count = 1) -> None:
        _tabor.write_file(pathlib.Path(file), self.deck(program, units, first_id).encode())

    @typed
    def to_abaqus(self, file: Path, *, units: str) -> None:
        """Writes ``*FRICTION``."""
        self._write(file, "abaqus", units)

    @typed
    def to_lsdyna(self, file: Path, *, units: str, first_id: Count = 1) -> None:
        """Writes ``*DEFINE_TABLE`` and ``*DEFINE_CURVE``."""
        self._write(file, "lsdyna", units, first_id)

    @typed
    def to_ansys(self, file: Path, *, units: str, first_id: Count = 1) -> None:
        """Writes ``TB,FRIC``."""
        self._write(file, "ansys", units, first_id)

    @typed
    def to_openradioss(self, file: Path, *, units: str, first_id: Count = 1) -> None:
        """Writes /FRICTION."""
        self._write(file, "openradioss", units, first_id)

    @typed
    def to_csv(self, file: Path, *, units: str = "m,s,kg") -> None:
        """Writes a line per number."""
        self._write(file, "csv", units)

    def to_xarray(self) -> Any:
        """Friction, its standard deviation and the number of scans as a Dataset over pressure [Pa], density of the oil
        [kg/m^2] and, where friction depends on it, sliding speed [m/s], to be written as NetCDF; needs xarray."""
        found = table_to_xarray(self.entries)
        return found.assign_attrs(left_out=self.left_out) if self.left_out else found

    def __repr__(self) -> str:
        return f"FrictionTable of {self._results}: {len(self.entries)} numbers" + (
            f"; left out: {self.left_out}" if self.left_out else "")
