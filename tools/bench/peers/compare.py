"""Drives tabor and its peers to the same proven error and records what that took.

Called by `run`. Every solve has a process of its own; every pressure field is judged by
bench_certify (certify.cpp). A row is identified by surface, n, case, tool and option, so that runs
of a part of the cases renew only their rows.
"""

from __future__ import annotations

import argparse
import fcntl
import json
import math
import platform
import statistics
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from datetime import date
from importlib import metadata
from pathlib import Path

sys.path.insert(1, str(Path(__file__).resolve().parents[1]))
import benchmark  # noqa: E402
import page  # noqa: E402

ROOT = Path(__file__).resolve().parents[3]
RECORD = ROOT / "docs/benchmarks_peers.json"

TARGET = 1e-6  # duality gap that every tool is driven to
CLEARLY_BETTER = 1e-7  # below this the setting was too tight and a looser one is tried
REFERENCE = 1e-10  # duality gap of the reference areas
TIMEOUT = 300  # [s] of processor time, per solve
EFFECTIVE_MODULUS = 70e9 / (1 - 0.33**2)  # aluminium against a rigid flat [Pa]
SATURATION = 240e6  # [Pa]
CONTACTS = (0.5, 2, 10, 50)  # pixels in contact [%]
SATURATED_PRESSURES = (2e6, 10e6)  # [Pa]
PIXEL = 0.67e-6  # of the generated surfaces [m]

# Options of each tool that are compared, with the tolerance its search starts from.
ELASTIC = {
    "ASPHER": {"double, auto": 3e-7, "float_then_double, auto": 3e-7},
    "Tamaas": {"pressure": 1e-6},
    "ContactMechanics": {"with restart": 2e-5, "without restart": 1e-5},
    "slippy": {"pk": 3e-6},
}
SATURATED = {"Tamaas": {"Kato": 1e-5}, "ContactMechanics": {"bearing-area start": 1e-3}}
REFUSED = {
    "ASPHER": "no saturation",
    "slippy": "its saturated method stops with a wrong load when every contact pixel is saturated",
}


@dataclass(frozen=True)
class Surface:
    name: str
    n: int
    heights: Path
    pixel: float  # [m]


@dataclass(frozen=True)
class Case:
    surface: Surface
    name: str  # "2 %" or "saturated 2 MPa"
    mean_pressure: float  # [Pa]
    saturation_pressure: float = math.inf  # [Pa]

    @property
    def is_saturated(self) -> bool:
        return math.isfinite(self.saturation_pressure)

    def arguments(self, pressure: Path) -> list[str]:
        numbers = (self.surface.pixel, EFFECTIVE_MODULUS, self.mean_pressure,
                   self.saturation_pressure)
        return [str(self.surface.heights), str(pressure), *map(repr, numbers)]


class Bench:
    """The programs, the scratch folder and the rows so far."""

    def __init__(self, build: Path, scratch: Path):
        self.build, self.scratch = build, scratch
        self.rows: list[dict] = []
        self.fresh: dict[tuple, dict] = {}  # those of this run
        self.settings: dict[tuple, float] = {}  # the tolerance that met the target last time
        self.references: dict[Case, float] = {}

    def output(self, command: list[str], timeout: float | None = None) -> dict:
        # In the scratch folder, as some tools leave files where they run.
        done = subprocess.run(command, capture_output=True, text=True, timeout=timeout, check=True,
                              cwd=self.scratch)
        return json.loads(done.stdout)

    def python(self, tool: str) -> Path:
        environment = "slippy" if tool == "slippy" else "main"
        return self.build / "peers" / environment / "bin/python"

    def present(self, tool: str) -> bool:
        """Whether `run` has installed it."""
        if tool == "tabor" or self.python(tool).is_file():
            return True
        print(f"skipped: {tool} is not installed, tools/bench/peers/run does that", file=sys.stderr)
        return False

    def certify(self, command: str, case: Case, pressure: Path, *more: str) -> dict:
        program = str(self.build / "tools/bench/bench_certify")
        return self.output([program, command, *case.arguments(pressure), *more])

    def tabor(self, case: Case, tolerance: float) -> dict:
        pressure = self.scratch / "tabor.npy"
        solved = self.certify("solve", case, pressure, repr(tolerance), "1")
        return solved | self.certify("check", case, pressure)

    def peer(self, case: Case, tool: str, option: str, tolerance: float) -> dict:
        pressure, request = self.scratch / "peer.npy", self.scratch / "request.json"
        request.write_text(json.dumps({
            "tool": tool, "option": option, "tolerance": tolerance, "threads": 1,
            "heights": str(case.surface.heights), "pressure": str(pressure),
            "pixel": case.surface.pixel, "effective_modulus": EFFECTIVE_MODULUS,
            "mean_pressure": case.mean_pressure,
            "saturation_pressure": str(case.saturation_pressure),
        }))
        command = f"ulimit -t {TIMEOUT}; exec \"$@\""  # processor time, as the machine is shared
        solved = self.output(
            ["bash", "-c", command, "bash", str(self.python(tool)),
             str(Path(__file__).with_name("solve.py")), str(request)], timeout=4 * TIMEOUT)
        return solved | self.certify("check", case, pressure)


