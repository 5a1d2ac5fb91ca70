"""A state as a command line, as Python and as a study file: each gives exactly its numbers."""

from __future__ import annotations

import json
import os
import shlex
from collections.abc import Iterable

from .._settings import OF_SCANS
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
    words = ["tabor", "friction" if state.has_friction else "contact", *_scan_words(state), "--material", state.material,
             "--pressure", state.pressure]
    if state.tool:
        words += ["--tool", state.tool]
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
    tool = f"tool={state.tool!r}" if state.tool else ""
    lines.append(f"contact = tb.contact({_arguments('surface', repr(state.pressure), f'tb.Solid({state.material!r})', tool)})")
    if not state.has_friction:
        return "\n".join([*lines, "print(contact)"])
    shear = f"shear_strength={state.shear_strength!r}" if state.shear_strength else ""
    trapped = "trapped=True" if state.trapped else ""
    return "\n".join([*lines, f"film = tb.rain(surface, {state.density!r})",
                      f"friction = tb.friction({_arguments('contact', 'film', shear, trapped)})", "print(friction)"])


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
    lines += [_line("shear_strength", state.shear_strength)] if state.shear_strength else []
    lines += ["", "[material]", _line("name", state.material)]
    if state.treatment:
        lines += ["", "[treatment]", _listed("steps", state.treatment)]
    if state.tool:
        lines += ["", "[contact]", _line("tool", state.tool)]
    lines += ["", "[sweep]", _listed("mean_pressure", [state.pressure]), _listed("lubricant_density", [state.density])]
    lines += ["", "[lubricant]", "trapped = true"] if state.trapped else []
    return "\n".join(lines + _scan_lines(state)) + "\n"
