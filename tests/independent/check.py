"""Repeats an independent computation and compares it with the numbers kept beside it, which the tests of tabor compare with.

usage: check.py NAME           computes NAME.py again and compares with NAME.json (exit status 77 without NumPy)
       check.py NAME --record  writes NAME.json"""

import importlib
import json
import os
import pathlib
import sys

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # other tests run beside

FOLDER = pathlib.Path(__file__).resolve().parent
SAME = 1e-6  # between processors and versions of LAPACK, relative


def numbers(values, path=""):
    """(path, number) of a nested dictionary."""
    if not isinstance(values, dict):
        yield path, values
        return
    for key, value in values.items():
        yield from numbers(value, f"{path}/{key}")


def differences(kept, computed):
    kept, computed = dict(numbers(kept)), dict(numbers(computed))
    if kept.keys() != computed.keys():
        return [f"other cases: {sorted(kept.keys() ^ computed.keys())}"]
    return [f"{path}: kept {kept[path]}, computed {computed[path]}" for path in kept
            if abs(computed[path] - kept[path]) > SAME * max(abs(kept[path]), 1e-3)]


def main(name, *options):
    try:
        module = importlib.import_module(name)
    except ModuleNotFoundError as error:
        print(f"skipped: {error.name} is not installed")
        return 77
    path, computed = FOLDER / f"{name}.json", module.compute()
    if "--record" in options:
        path.write_text(json.dumps(computed, indent=1) + "\n", "utf-8")
        return 0
    found = differences(json.loads(path.read_text("utf-8")), computed)
    print("\n".join(found) or f"{name}: as kept in {path.name}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.path.insert(0, str(FOLDER))
    sys.exit(main(*sys.argv[1:]))
