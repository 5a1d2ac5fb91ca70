"""Surfaces of other packages, as they are built there."""

from types import SimpleNamespace

import numpy as np
import pytest

import tabor as tb

Z = np.arange(12.0).reshape(3, 4)  # ny = 3, nx = 4


def test_surface_topography_is_x_first_masked_and_has_a_unit():
    masked = np.ma.masked_equal(Z, 5.0)
    other = SimpleNamespace(heights=lambda: masked.T, physical_sizes=(8.0, 3.0), unit="µm", is_periodic=True)
    surface = tb.Surface(other)
    assert surface.shape == (3, 4) and surface.periodic and surface.n_holes == 1
    assert surface.pixel == pytest.approx((2e-6, 1e-6), rel=1e-12)
    np.testing.assert_allclose(surface.height, np.where(Z == 5, np.nan, Z * 1e-6), rtol=1e-12)


def test_surfalize_is_in_micrometres():
    surface = tb.Surface(SimpleNamespace(data=Z, step_x=0.5, step_y=0.25))
    assert surface.pixel == pytest.approx((0.5e-6, 0.25e-6), rel=1e-12)
    np.testing.assert_allclose(surface.height, Z * 1e-6, rtol=1e-12)


def test_gwyfile_is_in_metres_or_refused():
    metre = SimpleNamespace(unitstr="m")
    field = SimpleNamespace(data=Z, xreal=4e-6, yreal=6e-6, si_unit_xy=metre, si_unit_z=metre)
    assert tb.Surface(field).pixel == pytest.approx((1e-6, 2e-6), rel=1e-12)
    field.si_unit_z = SimpleNamespace(unitstr="V")
    with pytest.raises(ValueError, match="unit of z: got 'V'; expected 'm'"):
        tb.Surface(field)


def test_xarray_goes_there_and_back():
    pytest.importorskip("xarray")
    surface = tb.Surface(Z * 1e-6, pixel=("1 um", "2 um"))
    array = surface.to_xarray()
    for given in (array, array.transpose("x", "y")):
        copy = tb.Surface(given)
        np.testing.assert_array_equal(copy.height, surface.height)
        assert copy.pixel == pytest.approx(surface.pixel, rel=1e-9)
    del array.attrs["units"]
    with pytest.raises(ValueError, match="units of the heights: it has no unit"):
        tb.Surface(array)


def test_a_surface_without_a_unit_is_refused():
    other = SimpleNamespace(heights=lambda: Z.T, physical_sizes=(1.0, 1.0), unit=None, is_periodic=False)
    with pytest.raises(ValueError, match="it has no unit"):
        tb.Surface(other)


# The packages themselves, where they are installed

def holed():
    heights = 1e-6 * np.arange(12.0).reshape(3, 4)
    heights[1, 2] = np.nan
    return heights


def test_surface_topography_itself():
    package = pytest.importorskip("SurfaceTopography")
    heights = holed()
    other = package.Topography(np.ma.masked_invalid(heights.T * 1e9), (8e3, 3e3), unit="nm", periodic=True)
    surface = tb.Surface(other)
    np.testing.assert_allclose(surface.height, heights, rtol=1e-15)
    assert surface.periodic and surface.pixel == pytest.approx((2e-6, 1e-6), rel=1e-12)
    with pytest.raises(ValueError, match="it has no unit"):
        tb.Surface(package.Topography(heights.T, (8.0, 3.0)))
    tilted = package.Topography(1e-6 * np.arange(20.0).reshape(5, 4), (5.0, 4.0), unit="m").detrend("height")
    np.testing.assert_array_equal(tb.Surface(tilted).height, tilted.heights().T)


def test_surface_topography_reads_the_same_surface(scan_file):
    package = pytest.importorskip("SurfaceTopography")
    mine, theirs = tb.read(scan_file), tb.Surface(package.read_topography(str(scan_file)))
    np.testing.assert_array_equal(theirs.height, mine.height)
    assert theirs.pixel == pytest.approx(mine.pixel, rel=1e-12)


def test_surfalize_itself(scan_file):
    package = pytest.importorskip("surfalize")
    heights = holed()
    surface = tb.Surface(package.Surface(heights * 1e6, 0.5, 0.5))
    np.testing.assert_allclose(surface.height, heights, rtol=1e-15)
    assert surface.pixel == pytest.approx((0.5e-6, 0.5e-6), rel=1e-12)
    mine, theirs = tb.read(scan_file), tb.Surface(package.Surface.load(str(scan_file)))
    np.testing.assert_allclose(theirs.height, mine.height, rtol=0, atol=1e-20)
    assert theirs.pixel == pytest.approx(mine.pixel, rel=1e-9)


def test_gwyfile_itself(tmp_path):
    package = pytest.importorskip("gwyfile")
    from gwyfile.objects import GwyContainer, GwyDataField, GwySIUnit

    def field(values, **units):
        units = {axis: GwySIUnit(unitstr=text) for axis, text in units.items()}
        return GwyDataField(values, xreal=4e-6, yreal=6e-6, **units)

    heights = 1e-6 * np.arange(12.0).reshape(3, 4)
    container = GwyContainer()
    container["/0/data"] = field(heights, si_unit_xy="m", si_unit_z="m")
    container.tofile(str(tmp_path / "a.gwy"))
    loaded = package.load(str(tmp_path / "a.gwy"))["/0/data"]
    for surface in (tb.Surface(container["/0/data"]), tb.Surface(loaded), tb.read(tmp_path / "a.gwy")):
        np.testing.assert_array_equal(surface.height, heights)
        assert surface.pixel == pytest.approx((1e-6, 2e-6), rel=1e-12)
    with pytest.raises(ValueError, match="unit of z: got .*; expected 'm'"):
        tb.Surface(field(heights, si_unit_xy="m", si_unit_z="V"))


