"""Types of arguments, asked by the signature of a function before it begins."""

from __future__ import annotations

import difflib
import functools
import inspect
import math
import operator
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import Executor
from types import MappingProxyType
from typing import Any, Literal, TypeVar, Union, cast, get_origin

import numpy as np

from ._files import is_open_file
from ._guesses import ARGUMENTS

#: A file or folder.
Path = Union[str, "os.PathLike[str]"]
#: A file by its name, or an open binary one.
File = Union[str, "os.PathLike[str]", Any]
#: Of random numbers: a whole number below 2^64.
Seed = int
#: How many: a whole number, zero or more.
Count = int
#: Where a picture is drawn, of Matplotlib; the current ones by default.
Axes = Any

_Function = TypeVar("_Function", bound=Callable[..., Any])
_Check = Callable[[Any, str], Any]  # (value, name of the argument) -> the value, as plain types

#: What to give where one of these classes is expected.
_SUCH_AS = {
    "Surface": 'a Surface, such as tabor.read(file) or tabor.Surface(heights, pixel="0.67 um")',
    "Contact": "a Contact, as tabor.contact returns it",
    "Film": "a Film, as tabor.rain returns it",
    "Lubricant": 'a Lubricant, such as tabor.Lubricant("0.1 Pa s")',
    "Solid": 'a Solid, such as tabor.Solid("aluminium-6016"), or the name of a material',
    "Executor": "an executor of concurrent.futures, such as ProcessPoolExecutor()",
}


def kind_of(value: Any) -> str:
    """What came, for a message: "list of Film", "None", "str 'x'"."""
    if value is None:
        return "None"
    name = type(value).__name__
    if isinstance(value, (list, tuple)) and value:
        return f"{name} of {type(value[0]).__name__}"
    return f"{name} {value!r}" if isinstance(value, (str, bool, int, float)) and len(repr(value)) < 60 else name


def wrong(name: str, value: Any, expected: str) -> TypeError:
    """The error for an argument of another type."""
    return TypeError(f"{name}: got {kind_of(value)}; expected {expected}")


def plain_text(value: Any, name: str) -> str:
    """A text."""
    if not isinstance(value, str):
        raise wrong(name, value, "a text")
    return str(value)


def texts(value: Any, name: str) -> list[str]:
    """Texts, or one alone."""
    if isinstance(value, str):
        return [value]
    if not isinstance(value, Iterable) or isinstance(value, (bytes, Mapping)):
        raise wrong(name, value, "a list of texts")
    return [plain_text(one, name) for one in value]


def flag(value: Any, name: str) -> bool:
    """True or False."""
    if not isinstance(value, (bool, np.bool_)):
        raise wrong(name, value, "True or False")
    return bool(value)


def whole(value: Any, name: str, least: int, most: int) -> int:
    """A whole number from ``least`` to ``most``."""
    if isinstance(value, (bool, np.bool_)):
        raise wrong(name, value, "a whole number")
    try:
        number = operator.index(value)
    except TypeError:
        raise wrong(name, value, "a whole number") from None
    if not least <= number <= most:
        expected = "zero or more" if number < least == 0 else f"{least} to {most}"
        raise ValueError(f"{name}: got {number}; expected {expected}")
    return number


def _real(value: Any, name: str) -> float:
    if isinstance(value, (bool, np.bool_)) or np.ndim(value) != 0 or np.asarray(value).dtype.kind not in "fiu":
        raise wrong(name, value, "a number")
    number = float(value)
    if number != number:
        raise ValueError(f"{name}: got NaN; expected a number")
    return number


def path(value: Any, name: str) -> Path:
    """The name of a file or folder."""
    if not isinstance(value, (str, os.PathLike)) or not isinstance(os.fspath(value), str):
        raise wrong(name, value, "the name of a file or folder")
    if not os.fspath(value) or "\0" in os.fspath(value):
        raise ValueError(f"{name}: got {os.fspath(value)!r}; expected the name of a file or folder")
    return value


def _file(value: Any, name: str) -> File:
    return value if is_open_file(value) else path(value, name)


def _channel(value: Any, name: str) -> str | int:
    return value if isinstance(value, str) else whole(value, name, 0, 2**31 - 1)


def mapping(value: Any, name: str) -> Mapping[str, Any]:
    """Values by names."""
    if not isinstance(value, Mapping):
        raise wrong(name, value, "a mapping")
    for key in value:
        if not isinstance(key, str):
            raise TypeError(f"{name}: got the key {key!r}; expected texts as keys")
    return value


def _axes(value: Any, name: str) -> Any:
    if value is not None and not hasattr(value, "get_figure"):
        raise wrong(name, value, "axes of Matplotlib")
    return value


def _executor(value: Any, name: str) -> Any:
    if not isinstance(value, Executor) and not callable(getattr(value, "submit", None)):
        raise wrong(name, value, _SUCH_AS["Executor"])
    return value


_CHECKS: dict[str, _Check] = {
    "str": plain_text, "bool": flag, "float": _real, "Path": path, "File": _file, "str | int": _channel, "Axes": _axes,
    "Sequence[str]": texts, "Iterable[str]": texts, "Executor": _executor,
    "int": lambda value, name: whole(value, name, -2**31, 2**31 - 1),
    "Count": lambda value, name: whole(value, name, 0, 2**31 - 1),
    "Seed": lambda value, name: whole(value, name, 0, 2**64 - 1),
}


