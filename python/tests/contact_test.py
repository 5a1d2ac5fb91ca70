"""Contacts: closed forms, refusals, certificates, and what stops them."""

import inspect
import pickle
import signal
import threading
import time

import numpy as np
import pytest

import tabor as tb
from conftest import heights
from tabor import _tabor


def wave(n=64, amplitude=1e-6, wavelength=64e-6):
    x = 2 * np.pi * (np.arange(n) + 0.5) / n
    return tb.Surface(np.tile(amplitude * np.cos(x), (n, 1)), pixel=wavelength / n, periodic=True)


def test_a_solid_takes_the_spelling_of_the_command_line():
    solid = tb.Solid(youngs_modulus="70 GPa", poisson_ratio=0.33, counter_youngs_modulus="210 GPa", counter_poisson_ratio=0.3)
    assert solid == tb.Solid(youngs_modulus="70 GPa", poissons_ratio=0.33, counter_youngs_modulus="210 GPa", counter_poissons_ratio=0.3)
    with pytest.raises(TypeError, match="poisson_ratio and poissons_ratio are the same argument"):
        tb.Solid(youngs_modulus="70 GPa", poisson_ratio=0.33, poissons_ratio=0.33)


def test_a_wave_is_flattened_at_westergaards_pressure():
    solid = tb.Solid(youngs_modulus=1e11, poissons_ratio=0)
    full = np.pi * 1e11 * 1e-6 / 64e-6
    for share in (0.1, 0.5, 0.9):
        found = tb.contact(wave(256), share * full, solid)
        expected = 2 / np.pi * np.arcsin(np.sqrt(share))  # Westergaard 1939
        assert found.values["contact_area_fraction_pixels"] == pytest.approx(expected, abs=2 / 256)
    assert tb.contact(wave(), 1.01 * full, solid).values["contact_area_fraction_pixels"] == 1


def test_the_load_is_carried_and_the_maps_agree(rough, steel):
    found = tb.contact(rough, "50 MPa", steel)
    assert found.pressure.mean() == pytest.approx(5e7, rel=1e-12)
    assert found.pressure.min() >= 0 and found.pressure.max() <= 2e9
    separation = found.values["separation_m"]
    np.testing.assert_allclose(found.gap, separation + found.displacement - rough.height, atol=1e-18)
    assert found.converged is found.values["converged"] is True and found.certificate <= 1e-6
    assert found.mean_pressure == 5e7 and 0 < found.area_fraction < 1


def test_maps_are_read_only_views_of_the_result(rough, steel):
    found = tb.contact(rough, "50 MPa", steel)
    view = found.pressure
    assert not view.flags.writeable and np.shares_memory(view, found.pressure)
    kept = view.copy()
    del found
    np.testing.assert_array_equal(view, kept)


def test_several_pressures_give_a_list_of_the_same_contacts(rough, steel):
    many = tb.contact(rough, np.array([2e7, 5e7]), steel)
    assert [one.mean_pressure for one in many] == [2e7, 5e7]
    np.testing.assert_array_equal(many[1].pressure, tb.contact(rough, 5e7, steel).pressure)


def test_a_separation_stands_for_the_pressure_that_leads_to_it(rough, steel):
    there = tb.contact(rough, "50 MPa", steel)
    back = tb.contact(rough, solid=steel, separation=there.values["separation_m"])
    assert back.mean_pressure == pytest.approx(5e7, rel=1e-4)
    assert back.values["separation_m"] == there.values["separation_m"]
    assert back.values["approach_m"] == pytest.approx(rough.height.max() - there.values["separation_m"], rel=1e-12)
    many = tb.contact(rough, solid=steel, separation=[0.8 * rough.height.max(), 0.5 * rough.height.max()])
    assert many[0].mean_pressure < many[1].mean_pressure
    with pytest.raises(ValueError, match="does not touch"):
        tb.contact(rough, solid=steel, separation=2 * rough.height.max())


