"""The notebooks of examples/ run as they are, and show what is stored in them."""

import os
import pathlib
import shutil

import pytest

import tabor as tb
from conftest import ROOT

nbformat = pytest.importorskip("nbformat")
nbclient = pytest.importorskip("nbclient")
pytest.importorskip("ipykernel")
for package in ("matplotlib", "pandas", "xarray", "h5netcdf", "jinja2", "ipywidgets"):
    pytest.importorskip(package)

NOTEBOOKS = sorted((ROOT / "examples" / "notebooks").glob("*.ipynb"))
SECONDS = 300  # of one cell: far more than any needs on a busy machine


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    """The folder of the notebooks beside what they read, so that none writes into the tree."""
    root = tmp_path_factory.mktemp("tree")
    shutil.copytree(ROOT / "examples", root / "examples")
    shutil.copytree(ROOT / "surfaces", root / "surfaces")
    return root / "examples" / "notebooks"


def test_there_are_some():
    assert [file.stem for file in NOTEBOOKS] == ["contact_of_a_scan", "lubricant_densities", "roughness_of_many_scans",
                                                 "sliders", "sliding", "stribeck_curve"]


def kinds_of(cell):
    """What a cell shows, without its numbers, which differ from machine to machine in the last digits."""
    kinds = [(output.output_type, output.get("name"), tuple(sorted(output.get("data", {})))) for output in cell.outputs]
    return list(dict.fromkeys(kinds))


@pytest.mark.parametrize("file", NOTEBOOKS, ids=lambda file: file.stem)
def test_a_notebook_runs_and_shows_what_is_stored(file, copy, monkeypatch):
    notebook = nbformat.read(file, as_version=4)
    nbformat.validate(notebook)
    cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
    stored = [kinds_of(cell) for cell in cells]
    assert not any("extent=(" in cell.source or "extent = [" in cell.source for cell in cells)  # a surface has its extent
    monkeypatch.setenv("PYTHONPATH", os.fspath(pathlib.Path(tb.__file__).parents[1]))
    monkeypatch.delenv("MPLBACKEND", raising=False)  # the kernel draws into the notebook
    nbclient.NotebookClient(notebook, timeout=SECONDS, kernel_name="python3",
                            resources={"metadata": {"path": os.fspath(copy)}}).execute()
    assert [kinds_of(cell) for cell in cells] == stored, "tools/notebooks stores what they show"
    shown = [output for cell in cells for output in cell.outputs]
    said = "".join(output.text for output in shown if output.output_type == "stream" and output.name == "stderr")
    assert "Warning: " not in said and ("Doubt: " in said or not said)
    assert sum("image/png" in output.get("data", {}) for output in shown) >= 2
