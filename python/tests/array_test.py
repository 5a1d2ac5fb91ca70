"""A surface as an array: coordinates, slices, arithmetic, functions, other packages."""

import io
import pathlib

import numpy as np
import pytest

import tabor as tb
from conftest import heights


@pytest.fixture(scope="module")
def plain():
    return tb.Surface(heights(24)[:16], pixel=("2 um", "1 um"), name="plain")


def test_it_has_the_shape_of_an_array(plain):
    assert (len(plain), plain.ndim, plain.size, np.size(plain), plain.shape) == (16, 2, 384, 384, (16, 24))
    assert plain.lengths == pytest.approx((48e-6, 16e-6)) and (plain.dx, plain.dy) == pytest.approx((2e-6, 1e-6))
    assert (plain.name, plain.unit) == ("plain", "m")
    with pytest.raises(TypeError, match="not iterable"):
        iter(plain)


def test_coordinates_are_those_of_pixel_centres(plain):
    np.testing.assert_allclose(plain.x, 2e-6 * (np.arange(24) + 0.5), rtol=1e-12)
    np.testing.assert_allclose(plain.y, 1e-6 * (np.arange(16) + 0.5), rtol=1e-12)
    assert plain.extent == pytest.approx((0, 48e-6, 16e-6, 0))


def test_the_mask_shows_holes():
    z = heights(8)
    z[2, 3] = np.nan
    mask = tb.Surface(z, pixel=1e-6).mask
    assert mask.dtype == bool and mask.sum() == 1 and mask[2, 3]


def test_a_slice_is_a_crop(levelled):
    part = levelled[10:90, 5:100]
    same = levelled.crop(5, 10, 95, 80)
    np.testing.assert_array_equal(part.height, levelled.height[10:90, 5:100])
    assert (part.history, part.pixel, part.source) == (same.history, levelled.pixel, levelled.source)
    for index in (np.s_[-20:], np.s_[..., 3:9], np.s_[3:9, ...], np.s_[:, :-4], np.s_[::1, 2:4]):
        np.testing.assert_array_equal(levelled[index].height, levelled.height[index])


def test_the_whole_slice_of_a_tile_still_repeats():
    tile = tb.generate("edt", pixels=64, seed=1)
    assert tile[:, :].periodic and tile[...].periodic and not tile[:16].periodic


@pytest.mark.parametrize("index, error, text", [
    (np.s_[::2], ValueError, r'step of 2 along y; .*resample\("nx,ny"\)'), (np.s_[:, ::-1], ValueError, r'step of -1 along x; .*flip'),
    (3, TypeError, r"got int 3 along y; expected slices, .*surface.height\["), (np.s_[2:5, 4], TypeError, "got int 4 along x"),
    (np.s_[9:9], ValueError, "pixels 9 to 9 along y"), (np.s_[1:2, 1:2, 1:2], IndexError, "got 3 indices"),
    (np.s_["a":], TypeError, "whole numbers"), (np.s_[None], TypeError, "got None"), (np.ones((16, 24), bool), TypeError, "got ndarray")])
def test_other_indices_are_refused(plain, index, error, text):
    with pytest.raises(error, match=text):
        plain[index]


def test_a_section_follows_a_plane():
    y, x = np.mgrid[0:20, 0:30] + 0.5
    plane = tb.Surface(1e-7 * x - 3e-7 * y, pixel="1 um")
    section = plane.section(("2.5 um", 3e-6), (25e-6, "17 um"))
    at = section.distance / section.distance[-1]
    expected = 0.1 * (2.5e-6 + at * 22.5e-6) - 0.3 * (3e-6 + at * 14e-6)
    np.testing.assert_allclose(section.height, expected, atol=1e-18)
    assert np.diff(section.distance).max() <= 1e-6 and section.distance[-1] == pytest.approx(np.hypot(22.5e-6, 14e-6))


def test_a_section_along_a_row_is_that_row(plain):
    section = plain.section((plain.x[0], plain.y[5]), (plain.x[-1], plain.y[5]))
    np.testing.assert_allclose(np.interp(plain.x - plain.x[0], section.distance, section.height), plain.height[5], atol=1e-18)
    assert "from" in repr(section) and "points" in section._repr_html_()


