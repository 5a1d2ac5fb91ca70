"""Runs one test module; exit code 77 and a message where a library of the report is absent."""

import sys
import types
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE)]
bare = sys.modules["tabor"] = types.ModuleType("tabor")  # this Python may lack the compiled module of the package
bare.__path__ = [str(HERE.parents[1] / "python/tabor")]

from tabor.report import dependencies


def main(names):
    missing = dependencies.missing_packages(dependencies.DEBIAN_PACKAGES)
    if missing:
        print(f"skipped: the report needs {' '.join(missing)} (apt install {' '.join(missing)})")
        return 77
    result = unittest.TextTestRunner(verbosity=2).run(unittest.defaultTestLoader.loadTestsFromNames(names))
    return 0 if result.wasSuccessful() and result.testsRun else 1


sys.exit(main(sys.argv[1:]))
