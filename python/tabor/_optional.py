"""Packages that some functions need and most do not."""

from __future__ import annotations

import importlib
import importlib.util
from collections.abc import Sequence
from typing import Any


def needs(package: str, what: str) -> Any:
    """The package, or ImportError that says what it is needed for and how to get it."""
    try:
        return importlib.import_module(package)
    except ImportError as error:
        root = package.partition(".")[0]
        raise ImportError(f"{what} needs {root}; pip install {root}") from error


def needs_all(packages: Sequence[str], extra: str) -> None:
    """Raises ImportError that names those of the packages of an extra that are missing, and how to get them."""
    missing = [package for package in packages if importlib.util.find_spec(package) is None]
    if missing:
        raise ImportError(f"{extra} needs {' and '.join(missing)}; pip install tabor[{extra}], or "
                          f"pip install {' '.join(missing)}")
