"""Files that tabor and other packages exchange: what one writes, the other reads."""

import numpy as np
import pytest

import tabor as tb


def holed():
    heights = 1e-6 * np.arange(12.0).reshape(3, 4)
    heights[1, 2] = np.nan
    return tb.Surface(heights, pixel=("1 um", "2 um"))


def assert_same(surface, heights, rtol=1e-12):
    np.testing.assert_array_equal(np.isnan(surface.height), np.isnan(heights))
    np.testing.assert_allclose(surface.height, heights, rtol=rtol, atol=1e-15)


def read_by_surface_topography(file):
    SurfaceTopography = pytest.importorskip("SurfaceTopography")
    return SurfaceTopography.read_topography(str(file))


def in_metres(topography):
    heights = np.ma.filled(np.ma.masked_array(topography.heights(), dtype=float), np.nan).T
    return heights * {"m": 1, "µm": 1e-6}[topography.unit]


@pytest.mark.parametrize("name, rtol", [("a.nc", 1e-12), ("a.sur", 1e-6), ("a.x3p", 1e-12)])
def test_surface_topography_reads_what_tabor_writes(tmp_path, name, rtol):
    surface = holed()
    surface.save(tmp_path / name)
    other = read_by_surface_topography(tmp_path / name)
    assert_same(surface, in_metres(other), rtol)
    np.testing.assert_allclose(other.to_unit("m").physical_sizes, (4e-6, 6e-6), rtol=1e-6)


def test_tabor_reads_netcdf_of_surface_topography(tmp_path):
    SurfaceTopography = pytest.importorskip("SurfaceTopography")
    heights = holed().height
    masked = np.ma.masked_invalid(heights.T * 1e6)
    SurfaceTopography.Topography(masked, (4, 6), unit="µm", periodic=True).to_netcdf(str(tmp_path / "a.nc"))
    surface = tb.read(tmp_path / "a.nc")
    assert_same(surface, heights)
    assert surface.pixel == pytest.approx((1e-6, 2e-6), rel=1e-12) and surface.periodic


def test_lines_of_surface_topography_become_rows(tmp_path):
    SurfaceTopography = pytest.importorskip("SurfaceTopography")
    SurfaceTopography.UniformLineScan(np.array([1.0, 2, 4]), 6.0, unit="mm").to_netcdf(str(tmp_path / "even.nc"))
    np.testing.assert_allclose(tb.read(tmp_path / "even.nc").height, [[1e-3, 2e-3, 4e-3]], rtol=1e-12)
    SurfaceTopography.NonuniformLineScan([0, 1, 3, 4.5], [1, 2, 0, 3.0], unit="um").to_netcdf(str(tmp_path / "line.nc"))
    np.testing.assert_allclose(tb.read(tmp_path / "line.nc").height, [[1e-6, 1.5e-6, 0, 3e-6]], rtol=1e-12, atol=1e-18)


def test_containers_go_there_and_back(tmp_path):
    SurfaceTopography = pytest.importorskip("SurfaceTopography")
    from SurfaceTopography.Container.IO import read_container

    surface = holed()
    surface.save(tmp_path / "a.zip")
    (container,) = read_container(str(tmp_path / "a.zip"))
    assert_same(surface, in_metres(container[0]))
    container.to_zip(str(tmp_path / "b.zip"))
    assert_same(tb.read(tmp_path / "b.zip"), surface.height)
    assert SurfaceTopography.__version__


def test_surfalize_reads_what_tabor_writes(tmp_path):
    surfalize = pytest.importorskip("surfalize")
    surface = holed()
    surface.save(tmp_path / "a.sur")
    other = surfalize.Surface.load(tmp_path / "a.sur")
    assert_same(surface, np.asarray(other.data) * 1e-6, rtol=1e-6)
    assert (other.step_x, other.step_y) == pytest.approx((1, 2), rel=1e-6)
