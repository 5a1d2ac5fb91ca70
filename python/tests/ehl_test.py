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


def test_numbers_are_si_where_a_key_has_a_unit():
    name = next(key.name for key in tb.ehl.keys("squeeze") if key.unit == "Pa s")
    words = tb.ehl.squeeze(tb.ehl.template("squeeze"), **{name: "0.2 Pa*s"}).solve()
    assert tb.ehl.squeeze(tb.ehl.template("squeeze"), **{name: np.float64(0.2)}).solve().facts == words.facts


@pytest.mark.parametrize("name", ["impact", "squeeze", "line", "point"])
def test_a_template_is_a_case_and_so_are_its_keys(name):
    case = getattr(tb.ehl, name)(tb.ehl.template(name))
    assert pickle.loads(pickle.dumps(case)).toml == case.toml
    tomllib = pytest.importorskip("tomllib")
    again = getattr(tb.ehl, name)(tomllib.loads(case.toml))
    assert tomllib.loads(again.toml) == tomllib.loads(case.toml)


def test_a_loaded_solution_shows_its_switches_as_words(file, tmp_path):
    pytest.importorskip("h5py")
    tb.ehl.squeeze(file).solve().save(tmp_path / "a.h5")
    facts = dict(tb.load(tmp_path / "a.h5").facts)
    assert facts["converged"] == facts["gap still closing at the turn"] == "yes"


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
    with pytest.raises(ValueError, match=r"expected a name that ends with \.h5 or \.hdf5"):
        found.save(tmp_path / "c.csv")
    assert not (tmp_path / "c.csv").exists()


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


@pytest.mark.parametrize("name", ["impact", "squeeze", "line", "point"])
def test_a_case_that_makes_no_sense_is_refused_when_it_is_made(name):
    make = getattr(tb.ehl, name)
    whole = tb.ehl.template(name)
    first = next(key for key in tb.ehl.keys(name) if key.usual == "required" or key.name == "ball.load")
    with pytest.raises(ValueError, match="missing|expected|given|give"):
        make({})
    for value in ("5 K", "-1 " + first.unit, "fast", float("nan"), object()):
        with pytest.raises((ValueError, TypeError), match=first.name.replace(".", r"\.")):
            make(whole, **{first.name: value})


def test_a_quantity_of_another_dimension_is_refused_when_the_case_is_made():
    pint = pytest.importorskip("pint")
    unit = pint.UnitRegistry()
    with pytest.raises(ValueError, match=r"lubricant\.viscosity: got 5 meter; expected a quantity in Pa s"):
        tb.ehl.squeeze(tb.ehl.template("squeeze"), **{"lubricant.viscosity": 5 * unit.m})
    with pytest.raises(ValueError, match="did you mean"):
        tb.ehl.squeeze(tb.ehl.template("squeeze"), **{"lubricant.viscocity": 5 * unit.Pa * unit.s})
    case = tb.ehl.squeeze(tb.ehl.template("squeeze"))
    found = case.sweep({"lubricant.viscosity": np.array([400, 500]) * unit.mPa * unit.s})
    assert found.axes == {"lubricant.viscosity": (0.4, 0.5)}


POINT = {"ball": {"radius": "1.5 mm", "load": "16.6 N"},
         "solids": {"e_prime": "230.8 GPa", "plastic_pressure": "4 GPa"},
         "lubricant": {"viscosity": "0.149 Pa s", "pressure_viscosity": "2.131e-8 1/Pa", "eyring_stress": "6.8 MPa"},
         "asperities": {"friction_coefficient": 0.12}, "motion": {"speed": "0.1 m/s"}, "grid": {"nodes": 33}}


@pytest.fixture(scope="module")
def case():
    return tb.ehl.point(POINT)


def test_a_sweep_is_that_of_the_command_line(program, case, tmp_path):
    (tmp_path / "ball.toml").write_text(case.toml, "utf-8")
    run = subprocess.run([program, "ehl", "point", tmp_path / "ball.toml", "--set", "lubricant.viscosity=0.1Pa*s,0.2Pa*s",
                          "--set", "motion.speed=0.1 m/s,0.3 m/s,1 m/s", "--json"], capture_output=True, text=True, check=True)
    told = json.loads(run.stdout)["results"]
    found = case.sweep({"lubricant.viscosity": ["0.1Pa*s", "0.2Pa*s"], "motion.speed": ["0.1 m/s", "0.3 m/s", "1 m/s"]})
    assert found.shape == (2, 3) and found.converged and len(found.rows) == len(told) == 6
    for row, other in zip(found.rows, told):
        assert all(other[key] == value for key, value in row.items() if key not in ("warnings", *found.axes))
    assert found.axes == {"lubricant.viscosity": (0.1, 0.2), "motion.speed": (0.1, 0.3, 1.0)}
    assert (np.diff(found["central_film_m"], axis=1) > 0).all() and (np.diff(found["central_film_m"], axis=0) > 0).all()


