"""The program behind `tabor report`: as a file it runs by any Python, with nothing of the package around it."""

import sys
import types
from pathlib import Path

if not __package__:  # this Python may lack the compiled module that `import tabor` needs
    bare = sys.modules["tabor"] = types.ModuleType("tabor")
    bare.__path__ = [str(Path(__file__).resolve().parents[1])]

from tabor.report import memory
from tabor.report.cli import main

memory.give_large_blocks_back()
sys.stdout.reconfigure(errors="surrogateescape")  # names of files are bytes
sys.exit(main(sys.argv[1:]))
