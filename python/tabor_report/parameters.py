"""A table of `tabor params`: roughness parameters of one or several scans, as --csv prints and -o writes them."""

import contextlib
import csv
import math
import re
from dataclasses import dataclass, field
from pathlib import Path

from tabor_report.errors import InputError, readable

LARGEST = 16_000_000  # bytes of a table that is read
_HEAD = ("scan", "treatment", "failure")


@dataclass
class Parameters:
    path: Path
    scans: list  # names, as many as columns of `values`
    treatment: str
    units: dict  # {parameter: unit}, in the order of the file
    values: dict  # {parameter: [number or NaN of each scan]}
    warnings: list = field(default_factory=list)

    kind = "params"
    file = contextlib.nullcontext()
    facts = {"methods": ["iso25178"]}

    @property
    def title(self):
        return f"Roughness parameters: {readable(self.path.stem)}"

    def mean_and_deviation(self, name):
        """Over the scans that have a number; the deviation is NaN for fewer than two."""
        known = [value for value in self.values[name] if math.isfinite(value)]
        if not known:
            return math.nan, math.nan
        mean = math.fsum(known) / len(known)
        squares = math.fsum((value - mean) ** 2 for value in known)
        return mean, math.sqrt(squares / (len(known) - 1)) if len(known) > 1 else math.nan


def load(path):
    """Raises InputError in one line if it is no such table."""
    rows = _rows(path)
    if not rows or tuple(rows[0][:3]) != _HEAD or any(len(row) != len(rows[0]) for row in rows):
        raise InputError(f"{path}: got a table that begins otherwise; expected one of 'tabor params --csv'")
    measured = [row for row in rows[1:] if not row[2]]
    units = dict(map(_name_and_unit, rows[0][3:]))
    return Parameters(
        path,
        [readable(Path(_without_apostrophe(row[0])).name) for row in measured],
        _common([row[1] for row in measured]),
        units,
        {name: [_number(path, row[place]) for row in measured] for place, name in enumerate(units, 3)},
        [f"Not measured: {readable(row[2])}" for row in rows[1:] if row[2]],
    )


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


def _common(texts):
    return texts[0] if len(set(texts)) == 1 else "; ".join(dict.fromkeys(texts))


def _without_apostrophe(text):
    return text[1:] if text.startswith("'") else text