def test_a_hole_is_a_gap_in_a_section():
    z = heights(8)
    z[4, 4] = np.nan
    section = tb.Surface(z, pixel=1e-6).section((0.5e-6, 4.5e-6), (7.5e-6, 4.5e-6))
    assert np.isnan(section.height[4]) and np.isfinite(section.height[[3, 5]]).all()


@pytest.mark.parametrize("p, q, text", [((0, 0), (0, 0), "one point twice"), ((0, 0), (1, 0), "q: got x = .*on the surface"),
                                        (1e-6, (0, 0), "p: got 1 lengths"), ((0, 0, 0), (0, 0), "p: got 3 lengths")])
def test_points_off_the_surface_are_refused(plain, p, q, text):
    with pytest.raises(ValueError, match=text):
        plain.section(p, q)


def test_numbers_are_added_and_multiplied(plain):
    z = plain.height
    for made, expected in ((plain - 1e-6, z - 1e-6), (plain + "1 um", z + 1e-6), (1e-6 - plain, 1e-6 - z), (2 * plain, 2 * z),
                           (np.float64(2) * plain, 2 * z), (plain / 4, z / 4), (-plain, -z), (+plain, z), (np.float64(1) - plain, 1 - z)):
        assert isinstance(made, tb.Surface) and made.pixel == plain.pixel
        np.testing.assert_array_equal(made.height, expected)
    assert ((plain - 1e-6) * 2).history == ("minus 1 µm", "times 2")


def test_quantities_are_lengths(plain):
    pint = pytest.importorskip("pint")
    np.testing.assert_allclose((plain - pint.UnitRegistry().Quantity(1, "um")).height, plain.height - 1e-6, rtol=1e-12)


def test_surfaces_and_arrays_on_one_grid_are_added(plain, rough):
    other = tb.Surface(heights(24, 2)[:16], pixel=("2 um", "1 um"), name="other")
    difference = plain - other
    np.testing.assert_array_equal(difference.height, plain.height - other.height)
    assert difference.history == ("minus other",)
    np.testing.assert_array_equal((plain + other.height).height, plain.height + other.height)
    np.testing.assert_array_equal((other.height - plain).height, other.height - plain.height)
    assert (rough - rough).periodic and not (rough - tb.Surface(rough.height + np.linspace(0, 1, 32), pixel=1e-6)).periodic


@pytest.mark.parametrize("compute, error, text", [
    (lambda s: s - s[:8], ValueError, "expected one grid"), (lambda s: s - tb.Surface(s.height, pixel=1e-6), ValueError, "pixels of 2e-06 m"),
    (lambda s: s * s, TypeError, "got a Surface to multiply by"), (lambda s: s / s, TypeError, "expected a number"),
    (lambda s: s / 0, ValueError, "division by zero"), (lambda s: s + "1", ValueError, "without a unit"), (lambda s: s + np.ones(3), ValueError, "array"),
    (lambda s: s + None, TypeError, "unsupported operand"), (lambda s: s - True, TypeError, "unsupported operand"),
    (lambda s: s * "1 um", ValueError, "factor"), (lambda s: s + float("nan"), ValueError, "NaN")])
def test_what_cannot_be_computed_is_refused(plain, compute, error, text):
    with pytest.raises(error, match=text):
        compute(plain)


def test_a_function_keeps_grid_history_and_edges(levelled):
    pytest.importorskip("xarray")
    cut = levelled.edges("cut") if not levelled.periodic else levelled
    made = cut.apply(lambda z: np.clip(z, -1e-7, 1e-7), "clip")
    np.testing.assert_array_equal(made.height, np.clip(cut.height, -1e-7, 1e-7))
    assert made.history == (*cut.history, "clip") and (made.pixel, made.source, made.periodic) == (cut.pixel, cut.source, cut.periodic)
    assert levelled.apply(np.negative).history[-1] == "negative"
    assert made.to_xarray().attrs["edges"] == cut.to_xarray().attrs["edges"] == "cut"


def test_a_function_does_not_change_the_surface(plain):
    def spoil(z):
        z[:] = 0
        return z
    before = plain.height.copy()
    plain.apply(spoil)
    np.testing.assert_array_equal(plain.height, before)


@pytest.mark.parametrize("function, error, text", [(lambda z: z[:4], ValueError, "that the function returns: got shape"), (lambda z: None, TypeError, "returns"),
                                                   (lambda z: z + np.inf, ValueError, "infinite"), (lambda z: z > 0, TypeError, "bool")])