def test_xarray_itself():
    package = pytest.importorskip("xarray")
    heights = holed()
    array = package.DataArray(heights * 1e9, {"y": 1e3 * np.arange(3.0), "x": 2e3 * np.arange(4.0)}, ("y", "x"),
                              attrs={"units": "nm"})
    array.x.attrs["units"] = array.y.attrs["units"] = "nm"
    for given in (array, array.transpose("x", "y")):
        surface = tb.Surface(given)
        np.testing.assert_allclose(surface.height, heights, rtol=1e-15)
        assert surface.pixel == pytest.approx((2e-6, 1e-6), rel=1e-12)
    with pytest.raises(ValueError, match="coordinate y: expected rising values"):
        tb.Surface(array.isel(y=slice(None, None, -1)))


# Heights that carry their unit

def test_a_quantity_of_pint_is_taken_in_its_unit():
    pint = pytest.importorskip("pint")
    unit = pint.UnitRegistry()
    for given in (Z * unit.um, Z * 1e3 * unit.nm, Z * 1e-6 * unit.m):
        surface = tb.Surface(given, pixel=0.5 * unit.um)
        np.testing.assert_allclose(surface.height, Z * 1e-6, rtol=1e-14)
        assert surface.pixel == pytest.approx((0.5e-6, 0.5e-6), rel=1e-15)
    np.testing.assert_allclose(tb.Surface(Z * unit.um, pixel=np.array([1.0, 2.0]) * unit.um, unit="um").height, Z * 1e-6, rtol=1e-14)
    masked = tb.Surface(unit.Quantity(np.ma.masked_equal(Z, 5.0), "um"), pixel=1e-6)
    assert masked.n_holes == 1 and masked.height[2, 3] == pytest.approx(11e-6, rel=1e-14)
    with pytest.raises(ValueError, match="heights: got an array in megapascal; expected a quantity in m"):
        tb.Surface(Z * unit.MPa, pixel=1e-6)


def test_a_unit_that_contradicts_the_heights_is_refused():
    pint = pytest.importorskip("pint")
    for unit in ("m", "nm"):
        with pytest.raises(ValueError, match=f"unit: got '{unit}' for heights that say they are in 'micrometer'; leave it out"):
            tb.Surface(Z * pint.UnitRegistry().um, pixel=1e-6, unit=unit)
    with pytest.raises(ValueError, match="unit: got 'um' for heights that say they are in 'm'"):
        tb.Surface(tb.Surface(Z, pixel=1e-6), pixel=1e-6, unit="um")
    with pytest.raises(ValueError, match="unit: got 'm' for heights that say they are in 'um'"):
        tb.Surface(SimpleNamespace(data=Z, step_x=0.5, step_y=0.25), unit="m")


@pytest.mark.parametrize("arguments", [{"pixel": "2 um"}, {"pixel": ("2 um", "2 um"), "unit": "um"}, {"pixel": 2e-6, "unit": "µm"}])
def test_an_array_of_xarray_is_taken_in_its_unit_when_the_pixel_is_given(arguments):
    xarray = pytest.importorskip("xarray")
    array = xarray.DataArray(Z, dims=("y", "x"), attrs={"units": "um"})
    for given in (array, array.transpose("x", "y"), array.rename(x="across", y="down")):
        np.testing.assert_allclose(tb.Surface(given, **arguments).height, Z * 1e-6, rtol=1e-15)
    with pytest.raises(ValueError, match="unit: got 'm' for heights that say they are in 'um'"):
        tb.Surface(array, pixel="2 um", unit="m")
    bare = xarray.DataArray(Z, dims=("y", "x"))
    np.testing.assert_array_equal(tb.Surface(bare, pixel=1e-6).height, Z)
    np.testing.assert_allclose(tb.Surface(bare, pixel=1e-6, unit="um").height, Z * 1e-6, rtol=1e-15)
    with pytest.raises(ValueError, match="units of the heights"):
        tb.Surface(array.assign_attrs(units="MPa"), pixel=1e-6)


def test_a_pixel_that_contradicts_the_coordinates_is_refused():
    xarray = pytest.importorskip("xarray")
    array = tb.Surface(Z * 1e-6, pixel=("1 um", "2 um")).to_xarray()
    assert tb.Surface(array, pixel=("1 um", "2 um")).pixel == pytest.approx((1e-6, 2e-6), rel=1e-12)
    with pytest.raises(ValueError, match="pixel: got 1e-06 m along y for an array whose coordinates are 2e-06 m apart"):
        tb.Surface(array, pixel="1 um")
    assert isinstance(array, xarray.DataArray)


def test_what_is_periodic_stays_so():
    surface = tb.Surface(Z * 1e-6, pixel="1 um", periodic=True)
    assert tb.Surface(surface).periodic and tb.Surface(surface).pixel == surface.pixel
    assert tb.Surface(SimpleNamespace(data=Z, step_x=0.5, step_y=0.25), periodic=True).periodic