def test_numbers_and_words_are_axes(case):
    found = case.sweep({"roughness.kind": ["lapped-like", "polished-like"], "motion.speed": np.geomspace(1, 10, 2)})
    assert found.axes == {"roughness.kind": ("lapped-like", "polished-like"), "motion.speed": (1.0, 10.0)}
    assert found.rows[1]["roughness.kind"] == "lapped-like" and found.rows[1]["motion.speed"] == 10.0
    assert found["formulas.hamrock_dowson_central_film_m"].shape == (2, 2)
    assert "roughness.kind  lapped-like, polished-like" in repr(found) and "<table>" in found._repr_html_()
    with pytest.raises(KeyError, match="film"):
        found["film"]
    copy = pickle.loads(pickle.dumps(found))
    assert copy.rows == found.rows and tb.cite(copy) == tb.cite(found)


def without_heads(file):
    """Everything in a file but its command and date: {path: (attributes, values)}."""
    h5py = pytest.importorskip("h5py")
    found = {}
    with h5py.File(file) as opened:
        opened.visititems(lambda name, node: found.update({name: (
            {key: repr(value) for key, value in node.attrs.items() if "LIST" not in key},
            node[()].tolist() if isinstance(node, h5py.Dataset) else None)}))
        return found, opened.attrs["kind"], opened.attrs["config_toml"]


def test_a_sweep_is_saved_as_on_the_command_line(program, case, tmp_path):
    (tmp_path / "ball.toml").write_text(case.toml, "utf-8")
    subprocess.run([program, "ehl", "point", tmp_path / "ball.toml", "--set", "motion.speed=0.3 m/s,1 m/s",
                    "-o", tmp_path / "told.h5", "--csv", tmp_path / "told.csv"], capture_output=True, check=True)
    found = case.sweep({"motion.speed": ["0.3 m/s", "1 m/s"]})
    found.save(tmp_path / "found.h5")
    found.save(tmp_path / "found.csv")
    assert (tmp_path / "found.csv").read_bytes() == (tmp_path / "told.csv").read_bytes()
    assert without_heads(tmp_path / "found.h5") == without_heads(tmp_path / "told.h5")
    with pytest.raises(ValueError, match=r"expected a name that ends with \.h5, \.hdf5 or \.csv"):
        found.save(tmp_path / "found.txt")
    with pytest.raises(ValueError, match="does not travel with a pickle"):
        pickle.loads(pickle.dumps(found)).save(tmp_path / "copy.h5")
    with pytest.raises(OSError):
        found.save(tmp_path / "no" / "folder.h5")


def test_a_sweep_says_why_a_case_is_invalid(case):
    speeds = {"motion.speed": [-1, 1]}
    with pytest.raises(tb.NotConverged, match=r"1 of 2 cases is invalid \(.*motion.speed: got -1 m/s.*\); check=False"):
        case.sweep(speeds)
    bad, good = case.sweep(speeds, check=False).rows
    assert bad["status"] == "rejected" and "above zero" in bad["error"] and not bad["converged"]
    assert good["converged"] and "error" not in good


@pytest.fixture(scope="module")
def fine():
    return tb.ehl.point(tb.ehl.template("point"), **{"grid.nodes": 65})


def test_a_study_of_grids_is_that_of_the_command_line(program, fine, tmp_path):
    (tmp_path / "ball.toml").write_text(fine.toml, "utf-8")
    run = subprocess.run([program, "ehl", "point", tmp_path / "ball.toml", "--study", "grid", "--json"],
                         capture_output=True, text=True, check=True)
    told = json.loads(run.stdout)
    found = fine.study("grid")
    assert list(found.axes) == ["grid.nodes"] and found.axes["grid.nodes"] == tuple(sorted(found.axes["grid.nodes"]))
    for row, other in zip(found.rows, told["results"], strict=True):
        assert all(other[key] == value for key, value in row.items() if key not in ("warnings", "grid.nodes"))
    assert told["limits"].keys() == found.limits.keys()
    for key, limit in found.limits.items():
        for value, other in ((limit.value, told["limits"][key]), (limit.order, told["orders"][key])):
            assert value == other or (np.isnan(value) and other is None)
    assert np.isfinite(found.limits["min_film_m"].order) and "limit of smallest film" in repr(found)
    with pytest.raises(ValueError, match="did you mean 'grid'"):
        fine.study("gird")