def test_what_a_function_may_return(plain, function, error, text):
    with pytest.raises(error, match=text):
        plain.apply(function)


def test_warnings_follow_the_heights(levelled):
    tilted = levelled.apply(lambda z: z + np.linspace(0, 1e-4, z.shape[1]))
    assert "tilt" in [one.code for one in tilted.warnings]


def test_a_surface_of_a_surface_is_the_same(levelled):
    same = tb.Surface(levelled)
    assert np.shares_memory(same.height, levelled.height)
    assert (same.history, same.source, same.warnings) == (levelled.history, levelled.source, levelled.warnings)
    assert tb.Surface(levelled, name="mine").name == "mine" and tb.Surface(levelled, name="mine").history == levelled.history
    assert tb.Surface(levelled, pixel="1 um").pixel == pytest.approx((1e-6, 1e-6))


@pytest.mark.parametrize("engine", [None, "h5netcdf", "scipy"])
def test_what_goes_to_xarray_comes_back(scan_file, tmp_path, engine):
    xarray = pytest.importorskip("xarray")
    scan = tb.read(scan_file)[:64, :80].level("plane")
    for surface in (scan, scan.edges("cut"), tb.Surface(heights(8), pixel=1e-6, periodic=True, name="a name"), tb.generate("edt", pixels=32)):
        array = surface.to_xarray()
        if engine:
            pytest.importorskip(engine)
            array.to_netcdf(tmp_path / "a.nc", engine=engine)
            with xarray.open_dataarray(tmp_path / "a.nc", engine=engine) as opened:
                array = opened.load()
        back = tb.Surface.from_xarray(array)
        np.testing.assert_array_equal(back.height, surface.height)
        assert back.lengths == pytest.approx(surface.lengths, rel=1e-12)
        for name in ("history", "source", "format", "warnings", "periodic", "name"):
            assert getattr(back, name) == getattr(surface, name), name
        assert dict(back.metadata) == dict(surface.metadata)
        assert back.to_xarray().attrs == surface.to_xarray().attrs


def test_arrays_of_others_need_coordinates(plain):
    pytest.importorskip("xarray")
    array = plain.to_xarray()
    assert tb.Surface.from_xarray(array.drop_attrs(deep=False).assign_attrs(units="m")).name == "array"
    with pytest.raises(ValueError, match="coordinate"):
        tb.Surface.from_xarray(array.drop_vars("x"))
    with pytest.raises(TypeError, match="array: got ndarray; expected a DataArray"):
        tb.Surface.from_xarray(plain.height)
    with pytest.raises(ValueError, match="not those that to_xarray wrote"):
        tb.Surface.from_xarray(array.assign_attrs(doubts="nonsense"))


def test_open_files_are_read(scan_file, tmp_path):
    expected = tb.read(scan_file)
    with open(scan_file, "rb") as opened:
        found = tb.read(opened)
    assert found.name == expected.name
    np.testing.assert_array_equal(found.height, expected.height)
    np.testing.assert_array_equal(tb.read(io.BytesIO(pathlib.Path(scan_file).read_bytes())).height, expected.height)
    assert tb.read(io.BytesIO(pathlib.Path(scan_file).read_bytes())).source == "file"
    expected.save(pathlib.Path(tmp_path, "a.sdf"))
    with pytest.raises(TypeError, match="opened as text"), open(__file__, encoding="utf-8") as text:
        tb.read(text)


def test_pictures_are_in_micrometres_with_one_colour_bar(plain):
    pyplot = pytest.importorskip("matplotlib.pyplot")
    figure, ax = pyplot.subplots()
    for _ in range(3):
        plain.plot(ax, window=("10 um", "4 um", "20 um", 6e-6), cmap="magma")
    assert len(figure.axes) == 2 and len(ax.images) == 1 and ax.get_xlabel() == "x [µm]"
    image = ax.images[0]
    assert image.get_extent() == pytest.approx([10, 30, 10, 4]) and image.get_cmap().name == "magma"
    np.testing.assert_allclose(image.get_array(), 1e6 * plain.height[4:10, 5:15])
    assert figure.axes[1].get_ylabel() == "height [µm]"
    ax.clear()
    plain.plot(ax)
    assert len(figure.axes) == 2
    with pytest.raises(ValueError, match="window: got one without a pixel; the map is 48 x 16 µm"):
        plain.plot(ax, window=(1, 1, 1, 1))
    pyplot.close(figure)
