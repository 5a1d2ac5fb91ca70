"""Packages that some functions need and most do not."""

from __future__ import annotations

import importlib
from typing import Any


def needs(package: str, what: str) -> Any:
    """The package, or ImportError that says what it is needed for and how to get it."""
    try:
        return importlib.import_module(package)
    except ImportError as error:
        root = package.partition(".")[0]
        raise ImportError(f"{what} needs {root}; pip install {root}") from error
