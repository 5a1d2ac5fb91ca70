"""Surfaces of arrays and files, their treatment and their numbers."""

import gc
import pickle
import weakref
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import tabor as tb
from conftest import heights


def test_a_surface_has_the_heights_it_was_given():
    z = heights()
    surface = tb.Surface(z, pixel=("2 um", 1e-6))
    np.testing.assert_array_equal(surface.height, z)
    assert surface.shape == (32, 32)
    assert surface.pixel == pytest.approx((2e-6, 1e-6), rel=1e-15)
    assert surface.lengths == pytest.approx((64e-6, 32e-6), rel=1e-15)


@pytest.mark.parametrize("convert", [np.asfortranarray, lambda z: z[::-1][::-1], lambda z: np.repeat(z, 2, 1)[:, ::2],
                                     lambda z: z.tolist(), lambda z: z.astype(">f8")])
def test_any_layout_gives_the_same_heights(convert):
    z = heights()
    np.testing.assert_array_equal(tb.Surface(convert(z), pixel=1e-6).height, z)


def test_float32_and_integers_are_converted():
    counts = np.arange(12, dtype=np.uint16).reshape(3, 4)
    np.testing.assert_array_equal(tb.Surface(counts, pixel=1e-6).height, counts.astype(float))
    single = heights().astype(np.float32)
    np.testing.assert_array_equal(tb.Surface(single, pixel=1e-6).height, single.astype(float))


def test_a_read_only_array_is_taken():
    z = heights()
    z.flags.writeable = False
    np.testing.assert_array_equal(tb.Surface(z, pixel=1e-6).height, z)


def test_a_surface_does_not_change_with_its_array():
    z = heights()
    surface = tb.Surface(z, pixel=1e-6)
    z[:] = 0
    assert np.abs(surface.height).max() > 0


def test_heights_are_a_read_only_view_that_keeps_its_owner():
    surface = tb.Surface(heights(), pixel=1e-6)
    view = surface.height
    assert not view.flags.writeable and not view.flags.owndata
    assert np.shares_memory(view, surface.height)
    owner = weakref.ref(surface)
    kept = view.copy()
    del surface
    gc.collect()
    assert owner() is None
    np.testing.assert_array_equal(view, kept)
    with pytest.raises(ValueError):
        view[0, 0] = 1


def test_masked_heights_are_holes():
    masked = np.ma.masked_greater(heights(), 1e-6)
    surface = tb.Surface(masked, pixel=1e-6)
    assert surface.n_holes == masked.mask.sum() > 0
    assert np.isnan(surface.height[masked.mask]).all()


@pytest.mark.parametrize("n, text", [(1, "1 hole"), (2, "2 holes")])
def test_holes_are_counted_when_a_surface_is_shown(n, text):
    z = heights()
    z[0, :n] = np.nan
    assert f"heights  in m, {text}\n" in repr(tb.Surface(z, pixel=1e-6))


def test_the_unit_of_heights_scales_them():
    z = heights()
    np.testing.assert_allclose(tb.Surface(z, pixel=1e-6, unit="um").height, z * 1e-6, rtol=1e-15)


@pytest.mark.parametrize("z, error, text", [
    (np.zeros(5), ValueError, r"heights: got an array of 1 dimension, shape \(5,\); expected a map of shape \(ny, nx\)"),
    (np.zeros((2, 2, 2)), ValueError, "heights: got an array of 3 dimensions"),
    ([[1.0, 2.0], [3.0]], TypeError, "heights: got list that is no array; expected real numbers in rows of one length"),
    (3.0, ValueError, "heights: got one number; expected a map"),
    (np.zeros((0, 4)), ValueError, r"heights: got an array of shape \(0, 4\), which is empty"),
    (np.full((4, 4), np.nan), tb.InputError, "heights: got no valid height at any pixel"),
    (np.ma.masked_all((4, 4)), tb.InputError, "heights: got no valid height at any pixel"),
    (np.array([[1, None]]), TypeError, "heights: got an array of object"),
    (np.array([["a"]]), TypeError, "heights: got an array of <U1"),
    (np.zeros((2, 2), complex), TypeError, "heights: got an array of complex128"),
    (np.zeros((2, 2), bool), TypeError, "heights: got an array of bool"),
    (np.array([[1, np.inf]]), ValueError, "heights: got an infinite height")])
def test_what_is_no_height_map_is_refused(z, error, text):
    with pytest.raises(error, match=text):
        tb.Surface(z, pixel=1e-6)


