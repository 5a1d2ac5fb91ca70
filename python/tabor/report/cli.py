"""`tabor report DIR|RESULTS.h5`: its options, and how it ends."""

import argparse
import os
import shlex
import sys

from tabor.report import dependencies, units
from tabor.report.errors import InputError, ReportError, UsageError, printable

EXAMPLES = """examples:
  tabor report study/                                    report.html in study/
  tabor report contact.h5 -o contact_page --figures pdf  page and figures in contact_page/
"""

FORMATS = ("png", "svg", "pdf")


def main(arguments):
    """Exit code: 0 done, 2 usage, 3 unreadable input or missing library, 5 cannot write."""
    try:
        options = _parser().parse_args(arguments)
        _convert(options)
        given = {name: value for name, value in vars(options).items() if name != "quiet"}
        for path in make(**given, command=shlex.join(["tabor", "report", *arguments])):
            if not options.quiet:
                print(path)
        return 0
    except ReportError as error:
        print(f"tabor report: {printable(error)}", file=sys.stderr)
        return error.exit_code


def make(result, output=None, *, html=True, static=False, figures=None, scan=None, all_scans=False, pressure=None,
         density=None, error_bar=None, command=""):
    """Paths of the figures, tables and page written; raises ReportError.

    figures: their formats, as "png,svg" [none, without a page PNG and SVG]; pressure [Pa], density [g/m^2]."""
    dependencies.require(["numpy", "h5py", "matplotlib"] + (["jinja2"] if html else []))
    options = argparse.Namespace(html=html, static=static, figures=_formats(figures, html), scan=scan,
                                 all_scans=all_scans, pressure=pressure, density=density, error_bar=error_bar)
    try:
        return _run(result, output, options, command)
    except ReportError:
        raise
    except Exception as error:
        # Files that are damaged, or lack what a result has, end in any of Python's errors.
        if "TABOR_TRACEBACK" in os.environ:
            raise
        reason = " ".join(f"{type(error).__name__}: {error}".split())
        raise InputError(
            f"{result}: got a file that cannot be drawn ({reason[:300]}); expected a whole result of "
            "tabor; compute it again (TABOR_TRACEBACK=1 says where it failed)"
        ) from None


def _run(result, output, options, command):
    # Imported late: these modules need the libraries that were just checked.
    from tabor.report import guard, hdf

    guard.forget()  # a file may have changed since another page was made
    hdf.begin(result)  # it is tried while this process imports the rest
    try:
        from tabor.report import applicable, build, interactive

        if interactive.is_asked_for(options):
            interactive.load()
    except Exception:
        guard.forget()
        raise
    source = build.open_result(result)
    with source.file:
        applicable.check(source, options)
        options.error_bar = options.error_bar or "std"
        return build.build(source, output or build.default_folder(source), options, command)


def _convert(options):
    options.pressure = None if options.pressure is None else units.parse_pressure(options.pressure)
    options.density = None if options.density is None else units.parse_density(options.density)


def _formats(figures, html):
    """'png,svg' -> ['png', 'svg']; none where only the page is asked for."""
    if figures is None:
        return [] if html else ["png", "svg"]
    formats = figures.split(",")
    if any(part not in FORMATS for part in formats):
        raise UsageError(f"--figures: got '{figures}'; expected png, svg, pdf or several of them, as png,svg")
    return list(dict.fromkeys(formats))


class _Parser(argparse.ArgumentParser):
    """Says what is wrong in one line, as tabor does."""

    def error(self, message):
        raise UsageError(message)


def _parser():
    parser = _Parser(
        prog="tabor report",
        epilog=EXAMPLES,
        description="Figures and one self-contained HTML page from a result of tabor.",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "result", metavar="DIR|RESULTS.h5", help="folder of `tabor sweep`, or a file written with -o"
    )
    parser.add_argument("-o", "--output", metavar="DIR", help="where to write (default: beside the result)")
    parser.add_argument(
        "--figures",
        metavar="FORMATS",
        help="write figures and their tables to figures/: png, svg, pdf or several, as png,svg",
    )
    parser.add_argument(
        "--static", action="store_true", help="a page of still figures, as where Bokeh or Pillow is absent"
    )
    parser.add_argument(
        "--no-html", dest="html", action="store_false", help="figures and tables only [--figures png,svg]"
    )
    parser.add_argument("--scan", type=int, metavar="N", help="scan that the maps show, counted from 0")
    parser.add_argument("--all-scans", action="store_true", help="maps of every scan")
    parser.add_argument(
        "--pressure", metavar="P", help="pressure that the maps show, such as 7MPa (nearest computed)"
    )
    parser.add_argument(
        "--density", metavar="D", help="lubricant density that the maps show, such as 0.45g/m^2"
    )
    parser.add_argument(
        "--error-bar",
        choices=("std", "sem"),
        help="standard deviation (default) or standard error of the mean",
    )
    parser.add_argument("--quiet", action="store_true", help="do not list the written files")
    return parser