# --- Surfaces and loads

def generated(bench: Bench, name: str, n: int, arguments: list[str]) -> Surface:
    file = bench.scratch / f"{name.replace(' ', '-').replace('/', '-')}-{n}.npy"
    command = [str(bench.build / "tools/tabor"), "generate", *arguments, "-o", str(file), "--quiet",
               "--pixels", str(n), "--pixel", f"{PIXEL}m"]
    subprocess.run(command, check=True, capture_output=True)
    return Surface(name, n, file, PIXEL)


def self_affine(bench: Bench, n: int, name: str, short_cutoff_pixels: int) -> Surface:
    return generated(bench, name, n, [
        "self-affine", "--hurst", "0.8", "--rms-slope", "0.1", "--roll-off", f"{n * PIXEL / 4}m",
        "--short-cutoff", f"{short_cutoff_pixels * PIXEL}m"])


def scan(bench: Bench, folder: Path, file: str, crop: str) -> list[Surface]:
    source = folder / file
    if not source.is_file():
        print(f"skipped: no scan {file}", file=sys.stderr)
        return []
    tabor = str(bench.build / "tools/tabor")
    info = bench.output([tabor, "info", str(source), "--json"])
    target = bench.scratch / f"{source.stem}.npy"
    subprocess.run([tabor, "convert", str(source), str(target), "--crop", crop, "--level", "plane",
                    "--fill", "harmonic", "--quiet"], check=True, capture_output=True)
    return [Surface(file, int(crop.split(",")[2]), target, info["pixel_x_m"])]


def surfaces(bench: Bench, n: int, scans: Path) -> list[Surface]:
    found = [
        self_affine(bench, n, "self-affine, cut-off Nyquist/4", 8),
        generated(bench, "EDT-like", n, ["edt"]),
    ]
    if n <= 1024:
        found.append(self_affine(bench, n, "self-affine, cut-off Nyquist", 2))
    if n == 512:
        found += scan(bench, scans.resolve(), "confocal_nanofocus1.nms", "0,0,512,512")
        found += scan(bench, scans.resolve(), "rubber_alicona.x3p", "174,61,512,512")
    return found


def pressure_for(bench: Bench, surface: Surface, contact: float, guess: float) -> float:
    """Mean pressure with which `contact` per cent of the pixels touch, to 2 per cent of that."""

    def area(pressure: float) -> float:
        return 100 * bench.tabor(Case(surface, "", pressure), 1e-4)["contact_area"]

    pressure, exponent, last = guess, 1.0, None
    for _ in range(12):
        reached = area(pressure)
        if abs(reached / contact - 1) < 0.02:
            break
        if last and reached != last[1]:
            exponent = math.log(reached / last[1]) / math.log(pressure / last[0])
            exponent = min(max(exponent, 0.2), 2.0)
        last = (pressure, reached)
        pressure *= (contact / max(reached, 0.01)) ** (1 / exponent)
    return pressure


def cases_of(bench: Bench, surface: Surface) -> list[Case]:
    """Loads of an earlier run are kept, so that renewed rows stand beside the old ones."""
    known = {row["case"]: row["mean_pressure_Pa"] for row in bench.rows
             if (row["surface"], row["n"]) == (surface.name, surface.n)}
    cases, pressure = [], 0.01 * 0.1 * EFFECTIVE_MODULUS / 4
    for contact in CONTACTS:
        name = f"{contact:g} %"
        pressure = known.get(name) or pressure_for(bench, surface, contact, pressure)
        cases.append(Case(surface, name, pressure))
        pressure *= 4
    return cases + [Case(surface, f"saturated {p / 1e6:g} MPa", p, SATURATION)
                    for p in SATURATED_PRESSURES]


