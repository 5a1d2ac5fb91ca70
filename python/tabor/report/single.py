"""A result file of one surface: `convert`, `combine`, `contact`, `lubricate` or `friction` with -o."""

import math
import tomllib
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from tabor.report import columns, density_curves, hdf, remarks, surface_numbers
from tabor.report.columns import Columns
from tabor.report.density_curves import Places
from tabor.report.errors import InputError, readable
from tabor.report.states import SingleState, count_visits
from tabor.report.table import Table


@dataclass
class Single:
    path: Path
    file: object
    facts: dict
    settings: dict
    surface: object
    states: list
    column: Columns  # what its numbers are called
    warnings: list = field(default_factory=list)
    density_curves: Table = field(default_factory=lambda: Table({}))  # empty where a file has none
    density_places: Places = field(default_factory=Places)
    _begun: Future = None  # of (amplitudes, distribution)

    kind = "single"

    @property
    def combination(self):
        """Numbers of `tabor combine`; {} in other files."""
        return hdf.attributes(self.file["combination"]) if "combination" in self.file else {}

    @property
    def is_difference(self):
        """Whether zero means that both scans agree: heights are shown as they are, not about their mean."""
        return bool(self.combination) and self.combination.get("mode") != "composite"

    @property
    def heading_of_heights(self):
        if not self.is_difference:
            return "Height about the mean"
        return "A \N{MINUS SIGN} B: above zero is worn" if self.combination.get("mode") == "wear" else "A \N{MINUS SIGN} B"

    @property
    def title(self):
        if self.combination:
            return _title_of_two(self.surface_facts.get("source", ""), self.combination.get("mode"))
        return readable(Path(self.surface_facts.get("source") or self.path.name).name)

    @property
    def answers(self):
        """(short, all): what friction against density says."""
        return density_curves.answers(self.facts, self.density_curves)

    @property
    def places(self):
        """The table of where densities lie on these curves; None in older files."""
        return density_curves.places_table(self.density_places, group_names=False)

    @property
    def surface_facts(self):
        return hdf.attributes(self.surface)

    @property
    def pixel(self):
        """(x, y) [m], from the axes of the map."""
        return tuple(_spacing(self.surface, name) for name in ("x", "y"))

    def height(self):
        return self.raw_height().astype(float, copy=False)

    def begin_numbers(self):
        """Amplitudes and distribution are computed by another thread until they are asked for."""
        beside = ThreadPoolExecutor(1)
        self._begun = beside.submit(self._numbers)
        beside.shutdown(wait=False)

    @cached_property
    def amplitudes(self):
        """Of the heights about their mean; {} of a difference."""
        return self._begun.result()[0] if self._begun else self._amplitudes(self.raw_height())

    @cached_property
    def distribution(self):
        """surface_numbers.Distribution of the heights, or None."""
        return self._begun.result()[1] if self._begun else self._distribution(self.raw_height())

    def _numbers(self):
        height = self.raw_height()
        return self._amplitudes(height), self._distribution(height)

    def _amplitudes(self, height):
        return {} if self.is_difference else surface_numbers.amplitudes(height)

    def _distribution(self, height):
        return surface_numbers.distribution(height, mean=not self.is_difference)

    def is_solved_on(self, state):
        """Whether a contact was solved on these heights, so that a section may show its gap."""
        return True

    def raw_height(self):
        """As stored [m], shape (ny, nx)."""
        return self.surface["height"][()]


def _title_of_two(source, mode):
    """'a.x3p − b.x3p' of 'folder/a.x3p - folder/b.x3p'."""
    sign, shown = ("+", "+") if mode == "composite" else ("-", "\N{MINUS SIGN}")
    return readable(f" {shown} ".join(Path(part).name for part in source.split(f" {sign} ")))


def load(path, file, kind=None, state_kind=SingleState):
    """kind: a Single, or a class of one; state_kind: that of its states."""
    if "states" in file and "surface" not in file:
        raise InputError(
            f"{path}: has numbers and no maps to draw; write it with fields=contact or fields=all"
        )
    if "surface" not in file or "height" not in file["surface"]:
        raise InputError(f"{path}: holds neither a study (/scans) nor a scan (/surface/height)")
    facts = hdf.attributes(file)
    nodes = [(key, file["states"][key]) for key in sorted(file["states"])] if "states" in file else []
    settings = _settings(file)
    states = [
        state_kind(key, node, _saturation_pressure(settings, hdf.attributes(node))) for key, node in nodes
    ]
    for state in states:
        _add_speed(state, settings)
    count_visits(states)
    single = (kind or Single)(path, file, facts, settings, file["surface"], states, columns.of_file(file))
    single.density_curves = density_curves.load(file, "density_curves", ("friction_lubricated",), single.warnings)
    single.density_places = density_curves.load_places(file, single.warnings)
    single.warnings.extend(dict.fromkeys(_warnings_about(single)))
    return single


def _add_speed(state, settings):
    """Oil that flows at one speed has it among the settings."""
    speed = settings.get("sliding_speed_m_per_s")
    if "fluid_load_share" in state.facts and isinstance(speed, float):
        state.facts.setdefault("sliding_speed_m_per_s", speed)


def _settings(file):
    """Settings in force, from config_toml; {} if it is no TOML or this Python cannot read it."""
    try:
        return tomllib.loads(hdf.text(file.attrs.get("config_toml", "")))
    except (AttributeError, tomllib.TOMLDecodeError):
        return {}


def _saturation_pressure(settings, facts):
    value = facts.get("saturation_pressure_Pa", settings.get("saturation_pressure_Pa"))
    return value if value and math.isfinite(value) else None


def _spacing(surface, name):
    axis = surface[name][:2]
    return float(axis[1] - axis[0]) if len(axis) > 1 else 1.0


def _warnings_about(single):
    lines = remarks.of_file(single.facts)
    for warning in hdf.text_list(single.surface_facts.get("doubts")):
        if not any(warning in line for line in lines):  # said there with its code
            yield warning
    for state in single.states:
        if not state.facts.get("converged", True):
            yield f"{state.name}: did not converge; do not use its numbers without a closer look."
        yield from hdf.text_list(state.facts.get("warnings"))
    yield from lines
