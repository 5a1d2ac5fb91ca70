"""Cases of films under load: the numbers and files of the command line."""

import json
import pickle
import subprocess

import numpy as np
import pytest

import tabor as tb
from conftest import ROOT


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "squeeze.toml"
    path.write_text(tb.ehl.template("squeeze"), "utf-8")
    return path


def test_numbers_are_those_of_the_command_line(program, file):
    run = subprocess.run([program, "ehl", "squeeze", file, "--json"], capture_output=True, text=True, check=True)
    told = json.loads(run.stdout)
    found = tb.ehl.squeeze(file).solve()
    assert found.values and all(told[key] == value for key, value in found.values.items() if "seconds" not in key)
    assert found.converged and found.facts[0][0] in repr(found)


def test_settings_override_keys(program, file):
    name = next(key.name for key in tb.ehl.keys("squeeze") if key.unit == "Pa s")
    run = subprocess.run([program, "ehl", "squeeze", file, "--set", f"{name}=0.2Pa*s", "--json"], capture_output=True,
                         text=True, check=True)
    found = tb.ehl.squeeze(file, **{name: "0.2 Pa*s"}).solve()
    told = json.loads(run.stdout)
    assert all(told[key] == value for key, value in found.values.items() if "seconds" not in key)
    assert dict(found.values) != dict(tb.ehl.squeeze(file).solve().values)


def test_a_quantity_of_pint_is_taken():
    pint = pytest.importorskip("pint")
    name = next(key.name for key in tb.ehl.keys("squeeze") if key.unit == "Pa s")
    words = tb.ehl.squeeze(tb.ehl.template("squeeze"), **{name: "0.2 Pa*s"}).solve()
    found = tb.ehl.squeeze(tb.ehl.template("squeeze"), **{name: pint.UnitRegistry()("200 mPa*s")}).solve()
    assert found.facts == words.facts


@pytest.mark.parametrize("name", ["impact", "squeeze", "line", "point"])
def test_a_template_is_a_case_and_so_are_its_keys(name):
    case = getattr(tb.ehl, name)(tb.ehl.template(name))
    assert pickle.loads(pickle.dumps(case)).toml == case.toml
    tomllib = pytest.importorskip("tomllib")
    again = getattr(tb.ehl, name)(tomllib.loads(case.toml))
    assert tomllib.loads(again.toml) == tomllib.loads(case.toml)


def test_its_file_is_that_of_the_command_line(program, file, tmp_path):
    h5py = pytest.importorskip("h5py")
    subprocess.run([program, "ehl", "squeeze", file, "-o", tmp_path / "a.h5"], capture_output=True, check=True)
    found = tb.ehl.squeeze(file).solve()
    found.save(tmp_path / "b.h5")
    with h5py.File(tmp_path / "a.h5") as theirs, h5py.File(tmp_path / "b.h5") as mine:
        names = []
        theirs.visititems(lambda name, thing: names.append(name) if isinstance(thing, h5py.Dataset) else None)
        assert names
        for name in names:
            np.testing.assert_array_equal(mine[name][()], theirs[name][()], err_msg=name)
        assert mine.attrs["kind"] == theirs.attrs["kind"] and mine.attrs["config_toml"] == theirs.attrs["config_toml"]
    assert tb.cite(tmp_path / "a.h5") == tb.cite(tmp_path / "b.h5")
    assert tb.cite(found).startswith("@software{tabor,")


def test_a_pickled_solution_has_its_numbers(file, tmp_path):
    found = tb.ehl.squeeze(file).solve()
    copy = pickle.loads(pickle.dumps(found))
    assert dict(copy.values) == dict(found.values) and copy.facts == found.facts
    with pytest.raises(ValueError, match="save it where it is solved"):
        copy.save(tmp_path / "a.h5")
    with pytest.raises(AttributeError, match="does not change"):
        copy.converged = False


def test_an_unknown_key_names_the_nearest(file):
    name = tb.ehl.keys("squeeze")[0].name
    with pytest.raises(ValueError, match=f"did you mean '{name}'"):
        tb.ehl.squeeze(file, **{name + "x": "1 m"})
    with pytest.raises(ValueError, match="impact, squeeze, line or point"):
        tb.ehl.keys("points")
    with pytest.raises(ValueError, match="none.toml"):
        tb.ehl.point("none.toml")