def test_a_force_is_a_pressure_on_the_whole_of_a_body_that_ends(rough, steel):
    area = np.prod(rough.lengths)
    found = tb.contact(rough, solid=steel, force=5e7 * area, boundary="free")
    np.testing.assert_allclose(found.pressure, tb.contact(rough, 5e7, steel, boundary="free").pressure, rtol=1e-6, atol=1e3)
    with pytest.raises(ValueError, match="boundary"):
        tb.contact(rough, solid=steel, force="1 N", boundary="periodic")
    with pytest.raises(ValueError, match="unit"):
        tb.contact(rough, solid=steel, force="1", boundary="free")


def test_one_of_pressure_separation_and_force_is_given(rough, steel):
    with pytest.raises(TypeError, match="give one of pressure, separation and force"):
        tb.contact(rough, solid=steel)
    for given in ({"pressure": 5e7, "separation": 1e-7}, {"separation": 1e-7, "force": 1.0}):
        with pytest.raises(ValueError, match="give only one of pressure, separation and force"):
            tb.contact(rough, solid=steel, **given)
    with pytest.raises(TypeError, match="solid"):
        tb.contact(rough, 5e7)


def test_edges_are_the_boundary_and_the_mirror_in_one_word(levelled, steel):
    part = levelled.crop(0, 0, 24, 20)
    for edges, surface, boundary in (("tile", part, "periodic"), ("cut", part.mirror(), "periodic"), ("end", part, "free")):
        expected = tb.contact(surface, "50 MPa", steel, boundary=boundary)
        for found in (tb.contact(part, "50 MPa", steel, edges=edges), tb.contact(part.edges(edges), "50 MPa", steel)):
            np.testing.assert_array_equal(found.pressure, expected.pressure)
            assert "not-periodic" not in [warning.code for warning in found.warnings]
            assert found.surface.shape == surface.shape
    assert "not-periodic" in [warning.code for warning in tb.contact(part, "50 MPa", steel).warnings]
    film = tb.rain(part.mirror(), "0.1 g/m^2")
    assert tb.friction(tb.contact(part, "50 MPa", steel, edges="cut"), film, shear_strength="70 MPa").dry > 0


@pytest.mark.parametrize("options", [{"edges": "cut", "boundary": "free"}, {"edges": "tile", "boundary": "free"},
                                     {"edges": "end", "boundary": "periodic"}, {"edges": "ends"}])
def test_edges_that_contradict_each_other_are_refused(rough, steel, options):
    with pytest.raises(ValueError, match="edges"):
        tb.contact(rough, "50 MPa", steel, **options)
    with pytest.raises(ValueError, match="edges"):
        tb.contact(rough.edges("end"), "50 MPa", steel, edges="tile")


def test_pickled_surfaces_keep_what_is_said_of_their_edges(rough):
    assert rough.edges("end").periodic is False
    assert pickle.loads(pickle.dumps(rough.edges("end"))).periodic is False
    assert pickle.loads(pickle.dumps(rough.crop(0, 0, 24, 20).edges("tile"))).periodic is True


def test_a_load_path_keeps_plastic_indentation(rough):
    soft = tb.Solid(youngs_modulus="210 GPa", poissons_ratio=0.3, saturation_pressure="400 MPa")
    fresh = tb.contact(rough, [2e8, 5e7], soft)
    path = tb.contact(rough, [2e8, 5e7], soft, load_path=True)
    np.testing.assert_array_equal(fresh[0].pressure, path[0].pressure)
    assert path[1].area_fraction > fresh[1].area_fraction


def test_warnings_have_a_code_and_a_text(levelled):
    found = tb.contact(levelled, "7 MPa", tb.Solid("aluminium-6016"))
    assert found.warnings and all(one.code and one.text for one in found.warnings)
    assert found.references and found.warnings[0].text in repr(found) and "certificate" in found._repr_html_()


