"""What was saved comes back: maps, numbers, settings, warnings, source."""

import io
import pickle
import pickletools
import subprocess

import numpy as np
import pytest

import tabor as tb

h5py = pytest.importorskip("h5py")
#: What a file does not say of a state.
NOT_STORED = {"tolerance", "lubricant_density_kg_per_m2", "escaping_fraction", "sliding_speed_m_per_s"}
SOLID = tb.Solid("aluminium-6016", saturation_pressure="300 MPa")


@pytest.fixture(scope="module")
def tile(scan_file):
    return tb.read(scan_file).level("plane").crop("96,96,64,64").mirror()


@pytest.fixture(scope="module")
def contacts(tile):
    return tb.contact(tile, ["2 MPa", "7 MPa"], SOLID, tolerance=1e-5)


@pytest.fixture(scope="module")
def films(tile):
    return tb.rain(tile, ["0.45 g/m^2", "0.9 g/m^2"], oil_density=850, seed=3)


def assert_same(found, given, *maps):
    assert type(found) is type(given)
    for name in maps:
        np.testing.assert_array_equal(getattr(found, name), getattr(given, name), err_msg=name)
    missing = {key for key, value in given.values.items() if key not in found.values or found.values[key] != value == value}
    assert missing <= NOT_STORED
    assert {one.code for one in found.warnings} == {one.code for one in given.warnings}
    assert set(given.references) <= set(found.references)


def assert_same_surface(found, given):
    np.testing.assert_array_equal(found.height, given.height)
    assert (found.history, found.source, found.periodic, found.lengths) == (given.history, given.source, given.periodic, given.lengths)


def test_contacts(contacts, tmp_path):
    tb.save(tmp_path / "a.h5", contacts, double=True)
    for found, given in zip(tb.load(tmp_path / "a.h5"), contacts, strict=True):
        assert_same(found, given, "pressure", "gap", "touching", "saturated", "patches")
        np.testing.assert_allclose(found.displacement, given.displacement, atol=given.values["contact_gap_error_m"] + 1e-18)
        assert_same_surface(found.surface, given.surface)
        assert found.solid == SOLID and found._options["tolerance"] == 1e-5 and found.converged
        assert (found.force, found.max_pressure) == (given.force, given.max_pressure)


def test_films_and_one_alone(films, tmp_path):
    tb.save(tmp_path / "a.h5", films, double=True)
    for found, given in zip(tb.load(tmp_path / "a.h5"), films, strict=True):
        assert_same(found, given, "thickness")
        assert found.lubricant_density == pytest.approx(given.lubricant_density, rel=1e-15) and found._options == given._options
    films[0].save(tmp_path / "b.h5")
    np.testing.assert_allclose(tb.load(str(tmp_path / "b.h5")).thickness, films[0].thickness, rtol=1e-6)


def test_frictions(contacts, films, tmp_path):
    given = [tb.friction(contact, film, boundary_shear_strength="5 MPa", dry_below="10 nm") for contact in contacts for film in films]
    tb.save(tmp_path / "a.h5", given, double=True)
    found = tb.load(tmp_path / "a.h5")
    for one, other in zip(found, given, strict=True):
        assert_same(one, other, "wet")
        np.testing.assert_array_equal(one.contact.pressure, other.contact.pressure)
        assert one.contact.solid == other.contact.solid and (one.dry, one.lubricated) == (other.dry, other.lubricated)
        assert {**one._options, "area": None} == other._options and one._options["area"] == "pixels"  # what was in force
    assert found[0].contact is found[1].contact and found[0].film is found[2].film
    with pytest.raises(KeyError, match="has no 'n_patches'"):
        found[0].contact.values["n_patches"]


def test_trapped_oil_and_a_flowing_film(contacts, films, tmp_path):
    trapped = tb.friction(contacts[1], films[1], trapped=True)
    trapped.save(tmp_path / "a.h5", double=True)
    assert_same(tb.load(tmp_path / "a.h5"), trapped, "liquid_pressure", "trapped_pressure", "trapped_gap")
    flowing = tb.fluid_film(contacts[0], films[1], tb.Lubricant("0.1 Pa s", pressure_viscosity=1e-8), "5 mm/s")
    flowing.save(tmp_path / "b.h5", double=True)
    found = tb.load(tmp_path / "b.h5")
    assert_same(found, flowing, "pressure", "fill", "gap", "solid_pressure")
    assert (found.lubricant, found.speed, found.friction_mixed, found.load_share) == (
        flowing.lubricant, flowing.speed, flowing.friction_mixed, flowing.load_share)


