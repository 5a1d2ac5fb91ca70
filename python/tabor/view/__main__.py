"""The program behind `tabor view`. As a file it takes the compiled package that lies beside it or, where there is none,
that of the Python that runs it."""

import signal
import sys
from pathlib import Path

HERE = Path(__file__).absolute().parents[2]  # links are not followed: a build folder links to the sources

if not __package__ and any((HERE / "tabor").glob("_tabor*.so")):
    sys.path.insert(0, str(HERE))
try:
    from tabor.view.cli import main
except ImportError as error:
    print(f"tabor: view: the Python package tabor cannot be used by {sys.executable} ({error}); install it with 'pip install "
          "SOURCES[report]' and name its Python in TABOR_PYTHON", file=sys.stderr)
    sys.exit(3)
if __name__ == "__main__":
    for ending in (signal.SIGTERM, signal.SIGHUP):  # as Ctrl-C: the server ends, its temporary folder goes
        signal.signal(ending, signal.default_int_handler)
    sys.exit(main(sys.argv[1:]))