def test_warnings_advise_what_python_has(levelled):
    """Every setting that a warning may name: as an argument of a function, or a step that can be treated with."""
    names = ("area boundary boundary_shear_strength droplet_height edge fit_max fit_min model reading "
             "saturation_pressure").split()
    arguments = {name for call in (tb.Solid, tb.contact, tb.rain, tb.friction, tb.Surface.psd)
                 for name in inspect.signature(call).parameters}
    for name in names:
        said = _tabor.advised(f"x; <{name}=a>")
        assert said.removeprefix("x; ").partition("=")[0] in arguments, said
    for name, argument, _ in tb._tabor.treatment_steps():
        said = _tabor.advised(f"x; <{name}=a>")
        assert said == f"x; treat('{name}=a')" if argument else said == f"x; treat('{name}')"
    assert _tabor.advised("x; <lowpass_scan> tells; <resolution_scan> tells") == "x"
    texts = [one.text for one in tb.contact(levelled, "7 MPa", tb.Solid("aluminium-6016")).warnings]
    assert any("treat('edges=cut')" in text for text in texts) and not any("--" in text or "<" in text for text in texts)


def test_doubts_come_before_information():
    z = np.random.default_rng(1).normal(0, 1e-7, (40, 50))
    z[20, 20] = 1e-3
    surface = tb.Surface(z, pixel=("1 um", "1.2 um")).despike("auto")
    kinds = [warning.kind for warning in surface.warnings]
    assert kinds == sorted(kinds) and {"doubt", "information"} == set(kinds)


def test_a_result_does_not_change(rough, steel):
    found = tb.contact(rough, 5e7, steel)
    with pytest.raises(AttributeError, match="a Contact does not change"):
        found.area = 1
    with pytest.raises(TypeError):
        found.values["seconds"] = 0


def test_the_library_knows_solids():
    known = {one.name: one for one in tb.materials()}
    solid = tb.Solid("steel-dc04")
    assert solid.youngs_modulus == known["steel-dc04"].youngs_modulus
    assert tb.Solid("steel-dc04", youngs_modulus="1 GPa").youngs_modulus == 1e9
    assert tb.Solid("aluminium", saturation_pressure="240 MPa") == tb.Solid("aluminium-6016")
    assert tb.Solid("aluminium-6016", saturation_pressure="none").saturation_pressure is None


def test_a_counter_body_makes_it_softer():
    rigid = tb.Solid(youngs_modulus=1e11, poissons_ratio=0)
    both = tb.Solid(youngs_modulus=1e11, poissons_ratio=0, counter_youngs_modulus=1e11, counter_poissons_ratio=0)
    assert (rigid.effective_modulus, both.effective_modulus) == (1e11, 5e10)


@pytest.mark.parametrize("arguments, text", [
    ({"material": "steel-dc4"}, "steel-dc04"), ({"material": "steel"}, "steel-100cr6, steel-dc04"),
    ({}, "give youngs_modulus and poissons_ratio"),
    ({"youngs_modulus": 1e9}, "give youngs_modulus and poissons_ratio"),
    ({"youngs_modulus": -1e9, "poissons_ratio": 0.3}, "modulus"),
    ({"youngs_modulus": 1e9, "poissons_ratio": 0.7}, "ratio"),
    ({"youngs_modulus": "70", "poissons_ratio": 0.3}, "youngs_modulus"),
    ({"youngs_modulus": 1e9, "poissons_ratio": 0.3, "counter_youngs_modulus": 1e9}, "belong together")])
def test_solids_that_do_not_exist_are_refused(arguments, text):
    with pytest.raises(ValueError, match=text):
        tb.Solid(**arguments)


@pytest.mark.parametrize("pressure, changes, text", [
    (0, {}, "pressure: got 0 Pa; expected more than zero"),
    (-1e6, {}, "expected more than zero"),
    (2e9, {}, "expected less than the saturation pressure 2 GPa"),
    (1e6, {"tolerance": 1}, "tolerance: got 1; expected 1e-12 to 1e-4"),
    (1e6, {"boundary": "periodc"}, "did you mean 'periodic'"),
    (1e6, {"solver": "slow"}, "solver: got 'slow'")])
def test_what_no_contact_can_be_is_refused(rough, steel, pressure, changes, text):
    with pytest.raises(ValueError, match=text):
        tb.contact(rough, pressure, steel, **changes)


