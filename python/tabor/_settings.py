"""Settings as the library's tables of parameters say them: arguments of functions with their types, units, defaults and
documentation. A setting that is added to a table becomes an argument of each function that takes the settings of that
table; ``_setting_types``, which type checkers read, is made of the lists below when the extension module is built."""

from __future__ import annotations

import inspect
import math
import textwrap
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, NamedTuple, TypeVar, cast

from . import _tabor
from ._arguments import flag, plain_text, typed, whole
from ._values import si, si_list

_Function = TypeVar("_Function", bound=Callable[..., Any])
_Settings = TypeVar("_Settings")


def is_surface(value: Any) -> bool:
    """True for a Surface, which this module knows nothing of."""
    return hasattr(value, "_topography")


class Setting(NamedTuple):
    """One line of a table."""

    table: str  #: "contact", "film", "trapped", "fluid", "friction", "read", "pixels" or "recipe"
    name: str  #: of the property of the settings of the extension module
    argument: str  #: of functions
    other: str  #: as the command line spells it, where that differs: "poisson_ratio"
    option: str  #: of the command line: "--seed"
    kind: str  #: "number", "numbers", "count", "flag", "word" or "text"
    dimension: str
    unit: str
    words: list[str]
    help: str
    example: str
    absent: str  #: what holds where it has no default and is not given
    none: str  #: the word that takes away the value of a material, or a bound: "inf"
    study_key: str
    is_of_material: bool
    default: Any

    @property
    def study_table(self) -> str:
        """Of a study file; "" is its head."""
        return self.study_key.rpartition(".")[0]

    @property
    def study_name(self) -> str:
        """Its key in that table."""
        return self.study_key.rpartition(".")[2]

    @property
    def shown_default(self) -> Any:
        """The default as a signature shows it."""
        if isinstance(self.default, list) and len(self.default) == 1:
            only = self.default[0]
            return only if self.unit else int(only)
        return self.default

    def taken(self, value: Any) -> Any:
        """The plain value of what is given: SI numbers, texts, switches. Raises TypeError and ValueError that name the
        argument."""
        if value is None and self.default is None:
            return None
        if self.kind == "number":
            if self.none and self.default is not None and isinstance(value, str) and value == self.none:
                return math.inf
            return si(value, self.dimension, self.argument)
        if self.kind == "numbers":
            return si_list(value, self.dimension, self.argument)[0]
        if self.kind == "count":
            return whole(value, self.argument, 0, 2**64 - 1)
        if self.takes_surface and is_surface(value):
            return value
        return flag(value, self.argument) if self.kind == "flag" else plain_text(value, self.argument)

    @property
    def takes_surface(self) -> bool:
        """True where a Surface may stand in place of the name of a scan file."""
        return self.name == "tool"

    @property
    def hint(self) -> str:
        """Its type, as it stands in a signature."""
        value = f'Annotated[Value, "{self.unit}"]' if self.unit else "Value"
        hint = {"number": value, "numbers": f"{value} | Sequence[{value}]", "count": "int", "flag": "bool",
                "word": f"Literal[{', '.join(map(repr, self.words))}]", "text": "str"}[self.kind]
        hint += " | Surface" if self.takes_surface else ""
        return hint if self.default is not None else f"{hint} | None"

    @property
    def documentation(self) -> str:
        """What it is, in which unit, and what holds unless it is given."""
        text = self.help + (f" [{self.unit}]" if self.unit else "")
        if self.words:
            text += ": " + ", ".join(f'"{word}"' for word in self.words)
        is_plain = self.kind in ("number", "numbers", "count") and not self.unit
        example = self.example if is_plain else f'"{self.example}"'
        holds = "that of the material" if self.is_of_material else self.absent
        if self.kind == "flag":
            holds = str(self.default)
        elif self.default is not None:
            holds = example
        elif self.example and not self.words:
            text += f", such as {example}"
        return f"{text}; unless given: {holds}." if holds else f"{text}."


_ALL = tuple(Setting(**row) for row in _tabor.settings())


def _of(*tables: str, without: Iterable[str] = ()) -> tuple[Setting, ...]:
    """Those of some tables that are no lists."""
    return tuple(one for one in _ALL if one.table in tables and one.kind != "numbers" and one.name not in without)


def _is_of_solid(one: Setting) -> bool:
    return one.is_of_material or one.study_key.startswith("material.")


