"""A report of Python is that of the command line."""

import pathlib
import subprocess
import sys

import pytest

import tabor as tb
from tabor import _optional

pytest.importorskip("h5py")
pytest.importorskip("jinja2")
matplotlib = pytest.importorskip("matplotlib")


@pytest.fixture(scope="module")
def pressed(rough, steel):
    return tb.contact(rough, ["50 MPa", "80 MPa"], steel)


def test_a_result_is_saved_beside_its_page(pressed, tmp_path):
    found = tb.report(pressed, tmp_path / "page", figures="png,svg")
    assert found.page == tmp_path / "page" / "report.html" and all(file.is_file() for file in found.files)
    assert "polonsky1999" in found.page.read_text("utf-8") and "tabor.report(" in found.page.read_text("utf-8")
    assert {file.suffix for file in found.files} == {".png", ".svg", ".csv", ".html"}
    assert tb.read(tmp_path / "page" / "result.h5").shape == (32, 32)
    assert "report.html" in repr(found) and "<a href" in found._repr_html_()


def test_figures_are_those_of_the_command_line(program, pressed, tmp_path):
    tb.save(tmp_path / "a.h5", pressed)
    mine = tb.report(tmp_path / "a.h5", html=False)
    assert mine.page is None and {file.parent for file in mine.files} == {tmp_path / "a_report" / "figures"}
    run = subprocess.run([program, "report", tmp_path / "a.h5", "-o", tmp_path / "theirs", "--no-html", "--quiet"],
                         capture_output=True, text=True, check=False)
    if run.returncode and "apt install" in run.stderr:
        pytest.skip("no libraries for the report of the program")
    assert run.returncode == 0, run.stderr
    for file in mine.files:
        if file.suffix == ".csv":  # pictures depend on the Matplotlib of either
            assert file.read_bytes() == (tmp_path / "theirs" / "figures" / file.name).read_bytes()


def test_a_study_and_its_options(scan_file, steel, tmp_path):
    study = tb.Study({"a": scan_file}, steel, pressure=[2e7, 5e7], density=[0, "0.9 g/m^2"],
                     treatment=["level=plane", "crop=0,0,64,64"])
    found = tb.report(study.run(tmp_path / "results"), tmp_path / "page", pressure="50 MPa", density="0.9 g/m^2",
                      error_bar="sem", all_scans=True)
    assert found.page == tmp_path / "page" / "report.html"
    with pytest.raises(ValueError, match="--scan 7: the study has scans 0 to 0"):
        tb.report(tmp_path / "results", tmp_path / "other", scan=7)


def test_a_film_under_load(tmp_path):
    found = tb.report(tb.ehl.squeeze(tb.ehl.template("squeeze")).solve(), tmp_path)
    assert "squeeze" in found.page.read_text("utf-8")


def test_films_swept(tmp_path):
    swept = tb.ehl.squeeze(tb.ehl.template("squeeze")).sweep({"roller.speed": ["0.2 m/s", "0.25 m/s"]})
    found = tb.report(swept, tmp_path)
    assert "sweep" in found.page.read_text("utf-8") and (tmp_path / "result.h5").is_file()


def test_figures_of_the_user_stay_as_they_are(pressed, tmp_path):
    before = dict(matplotlib.rcParams), matplotlib.get_backend()
    tb.report(pressed, tmp_path)
    assert (dict(matplotlib.rcParams), matplotlib.get_backend()) == before


def test_what_cannot_be_reported_is_refused(pressed, tmp_path):
    with pytest.raises(ValueError, match="give out, the folder to write to"):
        tb.report(pressed)
    for of_file in (tb.report, tb.cite, tb.FrictionTable):
        with pytest.raises(tb.InputFileNotFound, match=r"none\.h5: no such file"):
            of_file(tmp_path / "none.h5")
    with pytest.raises(TypeError, match="result: got int"):
        tb.report(7)
    with pytest.raises(ValueError, match="error_bar: got 'all'"):
        tb.report(pressed, tmp_path, error_bar="all")
    with pytest.raises(ValueError, match="--scan chooses among the cases of a study"):
        tb.report(pressed, tmp_path, scan=0)
    (tmp_path / "file").write_text("in the way")
    pressed[0].save(tmp_path / "a.h5")
    with pytest.raises(OSError, match="cannot be made"):
        tb.report(tmp_path / "a.h5", tmp_path / "file" / "below")


def test_missing_libraries_are_named(monkeypatch, pressed, tmp_path):
    found = _optional.importlib.util.find_spec
    monkeypatch.setattr(_optional.importlib.util, "find_spec",
                        lambda name: None if name in ("jinja2", "matplotlib") else found(name))
    with pytest.raises(ImportError, match=r"report needs matplotlib and jinja2; pip install tabor\[report\]"):
        tb.report(pressed, tmp_path)


@pytest.mark.parametrize("line", ["import tabor.report.cli", "from tabor_report import cli", "from tabor.report import cli"])
def test_the_function_stays_callable_beside_the_package_of_its_name(line, tmp_path):
    lines = f"import tabor as tb\n{line}\ntry:\n    tb.report({str(tmp_path / 'none.h5')!r})\nexcept ValueError as error:\n    print(error)"
    run = subprocess.run([sys.executable, "-c", lines], capture_output=True, text=True, check=True)
    assert "none.h5: no such file" in run.stdout


def test_drawing_imports_nothing_of_the_package_around_it():
    package = pathlib.Path(tb.__file__).parent
    program = ("import sys, types; sys.modules['tabor'] = types.ModuleType('tabor'); sys.modules['tabor'].__path__ = [sys.argv[1]]\n"
               "import tabor.report.build, tabor.report.live_page; print(*(name for name in sys.modules if name.startswith('tabor')))")
    run = subprocess.run([sys.executable, "-c", program, package], capture_output=True, text=True, check=True)
    assert [name for name in run.stdout.split() if not name.startswith("tabor.report")] == ["tabor"]
