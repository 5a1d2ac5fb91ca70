"""Versions for reports of faults."""

from __future__ import annotations

import importlib.metadata
import os
import platform
import sys

from . import _tabor

_PACKAGES = ("numpy", "xarray", "pandas", "matplotlib", "h5py", "h5netcdf", "netCDF4", "pint", "tqdm", "bokeh", "scipy")


def show_versions() -> None:
    """Prints the versions of tabor, Python, the system and the packages that tabor works with, for reports of faults.

    Examples
    --------
    >>> import tabor as tb
    >>> tb.show_versions()  # doctest: +ELLIPSIS
    tabor       ...
    """
    lines = {"tabor": _tabor.version, "Python": sys.version.split()[0], "system": platform.platform(), "threads": str(_tabor.threads()),
             "processors": str(os.cpu_count()), "transforms": _tabor.transforms}
    for name in _PACKAGES:
        try:
            lines[name] = importlib.metadata.version(name)
        except importlib.metadata.PackageNotFoundError:
            lines[name] = "not installed"
    for name, text in lines.items():
        print(f"{name:<12}{text}")