def test_what_is_loaded_computes_on(contacts, films, tmp_path):
    tb.save(tmp_path / "c.h5", contacts[1], double=True)
    tb.save(tmp_path / "f.h5", films[1], double=True)
    contact, film = tb.load(tmp_path / "c.h5"), tb.load(tmp_path / "f.h5")
    found = tb.friction(contact, film)
    assert found.lubricated == tb.friction(contacts[1], films[1]).lubricated
    assert dict(pickle.loads(pickle.dumps(contact)).values) == dict(contact.values)
    found.save(tmp_path / "again.h5")
    assert tb.load(tmp_path / "again.h5").dry == found.dry


def test_a_load_path_and_a_tool(rough, tmp_path):
    soft = tb.Solid(youngs_modulus="210 GPa", poissons_ratio=0.3, saturation_pressure="2 GPa", shear_strength="70 MPa")
    path = tb.contact(rough, [5e7, 2e8, 5e7], soft, load_path=True)
    tb.save(tmp_path / "a.h5", path, double=True)
    first, *later = tb.load(tmp_path / "a.h5")
    assert np.isfinite(first.displacement).all() and np.isnan(later[0].displacement).all()
    under = tb.contact(rough, "50 MPa", soft, tool="ground:Sa=10nm", tool_x="3 um")
    under.save(tmp_path / "b.h5", double=True)
    np.testing.assert_array_equal(tb.load(tmp_path / "b.h5").tool, under.tool)
    elastic = tb.Solid("aluminium-6016", saturation_pressure="none")
    tb.contact(rough, "50 MPa", elastic).save(tmp_path / "c.h5")
    assert tb.load(tmp_path / "c.h5").solid == elastic


def test_a_solution(tmp_path):
    pytest.importorskip("xarray")
    solved = tb.ehl.point(tb.ehl.template("point"), **{"grid.nodes": 33}).solve(check=False)
    solved.save(tmp_path / "a.h5")
    found = tb.load(tmp_path / "a.h5")
    for copy in (found, pickle.loads(pickle.dumps(found))):
        assert {key: value for key, value in solved.values.items() if value is not None} == {key: copy.values[key] for key in copy.values}
        assert (copy.program, copy.converged, copy.references) == ("point", solved.converged, solved.references)
        assert copy.to_xarray().identical(solved.to_xarray()) or list(copy.to_xarray()) == list(solved.to_xarray())
    assert "contact_film" in found.to_xarray() and "17.1 nm" in repr(found)
    with pytest.raises(ValueError, match="do not travel with a pickle"):
        pickle.loads(pickle.dumps(tb.ehl.squeeze(tb.ehl.template("squeeze")).solve())).to_xarray()


def test_a_sweep(tmp_path):
    pytest.importorskip("xarray")
    swept = tb.ehl.point(tb.ehl.template("point"), **{"grid.nodes": 33}).sweep(
        {"roughness.kind": ["lapped-like"], "motion.speed": ["0.1 m/s", "1 m/s"]}, check=False)
    swept.save(tmp_path / "a.h5")
    found = tb.load(tmp_path / "a.h5")
    for copy in (found, pickle.loads(pickle.dumps(found))):
        assert (dict(copy.axes), copy.columns, copy.references, copy.converged) == (dict(swept.axes), swept.columns, swept.references, swept.converged)
        assert [one.code for one in copy.warnings] == [one.code for one in swept.warnings]
        assert [row["warnings"] for row in copy.rows] == [row["warnings"] for row in swept.rows]
        for key, _, _ in swept.columns:
            np.testing.assert_array_equal(copy[key], swept[key])
        assert copy.to_xarray().equals(swept.to_xarray())
    with pytest.raises(ValueError, match="does not travel"):
        found.save(tmp_path / "b.h5")


def test_a_slide(tile, tmp_path):
    pytest.importorskip("xarray")
    given = tb.slide(tile, "7 MPa", SOLID, "4 um", step="0.67 um", every="1.34 um", density="0.9 g/m^2", tool="ground:Sa=0.1um", trapped=True)
    given.save(tmp_path / "a.h5", double=True)
    found = tb.load(tmp_path / "a.h5")
    for copy in (found, pickle.loads(pickle.dumps(found)), pickle.loads(pickle.dumps(given))):
        assert list(copy.states) == list(given.states) and "" not in copy.states
        for key, values in given.states.items():
            np.testing.assert_array_equal(copy.states[key], values, err_msg=key)
            assert copy.states[key].dtype == values.dtype
        assert {number: set(maps) for number, maps in copy.maps.items()} == {number: set(maps) for number, maps in given.maps.items()}
        np.testing.assert_array_equal(copy.after.height, given.after.height)
        assert (copy.after.history, copy.step, copy.steps, copy.steady, copy.converged) == (
            given.after.history, given.step, given.steps, given.steady, given.converged)
        assert {one.code for one in copy.warnings} == {one.code for one in given.warnings} and set(copy.references) == set(given.references)
        assert copy.to_xarray().equals(given.to_xarray())
        with pytest.raises(ValueError, match="does not travel"):
            tb.save(tmp_path / "b.h5", copy)


