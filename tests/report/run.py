"""Runs one test module; exit code 77 and a message where a library of the report is absent."""

import sys
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "python")]

from tabor_report import dependencies


def main(names):
    missing = dependencies.missing_packages(dependencies.DEBIAN_PACKAGES)
    if missing:
        print(f"skipped: the report needs {' '.join(missing)} (apt install {' '.join(missing)})")
        return 77
    result = unittest.TextTestRunner(verbosity=2).run(unittest.defaultTestLoader.loadTestsFromNames(names))
    return 0 if result.wasSuccessful() and result.testsRun else 1


sys.exit(main(sys.argv[1:]))
