"""What goes to xarray goes into files of NetCDF and comes back, whoever writes them."""

import numpy as np
import pytest

import tabor as tb

xarray = pytest.importorskip("xarray")


@pytest.fixture(scope="module", params=["h5netcdf", "netcdf4", "scipy"])
def engine(request):
    pytest.importorskip({"netcdf4": "netCDF4"}.get(request.param, request.param))
    return request.param


@pytest.fixture(scope="module")
def results(rough, steel, tmp_path_factory):
    contact = tb.contact(rough.lowpass("gauss:4um"), 5e7, steel)
    pytest.importorskip("h5py")
    squeeze = tb.ehl.squeeze(tb.ehl.template("squeeze"))
    words = tb.ehl.point(tb.ehl.template("point"), **{"grid.nodes": 33})
    film = tb.rain(contact.surface, "0.45 g/m^2")
    spectra = contact.surface.psd()
    slow = tb.fluid_film(contact, film, tb.Lubricant("0.1 Pa s"), "1 mm/s")
    study = tb.Study({"a": rough, "b": tb.Scans(rough.lowpass("gauss:4um"), pressure="20 MPa")}, steel, pressure=["20 MPa", "50 MPa"],
                     density=["0.45 g/m^2", "0.9 g/m^2"]).run(tmp_path_factory.mktemp("study"))
    return {"Results": study, "FrictionTable": study.friction_table(group="a", keep=["flood"]), "Surface": contact.surface, "Contact": contact, "Film": film, "Friction": tb.friction(contact, film), "FluidFilm": slow,
            "DensityCurve": tb.density_curve(contact), "Parameters": contact.surface.parameters(["Sa", "hybrid"]), "Spectra": spectra,
            "Spectrum": spectra.radial, "MeanSpectrum": tb.mean_spectra([spectra, rough.psd()]).radial, "Section": contact.surface.section((0, 0), (2e-5, 1e-5)),
            "Combination": tb.combine(rough, rough, search=False),
            "Slide": tb.slide(rough, "10 MPa", steel, "3 um", step="1 um", tool="ground:Sa=10nm", check=False),
            "Solution": squeeze.solve(), "Solution of a point": words.solve(check=False),
            "Sweep": squeeze.sweep({"lubricant.viscosity": ["0.4 Pa s", "0.5 Pa s"]}),
            "Sweep of words": words.sweep({"roughness.kind": ["lapped-like"], "motion.speed": [0.5, 1.0]}, check=False)}


def test_all_that_goes_to_xarray_is_here(results):
    with_it = {name for name in (*tb.__all__, *tb.ehl.__all__) if hasattr(getattr(tb, name, getattr(tb.ehl, name, None)), "to_xarray")}
    assert with_it == {name for name in results if " " not in name}


NAMES = ["Results", "FrictionTable", "Surface", "Contact", "Film", "Friction", "FluidFilm", "DensityCurve", "Parameters", "Spectra", "Spectrum", "MeanSpectrum", "Section",
         "Combination", "Slide", "Solution", "Solution of a point", "Sweep", "Sweep of words"]


@pytest.mark.parametrize("name", NAMES)
def test_a_file_of_netcdf_holds_it_all(results, engine, tmp_path, name):
    result = results[name]
    given = result.to_xarray()
    data = given if isinstance(given, xarray.Dataset) else given.to_dataset()
    given.to_netcdf(tmp_path / "a.nc", engine=engine)
    with xarray.open_dataset(tmp_path / "a.nc", engine=engine) as read:
        xarray.testing.assert_allclose(read.load(), data, rtol=0, atol=0)
        attributes = read.attrs if isinstance(given, xarray.Dataset) else read[given.name].attrs
        for warning in getattr(result, "warnings", ()) if name != "Parameters" else ():
            assert (warning if isinstance(warning, str) else f"{warning.text} [{warning.code}]") in attributes["warnings"].split("\n")
        for key, value in getattr(result, "values", {}).items() if name in ("Contact", "Film", "Friction", "FluidFilm", "Combination") else ():
            if isinstance(value, (bool, int, float, str)) and value == value:
                assert attributes[key] == value, key


@pytest.mark.parametrize("name", NAMES)
def test_what_has_a_unit_says_it(results, name):
    given = results[name].to_xarray()
    data = given if isinstance(given, xarray.Dataset) else given.to_dataset()
    if name == "Slide":
        assert data.sheet.attrs["units"] == data.gap.attrs["units"] == "m" and data.pressure.attrs["units"] == "Pa"
        assert data.psd_x.attrs["units"] == "m^3" and data.sheet.dims == ("kept_distance", "y", "x") and data.mean_gap_m.attrs["units"] == "m"
        return
    if name in ("Results", "FrictionTable"):  # most of their columns are ratios, texts and counts
        with_unit = [key for key in {**data.data_vars, **data.coords} if "pressure" in key or "density" in key]
        assert len(with_unit) > 1 and all(data[key].attrs.get("units") for key in with_unit), with_unit
        return
    without = {"lubricated_share", "friction_lubricated", "touching", "saturated", "wet", "fill", "converged"}
    for key, array in {**data.data_vars, **data.coords}.items():
        assert key in without or array.attrs.get("units") or name.startswith("Sweep") or key.endswith(("_share", "_index0")), key


def test_studies_are_arrays_over_what_was_varied(results):
    """Scans under other pressures leave gaps."""
    data, rows = results["Results"].to_xarray(), results["Results"].rows
    assert data.friction_lubricated.dims == ("scan", "mean_pressure_Pa", "lubricant_density_g_per_m2")
    assert data.sizes == {"scan": 2, "mean_pressure_Pa": 2, "lubricant_density_g_per_m2": 2} and list(data.group.values) == ["a", "b"]
    assert data.contact_area_fraction.isnull().sum() == 2 and data.mean_pressure_Pa.attrs["units"] == "Pa"
    for row in rows:
        at = data.sel(scan=row["scan"], mean_pressure_Pa=row["mean_pressure_Pa"], lubricant_density_g_per_m2=row["lubricant_density_g_per_m2"])
        assert at.friction_dry == row["friction_dry"] and at.case_id == row["case_id"] and at.group == row["group"]
    table = results["FrictionTable"]
    friction = table.to_xarray().friction
    for one in table.entries:
        assert friction.sel(mean_pressure=one.mean_pressure, lubricant_density=one.lubricant_density) == one.friction


def test_warnings_are_there(results):
    assert results["Contact"].warnings and "warnings" in results["Contact"].to_xarray().attrs
    assert results["Contact"].to_xarray().attrs["converged"] == 1
    assert results["Contact"].to_xarray().attrs["references"].split("\n") == list(results["Contact"].references)
    assert results["Sweep of words"].to_xarray()["converged"].dtype == np.int8
