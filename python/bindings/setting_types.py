"""Writes the types of settings and of treatment steps, which type checkers and editors read, of the tables of the library.

usage: setting_types.py FOLDER OUTPUT    FOLDER: the package with its extension module"""

import pathlib
import sys
import textwrap
import types

HEAD = '''"""Types of settings and of treatment steps, made of the tables of the library by python/bindings/setting_types.py."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, Literal, TypedDict

from ._progress import Progress
from ._values import Value

if TYPE_CHECKING:
    from ._surface import Surface


#: Surfaces that can be made.
RecipeKind = Literal[KINDS]


class TreatmentSteps:
    """Steps as methods of a surface, which _surface.py makes."""

    if TYPE_CHECKING:
'''


def documented(setting):
    """A line of documentation under an attribute."""
    text = textwrap.fill(setting.documentation, 116, initial_indent='    """', subsequent_indent="    ")
    return f'{text}"""\n'


def step_method(name, argument, text):
    """One step, whose argument may be given one by one."""
    values, colon = ("*values: Any", ": ") if argument else ("*", "")
    return f'        def {name}(self, {values}, progress: Progress = None) -> Surface:\n            """{text}{colon}{argument}"""\n\n'


def settings_class(name, settings):
    """Keyword arguments."""
    lines = "".join(f"    {one.argument}: {one.hint}\n{documented(one)}" for one in settings)
    return f'\n\nclass {name}(TypedDict, total=False):\n    """Settings as keyword arguments."""\n\n{lines}'


def values_class(name, settings, known):
    """Plain values in SI; `known` are those that are always there."""
    lines = "".join(f"    {one.name}: {'float' if one.name in known else 'float | None'}\n{documented(one)}" for one in settings)
    return f'\n\n@dataclass(frozen=True, init=False)\nclass {name}:\n    """Values in SI; None where there is none."""\n\n{lines}'


def main():
    folder, output = map(pathlib.Path, sys.argv[1:])
    package = types.ModuleType("tabor")  # without its __init__, which imports what is written here
    package.__path__ = [str(folder)]
    sys.modules["tabor"] = package
    from tabor import _settings as tables
    parts = {"ContactSettings": tables.CONTACT, "RainSettings": tables.RAIN, "FrictionSettings": tables.SHEAR, "TrappedFrictionSettings": tables.SHEAR + tables.DRY_BELOW + tables.TRAPPED,
             "SlideSettings": tables.SLIDE, "CurveSettings": tables.CURVE, "SolidSettings": tables.SOLID, "StudySettings": tables.STUDY,
             "ReadSettings": [one for one in tables.READ if one.name != "channel"],  # which may be a number, too
             "ScanSettings": [one for one in tables.OF_SCANS if one.name != "channel"], "LubricantSettings": tables.OIL[1:], "GenerateSettings": tables.PIXELS + tables.RECIPE}
    kinds = ", ".join(map(repr, tables._tabor.recipe_kinds()))
    text = HEAD.replace("KINDS", kinds) + "".join(step_method(*step) for step in tables._tabor.treatment_steps()).rstrip("\n") + "\n"
    text += "".join(settings_class(name, settings) for name, settings in parts.items())
    text += values_class("SolidValues", tables.SOLID, {"youngs_modulus", "poissons_ratio"})
    text += values_class("LubricantValues", tables.OIL, {"viscosity"})
    output.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
