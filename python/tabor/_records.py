"""What all results have in common: numbers by name, warnings, and what to cite."""

from __future__ import annotations

import html
from collections.abc import Callable, Iterable, Mapping
from typing import Any, Literal, NamedTuple

from . import _tabor
from ._arguments import Path, typed
from ._guesses import Named, Values


#: Maps that a file holds: all, heights with pressure and film alone, or none.
Fields = Literal["all", "contact", "none"]


class Warning(NamedTuple):
    """One reason to doubt a number, or information about what was done; docs/warnings.md says more."""

    code: str
    text: str
    kind: str = "doubt"  #: or "information"

    def __str__(self) -> str:
        return self.text


def warnings_of(texts: Iterable[tuple[str, str, str]]) -> tuple[Warning, ...]:
    """Warnings as a result shows them: doubts before information."""
    return tuple(Warning(*one) for one in texts)


def plain_attributes(values: Mapping[str, Any], before: str = "") -> dict[str, Any]:
    """Numbers as attributes that every file of NetCDF takes: switches as 0 and 1, large whole numbers as floats, tables
    inside by names with a dot; lists are left out."""
    found: dict[str, Any] = {}
    for key, value in values.items():
        if isinstance(value, bool):
            found[before + key] = int(value)
        elif isinstance(value, int):
            found[before + key] = value if abs(value) < 2**31 else float(value)
        elif isinstance(value, (float, str)):
            found[before + key] = value
        elif isinstance(value, Mapping):
            found.update(plain_attributes(value, f"{before}{key}."))
    return found


def attributes(record: Any) -> dict[str, Any]:
    """Numbers, warnings and references of a record as attributes."""
    return {**plain_attributes(record.values), **said(record.warnings, record.references)}


def said(warnings: Iterable[Any], references: Iterable[str]) -> dict[str, str]:
    """Warnings and references alone; what is empty is left out."""
    lines = {"warnings": "\n".join(map(_with_code, warnings)), "references": "\n".join(references)}
    return {key: text for key, text in lines.items() if text}


def _with_code(warning: Any) -> str:
    return f"{warning.text} [{warning.code}]" if isinstance(warning, Warning) else str(warning)


def with_unit(value: float, unit: str) -> str:
    """A switch as yes or no, a number as text: densities of oil in g/m² and masses in kg as they are, others in the multiple that suits them."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if not unit:
        return f"{value:.4g}"
    return f"{value:.4g} {unit}" if unit in ("g/m²", "kg") else _tabor.format_si(value, unit)


class Shown(Named):
    """Shows itself as headings and texts."""

    def _lines(self) -> list[tuple[str, str]]:
        raise NotImplementedError

    def _title(self) -> str:
        return type(self).__name__

    def __repr__(self) -> str:
        lines = self._lines()
        width = max((len(heading) for heading, _ in lines), default=0)
        return "\n".join([self._title()] + [f"  {heading:<{width}}  {text}" for heading, text in lines])

    def _repr_html_(self) -> str:
        return table_html(self._title(), self._lines())


class Record(Shown):
    """A result that does not change. ``values`` has its numbers by the names that ``--json`` and
    result files give them, whose endings are the units.

    Numbers, warnings and references stay in the record of the extension module until they are asked for: converting
    them all takes longer than the rest of a call from Python.
    """

    _facts: tuple[tuple[str, str, str], ...] = ()  #: heading, key, unit of what repr shows
    _record: Any
    _write: Callable[..., None]  #: ``tabor.save``, which knows all kinds of records and puts itself here

    @property
    def values(self) -> Mapping[str, Any]:
        """All numbers by name."""
        found: Values | None = self.__dict__.get("_values")
        if found is None:
            found = self.__dict__["_values"] = Values(self._record.values, type(self).__name__)
        return found

    @property
    def warnings(self) -> tuple[Warning, ...]:
        """Reasons to doubt its numbers."""
        return warnings_of(self._record.warnings)

    @property
    def references(self) -> tuple[str, ...]:
        """What to cite: keys of the bibliography of ``tabor cite``."""
        return tuple(self._record.references)

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError(f"a {type(self).__name__} does not change")

    def __getstate__(self) -> dict[str, Any]:
        return {key: dict(one) if isinstance(one, Values) else one for key, one in self.__dict__.items()}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        if "_values" in state:
            self.__dict__["_values"] = Values(state["_values"], type(self).__name__)

    @typed
    def save(self, file: Path, *, fields: Fields = "all", double: bool = False) -> None:
        """Writes it as ``tabor.save`` does."""
        self._write(file, self, fields=fields, double=double)

    def _lines(self) -> list[tuple[str, str]]:
        known = [one for one in self._facts if one[1] in self.values]  # a file may not hold all
        lines = [(heading, with_unit(self.values[key], unit)) for heading, key, unit in known]
        return lines + [("warning", warning.text) for warning in self.warnings]


def table_html(title: str, lines: list[tuple[str, str]], picture: str = "") -> str:
    """Headings and texts as a table for notebooks; ``picture`` is a base64 PNG."""
    rows = "".join(f"<tr><th style='text-align:left'>{html.escape(heading)}</th>"
                   f"<td style='text-align:left'>{html.escape(text)}</td></tr>" for heading, text in lines)
    image = f"<img src='data:image/png;base64,{picture}' alt='heights'>" if picture else ""
    return f"<div><b>{html.escape(title)}</b>{image}<table>{rows}</table></div>"
