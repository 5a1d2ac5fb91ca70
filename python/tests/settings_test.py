"""Arguments of functions are those of the library's tables, each with its type, unit, default and documentation."""

import inspect
import os
import pathlib
import pickle
import re
import subprocess
import sys
import textwrap

import pytest

import tabor as tb
from conftest import ROOT
from tabor import _settings
from tabor._settings import (
    CONTACT,
    CURVE,
    DRY_BELOW,
    OF_SCANS,
    OIL,
    PIXELS,
    RAIN,
    READ,
    RECIPE,
    SHEAR,
    SLIDE,
    SOLID,
    STUDY,
    TRAPPED,
)

#: Functions, what documents them, and the settings that they take.
TAKERS = {"contact": (tb.contact, tb.contact, CONTACT), "rain": (tb.rain, tb.rain, RAIN), "friction": (tb.friction, tb.friction, SHEAR + DRY_BELOW + TRAPPED),
          "slide": (tb.slide, tb.slide, SLIDE),
          "fluid_film": (tb.fluid_film, tb.fluid_film, SHEAR), "density_curve": (tb.density_curve, tb.density_curve, CURVE),
          "generate": (tb.generate, tb.generate, PIXELS + RECIPE), "Solid": (tb.Solid.__init__, tb.Solid, SOLID),
          "read": (tb.read, tb.read, READ), "Scans": (tb.Scans.__init__, tb.Scans, OF_SCANS),
          "Lubricant": (tb.Lubricant.__init__, tb.Lubricant, OIL), "Study": (tb.Study.__init__, tb.Study, STUDY)}

each = pytest.mark.parametrize("function, documented, settings", TAKERS.values(), ids=TAKERS)


def plain(text):
    return re.sub(r"\s+", " ", text)


def test_every_setting_is_an_argument_of_some_function():
    taken = {(one.table, one.name) for _, _, settings in TAKERS.values() for one in settings}
    lists = {("film", "lubricant_density"), ("fluid", "sliding_speed"), ("fluid", "fluid"), ("slide", "distance"), ("slide", "maps_at")}  # arguments of their own
    assert {(one.table, one.name) for one in _settings._ALL} - taken == lists


@each
def test_signatures_have_every_setting_with_its_default_and_unit(function, documented, settings):
    parameters = inspect.signature(function).parameters
    for one in settings:
        found = parameters[one.argument]
        if found.default is not found.empty:
            assert found.default == one.shown_default, one
            assert found.annotation == ("str | int | None" if one.name == "channel" else one.hint), one
            assert one.unit == "" or f'"{one.unit}"' in found.annotation
    assert not {"settings", "more"} & set(parameters)


@each
def test_documentation_has_every_setting_with_its_unit_and_default(function, documented, settings):
    text = plain(documented.__doc__)
    for one in settings:
        assert f" {one.argument} : {plain(one.help)}" in text, one
        assert one.unit == "" or f"[{one.unit}]" in one.documentation
        assert plain(one.documentation) in text
    assert "**settings" not in text


@each
def test_a_wrong_name_is_refused_with_the_nearest(function, documented, settings):
    for one in settings:
        wrong = one.argument + "x"
        with pytest.raises(TypeError, match=rf"\(\) got an unexpected keyword argument '{wrong}'; did you mean '\w+'\?"):
            documented(**{wrong: 1})


def values():
    """Settings with what has another dimension than theirs."""
    for name, (_, _, settings) in TAKERS.items():
        for one in settings:
            if one.kind == "number":
                yield pytest.param(one, "1 kg", id=f"{name}-{one.argument}")


@pytest.mark.parametrize("setting, wrong", list(values()))
def test_another_dimension_is_refused_by_name(setting, wrong):
    with pytest.raises(ValueError, match=f"{setting.argument}: got '{wrong}'"):
        setting.taken(wrong)


