"""tools/check/processors finds numbers that differ, and numbers that are missing."""

import importlib.machinery
import importlib.util
import pathlib

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "tools/check/processors"
loader = importlib.machinery.SourceFileLoader("check_processors", str(SCRIPT))
check = importlib.util.module_from_spec(importlib.util.spec_from_loader("check_processors", loader))
loader.exec_module(check)

found = check.numbers({"a": [1, {"b": 2.5, "name": "x"}], "converged": True, "seconds": {"total": 3}, "none": None})
assert found == {"/a/0": 1.0, "/a/1/b": 2.5}, found
assert check.largest_difference(found, found)[0] == 0
assert check.largest_difference(found, {**found, "/a/1/b": 2.0}) == (0.2, "/a/1/b")
assert check.largest_difference({"/x": 0.0}, {"/x": 1e-9}) == (1.0, "/x")
assert check.largest_difference(found, {"/a/0": 1.0}) == (float("inf"), "/a/1/b")
