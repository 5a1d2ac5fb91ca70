"""`tabor view SCAN...`: its options, and how it ends."""

from __future__ import annotations

import argparse
import json
import sys
import warnings
from collections.abc import Sequence
from typing import Any, NoReturn

from .. import Doubt, set_threads
from .state import State

DONE, USAGE, INPUT, INTERRUPTED = 0, 2, 3, 130
_READING = {"channel": "NAME", "pixel": "DX[,DY]", "unit": "UNIT", "z_scale": "LENGTH"}
EXAMPLES = """examples:
  tabor view surfaces/edt_before.x3p
  tabor view surfaces/edt_before.x3p surfaces/edt_after.x3p --step level=plane --no-browser
"""


class _Usage(Exception):
    """A word that no option takes."""


class _Parser(argparse.ArgumentParser):
    """Says what is wrong in one line, as tabor does."""

    def error(self, message: str) -> NoReturn:
        raise _Usage(message)


def main(arguments: Sequence[str]) -> int:
    """Serves the workbench until the last page closes. Exit code: 0 done, 2 usage, 3 unreadable input or missing library,
    130 interrupted."""
    try:
        options = _parser().parse_args(arguments)
        return _serve(options)
    except _Usage as error:
        return _fail(str(error), USAGE)
    except ImportError as error:
        return _fail(f"view: {error}", INPUT)
    except (ValueError, OSError, TypeError, OverflowError) as error:
        return _fail(str(error), INPUT)
    except KeyboardInterrupt:
        return INTERRUPTED


def _serve(options: argparse.Namespace) -> int:
    import_bokeh()
    from .opening import opened
    from .server import View, can_show

    warnings.simplefilter("ignore", Doubt)  # the page shows them
    set_threads(options.threads)
    view = View([opened(_state(file, options)) for file in options.scans], options.port, options.keep)
    try:
        _say(view.url, options)
        if not options.no_browser and can_show():
            view.show()
        view.wait()
    finally:
        view.close()
    return DONE


def import_bokeh() -> None:
    """Raises ImportError that says how to get Bokeh where it is absent."""
    try:
        import bokeh.server  # noqa: F401
    except ImportError:
        is_own = sys.prefix != sys.base_prefix  # Debian's Python takes packages of others in an environment alone
        how = (f"{sys.executable} -m pip install 'bokeh>=3.9,<4'" if is_own else
               "python3 -m venv --system-site-packages ENV && ENV/bin/pip install 'bokeh>=3.9,<4', then TABOR_PYTHON=ENV/bin/python3")
        raise ImportError(f"{sys.executable} has no Bokeh; {how}") from None


def _say(url: str, options: argparse.Namespace) -> None:
    if options.json_head is None:
        print(url, flush=True)
    else:
        print(json.dumps({**json.loads(options.json_head), "url": url, "warnings": []}, ensure_ascii=False), flush=True)
    if options.step and options.json_head is None:
        print("treatment: " + ", ".join(options.step), file=sys.stderr, flush=True)


def _state(file: str, options: argparse.Namespace) -> State:
    given = [(name, getattr(options, name)) for name in _READING if getattr(options, name) is not None]
    given += [("override_unit", "True")] if options.override_unit else []
    settings = dict(one.split("=", 1) for one in options.setting)
    tool = settings.pop("tool", "")
    return State(file, tuple(given), tool=tool, settings=tuple(settings.items())).adding(*options.step)


def _fail(text: str, code: int) -> int:
    print(f"tabor: {' '.join(text.split())}", file=sys.stderr)
    return code


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(prog="tabor view", epilog=EXAMPLES, formatter_class=argparse.RawDescriptionHelpFormatter,
                     description="Opens scans in a workbench in the browser, on this machine alone.")
    parser.add_argument("scans", metavar="SCAN", nargs="+", help="scan files, see 'tabor formats'")
    parser.add_argument("--port", type=int, default=0, metavar="N", help="port of 127.0.0.1 [any that is free]")
    parser.add_argument("--no-browser", action="store_true", help="print the address and open no browser")
    parser.add_argument("--keep", action="store_true", help="go on when the last page closes")
    parser.add_argument("--step", action="append", default=[], metavar="STEP", help="step of the treatment to begin with, such as level=plane")
    parser.add_argument("--setting", action="append", default=[], metavar="NAME=VALUE", help="setting of contact, oil or friction by its name in Python, such as seed=7")
    for name, placeholder in _READING.items():
        parser.add_argument(f"--{name.replace('_', '-')}", metavar=placeholder, help="as of 'tabor info'")
    parser.add_argument("--override-unit", action="store_true", help="as of 'tabor info'")
    parser.add_argument("--threads", type=int, default=0, metavar="N", help="threads to use [all cores]")
    parser.add_argument("--json-head", help=argparse.SUPPRESS)
    return parser
