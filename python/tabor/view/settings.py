"""Settings beyond those that the page has controls for, written as options, as arguments and as lines of a study."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from .._scans import line
from .._settings import CONTACT, DRY_BELOW, RAIN, SHEAR, SOLID, TRAPPED, Setting

Given = tuple[tuple[str, str], ...]  #: names of settings with their values as texts: (("seed", "7"), ("tool_repeats", "True"))

#: Settings that contact, rain and friction take, by the function that takes them.
PARTS: Mapping[str, tuple[Setting, ...]] = {
    "solid": SOLID, "contact": CONTACT, "film": RAIN,
    "friction": tuple(one for one in (*SHEAR, *DRY_BELOW, *TRAPPED) if one.name not in {other.name for other in SOLID})}
_KNOWN = {one.name: one for part in PARTS.values() for one in part}


def text_of(setting: Setting, value: Any) -> str:
    """A plain value as a text that all three languages take, with all its digits."""
    if isinstance(value, float):
        return f"{value!r} {setting.unit}".strip()
    return str(value)


def different(values: Mapping[str, Any], part: str, usual: Mapping[str, Any] | None = None) -> Given:
    """Those of the plain values of one part that are not the usual ones: unless given, the defaults."""
    found: list[tuple[str, str]] = []
    for one in PARTS[part]:
        value, expected = values.get(one.name), one.default if usual is None else usual.get(one.name)
        if value == expected or expected is None and value == one.absent:
            continue
        if value is not None or one.none:
            found.append((one.name, one.none if value is None else text_of(one, value)))
    return tuple(found)


def arguments(given: Given, part: str) -> dict[str, Any]:
    """Arguments of the function of one part."""
    return {one.argument: _argument(one, text) for one, text in _of(given, PARTS[part])}


def _of(given: Given, table: Iterable[Setting]) -> list[tuple[Setting, str]]:
    names = {one.name for one in table}
    return [(_KNOWN[name], text) for name, text in given if name in names]


def _argument(setting: Setting, text: str) -> Any:
    if setting.kind == "flag":
        return text == "True"
    return int(text) if setting.kind == "count" else text


def option_words(given: Given, part: str) -> list[str]:
    """Options of ``tabor contact`` and ``tabor friction`` for the function of one part."""
    words: list[str] = []
    for one, text in _of(given, PARTS[part]):
        words += [one.option] if one.kind == "flag" else [one.option, text]
    return words


def python_words(given: Given, part: str) -> list[str]:
    """Arguments of the function of one part, as a program writes them."""
    return [f"{name}={value!r}" for name, value in arguments(given, part).items()]


def study_lines(given: Given, table: str) -> list[str]:
    """Lines of one table of a study file."""
    found = [(_KNOWN[name], text) for name, text in given]
    return [f"{one.study_name} = {line(one, one.taken(_argument(one, text)))}" for one, text in found if one.study_key and one.study_table == table]
