"""A table of `tabor params`: roughness parameters of one or several scans, as --csv prints and -o writes them."""

import contextlib
import csv
import math
import re
from dataclasses import dataclass, field
from pathlib import Path

from tabor.report import names
from tabor.report.errors import InputError, readable

LARGEST = 16_000_000  # bytes of a table that is read
_HEAD = ("scan", "treatment", "failure")
_GROUP_HEAD = ("group", "parameter", "unit", "n", "mean", "std", "sem")


@dataclass
class Mean:
    """Of one parameter over the scans that have a number; the deviation is NaN for fewer than two."""

    n: int
    mean: float
    deviation: float


@dataclass
class Group:
    name: str  # "" for all scans of a table without groups
    places: list  # of its scans
    means: dict = field(default_factory=dict)  # {parameter: Mean}


@dataclass
class Parameters:
    path: Path
    scans: list  # names, as many as columns of `values`
    files: list  # of the scans, as the table has them
    treatment: str
    units: dict  # {parameter: unit}, in the order of the file
    values: dict  # {parameter: [number or NaN of each scan]}
    groups: list  # of Group
    warnings: list = field(default_factory=list)

    kind = "params"
    file = contextlib.nullcontext()
    facts = {"methods": ["iso25178"]}

    @property
    def title(self):
        return f"Roughness parameters: {readable(self.path.stem)}"

    @property
    def is_grouped(self):
        return any(group.name for group in self.groups)

    @property
    def has_change(self):
        """Whether a column compares the second scan with the first, as `tabor params` does of two."""
        return len(self.scans) == 2 and not self.is_grouped

    @property
    def has_means(self):
        return len(self.scans) > 1 or self.is_grouped


def load(path):
    """Raises InputError in one line if it is no such table."""
    rows = _rows(path)
    if rows and all(len(row) == len(rows[0]) for row in rows):
        if tuple(rows[0][:3]) == _HEAD:
            return _of_scans(path, rows)
        if tuple(rows[0][: len(_GROUP_HEAD)]) == _GROUP_HEAD:
            return _of_groups(path, rows)
    raise InputError(f"{path}: got a table that begins otherwise; expected one of 'tabor params --csv'")


def _of_scans(path, rows):
    measured = [row for row in rows[1:] if not row[2]]
    units = dict(map(_name_and_unit, rows[0][3:]))
    values = {name: [_number(path, row[place]) for row in measured] for place, name in enumerate(units, 3)}
    everything = Group("", list(range(len(measured))), {name: _mean(numbers) for name, numbers in values.items()})
    files = [readable(_without_apostrophe(row[0])) for row in measured]
    return Parameters(
        path,
        _short(files),
        files,
        _common([row[1] for row in measured]),
        units,
        values,
        [everything],
        [f"Not measured: {readable(row[2])}" for row in rows[1:] if row[2]],
    )


def _of_groups(path, rows):
    """A row per group and parameter: the mean, then a column per scan, empty for one of another group."""
    first = len(_GROUP_HEAD)
    files = [readable(_without_apostrophe(name)) for name in rows[0][first:]]
    units = {row[1]: row[2] for row in rows[1:]}
    values = {name: [math.nan] * len(files) for name in units}
    groups = {}
    for row in rows[1:]:
        group = groups.setdefault(row[0], Group(readable(_without_apostrophe(row[0])), []))
        group.means[row[1]] = Mean(_count(path, row[3]), _number(path, row[4]), _number(path, row[5]))
        for place, cell in enumerate(row[first:]):
            if cell:
                values[row[1]][place] = _number(path, cell)
                group.places = sorted({*group.places, place})
    return Parameters(path, _short(files), files, "", units, values, list(groups.values()))


def _short(files):
    """Scans are called as on the page of a study."""
    short = names.short(files)
    return [short[file] for file in files]


def _mean(numbers):
    known = [value for value in numbers if math.isfinite(value)]
    if not known:
        return Mean(0, math.nan, math.nan)
    mean = math.fsum(known) / len(known)
    squares = math.fsum((value - mean) ** 2 for value in known)
    return Mean(len(known), mean, math.sqrt(squares / (len(known) - 1)) if len(known) > 1 else math.nan)


def _rows(path):
    try:
        if path.exists() and not path.is_file():
            raise InputError(f"{path}: got a folder, device or pipe; give the file that 'tabor params -o' wrote")
        if path.stat().st_size > LARGEST:
            raise InputError(f"{path}: got more than {LARGEST // 1_000_000} MB; expected a table of 'tabor params'")
        with open(path, encoding="utf-8", errors="surrogateescape", newline="") as file:
            return [row for row in csv.reader(file, strict=True) if row]
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise InputError(f"{path}: {reason}; give the file that 'tabor params -o' wrote") from None
    except csv.Error as error:
        raise InputError(f"{path}: got no table ({error}); expected one of 'tabor params --csv'") from None


def _name_and_unit(title):
    match = re.fullmatch(r"(.*) \[(.*)\]", title)
    return (match.group(1), match.group(2)) if match else (title, "")


def _number(path, text):
    try:
        return float(text) if text else math.nan
    except ValueError:
        shown = readable(text)[:40]
        raise InputError(f"{path}: got '{shown}' for a number; expected a table of 'tabor params --csv'") from None


def _count(path, text):
    if text.isascii() and text.isdigit():
        return int(text)
    raise InputError(f"{path}: got '{readable(text)[:40]}' for a number of scans; expected a table of 'tabor params --csv'")


def _common(texts):
    return texts[0] if len(set(texts)) == 1 else "; ".join(dict.fromkeys(texts))


def _without_apostrophe(text):
    return text[1:] if text.startswith("'") else text
