"""Figures and one self-contained HTML page from tabor's result files (schema: docs/results.md).

It stands on no other part of the package, whose compiled module the Python that draws may lack.
"""

import sys
import types


class _Report(types.ModuleType):
    """The function `tabor.report` has the name of this package: once it is imported, the package is called in its place."""

    def __call__(self, *arguments, **named):
        from tabor import _report

        return _report.report(*arguments, **named)


sys.modules[__name__].__class__ = _Report
