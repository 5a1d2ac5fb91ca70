"""tabor.report by its former name: `from tabor_report import cli` and `python3 -m tabor_report` go on working."""

import importlib


def __getattr__(name):
    if name.startswith("__"):
        raise AttributeError(name)
    return importlib.import_module(f"tabor.report.{name}")
