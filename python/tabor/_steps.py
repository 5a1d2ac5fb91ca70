"""Steps of a treatment as methods of a surface, made of the library's table of steps."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import _tabor
from ._arguments import typed, wrong
from ._progress import Progress
from ._values import in_si, is_quantity


def _text_of(value: Any, step: str, expected: str) -> str:
    """One part of the argument of a step; a quantity is a length."""
    if isinstance(value, str):
        return value
    if is_quantity(value):
        return f"{float(in_si(value, 'length', step))!r} m"
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, float, np.integer, np.floating)):
        raise wrong(step, value, f"its argument, {expected}")
    return str(value)


def _add_step(surface: type, name: str, argument: str, text: str) -> None:
    def with_argument(self: Any, *values: Any, progress: Progress = None) -> Any:
        several = values[0] if len(values) == 1 and isinstance(values[0], (tuple, list)) else values
        words = ",".join(_text_of(value, name, argument) for value in several)
        return self.treat(f"{name}={words}" if words else name, progress=progress)

    def plain(self: Any, *, progress: Progress = None) -> Any:
        return self.treat(name, progress=progress)

    method: Any = with_argument if argument else plain
    method.__name__ = name
    method.__qualname__ = f"{surface.__name__}.{name}"
    method.__doc__ = f"{text[0].upper()}{text[1:]}." + (
        f"\n\nThe argument: {argument}; several may be given one by one." if argument else "")
    setattr(surface, name, method if argument else typed(method))


def add_steps(surface: type) -> None:
    """Gives the class, which has ``treat``, a method for each step."""
    for name, argument, text in _tabor.treatment_steps():
        _add_step(surface, name, argument, text)