def test_holes_are_refused_with_the_remedy(steel):
    z = heights()
    z[3, 3] = np.nan
    with pytest.raises(ValueError, match=r"surface.fill\('harmonic'\)"):
        tb.contact(tb.Surface(z, pixel=1e-6), 1e6, steel)


def test_a_contact_that_does_not_converge_is_raised_with_its_result():
    slats = tb.Surface(heights(64), pixel=(1e-3, 1e-8), periodic=True)  # 1e5 times longer than wide
    elastic = tb.Solid(youngs_modulus=2e11, poissons_ratio=0.3)
    found = tb.contact(slats, 1e9, elastic, tolerance=1e-12, solver="polonsky-keer", check=False)
    assert not found.converged and found.certificate > 1e-12
    with pytest.raises(tb.NotConverged, match="check=False") as raised:
        tb.contact(slats, 1e9, elastic, tolerance=1e-12, solver="polonsky-keer")
    assert raised.value.result.certificate == found.certificate
    assert pickle.loads(pickle.dumps(raised.value)).result.certificate == found.certificate


@pytest.fixture(scope="module")
def slow_case():
    """A contact of several seconds."""
    surface = tb.Surface(heights(1024), pixel=1e-6, periodic=True)
    return surface, tb.Solid(youngs_modulus="210 GPa", poissons_ratio=0.3)


def seconds_to_stop(surface, solid):
    """From Ctrl-C in the middle of a long path to the exception."""
    sent = []

    def interrupt():
        time.sleep(0.4)
        sent.append(time.perf_counter())
        signal.raise_signal(signal.SIGINT)

    sender = threading.Thread(target=interrupt)
    sender.start()
    with pytest.raises(KeyboardInterrupt):
        tb.contact(surface, np.geomspace(1e8, 1e9, 500), solid, tolerance=1e-12)
    waited = time.perf_counter() - sent[0]
    sender.join()
    return waited


def test_ctrl_c_stops_within_three_tenths_of_a_second(slow_case):
    assert min(seconds_to_stop(*slow_case) for _ in range(3)) < 0.3  # of three: other programs take cores


def test_other_threads_run_meanwhile(slow_case):
    surface, solid = slow_case
    ticks, ends = [], threading.Event()

    def tick():
        while not ends.wait(0.01):
            ticks.append(time.perf_counter())

    ticker = threading.Thread(target=tick)
    ticker.start()
    start = time.perf_counter()
    tb.contact(surface, 1e8, solid)
    seconds = time.perf_counter() - start
    ends.set()
    ticker.join()
    assert sum(start < moment < start + seconds for moment in ticks) > seconds / 0.1


def test_progress_is_told_and_what_it_raises_stops(slow_case):
    surface, solid = slow_case
    stages = []
    tb.contact(surface, 1e8, solid, progress=lambda stage, share, certificate: stages.append(stage))
    assert stages

    def refuse(stage, share, certificate):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        tb.contact(surface, 1e8, solid, progress=refuse)
    with pytest.raises(TypeError, match="progress"):
        tb.contact(surface, 1e8, solid, progress=3)


def test_a_bar_is_shown_without_a_word_elsewhere(slow_case, capfd):
    surface, solid = slow_case
    tb.contact(surface, 1e8, solid, progress=True)
    shown = capfd.readouterr()
    assert "contact" in shown.out + shown.err


def test_threads_do_not_change_a_bit(rough, steel):
    try:
        tb.set_threads(1)
        one = tb.contact(rough, 5e7, steel)
    finally:
        tb.set_threads(0)
    np.testing.assert_array_equal(one.pressure, tb.contact(rough, 5e7, steel).pressure)


def test_a_pickled_contact_is_the_same(rough, steel):
    found = tb.contact(rough, 5e7, steel)
    copy = pickle.loads(pickle.dumps(found))
    for name in ("pressure", "displacement", "gap"):
        np.testing.assert_array_equal(getattr(copy, name), getattr(found, name))
    assert (dict(copy.values), copy.warnings, copy.references, copy.solid) == (
        dict(found.values), found.warnings, found.references, found.solid)
    film = tb.rain(rough, "0.2 g/m^2")
    assert dict(tb.friction(copy, film).values) == dict(tb.friction(found, film).values)