def test_a_lubricant_takes_its_settings_by_place_too():
    assert tb.Lubricant("0.1 Pa s", 1e-8, "5 MPa") == tb.Lubricant(eyring_stress=5e6, viscosity=0.1, pressure_viscosity="1e-8 1/Pa")
    with pytest.raises(TypeError, match="multiple values for argument 'pressure_viscosity'"):
        tb.Lubricant(0.1, 1e-8, pressure_viscosity=1e-8)
    with pytest.raises(TypeError, match=r"Lubricant\(\) takes 3 arguments by position \(viscosity, pressure_viscosity, eyring_stress\); got 4$"):
        tb.Lubricant(0.1, 1e-8, 5e6, 1)


def test_values_of_solids_and_oils_are_those_of_the_tables(steel):
    assert [one for one in vars(steel) if one != "material"] == [one.name for one in SOLID]
    assert repr(steel) == ("Solid(youngs_modulus=210000000000.0, poissons_ratio=0.3, saturation_pressure=2000000000.0, "
                           "shear_strength=300000000.0, counter_youngs_modulus=None, counter_poissons_ratio=None, material='')")
    assert pickle.loads(pickle.dumps(steel)) == steel
    with pytest.raises(AttributeError):
        steel.youngs_modulus = 1.0


CHECKED = """
    import tabor as tb

    surface = tb.generate("edt", pixels=16, waviness="0.1 um", stage="after")
    solid = tb.Solid(youngs_modulus="70 GPa", poissons_ratio=0.33)
    one: tb.Contact = tb.contact(surface, "7 MPa", solid, boundary="periodic", tolerance=1e-6)
    oil = tb.Lubricant("0.1 Pa s", 1e-8, eyring_stress="5 MPa")
    viscosity: float = oil.viscosity
    film: tb.Film = tb.rain(surface, "0.45 g/m^2", seed=2)
    friction = tb.friction(one, film, area="pixels")
"""


@pytest.fixture(scope="module")
def mypy_says(tmp_path_factory):
    """What a type checker says of a user's lines below those that are right."""
    pytest.importorskip("mypy")
    package = pathlib.Path(tb.__file__).parent
    if not (package / "_tabor.pyi").is_file():
        pytest.skip("the stub of the extension module is not built")
    folder = tmp_path_factory.mktemp("checked")

    def said(line=""):
        (folder / "user.py").write_text(textwrap.dedent(CHECKED) + line, "utf-8")
        run = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--no-error-summary", "--cache-dir", folder / "cache", folder / "user.py"],
                             capture_output=True, text=True, check=False, cwd=folder, env={**os.environ, "MYPYPATH": str(package.parent)})
        return [text for text in run.stdout.splitlines() if "user.py" in text]

    return said


def test_a_type_checker_takes_right_calls(mypy_says):
    assert mypy_says() == []


@pytest.mark.parametrize("line, text", [
    ("tb.contact(surface, 1e6, solid, boundry='free')", "boundry"), ("tb.contact(surface, 1e6, solid, boundary='fre')", "boundary"),
    ("tb.rain(surface, 0, edge='shut')", "edge"), ("tb.generate('edt', stage='later')", "stage"),
    ("tb.Solid(youngs_modulos=1)", "youngs_modul"), ("tb.Lubricant()", "Lubricant|viscosity"), ("tb.Study({}, solid, load_path=True)", "load_path")])
def test_a_type_checker_refuses_wrong_ones(mypy_says, line, text):
    assert re.search(text, "\n".join(mypy_says(line)))


def test_the_types_are_made_of_the_tables():
    package = pathlib.Path(tb.__file__).parent
    made = (package / "_setting_types.py").read_text("utf-8")
    for _, _, settings in TAKERS.values():
        for one in settings:
            assert f"    {one.argument}: {one.hint}\n" in made or one.argument in ("viscosity", "channel"), one
    assert not (ROOT / "python" / "tabor" / "_setting_types.py").exists()
