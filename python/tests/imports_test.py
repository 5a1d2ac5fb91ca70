"""Modules of the package stand on each other in one direction, imports inside functions included."""

import ast
import graphlib

import pytest

from conftest import ROOT

PACKAGE = ROOT / "python" / "tabor"


def name_of(file, package):
    parts = (package.name, *file.relative_to(package).with_suffix("").parts)
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def imported(file, name):
    """Full names of what a module imports, and of what it takes from there."""
    folder = name.split(".") if file.name == "__init__.py" else name.split(".")[:-1]
    for node in ast.walk(ast.parse(file.read_text("utf-8"))):
        if isinstance(node, ast.Import):
            yield from (one.name for one in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = ".".join([*(folder[:len(folder) - node.level + 1] if node.level else []), *([node.module] if node.module else [])])
            yield base
            yield from (f"{base}.{one.name}" for one in node.names)


def graph(package):
    """{module: modules of the package that it imports}; to stand inside a package is no import of it."""
    files = {name_of(file, package): file for file in package.rglob("*.py")}
    return {name: {other for other in imported(file, name) if other in files and not f"{name}.".startswith(f"{other}.")}
            for name, file in files.items()}


def order(package):
    return list(graphlib.TopologicalSorter(graph(package)).static_order())


def test_no_module_stands_on_itself():
    found = order(PACKAGE)
    assert len(found) > 20 and found.index("tabor._arguments") < found.index("tabor._contact") < found.index("tabor._save")


@pytest.mark.parametrize("line", ["from . import a", "from .a import x", "import toy.a", "def f():\n    from toy import a"])
def test_a_circle_is_found(tmp_path, line):
    package = tmp_path / "toy"
    package.mkdir()
    for name, text in (("__init__", "from . import a"), ("a", "from .b import y"), ("b", line)):
        (package / f"{name}.py").write_text(text)
    with pytest.raises(graphlib.CycleError, match="toy.a"):
        order(package)
