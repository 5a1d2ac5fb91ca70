"""Names the Debian package of a Python library that is absent, before anything imports it."""

import contextlib
import importlib
import os
from pathlib import Path

from tabor.report.errors import InputError

DEBIAN_PACKAGES = {
    "numpy": "python3-numpy",
    "h5py": "python3-h5py",
    "matplotlib": "python3-matplotlib",
    "jinja2": "python3-jinja2",
}


def missing_packages(names):
    return [DEBIAN_PACKAGES[name] for name in names if not _is_importable(name)]


def require(names):
    """Raises InputError with the apt line that brings what is absent."""
    missing = missing_packages(names)
    if missing:
        raise InputError(
            f"the report needs Python libraries that are not installed; "
            f"install them with: apt install {' '.join(missing)}"
        )


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
