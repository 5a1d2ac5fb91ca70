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