@pytest.mark.parametrize("pixel, text", [(0, "above zero"), (-1e-6, "above zero"), ("0.67", "pixel"),
                                         ("1 MPa", "pixel"), ((1e-6, 1e-6, 1e-6), "got 3 lengths"),
                                         (float("inf"), "above zero")])
def test_what_is_no_pixel_is_refused(pixel, text):
    with pytest.raises(ValueError, match=text):
        tb.Surface(heights(), pixel=pixel)


def test_a_pixel_must_be_given():
    with pytest.raises(TypeError, match="pixel"):
        tb.Surface(heights())


def test_a_surface_does_not_change():
    surface = tb.Surface(heights(), pixel=1e-6)
    with pytest.raises(AttributeError, match="does not change"):
        surface.height = 1
    with pytest.raises(AttributeError, match="does not change"):
        surface.other = 1


def test_levelling_removes_a_plane():
    y, x = np.mgrid[0:32, 0:48] * 1e-6
    surface = tb.Surface(0.1 * x - 0.3 * y + 1, pixel=1e-6)
    assert np.abs(surface.level("plane").height).max() < 1e-15
    assert surface.history == ()
    assert surface.level("plane").history[0].startswith("level=plane")


def test_methods_are_the_steps_of_the_command_line(levelled):
    chain = levelled.lowpass("hann:32/L").crop(0, 0, 64, 32).mirror().flip("x")
    same = levelled.treat("lowpass=hann:32/L", "crop=0,0,64,32", "mirror", "flip=x")
    np.testing.assert_array_equal(chain.height, same.height)
    assert chain.periodic and chain.shape == (64, 128)
    assert "Hann" in tb.Surface.lowpass.__doc__


@pytest.mark.parametrize("step, near", [("levle=plane", "level"), ("level=plain", "plane")])
def test_a_misspelt_step_names_the_nearest(rough, step, near):
    with pytest.raises(ValueError, match=f"did you mean '{near}'"):
        rough.treat(step)


def test_holes_are_filled():
    z = np.ones((16, 16))
    z[4:8, 4:8] = np.nan
    filled = tb.Surface(z, pixel=1e-6).fill("harmonic")
    assert filled.n_holes == 0
    np.testing.assert_allclose(filled.height, 1, rtol=1e-12)


def test_parameters_of_a_wave_are_those_of_the_closed_form():
    x = 2 * np.pi * np.arange(64) / 64
    surface = tb.Surface(np.tile(1e-6 * np.sin(x), (64, 1)), pixel=1e-6, periodic=True)
    found = surface.parameters(["Sq", "Sz"])
    assert found["Sq"].value == pytest.approx(1e-6 / np.sqrt(2), rel=1e-12)
    assert found["Sz"].value == pytest.approx(2e-6, rel=1e-12)
    assert found["Sq"].unit == "m" and "root mean square" in found["Sq"].definition
    with pytest.raises(ValueError, match="got 'Sw'"):
        surface.parameters(["Sw"])
    with pytest.raises(KeyError):
        found["Sa"]


def test_a_spectrum_has_the_power_of_its_wave():
    x = 2 * np.pi * 8 * np.arange(64) / 64
    surface = tb.Surface(np.tile(1e-6 * np.sin(x), (64, 1)), pixel=1e-6, periodic=True)
    spectrum = surface.psd().x
    step = 2 * np.pi / 64e-6
    assert spectrum.q[np.argmax(spectrum.density)] == pytest.approx(8 * step, rel=1e-12)
    assert (spectrum.density * step / np.pi).sum() == pytest.approx(0.5e-12, rel=1e-9)
    with pytest.raises(ValueError, match="convention"):
        surface.psd("other")


def test_a_spectrum_of_no_self_affine_surface_says_so():
    rough = tb.generate("self-affine", pixels=128, pixel="1 um", rms_slope=0.1)
    found = rough.psd()
    assert found.warnings == () and 0 < found.radial.hurst_standard_error < found.radial.hurst < 1
    steep = rough.lowpass("gauss:20um").psd(fit_min="0.3/um", fit_max=6e5)
    assert [warning.code for warning in steep.warnings] == ["hurst"] and steep.radial.hurst > 1
    with pytest.raises(ValueError, match="fit_min"):
        rough.psd(fit_min="0.6/um", fit_max="0.3/um")
    with pytest.raises(ValueError, match="unit"):
        rough.psd(fit_min="1 kg")


