"""What documents show is what the package does."""

import doctest
import importlib
import inspect
import os
import pathlib
import re
import subprocess
import sys

import pytest

import tabor as tb
from conftest import ROOT


USED_BY_DOCUMENTS = ("h5py", "pandas", "xarray")  # what examples show is optional


def require(*names):
    """Skips a test where one of these packages is not installed."""
    for name in names:
        pytest.importorskip(name)


@pytest.fixture(autouse=True)
def in_the_root():
    before = pathlib.Path.cwd()
    os.chdir(ROOT)
    yield
    os.chdir(before)


@pytest.mark.parametrize("page", ["python.md", "first_hour.md"])
def test_the_session_of_the_page_prints_what_it_shows(page):
    require(*USED_BY_DOCUMENTS)
    found = doctest.testfile(str(ROOT / "docs" / page), module_relative=False, encoding="utf-8",
                             optionflags=doctest.REPORT_NDIFF)
    assert found.attempted > 15 and found.failed == 0


def names_in_hdf5(page):
    """(dataset, None) of h5read and (group, attribute) of h5readatt in the MATLAB of a page."""
    text = (ROOT / "docs" / page).read_text("utf-8")
    return re.findall(r"h5read(?:att)?\('friction.h5', '([^']+)'(?:, '([^']+)')?\)", text)


def test_the_page_for_matlab_names_what_a_file_holds(tmp_path):
    h5py = pytest.importorskip("h5py")
    sheet = tb.read("surfaces/edt_before.x3p").level("plane").crop(0, 0, 64, 64)
    film = tb.rain(sheet, "0.9 g/m^2")
    tb.save(tmp_path / "friction.h5", [tb.friction(one, film) for one in tb.contact(sheet, ["2 MPa", "7 MPa"], "aluminium-6016")])
    names = names_in_hdf5("from_matlab.md")
    assert len(names) > 7
    with h5py.File(tmp_path / "friction.h5") as file:
        for place, attribute in names:
            assert place in file, place
            assert not attribute or attribute in file[place].attrs, attribute


def test_the_pages_for_users_of_others_name_what_is_there():
    text = "".join((ROOT / "docs" / page).read_text("utf-8") for page in ("glossary.md", "from_tamaas.md", "from_gwyddion.md", "from_surfacetopography.md"))
    kinds = {"surface": tb.Surface, "contact": tb.Contact, "film": tb.Film, "friction": tb.Friction, "tb": tb}
    used = set(re.findall(r"\b(surface|contact|film|friction|tb)\.([a-zA-Z]\w*)", text))
    used = {one for one in used if one[1] not in ("engineering", "h5", "cavitation")}  # a web site, files, a key of case files
    assert len(used) > 30
    assert [f"{name}.{member}" for name, member in sorted(used) if not hasattr(kinds[name], member)] == []


def test_types_hold():
    pytest.importorskip("mypy")
    package = pathlib.Path(tb.__file__).parent
    if not (package / "_tabor.pyi").is_file():
        pytest.skip("the stub of the extension module is not built")
    checked = subprocess.run([sys.executable, "-m", "mypy", "--config-file", ROOT / "pyproject.toml", "--cache-dir",
                              os.devnull, package], capture_output=True, text=True, check=False)
    assert checked.returncode == 0, checked.stdout


def test_types_of_the_ten_tasks_hold(tmp_path):
    """As those of a user, who knows the package by its public names."""
    pytest.importorskip("mypy")
    package = pathlib.Path(tb.__file__).parent
    if not (package / "_tabor.pyi").is_file():
        pytest.skip("the stub of the extension module is not built")
    checked = subprocess.run([sys.executable, "-m", "mypy", "--config-file", ROOT / "pyproject.toml", "--strict", "--cache-dir", tmp_path,
                              ROOT / "python" / "tests" / "ten_tasks_test.py"], capture_output=True, text=True, check=False,
                             env={**os.environ, "MYPYPATH": os.fspath(package.parent)})
    assert checked.returncode == 0, checked.stdout


def test_every_step_has_a_method_and_a_type():
    types = (pathlib.Path(tb.__file__).parent / "_setting_types.py").read_text("utf-8")
    for name, _, text in tb._tabor.treatment_steps():
        assert text[1:] in getattr(tb.Surface, name).__doc__
        assert f"        def {name}(self, *" in types


def documented():
    """Public names and members with their docstrings, and modules."""
    for module in (tb, tb.ehl, *(importlib.import_module(f"tabor.{name}") for name in ("_guesses", "_values"))):
        yield module.__name__, module.__doc__
    for prefix, module in (("", tb), ("ehl.", tb.ehl)):
        for name in module.__all__:
            thing = getattr(module, name)
            yield prefix + name, thing.__doc__
            if isinstance(thing, type):
                yield from ((f"{prefix}{name}.{key}", getattr(getattr(thing, key), "__doc__", None)) for key in vars(thing) if not key.startswith("_"))


def test_examples_of_docstrings_hold():
    require(*USED_BY_DOCUMENTS)
    parser, runner = doctest.DocTestParser(), doctest.DocTestRunner(optionflags=doctest.REPORT_NDIFF)
    for name, text in documented():
        runner.run(parser.get_doctest(text or "", {}, name, None, 0))
    assert runner.tries > 25 and runner.failures == 0


#: Arguments with a unit that are typed by overloads.
DIMENSIONAL = ("pressure", "separation", "force", "density")


def functions():
    """Public functions by their names."""
    for prefix, module in (("tb.", tb), ("tb.ehl.", tb.ehl)):
        yield from ((prefix + name, thing) for name in module.__all__ if inspect.isfunction(thing := getattr(module, name)))


@pytest.mark.parametrize("name, function", functions())
def test_functions_say_arguments_units_result_and_an_example(name, function):
    sections = re.findall(r"^    ?(\w+)\n +-+$", function.__doc__, re.M)
    signature = inspect.signature(function)
    assert "Examples" in sections and ">>>" in function.__doc__
    assert ("Returns" in sections) == (signature.return_annotation != "None")
    text = re.sub(r"\s+", " ", function.__doc__)
    own = inspect.signature(inspect.unwrap(function)).parameters
    for argument in signature.parameters:
        assert re.search(rf"[ ,]{argument}(, \w+)* : ", text), argument
        if argument in own and ("Value" in own[argument].annotation or argument in DIMENSIONAL):  # settings_test.py asks the others
            entry = re.search(rf"[ ,]{argument}(, \w+)* : (.*?)(?= \w+(, \w+)* : | Returns )", text)[2]
            assert re.search(r"\[[^]]+\]", entry), f"{argument} has no unit"


def test_all_that_is_public_is_explained():
    for name in tb.__all__:
        thing = getattr(tb, name)
        assert name in ("Progress", "Value") or thing.__doc__, name
        if isinstance(thing, type):
            members = [value for key, value in vars(thing).items() if not key.startswith("_")]
            assert all(value.__doc__ for value in members if callable(value) or isinstance(value, property)), name


def test_the_readme_gives_a_friction_number():
    lines = (ROOT / "README.md").read_text("utf-8").splitlines()
    code = [line.removeprefix("    ") for line in lines if line.startswith(("    import tabor", "    sheet", "    pressed", "    oil", "    print("))]
    assert len(code) >= 5
    names = {}
    exec("\n".join(code), names)
    assert 0 < names["pressed"].area_fraction < 1