def test_xarray_has_maps_units_and_numbers(rough, steel):
    pytest.importorskip("xarray")
    found = tb.contact(rough, 5e7, steel)
    data = found.to_xarray()
    np.testing.assert_array_equal(data.gap.values, found.gap)
    assert data.pressure.attrs["units"] == "Pa" and data.attrs["mean_pressure_Pa"] == 5e7


def test_a_rough_tool_presses_as_the_sum_of_both_under_a_flat(rough, steel):
    under = tb.contact(rough, "50 MPa", steel, tool="self-affine:Sa=20nm,seed=3", tool_x=3 * 1e-6)
    flat = tb.contact(tb.Surface(rough.height + under.tool, pixel=1e-6, periodic=True), "50 MPa", steel)
    np.testing.assert_array_equal(under.pressure, flat.pressure)
    assert under.values["tool_x_m"] == pytest.approx(3 * 1e-6) and flat.tool is None
    assert "tool_x_m" not in flat.values
    np.testing.assert_array_equal(pickle.loads(pickle.dumps(under)).tool, under.tool)


def test_a_surface_in_memory_is_a_tool(rough, steel):
    tool = tb.Surface(1e-8 * np.cos(np.arange(rough.shape[1])) * np.ones(rough.shape), pixel=1e-6)
    under = tb.contact(rough, "50 MPa", steel, tool=tool, tool_x=3e-6)
    np.testing.assert_allclose(under.tool, np.roll(tool.height - tool.height.mean(), 3, axis=1), atol=1e-20)
    flat = tb.contact(tb.Surface(rough.height + under.tool, pixel=1e-6, periodic=True), "50 MPa", steel)
    np.testing.assert_array_equal(under.pressure, flat.pressure)
    np.testing.assert_array_equal(pickle.loads(pickle.dumps(under)).tool, under.tool)
    assert tb.friction(under, tb.rain(rough, "0.2 g/m^2")).values["tool_x_m"] == under.values["tool_x_m"]
    slid = tb.slide(rough, "50 MPa", steel, 2 * rough.pixel[0], tool=tool, step=2 * rough.pixel[0])
    assert slid.steps == 1


def test_a_surface_that_is_no_tool_is_rejected(rough, steel):
    holed = rough.height.copy()
    holed[0, 0] = np.nan
    for tool, message in ((tb.Surface(holed, pixel=1e-6), "fill them"), (tb.Surface(rough.height, pixel=3e-7), "pixels"),
                          (tb.Surface(rough.height[:, :8], pixel=1e-6), "tool-repeats|tool_repeats")):
        with pytest.raises(ValueError, match=message):
            tb.contact(rough, "50 MPa", steel, tool=tool)


def test_a_tool_that_makes_no_sense_is_rejected(rough, steel):
    for tool, message in (("grond:Sa=1um", "ground"), ("ground:Sa=1", "unit"), ("nowhere.x3p", "nowhere.x3p")):
        with pytest.raises(ValueError, match=message):
            tb.contact(rough, "50 MPa", steel, tool=tool)
    with pytest.raises(ValueError, match="needs tool"):
        tb.contact(rough, "50 MPa", steel, tool_x="1 um")


def test_sliding_ploughs_the_sheet_and_leaves_it(rough, steel):
    found = tb.slide(rough, "50 MPa", steel, 6 * rough.pixel[0], tool="ground:Sa=10nm,groove-length=20um", step=2 * rough.pixel[0],
                     every=2 * rough.pixel[0], density="0.1 g/m^2")
    assert found.steps == 3 and found.states["distance_m"].tolist() == pytest.approx([2 * i * rough.pixel[0] for i in range(4)])
    assert np.isnan(found.states["friction_ploughing"][0]) and found.converged and found.states["converged"].dtype == bool
    assert (found.states["friction_ploughing_lower"][1:] <= found.states["friction_ploughing_upper"][1:]).all()
    assert found.after.shape == rough.shape and found.after.history[-1].startswith("slide")
    assert found.after.height.mean() == pytest.approx(rough.height.mean(), abs=1e-18)
    worn = tb.slide(rough, "50 MPa", steel, 6 * rough.pixel[0], tool="ground:Sa=10nm,groove-length=20um", step=2 * rough.pixel[0], displaced="lost")
    assert worn.states["lost_volume_m3_per_m2"][-1] > 0 and np.isnan(worn.states["friction_lubricated"]).all()