# --- One row

def search(bench: Bench, case: Case, tool: str, option: str, start: float) -> tuple[float, dict]:
    """The loosest tolerance of the tool, in steps of about 3, whose pressure meets the target."""
    tolerance, met, tried = start, None, set()
    while len(tried) < 7 and tolerance not in tried:
        tried.add(tolerance)
        row = bench.peer(case, tool, option, tolerance)
        gap = row["certificate"]
        if gap is not None and gap <= TARGET:
            met = (tolerance, row)
            if gap >= CLEARLY_BETTER:
                break
            tolerance = rounded(tolerance * 3)
        else:
            if met:
                break
            far = gap is None or gap > 100 * TARGET
            tolerance = rounded(tolerance / (30 if far else 3))
    return met or (tolerance, row)


def rounded(tolerance: float) -> float:
    return float(f"{tolerance:.2e}")


def repeated(solve, first: dict) -> dict:
    """Times of the median of three solves; of the first alone where it took long."""
    if first["processor_seconds"] > 3:
        return first
    rows = [first, solve(), solve()]
    middle = statistics.median(row["processor_seconds"] for row in rows)
    return next(row for row in rows if row["processor_seconds"] == middle)


def measured(bench: Bench, case: Case, tool: str, option: str, start: float) -> dict:
    key = (tool, option, case.name)
    try:
        tolerance, row = search(bench, case, tool, option, bench.settings.get(key, start))
    except subprocess.TimeoutExpired:
        return {"note": f"not within {TIMEOUT} s"}
    except subprocess.CalledProcessError as error:
        if error.returncode in (-9, 137, -24, 152):
            return {"note": f"not within {TIMEOUT} s"}
        return {"note": "failed: " + (error.stderr.strip().splitlines() or ["no message"])[-1]}
    if row["certificate"] is None or row["certificate"] > TARGET:
        return row | {"tolerance": tolerance, "note": "target not reached"}
    bench.settings[key] = tolerance
    row = repeated(lambda: bench.peer(case, tool, option, tolerance), row)
    return row | {"tolerance": tolerance}


def add(bench: Bench, case: Case, tool: str, option: str, row: dict) -> None:
    surface = case.surface
    row |= {"surface": surface.name, "n": surface.n, "case": case.name, "tool": tool,
            "option": option, "mean_pressure_Pa": case.mean_pressure, "pixel_m": surface.pixel}
    if "contact_area" in row:
        row["area_error"] = row["contact_area"] / reference_area(bench, case) - 1
    row["date"] = date.today().isoformat()
    bench.rows = merged(bench.rows, [row])
    bench.fresh[page.key(row)] = row
    print(page.line(row, bench.rows), flush=True)


def merged(old: list[dict], new: list[dict]) -> list[dict]:
    return list({page.key(row): row for row in [*old, *new]}.values())


def reference_area(bench: Bench, case: Case) -> float:
    if case not in bench.references:
        bench.references[case] = bench.tabor(case, REFERENCE)["contact_area"]
    return bench.references[case]


def wanted_options(bench: Bench, case: Case, tool: str, options: dict) -> dict:
    """All at n = 512; above that the option that was the fastest there on the same case."""
    if case.surface.n == 512 or len(options) == 1:
        return options
    smaller = [row for row in bench.rows if row["tool"] == tool and row["case"] == case.name
               and row["surface"] == case.surface.name and row["n"] < case.surface.n
               and page.reached(row)]
    if not smaller:
        return options
    best = min(smaller, key=lambda row: (-row["n"], row["processor_seconds"]))["option"]
    return {best: options[best]}


def expected_seconds(bench: Bench, case: Case, tool: str, option: str) -> float:
    """From the next smaller size: the pixels and a growing number of iterations."""
    for row in bench.rows:
        same = (row["tool"], row["option"], row["case"], row["surface"], row["n"] * 2) == (
            tool, option, case.name, case.surface.name, case.surface.n)
        if same and page.reached(row):
            return 6 * row["processor_seconds"]
        if same:
            return math.inf
    return 0