def test_a_slide_shows_where_it_ended_and_its_warnings(tile):
    given = tb.slide(tile, "7 MPa", SOLID, "2 um", step="0.67 um", density="0.9 g/m^2", tool="ground:Sa=0.1um")
    shown = repr(given)
    assert shown.startswith(f"Slide\n  distance             2.01 µm in {given.steps} steps\n")
    assert f"lubricated friction  {given.states['friction_lubricated'][-1]:.4g} at the end" in shown
    assert all(one.text in shown for one in given.warnings) and "<table>" in given._repr_html_()
    dry = repr(tb.slide(tile, "7 MPa", SOLID, "2 um", step="0.67 um", tool="ground:Sa=0.1um"))
    assert "dry friction" in dry and "lubricated" not in dry and "nan" not in dry


def test_a_slide_of_the_command_line(program, scan_file, tmp_path):
    subprocess.run([program, "slide", scan_file, "--level", "plane", "--crop", "96,96,32,32", "--mirror", "--pressure", "7MPa", "--material",
                    "aluminium-6016", "--tool", "ground:Sa=0.1um", "--distance", "2um", "-o", tmp_path / "a.h5", "--quiet"],
                   check=True, capture_output=True)
    found = tb.load(tmp_path / "a.h5")
    assert found.steps * found.step == pytest.approx(found.states["distance_m"][-1]) and found.after.history[-1].startswith("slide: ")


@pytest.mark.parametrize("options", [{"shift": (0, 0), "match": "none"}, {"mode": "difference"}, {"mode": "composite", "match": "none"}])
def test_a_combination(tile, options, tmp_path):
    given = tb.combine(tile, tile.apply(lambda z: np.minimum(z, 1e-6), "worn"), **options)
    given.save(tmp_path / "a.h5")
    found = tb.load(tmp_path / "a.h5")
    np.testing.assert_allclose(found.surface.height, given.surface.height, rtol=1e-6)
    registration = given.values["registration"]
    known = {**given.values, "registration": registration and {key: one for key, one in registration.items() if key != "correlation"}}
    assert dict(found.values) == {key: one for key, one in known.items() if one is not None or key == "registration"}
    assert (found.mode, found.warnings, found.references, found.worn) == (given.mode, given.warnings, given.references, given.worn)
    with pytest.raises(ValueError, match="ends with .h5"):
        given.save(tmp_path / "a.sdf")


def test_parameters_and_those_of_the_command_line(program, scan_file, tmp_path):
    given = tb.read(scan_file).level("plane").parameters()
    given.save(tmp_path / "a.json")
    run = subprocess.run([program, "params", scan_file, "--level", "plane", "--set", "all", "--json"], check=True, capture_output=True)
    (tmp_path / "b.json").write_bytes(run.stdout)
    for found in (tb.load(tmp_path / "a.json"), tb.load(tmp_path / "b.json")):
        assert [(one.symbol, one.unit, one.definition, one.set, one.note) for one in found.values()] == [
            (one.symbol, one.unit, one.definition, one.set, one.note) for one in given.values()]
        np.testing.assert_array_equal([*found.values()], [*given.values()])
        assert found.history == given.history and [one.code for one in found.warnings] == [one.code for one in given.warnings]
        assert found.source.endswith("edt_before.x3p")
    (tmp_path / "c.json").write_text("{}")
    with pytest.raises(tb.InputError, match="c.json: no parameters of one scan"):
        tb.load(tmp_path / "c.json")
    with pytest.raises(ValueError, match="ends with .json"):
        given.save(tmp_path / "a.h5")


def test_a_state_says_that_a_warning_was_gathered_from_all_states_of_its_file(tile, tmp_path):
    """A file has the codes of each state, and texts of all states together."""
    contacts = tb.contact(tile, ["2 MPa", "5 MPa", "7 MPa"], SOLID)
    tb.save(tmp_path / "a.h5", contacts)
    with h5py.File(tmp_path / "a.h5", "a") as file:
        file.attrs["warnings"] = ["Steep. [steep]", "Edges add 8 % (all 3 cases, the worst shown) [clamp]", "Seams (1 of 3 cases: 7 MPa (2nd)) [seam-load]"]
        file.attrs["warning_classes"] = ["doubt"] * 3
        for state, codes in zip(file["states"].values(), (["steep", "clamp"], ["clamp"], ["clamp", "seam-load"])):
            state.attrs["warning_codes"] = codes
    first, second, third = ([str(one) for one in state.warnings] for state in tb.load(tmp_path / "a.h5"))
    edges = "Edges add 8 % (all 3 cases of the file, the worst shown)"
    assert (first, second, third) == (["Steep.", edges], [edges], [edges, "Seams (1 of 3 cases of the file: 7 MPa (2nd))"])
    tb.save(tmp_path / "one.h5", contacts[0])
    assert [str(one) for one in tb.load(tmp_path / "one.h5").warnings] == [str(one) for one in contacts[0].warnings]


