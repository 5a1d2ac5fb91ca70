"""The notebooks of examples/ run as they are, without stored outputs."""

import os
import pathlib
import shutil

import pytest

import tabor as tb
from conftest import ROOT

nbformat = pytest.importorskip("nbformat")
nbclient = pytest.importorskip("nbclient")
pytest.importorskip("ipykernel")
for package in ("matplotlib", "pandas", "xarray", "h5netcdf", "jinja2"):
    pytest.importorskip(package)

NOTEBOOKS = sorted((ROOT / "examples" / "notebooks").glob("*.ipynb"))
SECONDS = 60  # of one notebook, so that a reader waits for none


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    """The folder of the notebooks beside what they read, so that none writes into the tree."""
    root = tmp_path_factory.mktemp("tree")
    shutil.copytree(ROOT / "examples", root / "examples")
    shutil.copytree(ROOT / "surfaces", root / "surfaces")
    return root / "examples" / "notebooks"


def test_there_are_some():
    assert [file.stem for file in NOTEBOOKS] == ["contact_of_a_scan", "lubricant_densities", "roughness_of_many_scans",
                                                 "sliding", "stribeck_curve"]


@pytest.mark.parametrize("file", NOTEBOOKS, ids=lambda file: file.stem)
def test_a_notebook_is_clean_and_runs(file, copy, monkeypatch):
    notebook = nbformat.read(file, as_version=4)
    nbformat.validate(notebook)
    cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert all(cell.outputs == [] and cell.execution_count is None for cell in cells)
    monkeypatch.setenv("PYTHONPATH", os.fspath(pathlib.Path(tb.__file__).parents[1]))
    monkeypatch.delenv("MPLBACKEND", raising=False)  # the kernel draws into the notebook
    nbclient.NotebookClient(notebook, timeout=SECONDS, kernel_name="python3",
                            resources={"metadata": {"path": os.fspath(copy)}}).execute()
    shown = [output for cell in cells for output in cell.outputs]
    assert not [output for output in shown if output.output_type == "stream" and output.name == "stderr"]
    assert sum("image/png" in output.get("data", {}) for output in shown) >= 2
