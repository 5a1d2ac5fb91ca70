"""Runs the file that `tabor report` runs, which needs no other part of tabor."""

import runpy
from pathlib import Path

runpy.run_path(str(Path(__file__).resolve().parents[1] / "tabor/report/__main__.py"), run_name="__main__")
