"""What the benchmark scripts of this folder share: building a program, running it, keeping its output in docs/benchmarks.md."""

import argparse
import datetime
import functools
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/benchmarks.md"
sys.path.append(str(ROOT / "tools"))

from markdown_lines import wrapped  # noqa: E402
TITLE = "# Benchmarks\n\nMeasured numbers, each with the command that made it.\n"


def arguments(description: str) -> tuple[argparse.Namespace, list[str]]:
    """--record, and what is meant for the benchmark program."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--record", action="store_true", help="keep the output in docs/benchmarks.md")
    return parser.parse_known_args()


def program(name: str) -> pathlib.Path:
    """The benchmark program, built in TABOR_BUILD (build/release unless set)."""
    return built(name, "tools/bench")


def built(name: str, room: str) -> pathlib.Path:
    folder = pathlib.Path(os.environ.get("TABOR_BUILD", ROOT / "build/release"))
    if not (folder / "CMakeCache.txt").is_file():
        raise SystemExit(f"no build in {folder}: cmake --preset release, or set TABOR_BUILD")
    subprocess.run(["cmake", "--build", str(folder), "--target", name], check=True, stdout=sys.stderr)
    return folder / room / name


def output_of(command: list[str]) -> str:
    """Runs a command, showing its lines as they come. Its idle threads sleep."""
    lines = []
    environment = {"OMP_WAIT_POLICY": "passive", **os.environ}
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as process:
        for line in process.stdout:
            print(line, end="", flush=True)
            lines.append(line)
    if process.returncode:
        raise SystemExit(f"{command[0]} failed with status {process.returncode}")
    return "".join(lines)


def machine() -> str:
    names = re.findall(r"model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text("utf-8"))
    return f"{os.cpu_count()} processors ({names[0] if names else 'unnamed'})"


@functools.cache
def digest_of_surfaces(tabor: str) -> str:
    """Tells generators of surfaces apart: of one surface of each kind, to a picometre."""
    digest = hashlib.sha256()
    with tempfile.TemporaryDirectory() as folder:
        for words in ["edt", "self-affine --rms-height 1um --pixel 1um", "ground --rms-height 1um --pixel 1um"]:
            file = os.path.join(folder, "surface.npy")
            subprocess.run([tabor, "generate", *words.split(), "-o", file, "--pixels", "64", "--quiet"], check=True,
                           stdout=subprocess.DEVNULL)
            digest.update(np.rint(np.load(file) * 1e12).astype("<i8").tobytes())
    return digest.hexdigest()[:8]


def made_by(command: str, on_surfaces: bool = True) -> str:
    """The line that opens a section; with the digest of generated surfaces if it stands on any."""
    of_surfaces = f" Generated surfaces {digest_of_surfaces(str(built('tabor', 'tools')))}." if on_surfaces else ""
    return f"Made by `{command}` on {datetime.date.today()}; do not edit. {machine()}.{of_surfaces}"


def record(title: str, text: str, page: pathlib.Path = PAGE) -> None:
    """Replaces the section of this title in the page, or appends it."""
    page_text = page.read_text("utf-8") if page.is_file() else TITLE
    parts = re.split(r"(?m)^(?=## )", page_text)
    section = wrapped(f"## {title}\n\n{text.strip()}\n")
    places = [i for i, part in enumerate(parts) if part.startswith(f"## {title}\n")]
    if places:
        parts[places[0]] = section
    else:
        parts.append(section)
    page.write_text("\n".join(part.strip("\n") + "\n" for part in parts), "utf-8")


def record_outputs(title: str, command: str, text: str, outputs: list[str], on_surfaces: bool = True) -> None:
    blocks = "\n".join(f"```\n{output.rstrip()}\n```\n" for output in outputs)
    record(title, f"{made_by(command + ' --record', on_surfaces)}\n\n{text.strip()}\n\n{blocks}")
