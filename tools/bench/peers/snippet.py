"""Runs a piece of Python of tutorials.py, in a process of its own, and keeps the arrays that it leaves.

    python snippet.py REQUEST.json

The request names the code, the .npz files of its inputs and outputs, and how often it is timed: one run that is not, which
imports and plans, goes before. The seconds of processor time go to standard output.
"""

from __future__ import annotations

import contextlib
import json
import sys
import time
from pathlib import Path

import numpy as np


def inputs(file: str | None) -> dict:
    if file is None:
        return {}
    with np.load(file) as arrays:
        return {name: arrays[name] if arrays[name].ndim else arrays[name].item() for name in arrays.files}


def quiet() -> None:
    """Tamaas tells each iteration, which takes time."""
    if "tamaas" in sys.modules:
        sys.modules["tamaas"].set_log_level(sys.modules["tamaas"].LogLevel.error)


def run(code, names: dict) -> tuple[float, dict]:
    names = dict(names)
    before = time.process_time()
    exec(code, names)
    return time.process_time() - before, names


def kept(names: dict) -> dict:
    """Numbers and arrays, and lists of arrays as one."""
    found = {name: value for name, value in names.items() if isinstance(value, (int, float, np.ndarray))}
    return found | {name: np.array(names[name]) for name in ("pressures", "gaps") if name in names}


def main() -> None:
    request = json.loads(Path(sys.argv[1]).read_text("utf-8"))
    code, given = compile(request["code"], "tutorial", "exec"), inputs(request["inputs"])
    with contextlib.redirect_stdout(sys.stderr):  # packages talk
        _, names = run(code, given)
        quiet()
        seconds = [run(code, given)[0] for _ in range(request["repeats"])]
    np.savez(request["outputs"], **kept(names))
    print(json.dumps(seconds))


if __name__ == "__main__":
    main()
