"""Tutorials of other packages, in them and in tabor: lines of code, seconds, agreement.

Called by `run --tutorials`. Each file of tutorials/ is one: a title, what it is, and three pieces of Python, of which the first
makes what both packages are given, or says of which tutorial that is, and the others leave `pressures` [Pa] and `gaps` [m], one map
per load.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import statistics
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path

import numpy as np

sys.path.insert(1, str(Path(__file__).resolve().parents[1]))
import benchmark  # noqa: E402

FOLDER = Path(__file__).with_name("tutorials")
PAGE = benchmark.ROOT / "docs/other_packages.md"
NAMES = ("rough", "saturated", "paraboloid", "waves", "sphere", "cone")
HEAD = ("| tutorial | package | lines | seconds | ratio to tabor | pixels in contact | mean gap | highest pressure | pressures |\n"
        "|---|---|---|---|---|---|---|---|---|")
INTRODUCTION = """# Other packages

Tutorials of [Tamaas](https://tamaas.readthedocs.io) and
[ContactMechanics](https://github.com/ContactEngineering/ContactMechanics), written in their own
package and in tabor. [Benchmarks](benchmarks.md#peers) compares solvers on larger maps at the same
proven error.
"""
MEANING = """
- **Lines** of code as shown, without empty lines. The inputs of both packages, such as the surface,
  are not counted.
- **Seconds** of processor time for the code shown, without imports, which an earlier run has
  loaded. Median of {repeats}, on one thread of a shared machine. Each package works to the
  tolerance of the tutorial, tabor to its own default, a relative error of 1e-6. The ratio is
  therefore the cost of the tutorial as it stands and does not rank the solvers.
- **Agreement** of the package with tabor: the largest difference under any of the loads. Pixels in
  contact are a share of all pixels. The mean gap (residual indentation counted as zero) and the
  highest pressure are relative to tabor's. The pressures of all pixels are compared by the root
  mean square of their difference over that of tabor's.
"""


@dataclass(frozen=True)
class Piece:
    package: str  # "Tamaas", "ContactMechanics", "NumPy" or "tabor"
    code: str

    @property
    def lines(self) -> int:
        return sum(1 for line in self.code.splitlines() if line.strip() and not line.lstrip().startswith("#"))


@dataclass(frozen=True)
class Tutorial:
    title: str
    text: str
    given: str  # what both packages get, as the page says it
    surface: Piece
    theirs: Piece
    ours: Piece


def read(name: str) -> Tutorial:
    """Comments before the first piece are title and text."""
    head, *pieces = re.split(r"(?m)^# --- (.*)\n", (FOLDER / f"{name}.py").read_text("utf-8"))
    title, *text = [line.removeprefix("# ") for line in head.strip().splitlines()]
    surface, theirs, ours = (Piece(heading.removeprefix("surface: "), code.strip())
                             for heading, code in zip(pieces[::2], pieces[1::2]))
    if surface.package.startswith("that of "):
        other = read(surface.package.removeprefix("that of "))
        return Tutorial(title, "\n".join(text), f"Both packages use the surface of \"{other.title}\".", other.surface, theirs, ours)
    given = f"Both packages use this input, made with {surface.package}:\n\n```python\n{surface.code}\n```"
    return Tutorial(title, "\n".join(text), given, surface, theirs, ours)


class Bench:
    """Where the packages are, and the scratch folder."""

    def __init__(self, build: Path, scratch: Path, repeats: int):
        self.build, self.scratch, self.repeats = build, scratch, repeats

    def why_not(self, package: str) -> str | None:
        """Why its pieces cannot be run."""
        if package == "tabor":
            present = (self.build / "python/tabor/__init__.py").is_file()
            return None if present else "the Python package of tabor is not built (TABOR_PYTHON_PACKAGE)"
        try:
            metadata.version("numpy" if package == "NumPy" else package)
        except metadata.PackageNotFoundError:
            return f"{package} is not installed, tools/bench/peers/run does that"
        return None

    def python(self, package: str) -> str:
        """The interpreter that tabor was built for; this one has the others."""
        if package != "tabor":
            return sys.executable
        cache = (self.build / "CMakeCache.txt").read_text("utf-8")
        return re.search(r"(?m)^_?Python_EXECUTABLE:\w+=(.*)", cache)[1]

    def run(self, piece: Piece, inputs: Path | None, repeats: int) -> tuple[list[float], Path]:
        outputs = self.scratch / f"{piece.package}{'' if inputs else '-surface'}.npz"
        request = self.scratch / "request.json"
        request.write_text(json.dumps({"code": piece.code, "inputs": inputs and str(inputs), "outputs": str(outputs),
                                       "repeats": repeats}), "utf-8")
        environment = {**os.environ, "PYTHONPATH": str(self.build / "python") if piece.package == "tabor" else "",
                       "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
        done = subprocess.run([self.python(piece.package), str(Path(__file__).with_name("snippet.py")), str(request)],
                              capture_output=True, text=True, check=False, cwd=self.scratch, env=environment)
        if done.returncode:
            raise SystemExit(f"{piece.package}: {(done.stderr.strip().splitlines() or ['no message'])[-1]}")
        return json.loads(done.stdout), outputs


# --- Agreement

def areas(maps: np.ndarray) -> np.ndarray:
    return (maps > 0).mean(axis=(1, 2))


def mean_gaps(arrays) -> np.ndarray:
    return np.maximum(arrays["gaps"], 0).mean(axis=(1, 2))


def relative(theirs: np.ndarray, ours: np.ndarray) -> float:
    return float(np.max(np.abs(theirs / ours - 1)))


def agreement(theirs: Path, ours: Path) -> dict[str, float]:
    """The largest differences under any of the loads."""
    with np.load(theirs) as other, np.load(ours) as own:
        pressures, expected = other["pressures"], own["pressures"]
        difference = np.sqrt(((pressures - expected) ** 2).mean(axis=(1, 2)) / (expected**2).mean(axis=(1, 2)))
        return {"area": float(np.max(np.abs(areas(pressures) - areas(expected)))), "gap": relative(mean_gaps(other), mean_gaps(own)),
                "highest": relative(pressures.max(axis=(1, 2)), expected.max(axis=(1, 2))), "field": float(difference.max())}


def measured(bench: Bench, tutorial: Tutorial) -> dict:
    _, surface = bench.run(tutorial.surface, None, 0)
    seconds, outputs = {}, {}
    for piece in (tutorial.theirs, tutorial.ours):
        times, outputs[piece.package] = bench.run(piece, surface, bench.repeats)
        seconds[piece.package] = statistics.median(times)
    return {"seconds": seconds, **agreement(outputs[tutorial.theirs.package], outputs["tabor"])}


# --- The page

def cells(tutorial: Tutorial, found: dict) -> str:
    theirs, seconds = tutorial.theirs.package, found["seconds"]
    rows = [[tutorial.title, theirs, str(tutorial.theirs.lines), f"{seconds[theirs]:.2g}", f"{seconds[theirs] / seconds['tabor']:.2g}",
             *(f"{found[key]:.0e}" if found[key] else "the same" for key in ("area", "gap", "highest", "field"))],
            ["", "tabor", str(tutorial.ours.lines), f"{seconds['tabor']:.2g}", *[""] * 5]]
    return "\n".join("| " + " | ".join(row) + " |" for row in rows)


def side_by_side(theirs: Piece, ours: Piece) -> str:
    columns = "".join(f"<td>\n\n```python\n{piece.code}\n```\n\n</td>\n" for piece in (theirs, ours))
    return (f"<table>\n<tr><th>{theirs.package}, {theirs.lines} lines</th><th>tabor, {ours.lines} lines</th></tr>\n"
            f"<tr valign=\"top\">\n{columns}</tr>\n</table>\n")


def section(tutorial: Tutorial) -> str:
    return f"## {tutorial.title}\n\n{tutorial.text}\n\n{tutorial.given}\n\n{side_by_side(tutorial.theirs, tutorial.ours)}"


def versions() -> str:
    names = ("tamaas", "ContactMechanics", "SurfaceTopography", "NuMPI", "muGrid", "numpy")
    return ", ".join(f"{name} {metadata.version(name)}" for name in names)


def page(tutorials: list[Tutorial], rows: list[str], repeats: int) -> str:
    made = benchmark.made_by("tools/bench/peers/run --tutorials --record", on_surfaces=False)
    table = "\n".join([HEAD, *rows])
    return "\n".join([INTRODUCTION, f"{made} {versions()}.\n", table, MEANING.format(repeats=repeats), *map(section, tutorials)])


def main() -> None:
    parser = argparse.ArgumentParser(prog="run --tutorials")
    parser.add_argument("--build", type=Path, required=True, help=argparse.SUPPRESS)
    parser.add_argument("--record", action="store_true", help="make docs/other_packages.md again")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("names", nargs="*", metavar="TUTORIAL", help=", ".join(NAMES))
    options = parser.parse_args()
    done, rows = [], []
    with tempfile.TemporaryDirectory() as scratch:
        bench = Bench(options.build.resolve(), Path(scratch), options.repeats)
        print(HEAD)
        for name in options.names or NAMES:
            tutorial = read(name)
            missing = [why for piece in (tutorial.surface, tutorial.theirs, tutorial.ours) if (why := bench.why_not(piece.package))]
            if missing:
                print(f"skipped: {name}: {missing[0]}", file=sys.stderr)
                continue
            done.append(tutorial)
            rows.append(cells(tutorial, measured(bench, tutorial)))
            print(rows[-1], flush=True)
    if options.record and len(done) < len(NAMES):
        sys.exit("nothing recorded: the page needs all tutorials")
    if options.record:
        PAGE.write_text(page(done, rows, options.repeats), "utf-8")


if __name__ == "__main__":
    main()