def test_what_a_file_does_not_hold_is_not_shown(contacts, films, tmp_path):
    tb.friction(contacts[0], films[0]).save(tmp_path / "a.h5")
    found = tb.load(tmp_path / "a.h5")
    shown = repr(found.film).splitlines()
    assert shown[:2] == ["Film", "  density    0.45 g/m²"] and not any("wet" in line for line in shown)
    assert "pressure" in repr(found.contact) and "0.45 g/m²" in found.film._repr_html_()


def test_a_study_by_its_folder_or_its_file(tile, tmp_path):
    given = tb.Study({"a": tile}, SOLID, pressure="7 MPa", density="0.9 g/m^2").run(tmp_path / "r")
    for name in ("r", "r/results.h5"):
        found = tb.load(tmp_path / name)
        assert (found.rows, found.warnings, found.answers) == (given.rows, given.warnings, given.answers)
    assert pickle.loads(pickle.dumps(given)).rows == given.rows
    with pytest.raises(FileNotFoundError, match="no results.csv"):
        tb.load(tmp_path)


def test_pickles_name_public_classes(contacts, films, tile):
    """So that they survive modules that are renamed; the classes of the extension module are named as such."""
    results = [contacts[0], films[0], tb.friction(contacts[0], films[0]), tile, tile.parameters("Sa"), tile.psd(), SOLID, tb.Lubricant(0.1),
               tb.density_curve(contacts[0]), tile.section((0, 0), (1e-5, 0)), contacts[0].warnings, tb.materials()]
    case = tb.ehl.squeeze(tb.ehl.template("squeeze"))
    results += [case, case.solve(), case.sweep({"lubricant.viscosity": [0.4]})]
    for one in results:
        _ = getattr(one, "values", None)  # kept once they were asked for
        names = {text for opcode, text, _ in pickletools.genops(pickle.dumps(one, 2)) if opcode.name == "GLOBAL"}
        assert not {name for name in names if name.startswith("tabor._") and not name.startswith("tabor._tabor ")}, type(one)


def test_the_command_line_s_own(program, scan_file, tmp_path):
    subprocess.run([program, "friction", scan_file, "--level", "plane", "--crop", "96,96,64,64", "--mirror", "--pressure", "2MPa", "--material",
                    "aluminium-6016", "--density", "0.9g/m^2", "-o", tmp_path / "a.h5", "--quiet"], check=True, capture_output=True)
    found = tb.load(tmp_path / "a.h5")
    assert found.contact.solid == tb.Solid("aluminium-6016") and found.film.lubricant_density == pytest.approx(9e-4)
    assert found.contact.surface.source.endswith("edt_before.x3p") and found.contact.surface.history[0].startswith("level=plane")


def test_open_files_and_surfaces(contacts, rough, tmp_path):
    contacts[0].save(tmp_path / "a.h5")
    assert tb.load(io.BytesIO((tmp_path / "a.h5").read_bytes())).area_fraction == contacts[0].area_fraction
    with open(tmp_path / "a.h5", "rb") as file:
        assert tb.load(file).area_fraction == contacts[0].area_fraction
    rough.save(tmp_path / "s.h5")
    np.testing.assert_array_equal(tb.load(tmp_path / "s.h5").height, rough.height)


def test_what_cannot_be_loaded_says_why(contacts, scan_file, tmp_path):
    contacts[0].save(tmp_path / "numbers.h5", fields="none")
    with h5py.File(tmp_path / "other.h5", "w") as file:
        file.attrs.update(format="tabor", kind="spectra")
    for file, text in (("numbers.h5", "numbers alone"), ("other.h5", "it holds spectra; load takes contacts"), (scan_file, "no result file")):
        with pytest.raises(tb.InputError, match=text):
            tb.load(tmp_path / file)
    with pytest.raises(FileNotFoundError, match="none.h5: no such file"):
        tb.load(tmp_path / "none.h5")


def test_fields_that_are_missing_are_gaps(contacts, tmp_path):
    contacts[0].save(tmp_path / "a.h5", fields="contact", double=True)
    found = tb.load(tmp_path / "a.h5")
    np.testing.assert_array_equal(found.touching, contacts[0].touching)
    assert np.isnan(found.gap).all()