def _instance_check(annotation: str, names: Mapping[str, Any]) -> _Check | None:
    """Of a class, or a text instead, that is known where the function stands, by the time that it is called."""
    kind = annotation.removesuffix(" | str")
    if kind not in _SUCH_AS:
        return None

    def check(value: Any, name: str) -> Any:
        if not (isinstance(value, names[kind]) or kind != annotation and isinstance(value, str)):
            raise wrong(name, value, _SUCH_AS[kind])
        return value

    return check


def _check_of(annotation: str, names: Mapping[str, Any]) -> _Check | None:
    inner = annotation.removesuffix(" | None")
    is_choice = inner.startswith("Literal[") or get_origin(names.get(inner)) is Literal
    check = plain_text if is_choice else _CHECKS.get(inner) or _instance_check(inner, names)
    if check is None or inner == annotation:
        return check
    asked = check
    return lambda value, name: None if value is None else asked(value, name)


def _title(function: Callable[..., Any]) -> str:
    """A function as its user writes it: "Surface", "Surface.section"."""
    return function.__qualname__.removesuffix(".__init__")


def _unknown(function: Callable[..., Any], name: str, names: Iterable[str]) -> TypeError:
    """The error for an argument that a function does not have."""
    known = list(names)
    near = [ARGUMENTS[name]] if ARGUMENTS.get(name) in known else difflib.get_close_matches(name, known, 1)
    return TypeError(f"{_title(function)}() got an unexpected keyword argument {name!r}" + (f"; did you mean {near[0]!r}?" if near else ""))


def _too_many(function: Callable[..., Any], n_given: int, by_place: Sequence[str], by_name: Sequence[str]) -> TypeError:
    """The error for more arguments by position than a function takes, with those that it takes by name."""
    if not by_place and not by_name:
        return TypeError(f"{_title(function)}() takes no arguments; got {n_given}")
    noun = "argument" if len(by_place) == 1 else "arguments"
    taken = f"{len(by_place)} {noun} by position ({', '.join(by_place)})" if by_place else "no arguments by position"
    named = ", ".join(f"{name}=" for name in by_name[:4]) + (", ..." if len(by_name) > 4 else "")
    return TypeError(f"{_title(function)}() takes {taken}; got {n_given}" + (f"; give the others by name: {named}" if named else ""))


def _with_more(function: Callable[..., Any], args: tuple[Any, ...], given: dict[str, Any], n_own: int,
               more: Sequence[str]) -> tuple[Any, ...]:
    """The arguments of the function's own; those behind them go to the settings in their order."""
    for name, value in zip(more, args[n_own:]):
        if name in given:
            raise TypeError(f"{_title(function)}() got multiple values for argument {name!r}")
        given[name] = value
    return args[:n_own]


def _renamed(function: Callable[..., Any], given: dict[str, Any], others: Mapping[str, str]) -> None:
    """Gives arguments their own names where another spelling was used."""
    for other in others.keys() & given.keys():
        name = others[other]
        if name in given:
            raise TypeError(f"{_title(function)}(): {other} and {name} are the same argument; give one of them")
        given[name] = given.pop(other)


def typed(function: _Function, settings: Sequence[str] = (), others: Mapping[str, str] = MappingProxyType({})) -> _Function:
    """The function, with its arguments asked by their annotations first: TypeError says what came and what was
    expected, and names the nearest argument for one that it does not have. Values with units, and what has a type of its
    own in one function alone, are asked there. ``settings`` are arguments that it takes by ``**settings`` (_settings.py),
    and by place where it takes ``*more``; ``others`` are further spellings of them."""
    code = function.__code__
    n_own = code.co_argcount
    names = code.co_varnames[:n_own + code.co_kwonlyargcount]
    found = ((name, _check_of(function.__annotations__.get(name, ""), function.__globals__)) for name in names)
    checks = {name: check for name, check in found if check is not None}
    positional = tuple(checks.get(name) for name in names[:n_own])
    known = None if code.co_flags & inspect.CO_VARKEYWORDS and not settings else {*names, *settings}
    takes_more = bool(code.co_flags & inspect.CO_VARARGS)
    further = [name for name in settings if name not in names]
    more = further if settings and takes_more else None
    by_place = (*names[:n_own], *(more or ()))
    by_name = [*names[n_own:], *(() if more else further)]
    most = math.inf if takes_more and not more else len(by_place)
    n_self = int(names[:1] in (("self",), ("cls",)))

    @functools.wraps(function)
    def asked(*args: Any, **given: Any) -> Any:
        if len(args) > most:
            raise _too_many(function, len(args) - n_self, by_place[n_self:], by_name)
        if more is not None and len(args) > n_own:
            args = _with_more(function, args, given, n_own, more)
        _renamed(function, given, others)
        plain = [check(value, name) if check else value for value, check, name in zip(args, positional, names)]
        for name in given:
            if name in checks:
                given[name] = checks[name](given[name], name)
            elif known is not None and name not in known:
                raise _unknown(function, name, known)
        return function(*plain, *args[len(plain):], **given)

    return cast(_Function, asked)
