"""A state as a command line, as Python and as a study file: each gives exactly its numbers."""

from __future__ import annotations

import json
import os
import shlex
from collections.abc import Iterable
from typing import NamedTuple

from .._settings import OF_SCANS
from .settings import PARTS, option_words, python_words, study_lines
from .state import PARAMETERS, State

IN_MEMORY = "surface.h5"  #: stands for a surface that is in no file


def _step_words(treatment: Iterable[str]) -> list[str]:
    """Steps as options: "level=plane" is --level plane."""
    words: list[str] = []
    for step in treatment:
        name, is_given, argument = step.partition("=")
        words += [f"--{name}", argument] if is_given else [f"--{name}"]
    return words


def _reading_words(state: State) -> list[str]:
    words: list[str] = []
    for name, value in state.reading:
        option = "--" + name.replace("_", "-")
        words += [option] if value == "True" else [option, value]
    return words


def _scan_words(state: State) -> list[str]:
    return [state.scan or IN_MEMORY, *_reading_words(state), *_step_words(state.treatment)]


def parameters_command(state: State) -> str:
    """The line of `tabor params` that gives the roughness parameters."""
    return shlex.join(["tabor", "params", *_scan_words(state)])


def friction_words(state: State) -> list[str]:
    """Words of `tabor friction` that give contact, oil and friction; of `tabor contact` where no shear strength is
    known."""
    words = ["tabor", "friction" if state.has_friction else "contact", *_scan_words(state)]
    words += ["--material", state.material] if state.material else []
    words += ["--pressure", state.pressure, *(["--tool", state.tool] if state.tool else [])]
    parts = PARTS if state.has_friction else ("solid", "contact")
    words += [word for part in parts for word in option_words(state.settings, part)]
    if not state.has_friction:
        return words
    words += ["--shear-strength", state.shear_strength] if state.shear_strength else []
    return [*words, "--density", state.density, *(["--trapped"] if state.trapped else [])]


def command_line(state: State) -> str:
    """Lines for a shell; a surface in memory is to be written first."""
    lines = [] if state.scan else [f"# first, in Python: surface.save({IN_MEMORY!r})"]
    return "\n".join([*lines, parameters_command(state), shlex.join(friction_words(state))])


def _arguments(*given: str) -> str:
    return ", ".join(one for one in given if one)


def _read_line(state: State) -> list[str]:
    if not state.scan:
        return ["# surface: the one that tb.view(surface) was called with"]
    reading = [f"{name}={value if value == 'True' else repr(value)}" for name, value in state.reading]
    return [f"surface = tb.read({_arguments(repr(state.scan), *reading)})"]


def python(state: State) -> str:
    """A program whose ``surface``, ``contact``, ``film`` and ``friction`` have the numbers."""
    lines = ["import tabor as tb", "", *_read_line(state)]
    if state.treatment:
        lines.append(f"surface = surface.treat({', '.join(map(repr, state.treatment))})")
    lines.append(f"print(surface.parameters({list(PARAMETERS)}))")
    solid = f"tb.Solid({_arguments(repr(state.material) if state.material else '', *python_words(state.settings, 'solid'))})"
    tool = f"tool={state.tool!r}" if state.tool else ""
    lines.append(f"contact = tb.contact({_arguments('surface', repr(state.pressure), solid, tool, *python_words(state.settings, 'contact'))})")
    if not state.has_friction:
        return "\n".join([*lines, "print(contact)"])
    shear = f"shear_strength={state.shear_strength!r}" if state.shear_strength else ""
    trapped = "trapped=True" if state.trapped else ""
    film = _arguments("surface", repr(state.density), *python_words(state.settings, "film"))
    friction = _arguments("contact", "film", shear, trapped, *python_words(state.settings, "friction"))
    return "\n".join([*lines, f"film = tb.rain({film})", f"friction = tb.friction({friction})", "print(friction)"])


class Combined(NamedTuple):
    """Two states and how their surfaces are put together; values are those of ``combine``."""

    first: State
    second: State
    mode: str
    match: str
    search: bool


def combined_command(asked: Combined) -> str:
    """The line of `tabor combine`, which treats both scans alike."""
    first, second = asked.first, asked.second
    if not (first.scan and second.scan):
        return "# 'tabor combine' reads files: write the scans first, or use the Python"
    if (first.reading, first.treatment) != (second.reading, second.treatment):
        return "# 'tabor combine' treats both scans alike: write the treated scans first, or use the Python"
    words = ["tabor", "combine", first.scan, second.scan, *_reading_words(first), *_step_words(first.treatment)]
    return shlex.join([*words, "--mode", asked.mode, "--match", asked.match, *([] if asked.search else ["--no-register"])])


def combined_python(asked: Combined) -> str:
    """A program whose ``found`` has the map and the numbers."""
    lines = ["import tabor as tb", ""]
    for name, state in (("first", asked.first), ("second", asked.second)):
        lines += [line.replace("surface", name, 1) for line in _read_line(state)]
        if state.treatment:
            lines.append(f"{name} = {name}.treat({', '.join(map(repr, state.treatment))})")
    search = "" if asked.search else "search=False"
    call = _arguments("first", "second", repr(asked.mode), f"match={asked.match!r}", search)
    return "\n".join([*lines, f"found = tb.combine({call})", "print(found)"])


def _line(key: str, value: str) -> str:
    return f"{key} = {json.dumps(value, ensure_ascii=False)}"  # a text of JSON is one of TOML


def _listed(key: str, values: Iterable[str]) -> str:
    return f"{key} = [{', '.join(json.dumps(value, ensure_ascii=False) for value in values)}]"


def _scan_lines(state: State) -> list[str]:
    known = {one.name: one.study_name for one in OF_SCANS}
    lines = ["", "[[scan]]", _line("file", os.path.abspath(state.scan or IN_MEMORY)), _line("group", "scan")]
    for name, value in state.reading:
        if name in known:
            lines.append(_line(known[name], value))
        else:
            lines.append(f"# a study has no key for {name}: write the scan with 'tabor convert' first")
    return lines


def study(state: State) -> str:
    """A study file of `tabor sweep` with one scan, pressure and density; "" where no shear strength is known, which a
    study needs."""
    if not state.has_friction:
        return "# A study needs a shear strength; the library has none of this material: give one."
    lines = [_line("title", os.path.basename(state.scan) or "surface")]
    tables = {"": [_line("shear_strength", state.shear_strength)] if state.shear_strength else [],
              "material": [_line("name", state.material)] if state.material else [],
              "treatment": [_listed("steps", state.treatment)] if state.treatment else [],
              "contact": [_line("tool", _absolute(state.tool))] if state.tool else [],
              "sweep": [_listed("mean_pressure", [state.pressure]), _listed("lubricant_density", [state.density])],
              "lubricant": ["trapped = true"] if state.trapped else []}
    for table, own in tables.items():
        own += study_lines(state.settings, table)
        lines += [*(["", f"[{table}]"] if table and own else []), *own]
    return "\n".join(lines + _scan_lines(state)) + "\n"


def _absolute(tool: str) -> str:
    """A tool that is a file by its whole name: a study takes names from its own folder."""
    return os.path.abspath(tool) if os.path.exists(tool) else tool
