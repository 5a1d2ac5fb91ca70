"""tools/check/benchmarks finds the sections that were measured on other surfaces."""

import importlib.machinery
import importlib.util
import pathlib

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "tools/check/benchmarks"
loader = importlib.machinery.SourceFileLoader("check_benchmarks", str(SCRIPT))
check = importlib.util.module_from_spec(importlib.util.spec_from_loader("check_benchmarks", loader))
loader.exec_module(check)

PAGE = """# Benchmarks

## Old

Made by `tools/bench/old --record` on 2026-11-01; do not edit. 2 processors (some). Generated surfaces 0123abcd.

## New

Made by `tools/bench/new --record` on 2026-11-02; do not edit. 2 processors (some). Generated surfaces 89abcdef.

## On none

Made by `tools/bench/none --record` on 2026-11-01; do not edit. 2 processors (some).
"""

assert check.stale(PAGE, "89abcdef") == [("Old", "tools/bench/old --record")]
assert [title for title, _ in check.stale(PAGE, "ffffffff")] == ["Old", "New"]
assert check.stale("", "89abcdef") == []