def test_a_scan_is_read_and_shown(scan_file):
    surface = tb.read(scan_file)
    assert surface.format == "x3p" and surface.shape == (512, 512)
    assert "512 x 512 pixels of 670 nm" in repr(surface) and "heights  in m, no holes" in repr(surface)
    page = surface._repr_html_()
    assert "512 x 512" in page and "data:image/png;base64," in page


def test_a_thumbnail_is_a_png_of_the_heights(tmp_path):
    image = pytest.importorskip("matplotlib.image")
    z = np.linspace(0, 1, 600)[None, :] * np.ones((300, 1))
    z[:150, :300] = np.nan
    from tabor._surface import thumbnail
    (tmp_path / "a.png").write_bytes(thumbnail(z))
    pixels = image.imread(tmp_path / "a.png")
    assert pixels.shape == (60, 120)
    assert (pixels[:30, :60] == 0).all() and (np.diff(pixels[40]) >= 0).all() and pixels[40, -1] == 1


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(ValueError, match="none.x3p"):
        tb.read(tmp_path / "none.x3p")


def test_what_a_file_leaves_open_is_asked_for(tmp_path):
    np.save(tmp_path / "z.npy", heights())
    with pytest.raises(ValueError, match="pixel"):
        tb.read(tmp_path / "z.npy")
    surface = tb.read(tmp_path / "z.npy", pixel="2 um", unit="m")
    assert surface.pixel == pytest.approx((2e-6, 2e-6), rel=1e-15)


def test_a_damaged_hdf5_file_is_a_value_error(tmp_path):
    file = tmp_path / "broken.h5"
    file.write_bytes(b"\x89HDF\r\n\x1a\n" + bytes(range(256)) * 8)
    with pytest.raises(ValueError, match="broken.h5"):
        tb.read(file)


def test_what_is_written_is_read_again(tmp_path, rough):
    rough.save(tmp_path / "a.h5")
    np.testing.assert_array_equal(tb.read(tmp_path / "a.h5").height, rough.height)
    with pytest.raises(ValueError, match="a.other"):
        rough.save(tmp_path / "a.other")


def test_a_pickled_surface_is_the_same(levelled):
    copy = pickle.loads(pickle.dumps(levelled))
    np.testing.assert_array_equal(copy.height, levelled.height)
    assert (copy.history, copy.warnings, copy.source, copy.lengths) == (
        levelled.history, levelled.warnings, levelled.source, levelled.lengths)


def test_a_surface_is_looked_at_once_whoever_asks_first():
    tilted = heights() + np.linspace(0, 1e-4, heights().shape[1])
    expected = tb.Surface(tilted, pixel=1e-6).warnings
    assert "not-levelled" in [one.code for one in expected]
    surface = tb.Surface(tilted, pixel=1e-6)
    assert surface.shape == tilted.shape and not surface._is_looked_at
    view = surface.height
    with ThreadPoolExecutor(4) as pool:
        found = list(pool.map(lambda _: surface.warnings, range(8)))
    assert all(one == expected for one in found)
    assert np.shares_memory(view, surface.height)
    assert pickle.loads(pickle.dumps(tb.Surface(tilted, pixel=1e-6))).warnings == expected


def test_xarray_has_coordinates_in_metres(rough):
    pytest.importorskip("xarray")
    array = rough.to_xarray()
    np.testing.assert_array_equal(array.values, rough.height)
    assert array.dims == ("y", "x") and float(array.x[0]) == pytest.approx(0.5e-6, rel=1e-12)
    assert array.attrs["units"] == array.x.attrs["units"] == "m"


def test_rows_are_levelled_and_warned_about():
    x = np.linspace(0, 6 * np.pi, 128, endpoint=False)
    clean = np.tile(1e-6 * np.sin(x), (64, 1))
    offsets = 2e-6 * np.random.default_rng(1).normal(size=(64, 1))
    scan = tb.Surface(clean + offsets, pixel="1 um")
    assert "row-jumps" in [warning.code for warning in scan.warnings]
    level = scan.level("rows")
    assert np.ptp(level.height - clean) < 1e-18
    assert "row-jumps" not in [warning.code for warning in level.warnings]


def test_edges_are_looked_at():
    x = np.linspace(0, 6 * np.pi, 64, endpoint=False)
    waves = tb.Surface(np.tile(1e-6 * np.sin(x), (32, 1)), pixel="1 um")
    assert waves.periodic and waves.psd().window == "none"
    assert not waves.crop(0, 0, 40, 32).periodic and waves.crop(0, 0, 40, 32).psd().window == "hann"
    assert not waves.edges("end").periodic and waves.edges("end").psd().window == "hann"
