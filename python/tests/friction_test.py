"""Films and friction: the same bits as the command line, the limits that need no computer, refusals."""

import json
import pickle
import subprocess
import time

import numpy as np
import pytest

import tabor as tb
from conftest import heights

#: Of the work, not of the result.
CLOCKS = {"seconds", "fft_seconds", "peak_memory_bytes"}


def told_by(program, *words):
    """The states of a verb's --json."""
    run = subprocess.run([program, *map(str, words), "--json"], capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
    return json.loads(run.stdout)["states"]


def assert_same(record, state):
    for key, value in state.items():
        if key not in CLOCKS:
            assert record.values[key] == value, key


def test_friction_is_that_of_the_command_line_to_the_last_bit(program, scan_file):
    states = told_by(program, "friction", scan_file, "--level", "plane", "--crop", "0,0,128,128", "--pressure",
                     "2MPa,7MPa", "--material", "aluminium-6016", "--density", "0.45g/m^2,0.9g/m^2",
                     "--boundary-shear-strength", "5MPa", "--seed", "3")
    surface = tb.read(scan_file).level("plane").crop("0,0,128,128")
    films = tb.rain(surface, ["0.45 g/m^2", "0.9 g/m^2"], seed=3)
    found = [tb.friction(contact, film, boundary_shear_strength="5 MPa")
             for contact in tb.contact(surface, ["2 MPa", "7 MPa"], tb.Solid("aluminium-6016")) for film in films]
    assert len(found) == len(states) == 4
    for record, state in zip(found, states):
        assert_same(record, state)
        assert state["friction_dry"] == record.dry and state["friction_lubricated"] == record.lubricated


def test_contact_is_that_of_the_command_line_to_the_last_bit(program, scan_file):
    states = told_by(program, "contact", scan_file, "--level", "plane", "--crop", "0,0,100,90", "--pressure", "7MPa",
                     "--youngs-modulus", "70GPa", "--poisson-ratio", "0.33", "--boundary", "free")
    surface = tb.read(scan_file).treat("level=plane", "crop=0,0,100,90")
    solid = tb.Solid(youngs_modulus="70 GPa", poissons_ratio=0.33)
    assert_same(tb.contact(surface, 7e6, solid, boundary="free"), states[0])


def test_a_flowing_film_is_that_of_the_command_line_to_the_last_bit(program, scan_file):
    treatment = ["--level", "plane", "--crop", "96,96,64,64", "--mirror"]
    states = told_by(program, "friction", scan_file, *treatment, "--pressure", "2MPa", "--material", "aluminium-6016",
                     "--density", "0.9g/m^2", "--fluid", "reynolds", "--speed", "5mm/s", "--viscosity", "0.225Pa*s")
    surface = tb.read(scan_file).level("plane").crop("96,96,64,64").mirror()
    dry = tb.contact(surface, "2 MPa", tb.Solid("aluminium-6016"))
    found = tb.fluid_film(dry, tb.rain(surface, "0.9 g/m^2"), tb.Lubricant(viscosity="0.225 Pa s"), speed="5 mm/s")
    assert_same(found, states[0])
    assert found.friction_mixed == states[0]["friction_mixed"] and found.converged
    assert found.pressure.shape == found.gap.shape == surface.shape and not found.fill.flags.writeable
    copy = pickle.loads(pickle.dumps(found))
    np.testing.assert_array_equal(copy.pressure, found.pressure)


def test_dry_friction_is_area_times_shear_strength_over_pressure(rough):
    elastic = tb.Solid(youngs_modulus="210 GPa", poissons_ratio=0.3)
    dry = tb.contact(rough, "50 MPa", elastic)
    found = tb.friction(dry, tb.rain(rough, 0), shear_strength="300 MPa", area="pixels")
    assert found.dry == pytest.approx(dry.values["contact_area_fraction_pixels"] * 6, rel=1e-12)
    assert found.lubricated == found.dry and found.lubricated_share == 0


def test_pixels_are_counted_where_contact_saturates_and_else_corrected(rough, steel):
    elastic = tb.Solid(youngs_modulus="210 GPa", poissons_ratio=0.3)
    for solid, counted in ((steel, "pixels"), (elastic, "corrected")):
        dry, film = tb.contact(rough, "50 MPa", solid), tb.rain(rough, 0)
        found = [tb.friction(dry, film, shear_strength="300 MPa", area=area).dry for area in (None, counted)]
        assert found[0] == found[1]


def test_a_flooded_contact_has_the_friction_of_its_boundary_film(rough, steel):
    dry = tb.contact(rough, "50 MPa", steel)
    flooded = tb.rain(rough, "1 kg/m^2", model="uniform")
    assert flooded.wet_fraction == 1
    assert tb.friction(dry, flooded).lubricated == 0
    found = tb.friction(dry, flooded, boundary_shear_share=0.25)
    assert found.lubricated == pytest.approx(0.25 * found.dry, rel=1e-12)


def test_films_hold_what_was_dosed(levelled):
    films = tb.rain(levelled, ["0.9 g/m^2", 0.45e-3])
    assert [film.lubricant_density for film in films] == pytest.approx([0.9e-3, 0.45e-3], rel=1e-15)
    for film in films:
        assert film.thickness.mean() == pytest.approx(film.lubricant_density / 900, rel=1e-3)
        assert not film.thickness.flags.writeable and film.thickness.min() == 0


def test_a_seed_chooses_the_droplets(levelled):
    one, same, other = (tb.rain(levelled, "0.2 g/m^2", seed=seed).thickness for seed in (1, 1, 2))
    np.testing.assert_array_equal(one, same)
    assert not np.array_equal(one, other)


@pytest.mark.parametrize("density, changes, text", [
    ("-1 g/m^2", {}, "density: got -1 g/m\\^2; expected zero or more"),
    ("1 g", {}, "density"), ("1", {}, "density"),
    ("1 g/m^2", {"oil_density": 0}, "oil_density"),
    ("1 g/m^2", {"droplet_height": 0}, "droplet_height"),
    ("1 g/m^2", {"model": "droplet"}, "did you mean 'droplets'"),
    ("1 g/m^2", {"edge": "shut"}, "edge: got 'shut'"),
    ("1 g/m^2", {"seed": -1}, "seed: got -1")])
def test_what_no_rain_can_be_is_refused(rough, density, changes, text):
    with pytest.raises(ValueError, match=text):
        tb.rain(rough, density, **changes)


def test_holes_are_refused_with_the_remedy():
    z = heights()
    z[0, 0] = np.nan
    with pytest.raises(ValueError, match=r"surface.fill\('harmonic'\)"):
        tb.rain(tb.Surface(z, pixel=1e-6), "1 g/m^2")


@pytest.mark.parametrize("arguments, text", [
    ({"shear_strength": -1}, "shear_strength"),
    ({"boundary_shear_strength": "1 GPa"}, "boundary_shear_strength: got 1 GPa; expected zero to the shear strength"),
    ({"boundary_shear_strength": 1e6, "boundary_shear_share": 0.1}, "say the same"),
    ({"area": "pixel"}, "did you mean 'pixels'")])
def test_what_no_friction_can_be_is_refused(rough, steel, arguments, text):
    with pytest.raises(ValueError, match=text):
        tb.friction(tb.contact(rough, 5e7, steel), tb.rain(rough, 0), **arguments)


def test_a_missing_shear_strength_is_asked_for(rough):
    bare = tb.Solid(youngs_modulus=2e11, poissons_ratio=0.3)
    with pytest.raises(ValueError, match="give shear_strength"):
        tb.friction(tb.contact(rough, 5e7, bare), tb.rain(rough, 0))


def test_a_film_of_another_shape_is_refused(rough, steel, levelled):
    with pytest.raises(ValueError, match=r"film: got shape \(128, 128\); expected that of the contact, \(32, 32\)"):
        tb.friction(tb.contact(rough, 5e7, steel), tb.rain(levelled, 0))


def test_a_flowing_film_needs_a_speed_that_is_none_below_zero(rough, steel):
    dry, film = tb.contact(rough, 5e7, steel), tb.rain(rough, "1 g/m^2")
    with pytest.raises(ValueError, match="speed: got -1 m/s"):
        tb.fluid_film(dry, film, tb.Lubricant("0.1 Pa s"), speed=-1)
    with pytest.raises(ValueError, match="viscosity"):
        tb.Lubricant("0.1")
    free = tb.contact(rough, 5e7, steel, boundary="free")
    with pytest.raises(ValueError, match="use treat.'edges=tile'. or treat.'edges=cut'."):
        tb.fluid_film(free, film, tb.Lubricant("0.1 Pa s"), speed=1)


def test_a_pickled_film_and_friction_are_the_same(rough, steel):
    film = tb.rain(rough, "0.2 g/m^2")
    copy = pickle.loads(pickle.dumps(film))
    np.testing.assert_array_equal(copy.thickness, film.thickness)
    assert dict(copy.values) == dict(film.values)
    found = tb.friction(tb.contact(rough, 5e7, steel), copy)
    again = pickle.loads(pickle.dumps(found))
    assert dict(again.values) == dict(found.values) and again.warnings == found.warnings


def test_a_density_curve_is_that_of_the_command_line(program, scan_file):
    run = subprocess.run([program, "friction", scan_file, "--level", "plane", "--crop", "0,0,128,128", "--pressure",
                          "2MPa,7MPa", "--material", "aluminium-6016", "--density", "0.45g/m^2,0.9g/m^2", "--json"],
                         capture_output=True, text=True, check=True)
    told = json.loads(run.stdout)["density_curves"]
    surface = tb.read(scan_file).level("plane").crop("0,0,128,128")
    found = tb.density_curve(tb.contact(surface, ["2 MPa", "7 MPa"], tb.Solid("aluminium-6016")))
    assert len(told) == len(found) == 2
    for one, curve in zip(told, found):
        assert one["mean_pressure_Pa"] == curve.mean_pressure
        assert one["friction_lubricated"] == curve.friction_lubricated.tolist()
        assert one["lubricated_share"] == curve.lubricated_share.tolist()
        assert one["plateau_from_g_per_m2"] == pytest.approx(curve.plateau.first * 1e3, rel=1e-14)
        assert one["plateau_to_g_per_m2"] == pytest.approx(curve.plateau.last * 1e3, rel=1e-14)
        assert one["beyond_plateau_g_per_m2"] == pytest.approx(curve.plateau.beyond * 1e3, rel=1e-14)
    text = subprocess.run([*run.args[:-1]], capture_output=True, text=True, check=True).stdout
    films = tb.rain(surface, ["0.45 g/m^2", 0.9e-3])
    pressed = tb.contact(surface, "7 MPa", tb.Solid("aluminium-6016"))
    assert found[1].says([tb.friction(pressed, film) for film in films]) in " ".join(text.split())


def test_a_density_that_is_asked_for_is_a_point_of_the_curve_with_the_wet_share_of_its_film(rough, steel):
    pressed = tb.contact(rough, "50 MPa", steel)
    curve = tb.density_curve(pressed, density=["0.1234 g/m^2", 0.00777])
    film = tb.rain(rough, "0.1234 g/m^2", model="limit")
    place = list(curve.lubricant_density).index(film.lubricant_density)
    assert curve.lubricated_share[place] == tb.friction(pressed, film).lubricated_share
    assert 0.00777 in curve.lubricant_density
    assert curve.says("0.1234 g/m^2") == curve.says(tb.friction(pressed, film))


def test_a_density_curve_falls_from_dry_friction(rough, steel):
    curve = tb.density_curve(tb.contact(rough, "50 MPa", steel), boundary_shear_share=0.25)
    dry = curve.friction_dry
    assert dry == tb.friction(tb.contact(rough, "50 MPa", steel), tb.rain(rough, 0)).dry
    assert (np.diff(curve.friction_lubricated) <= 1e-15).all()
    np.testing.assert_allclose(curve.friction_lubricated, dry * (1 - 0.75 * curve.lubricated_share), rtol=1e-12)
    assert pickle.loads(pickle.dumps(curve)).says() == curve.says()


def test_what_has_no_density_curve_is_refused(rough, levelled, steel):
    one, other = tb.contact(rough, 5e7, steel), tb.contact(levelled, 5e6, steel)
    with pytest.raises(ValueError, match="several surfaces"):
        tb.density_curve([one, other])
    with pytest.raises(ValueError, match="empty list"):
        tb.density_curve([])
    with pytest.raises(ValueError, match="edge: got 'shut'"):
        tb.density_curve(one, edge="shut")
    flat = tb.Surface(np.zeros((16, 16)), pixel=1e-6, periodic=True)
    with pytest.raises(ValueError, match="without heights"):
        tb.density_curve(tb.contact(flat, 5e7, steel))


def others(surface):
    """Surfaces that could be taken for this one: shape and name are the same."""
    pixel = surface.pixel[0]
    return {"other heights": tb.Surface(heights(seed=2), pixel=pixel, periodic=True),
            "shifted": tb.Surface(surface.height + 1e-12, pixel=pixel, periodic=True),
            "wider": tb.Surface(surface.height, pixel=2 * pixel, periodic=True), "turned": surface.flip("x"),
            "treated": surface.lowpass("gauss:4um")}


@pytest.mark.parametrize("name", ["other heights", "shifted", "wider", "turned", "treated"])
def test_a_film_or_a_contact_of_another_surface_is_refused(rough, steel, name):
    other = others(rough)[name]
    dry, film = tb.contact(rough, 5e7, steel), tb.rain(rough, "0.45 g/m^2")
    for contact, oil in ((dry, tb.rain(other, "0.45 g/m^2")), (tb.contact(other, 5e7, steel), film)):
        for call in (lambda: tb.friction(contact, oil), lambda: tb.fluid_film(contact, oil, tb.Lubricant(0.1), 1e-3)):
            with pytest.raises(ValueError, match="film: got a film on another surface, or on this one treated in another way"):
                call()
        copies = pickle.loads(pickle.dumps((contact, oil)))
        with pytest.raises(ValueError, match="another surface"):
            tb.friction(*copies)
    with pytest.raises(ValueError, match="several surfaces"):
        tb.density_curve([dry, tb.contact(other, 5e7, steel)])


def test_records_of_equal_surfaces_belong_together(rough, steel, tmp_path):
    copy = tb.Surface(rough.height.copy(), pixel=rough.pixel, periodic=False, name="copy")
    dry, film = tb.contact(rough, 5e7, steel), tb.rain(copy, "0.45 g/m^2")
    found = tb.friction(dry, film)
    assert found.lubricated == tb.friction(dry, tb.rain(rough, "0.45 g/m^2")).lubricated
    again = pickle.loads(pickle.dumps(dry))
    assert tb.friction(again, film).lubricated == found.lubricated
    curves = tb.density_curve([dry, again, tb.contact(copy, 2e7, steel)])
    assert len(curves) == 3 and (curves[0].friction_lubricated == curves[1].friction_lubricated).all()
    tb.save(tmp_path / "a.h5", [dry, pickle.loads(pickle.dumps(tb.contact(rough, 2e7, steel)))])


def test_the_digest_of_a_surface_takes_milliseconds():
    surface = tb.Surface(heights(1024), pixel=1e-6)
    seconds = []
    for _ in range(5):
        begin = time.perf_counter()
        tb._tabor.digest_of(surface._topography)
        seconds.append(time.perf_counter() - begin)
    assert min(seconds) < 0.05  # 1 to 2 ms of one processor


def test_trapped_oil_carries_load_and_takes_friction_from_the_solids(rough, steel):
    dry, film = tb.contact(rough, "50 MPa", steel), tb.rain(rough, "0.5 g/m^2")
    without = tb.friction(dry, film, boundary_shear_share=0.1)
    found = tb.friction(dry, film, boundary_shear_share=0.1, trapped=True)
    assert without.liquid_pressure is None and "liquid_load_share" not in without.values
    assert found.dry == without.dry and found.converged
    assert found.lubricated == pytest.approx(found.values["friction_solid"] + found.values["friction_boundary"], rel=1e-15)
    assert found.liquid_pressure.max() == pytest.approx(found.values["max_liquid_pressure_Pa"])
    assert found.trapped_pressure.mean() == pytest.approx(50e6, rel=1e-9)
    incompressible = tb.friction(dry, film, boundary_shear_share=0.1, trapped=True, bulk_modulus="inf")
    assert incompressible.values["liquid_load_share"] >= found.values["liquid_load_share"]
    copy = pickle.loads(pickle.dumps(found))
    np.testing.assert_array_equal(copy.liquid_pressure, found.liquid_pressure)
    assert copy.values == found.values


@pytest.mark.parametrize("settings, text", [
    ({"bulk_modulus": "2 GPa"}, "bulk_modulus.*needs.*trapped"),
    ({"trapped": True, "bulk_modulus": 0}, "bulk_modulus"),
    ({"trapped": True, "bulk_modulus": "2 m"}, "bulk_modulus"),
])
def test_trapped_oil_that_does_not_exist_is_rejected(rough, steel, settings, text):
    dry, film = tb.contact(rough, "50 MPa", steel), tb.rain(rough, "0.5 g/m^2")
    with pytest.raises(ValueError, match=text):
        tb.friction(dry, film, **settings)
