"""A result file of `tabor ehl`: one case with its histories and profiles, or the numbers of a sweep."""

import collections
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from tabor.report import columns, hdf, remarks
from tabor.report.columns import Columns
from tabor.report.errors import readable


_NO_COLUMNS = ("axes", "shape", "converged", "warnings", "warning_codes", "warning_marks")


@dataclass
class Ehl:
    path: Path
    file: object
    facts: dict
    column: Columns  # what its numbers are called
    warnings: list = field(default_factory=list)

    kind = "ehl"

    @property
    def title(self):
        return f"{self.facts['kind']}: {readable(self.path.stem)}"

    @property
    def program(self):
        return self.facts["kind"].split()[1]

    @property
    def is_sweep(self):
        return "sweep" in self.file

    @property
    def settings(self):
        try:
            return tomllib.loads(hdf.text(self.file.attrs.get("config_toml", "")))
        except tomllib.TOMLDecodeError:
            return {}

    @property
    def scalars(self):
        return hdf.attributes(self.file["result"]) if "result" in self.file else {}

    @property
    def parts(self):
        """{name: scalars} of the results within a result, as those of the dry contact."""
        node = self.file.get("result", {})
        return {name: hdf.attributes(node[name]) for name in node}

    @property
    def numbers(self):
        """{name: dataset} of what a sweep computed, one number per case."""
        node = self.file["sweep"]
        return {name: node[name] for name in node if name not in _NO_COLUMNS}

    @property
    def codes(self):
        """Of a sweep, the codes of the warnings of each case: 'coarse-grid short-inlet'; [] where none has any."""
        codes = codes_of(self.file["sweep"])
        return codes if any(codes) else []

    @property
    def axes(self):
        """{key: dataset} of what a sweep varies, the last one fastest."""
        if not self.is_sweep:
            return {}
        node = self.file["sweep"]
        return {hdf.text(key): node["axes"][hdf.text(key)] for key in np.atleast_1d(node.attrs["axes"])}

    def curves(self, group):
        """{name: values} of the one-dimensional datasets of a group, {} if it is absent."""
        node = self.file.get(group)
        return {name: node[name][()] for name in node if node[name].ndim == 1} if node else {}

    def table(self, group, names=None):
        """{name with its unit: values} of curves of a group [all], for CSV."""
        curves = self.curves(group)
        units = {name: columns.unit_of_curve(name, self.file[group][name]) for name in names or curves if name in curves}
        return {f"{name}_{unit}".removesuffix("_"): curves[name] for name, unit in units.items()}


def codes_of(sweep):
    """The codes of the warnings of each case of a group /sweep; marks in files of version 1 to 3, [] in older ones."""
    name = next((name for name in ("warning_codes", "warning_marks") if name in sweep), None)
    return [hdf.text(codes) for codes in sweep[name][()]] if name else []


def is_ehl(file):
    return hdf.text(file.attrs.get("kind", "")).startswith("ehl ")


def load(path, file):
    source = Ehl(path, file, hdf.attributes(file), columns.of_file(file))
    if source.is_sweep and "converged" in file["sweep"]:
        converged = file["sweep/converged"][()] > 0
        if not converged.all():
            source.warnings.append(f"{(~converged).sum()} of {converged.size} cases did not converge: red in the table.")
    if not source.scalars.get("converged", True):
        source.warnings.append("The computation did not converge; its numbers are those of where it ended.")
    source.warnings += remarks.of_file(source.facts)
    source.warnings += _warnings_of_cases(file)
    return source


def _warnings_of_cases(file):
    """Each warning once, with the number of its cases, where a sweep's file does not say so itself."""
    if "sweep" in file and codes_of(file["sweep"]):
        return []
    cases = [hdf.text(text).splitlines() for text in file["sweep/warnings"][()]] if "sweep/warnings" in file else []
    counts = collections.Counter(warning for texts in cases for warning in set(texts))
    return [f"{warning} ({count} of {len(cases)} cases)" for warning, count in sorted(counts.items())]