def compare(bench: Bench, case: Case, tools: list[str], expected_limit: float) -> None:
    if "tabor" in tools:
        solve = lambda: bench.tabor(case, TARGET)  # noqa: E731
        add(bench, case, "tabor", "fast", repeated(solve, solve()) | {"tolerance": TARGET})
    table = SATURATED if case.is_saturated else ELASTIC
    for tool in [tool for tool in table if tool in tools]:
        for option, start in wanted_options(bench, case, tool, table[tool]).items():
            if expected_seconds(bench, case, tool, option) > expected_limit:
                row = {"note": f"not run: more than {expected_limit:g} s expected"}
            else:
                row = measured(bench, case, tool, option, start)
            add(bench, case, tool, option, row)


# --- The record

def versions() -> dict[str, str]:
    names = ("tamaas", "ContactMechanics", "SurfaceTopography", "NuMPI", "muGrid", "aspher",
             "numpy")
    found = {name: metadata.version(name) for name in names}
    commit = subprocess.run(["git", "describe", "--always", "--dirty"], cwd=ROOT,
                            capture_output=True, text=True, check=False).stdout.strip()
    requirements = Path(__file__).with_name("requirements-slippy.txt").read_text()
    numpy = next(line for line in requirements.splitlines() if line.startswith("numpy=="))
    return {"tabor": commit or "unknown", "Python": platform.python_version(), **found,
            "slippy": f"0.5.2 ({numpy})"}


def load_record() -> dict:
    return json.loads(RECORD.read_text("utf-8")) if RECORD.is_file() else {"rows": []}


def save_record(bench: Bench) -> None:
    """Fresh rows replace the recorded ones; those of another run, even one at work, stay."""
    record = {
        "date": date.today().isoformat(), "command": "tools/bench/peers/run --record",
        "target": TARGET, "timeout_s": TIMEOUT, "machine": benchmark.machine(),
        "versions": versions(), "refused": REFUSED,
    }
    with open(bench.build / "peers/record.lock", "w", encoding="utf-8") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        rows = merged(load_record()["rows"], list(bench.fresh.values()))
        record["rows"] = sorted(rows, key=page.order)
        RECORD.write_text(json.dumps(record, indent=1, allow_nan=False) + "\n", "utf-8")
        benchmark.record("Peers", page.section(record))


def parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="run")
    parser.add_argument("--build", type=Path, required=True, help=argparse.SUPPRESS)
    parser.add_argument("--scans", type=Path, required=True, help=argparse.SUPPRESS)
    parser.add_argument("--quick", action="store_true", help="n = 512 only")
    parser.add_argument("--record", action="store_true", help="renew docs/benchmarks.md")
    parser.add_argument("--sizes", default="512,1024,2048")
    parser.add_argument("--tools", default="tabor,ASPHER,Tamaas,ContactMechanics,slippy")
    parser.add_argument("--surface", default="", help="only this, by its name in the table")
    parser.add_argument("--cases", default="", help="only these, e.g. '2 %%,saturated 2 MPa'")
    parser.add_argument("--longest", type=float, default=TIMEOUT,
                        help="leave out solves expected to take more seconds")
    return parser.parse_args()


def run(bench: Bench, options: argparse.Namespace) -> None:
    tools = [tool for tool in options.tools.split(",") if bench.present(tool)]
    sizes = [512] if options.quick else [int(n) for n in options.sizes.split(",")]
    print(page.HEAD)
    for n in sizes:
        for surface in surfaces(bench, n, options.scans):
            if options.surface not in ("", surface.name):
                continue
            for case in cases_of(bench, surface):
                if options.cases and case.name not in options.cases.split(","):
                    continue
                compare(bench, case, tools, options.longest)
                if options.record:
                    save_record(bench)


def main() -> None:
    options = parse()
    with tempfile.TemporaryDirectory() as scratch:
        bench = Bench(options.build.resolve(), Path(scratch))
        if options.record:
            bench.rows = load_record()["rows"]
            bench.settings = {(r["tool"], r["option"], r["case"]): r["tolerance"]
                              for r in bench.rows if page.reached(r)}
        try:
            run(bench, options)
        except subprocess.CalledProcessError as error:  # of tabor's own programs
            sys.exit((error.stderr or f"{error}").strip())


if __name__ == "__main__":
    main()
