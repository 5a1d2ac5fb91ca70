"""Names the package of a Python library that is absent, before anything imports it."""

import contextlib
import importlib
import os
import sys
from pathlib import Path

from tabor.report.errors import InputError

DEBIAN_PACKAGES = {
    "numpy": "python3-numpy",
    "h5py": "python3-h5py",
    "matplotlib": "python3-matplotlib",
    "jinja2": "python3-jinja2",
}


def missing_packages(names):
    return [DEBIAN_PACKAGES[name] for name in _missing(names)]


def require(names):
    """Raises InputError with the line for apt, or in a virtual environment for pip, that brings what is absent."""
    missing = _missing(names)
    if missing:
        raise InputError(f"the report needs Python libraries that are not installed; install them with: {_remedy(missing)}")


def _missing(names):
    return [name for name in names if not _is_importable(name)]


def _remedy(missing):
    if sys.prefix != sys.base_prefix:
        return f"{sys.executable} -m pip install {' '.join(missing)}"
    return f"apt install {' '.join(DEBIAN_PACKAGES[name] for name in missing)}"


def _is_importable(name):
    try:
        with _at_home():
            importlib.import_module(name)
    except ImportError:
        return False
    return True


@contextlib.contextmanager
def _at_home():
    """Works in this package's folder for a while: Matplotlib takes a matplotlibrc from the current one."""
    here = os.open(".", os.O_RDONLY)
    os.chdir(Path(__file__).resolve().parent)
    try:
        yield
    finally:
        os.fchdir(here)
        os.close(here)