def test_a_sweep_of_grids_has_limits_others_have_none(case, fine):
    grids = fine.sweep({"grid.nodes": [29, 45, 65]})
    films = grids["min_film_m"]
    assert 0 < abs(grids.limits["min_film_m"].value - films[2]) < abs(films[0] - films[2])
    assert case.sweep({"motion.speed": [0.5, 1.0]}).limits == {}


def test_a_sweep_goes_to_pandas_and_xarray(case):
    pytest.importorskip("pandas")
    pytest.importorskip("xarray")
    found = case.sweep({"motion.speed": [0.5, 1.0]})
    assert list(found.table["motion.speed"]) == [0.5, 1.0]
    maps = found.to_xarray()
    assert maps.central_film_m.sel({"motion.speed": 1.0}) == found["central_film_m"][1]
    assert maps.central_film_m.attrs["units"] == "m"


def test_values_of_a_sweep_have_their_units(case, tmp_path):
    pyplot = pytest.importorskip("matplotlib.pyplot")
    for package in ("h5py", "xarray"):
        pytest.importorskip(package)
    found = case.sweep({"motion.speed": ["0.5 m/s", "1 m/s"], "roughness.kind": ["lapped-like", "polished-like"]})
    found.save(tmp_path / "sweep.h5")
    for one in (found, tb.load(tmp_path / "sweep.h5"), pickle.loads(pickle.dumps(found))):
        assert "motion.speed    0.5, 1 m/s\n" in repr(one) and "roughness.kind  lapped-like, polished-like\n" in repr(one)
        assert one.plot(ax=pyplot.figure().gca()).get_xlabel() == "motion.speed [m/s]"
        pyplot.close()
        coords = one.to_xarray().coords
        assert coords["motion.speed"].attrs == {"units": "m/s"} and coords["roughness.kind"].attrs == {}


def test_a_solution_shows_no_empty_line(file):
    assert all(len(line.split()) > 1 for line in repr(tb.ehl.squeeze(file).solve()).splitlines())


def test_a_sweep_in_a_folder_goes_on(case, tmp_path):
    class Stop(Exception):
        pass

    seen = []

    def stop_late(stage, share, certificate):
        seen.append(stage)
        if any(tmp_path.glob("kept/*.h5")) or any(tmp_path.glob("kept/*/*.h5")):
            raise Stop

    speeds = {"motion.speed": list(np.geomspace(0.1, 10, 8))}
    with pytest.raises(Stop):
        tb.ehl.point({**POINT, "grid": {"nodes": 65}}).sweep(speeds, folder=tmp_path / "kept", progress=stop_late)
    rest = tb.ehl.point({**POINT, "grid": {"nodes": 65}}).sweep(speeds, folder=tmp_path / "kept")
    assert 0 < rest.n_computed < 8
    assert tb.ehl.point({**POINT, "grid": {"nodes": 65}}).sweep(speeds, folder=tmp_path / "kept").n_computed == 0
    assert rest.rows == tb.ehl.point({**POINT, "grid": {"nodes": 65}}).sweep(speeds).rows


@pytest.mark.parametrize("values, text", [({}, "got no key"), ({"motion.speed": "1 m/s"}, "expected a list of values"),
                                          ({"motion.speed": []}, "got an empty list"),
                                          ({"motion.sped": [1.0]}, "did you mean 'motion.speed'"),
                                          ({"motion.speed": [-1.0]}, "motion.speed")])
def test_sweeps_of_nothing_are_refused(case, values, text):
    with pytest.raises(ValueError, match=text):
        case.sweep(values)


def test_a_rough_film_is_saved_after_it_was_solved(case, tmp_path):
    h5py = pytest.importorskip("h5py")
    found = tb.ehl.point({**POINT, "roughness": {"kind": "lapped-like"}, "motion": {"speed": "1 m/s"}}).solve()
    for name in ("a.h5", "b.h5"):  # the film of the smooth bodies is solved for in each
        found.save(tmp_path / name)
    with h5py.File(tmp_path / "a.h5") as one, h5py.File(tmp_path / "b.h5") as other:
        names = set(one["along"])
        assert "film" in names and any("smooth" in name for name in names)
        for name in names:
            np.testing.assert_array_equal(one["along"][name][()], other["along"][name][()])