SLIDING = {"tool": "ground:Sa=10nm,groove-length=20um", "density": "0.1 g/m^2"}


def test_a_slide_has_maps_and_spectra_and_writes_the_file_of_the_terminal(rough, steel, tmp_path):
    step = 2 * rough.pixel[0]
    h5py = pytest.importorskip("h5py")
    found = tb.slide(rough, "50 MPa", steel, 3 * step, step=step, every=step, maps_at=[step], **SLIDING)
    assert sorted(found.maps) == [0, 1, 3] and found.steady is None
    last = found.maps[3]
    assert set(last) == {"sheet", "pressure", "gap", "film_thickness", "squeezed_film"}
    np.testing.assert_array_equal(last["sheet"], found.after.height)
    assert last["pressure"].mean() == pytest.approx(50e6)
    assert len(found.spectra) == 4 and found.before["psd_x_m3"].shape == found.spectra[0]["psd_x_m3"].shape
    states = found.states
    assert (states["friction_lubricated"] <= states["friction_lubricated_squeezed"]).all() and (states["friction_lubricated_squeezed"] <= states["friction_dry"]).all()
    tb.save(tmp_path / "slide.h5", found)
    with h5py.File(tmp_path / "slide.h5") as file:
        assert sorted(file["states"]) == ["0000", "0001", "0002", "0003"]
        np.testing.assert_allclose(file["states/0003/sheet"][()], last["sheet"], rtol=1e-6, atol=1e-13)
        np.testing.assert_array_equal(file["spectra/0003/psd_y_m3"][()], found.spectra[3]["psd_y_m3"])
        assert file["states/0003"].attrs["friction_lubricated_squeezed"] == states["friction_lubricated_squeezed"][3]


class Enough(Exception):
    """A user's own."""


def test_a_stopped_slide_goes_on_with_the_same_bits(levelled, tmp_path):
    sheet = levelled.crop("0,0,64,64").mirror()
    settings = {"step": "0.67 um", "trapped": True, "tool": "ground:Sa=0.1um,length=200um", "density": "0.1 g/m^2"}
    whole = tb.slide(sheet, "10 MPa", "aluminium-6016", "20 um", **settings)

    def stop(stage, share, certificate):
        if stage.startswith("slide,"):
            raise Enough

    with pytest.raises(Enough):
        tb.slide(sheet, "10 MPa", "aluminium-6016", "20 um", checkpoint=tmp_path / "run", progress=stop, **settings)
    with pytest.raises(ValueError, match="other settings"):
        tb.slide(sheet, "11 MPa", "aluminium-6016", "20 um", checkpoint=tmp_path / "run", **settings)
    rest = tb.slide(sheet, "10 MPa", "aluminium-6016", "20 um", checkpoint=tmp_path / "run", **settings)
    np.testing.assert_array_equal(rest.after.height, whole.after.height)
    for key, values in whole.states.items():
        np.testing.assert_array_equal(rest.states[key], values)
    assert not (tmp_path / "run").exists()


@pytest.mark.parametrize("settings, text", [
    ({}, "tool"), ({"tool": "ground:Sa=10nm", "step": "1 mm"}, "step"), ({"tool": "ground:Sa=10nm", "displaced": "gone"}, "displaced"),
    ({"tool": "ground:Sa=10nm", "reach": 0}, "reach"),
])
def test_sliding_says_what_it_needs(rough, steel, settings, text):
    with pytest.raises(ValueError, match=text):
        tb.slide(rough, "50 MPa", steel, "10 um", **settings)
