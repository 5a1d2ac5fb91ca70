"""Figures and a page from results, drawn by tabor.report as `tabor report` does."""

from __future__ import annotations

import html as html_text
import json
import os
import pathlib
import subprocess
import sys
from typing import Any, Literal, NamedTuple

from ._arguments import Count, Path, path, typed, wrong
from ._errors import InputError, require_file
from ._optional import needs_all
from ._records import Record
from ._save import save
from ._study import Results
from ._sweep import Sweep
from ._values import Value, optional_si
from .ehl import Solution

#: Runs beside this process: the report sets Matplotlib up for itself, and tries files in copies of its process.
_PROGRAM = """
import json, sys, types
given = json.load(sys.stdin)
sys.path[:] = given["path"]
bare = sys.modules["tabor"] = types.ModuleType("tabor")  # drawing needs nothing else of the package
bare.__path__ = [given["package"]]
from tabor.report import cli, errors
try:
    answer = {"files": [str(file) for file in cli.make(**given["make"])]}
except errors.ReportError as error:
    answer = {"error": errors.printable(error), "code": error.exit_code}
print(json.dumps(answer))
"""
_CANNOT_WRITE = 5


class Report(NamedTuple):
    """What a report wrote."""

    page: pathlib.Path | None  #: report.html; None where no page was asked for
    files: tuple[pathlib.Path, ...]  #: figures (PNG, SVG), their numbers (CSV) and the page

    def __repr__(self) -> str:
        return f"Report of {len(self.files)} files: {self.page or self.files[0].parent}"

    def _repr_html_(self) -> str:
        target = html_text.escape(os.fspath(self.page or self.files[0].parent))
        return f"<a href='{target}'>{target}</a>"


def _file_of(result: Any, out: Path | None) -> pathlib.Path:
    """Where the result lies; one that lies in no file is saved beside its report."""
    if isinstance(result, Results):
        return result.folder
    if isinstance(result, (str, os.PathLike)):
        require_file(path(result, "result"))
        return pathlib.Path(result)
    if not isinstance(result, (Record, Solution, Sweep, list, tuple)):
        raise wrong("result", result, "results, or a file or folder of them")
    if out is None:
        raise ValueError("result: it is in no file; give out, the folder to write to")
    file = pathlib.Path(out, "result.h5")
    file.parent.mkdir(parents=True, exist_ok=True)
    if isinstance(result, (Solution, Sweep)):
        result.save(file)
    else:
        save(file, result)
    return file


def _made(arguments: dict[str, Any]) -> list[str]:
    done = subprocess.run([sys.executable, "-P", "-B", "-X", "utf8", "-W", "ignore", "-c", _PROGRAM], text=True,
                          input=json.dumps({"path": sys.path, "package": os.path.dirname(__file__), "make": arguments}),
                          capture_output=True, check=False, encoding="utf-8", errors="surrogateescape")
    if done.returncode != 0:
        raise RuntimeError(f"report: the drawing program ended with {done.returncode}: {done.stderr.strip()[-300:]}")
    answer = json.loads(done.stdout.splitlines()[-1])
    if "error" in answer:
        raise (OSError if answer["code"] == _CANNOT_WRITE else InputError)(answer["error"])
    files: list[str] = answer["files"]
    return files


@typed
def report(result: Any, out: Path | None = None, *, html: bool = True, static: bool = False,
           figures: str | None = None, scan: Count | None = None, all_scans: bool = False, pressure: Value | None = None, density: Value | None = None,
           error_bar: Literal["std", "sem"] | None = None) -> Report:
    """One self-contained page, as ``tabor report`` makes it; needs ``pip install tabor[report]``.

    Parameters
    ----------
    result : folder of ``Study.run`` or ``tabor sweep``, ``Results``, a file of ``save`` or of the command line; or
        contacts, films, frictions, a solution or a sweep of ``ehl``, which are then saved as result.h5 in ``out``.
    out : folder to write to [beside the result].
    html : write the page, not only figures and tables.
    static : a page of still figures, as where Bokeh or Pillow is missing.
    figures : write figures and their tables, too: "png", "svg", "pdf" or several, as "png,svg" [none with a page].
    scan, all_scans : of a study: number of the scan that the maps show, counted from 0, or maps of every scan.
    pressure, density : of a study: mean pressure [Pa] and areal density [kg/m^2] that the maps show, the nearest
        ones computed.
    error_bar : of a study: "std", standard deviation, or "sem", standard error of the mean ["std"].

    Returns
    -------
    Report
        The page and all files.

    Raises
    ------
    ImportError
        Where h5py, matplotlib or jinja2 are missing.
    ValueError
        For what is no result of tabor, and for options that it has no use for.
    OSError
        Where the folder cannot be written.

    Examples
    --------
    >>> import tabor as tb
    >>> pressed = tb.contact(tb.generate("edt", pixels=32, seed=1), "7 MPa", "aluminium-6016")
    >>> tb.report(pressed, "pressed").page  # doctest: +SKIP
    PosixPath('pressed/report.html')
    """
    needs_all(("h5py", "matplotlib", *(("jinja2",) if html else ())), "report")
    if error_bar not in (None, "std", "sem"):
        raise ValueError(f"error_bar: got {error_bar!r}; expected 'std' or 'sem'")
    shown = optional_si(density, "areal_density", "density")
    arguments = {"html": html, "static": static, "figures": figures, "scan": scan, "all_scans": all_scans, "error_bar": error_bar,
                 "pressure": optional_si(pressure, "pressure", "pressure"),
                 "density": None if shown is None else 1e3 * shown}
    file = _file_of(result, out)
    folder = None if out is None else os.fspath(out)
    words = [repr(os.fspath(file)), *([] if folder is None else [f"out={folder!r}"])]
    files = _made({**arguments, "result": os.fspath(file), "output": folder,
                   "command": f"tabor.report({', '.join(words)})"})
    paths = tuple(map(pathlib.Path, files))
    return Report(paths[-1] if html else None, paths)