SOLID = tuple(sorted(filter(_is_of_solid, _of("contact", "friction")), key=lambda one: not one.is_of_material))
CONTACT = tuple(one for one in _of("contact", without=("tool_places",)) if not _is_of_solid(one))
RAIN = _of("film")
TRAPPED = _of("trapped")
SHEAR = _of("friction", without=("dry_below",))
DRY_BELOW = tuple(one for one in _of("friction") if one.name == "dry_below")  # of oil that stays where it was laid
CURVE = SHEAR + tuple(one for one in RAIN if one.name not in ("model", "droplet_height", "seed"))  # of vanishing droplets
OIL = _of("fluid", without=("fluid", "sliding_speed"))  # a lubricant flows; a speed is what happens to it
OF_STUDY_SLIDES = tuple(one for one in _ALL if one.table == "slide" and one.study_key)
OWN_OF_SLIDE = _of("slide", without=("distance",))
SLIDE = tuple(one for one in CONTACT if one.name != "load_path") + OWN_OF_SLIDE + RAIN + TRAPPED + SHEAR + DRY_BELOW  # of sliding
PLACES = tuple(one for one in _of("contact") if one.name == "tool_places")  # of the tool: studies average over them
STUDY = tuple(one for one in SHEAR + RAIN + DRY_BELOW + TRAPPED + CONTACT + PLACES if one.study_key)
PIXELS = tuple(one for one in _ALL if one.table == "pixels")
RECIPE = _of("recipe")
READ = tuple(one for one in _ALL if one.table == "read")
OF_SCANS = tuple(one for one in READ if one.study_key)  # that scans of a study may have for themselves

#: Lines of studies, in their order.
OF_STUDIES = _of("contact", "film", "trapped", "fluid", "friction")


def complete(settings: Sequence[Setting], given: Mapping[str, Any]) -> dict[str, Any]:
    """Plain values of all settings by their names: what is given, else the default."""
    return {one.name: one.taken(given[one.argument]) if one.argument in given else one.default for one in settings}


def filled(target: _Settings, values: Mapping[str, Any]) -> _Settings:
    """Settings of the extension module with these values; None leaves what they have."""
    taking: Any = target
    for name, value in values.items():
        if is_surface(value):
            taking.take_tool(value._topography)
        else:
            setattr(target, name, value)
    return target


def _signature(function: Callable[..., Any], settings: Sequence[Setting]) -> inspect.Signature:
    """That of the function, with the settings in place of ``**settings``; where it takes ``*more``, by place as well."""
    own = inspect.signature(function)
    parts = own.parameters.values()
    by_place = any(one.kind is one.VAR_POSITIONAL for one in parts)
    kind = inspect.Parameter.POSITIONAL_OR_KEYWORD if by_place else inspect.Parameter.KEYWORD_ONLY
    taken = [inspect.Parameter(one.argument, kind, default=one.shown_default, annotation=one.hint)
             for one in settings if one.argument not in own.parameters]
    first = [one for one in parts if one.kind is one.POSITIONAL_OR_KEYWORD]
    last = [one for one in parts if one.kind is one.KEYWORD_ONLY]
    return own.replace(parameters=[*first, *taken, *last])


def _lines(settings: Sequence[Setting]) -> str:
    return "".join(textwrap.fill(f"{one.argument} : {one.documentation}", 116, initial_indent="    ",
                                 subsequent_indent="        ") + "\n" for one in settings)


def takes(settings: Sequence[Setting]) -> Callable[[_Function], _Function]:
    """Gives a function the settings as keyword arguments: in its signature, in its documentation, where the line
    ``**settings`` stands, and asked by name. It receives those that are given, as they are: see ``complete``."""

    def decorate(function: _Function) -> _Function:
        asked: Any = typed(function, [one.argument for one in settings],
                           {one.other: one.argument for one in settings if one.other})
        asked.__signature__ = _signature(function, settings)
        asked.__doc__ = (function.__doc__ or "").replace("    **settings\n", _lines(settings))
        return cast(_Function, asked)

    return decorate


def documented(settings: Sequence[Setting]) -> Callable[[type[_Settings]], type[_Settings]]:
    """The same for the documentation of a class."""

    def decorate(one: type[_Settings]) -> type[_Settings]:
        one.__doc__ = (one.__doc__ or "").replace("    **settings\n", _lines(settings))
        return one

    return decorate
