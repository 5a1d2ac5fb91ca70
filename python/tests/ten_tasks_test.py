"""Ten tasks of a notebook, written by the documents alone; types hold under mypy --strict."""

from __future__ import annotations

import concurrent.futures
import multiprocessing
import pathlib
import pickle
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import tabor as tb

SHEET = pathlib.Path(__file__).resolve().parents[2] / "surfaces" / "edt_before.x3p"


@pytest.fixture(scope="module")
def sheet() -> tb.Surface:
    """A tile of the sample sheet."""
    return tb.read(SHEET).level("plane").crop(96, 96, 64, 64).mirror()


def test_1_twenty_scans_of_a_folder_as_a_table(tmp_path: pathlib.Path) -> None:
    pytest.importorskip("pandas")
    for group in ("before", "after"):
        for place in range(10):
            tb.generate("edt", pixels=64, seed=place, stage="before" if group == "before" else "after").save(tmp_path / f"{group}_{place}.sdf")
    table = tb.parameters(f"{tmp_path}/*.sdf", ["Sa", "Sq", "Sdq", "Sdr"], treatment=["level=plane"], fields="{group}_{place}")
    assert list(table.columns) == ["group", "place", "Sa", "Sq", "Sdq", "Sdr"] and len(table) == 20
    means = table.groupby("group")["Sq"].mean()
    assert 0 < means["after"] < means["before"] < 1e-5


def test_2_area_against_pressure_of_three_scans_with_error_bars() -> None:
    pyplot = pytest.importorskip("matplotlib.pyplot")
    pressures = np.geomspace(1e6, 50e6, 5)
    scans = [tb.generate("edt", pixels=64, seed=seed) for seed in (1, 2, 3)]
    contacts: list[list[tb.Contact]] = [tb.contact(scan, pressures, "aluminium-6016") for scan in scans]
    areas = np.array([[one.area_fraction for one in of_scan] for of_scan in contacts])
    figure, axes = pyplot.subplots()
    axes.errorbar(1e-6 * pressures, areas.mean(axis=0), areas.std(axis=0, ddof=1), fmt="o-", capsize=3)
    axes.set(xscale="log", yscale="log", xlabel="pressure [MPa]", ylabel="real over nominal area")
    assert (np.diff(areas, axis=1) > 0).all()
    pyplot.close(figure)


def test_3_friction_of_two_densities_against_the_density(sheet: tb.Surface) -> None:
    pressed = tb.contact(sheet, "7 MPa", "aluminium-6016")
    films: list[tb.Film] = tb.rain(sheet, ["0.45 g/m^2", "3 g/m^2"], oil_density=900)
    frictions = [tb.friction(pressed, film, boundary_shear_strength="5 MPa") for film in films]
    curve = tb.density_curve(pressed, density=["0.45 g/m^2", "3 g/m^2"], boundary_shear_strength="5 MPa")
    at = np.interp([film.lubricant_density for film in films], curve.lubricant_density, curve.friction_lubricated)
    assert frictions[1].lubricated < frictions[0].lubricated <= frictions[0].dry
    assert at[1] == pytest.approx(frictions[1].lubricated, rel=0.05)
    assert "g/m^2" in curve.says(frictions)


def area_with(surface: tb.Surface, saturation_pressure: float) -> float:
    """Computed by a worker."""
    solid = tb.Solid("aluminium-6016", saturation_pressure=saturation_pressure)
    return tb.contact(surface, "7 MPa", solid).area_fraction


def test_4_the_saturation_pressure_in_a_pool_of_processes(sheet: tb.Surface) -> None:
    caps = [150e6, 240e6, 400e6]
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn")) as executor:
        areas = list(executor.map(area_with, [sheet] * 3, caps))
    assert areas == sorted(areas, reverse=True) and areas[1] == area_with(sheet, caps[1])


def test_5_a_stribeck_curve_with_the_film_of_one_speed_beside_it() -> None:
    pyplot = pytest.importorskip("matplotlib.pyplot")
    pytest.importorskip("xarray")
    pytest.importorskip("h5py")
    case = tb.ehl.point(tb.ehl.template("point"), grid={"nodes": 33})
    curve: tb.ehl.Sweep = case.sweep({"motion.speed": np.geomspace(0.03, 3, 4)})
    one: tb.ehl.Solution = tb.ehl.point(tb.ehl.template("point"), grid={"nodes": 33}, motion={"speed": "0.3 m/s"}).solve()
    figure, (left, right) = pyplot.subplots(1, 2)
    curve.plot("friction_coefficient", left)
    maps = one.to_xarray()
    (1e9 * maps.contact_film).plot(ax=right)
    assert left.get_xscale() == "log" and maps.contact_film.attrs["units"] == "m"
    assert curve["central_film_m"].argmax() == curve.axes["motion.speed"].index(max(curve.axes["motion.speed"]))
    pyplot.close(figure)


def low_waves(z: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Of a filter of one's own: waves longer than four pixels."""
    waves = np.fft.rfft2(z)
    along_y, along_x = np.fft.fftfreq(z.shape[0])[:, None], np.fft.rfftfreq(z.shape[1])[None, :]
    waves[np.hypot(along_y, along_x) > 0.25] = 0
    return np.fft.irfft2(waves, z.shape)


def test_6_an_array_and_a_filter_of_ones_own_under_a_force_in_newtons() -> None:
    heights = 1e-6 * np.random.default_rng(1).standard_normal((48, 64))
    own = tb.Surface(heights, pixel="1 um", name="mine").apply(low_waves, "waves above 4 pixels")
    pressed = tb.contact(own, force="0.05 N", solid="aluminium-6016", boundary="free")
    assert pressed.force == pytest.approx(0.05, rel=1e-9)
    assert pressed.surface.history == ("waves above 4 pixels",) and pressed.touching.any()


def test_7_hertz_by_the_separation() -> None:
    """A paraboloid pressed in by d bears 4/3 E* sqrt(R) d^1.5 (Johnson 1985, section 4.2)."""
    radius, modulus, depth, n, pixel = 1e-3, 70e9 / (1 - 0.33**2), 2e-7, 128, 0.5e-6
    x = pixel * (np.arange(n) - n / 2 + 0.5)
    ball = tb.Surface(-(x**2 + x[:, None]**2) / (2 * radius), pixel=pixel)
    elastic = tb.Solid(youngs_modulus="70 GPa", poissons_ratio=0.33)
    pressed: tb.Contact = tb.contact(ball, separation=-depth, solid=elastic, boundary="free")
    assert pressed.force == pytest.approx(4 / 3 * modulus * np.sqrt(radius * depth**3), rel=0.01)


def test_8_netcdf_pickle_and_files_of_every_result(sheet: tb.Surface, tmp_path: pathlib.Path) -> None:
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("h5netcdf")
    pytest.importorskip("h5py")
    contact, film = tb.contact(sheet, "7 MPa", "aluminium-6016"), tb.rain(sheet, "0.9 g/m^2")
    slid = tb.slide(sheet, "7 MPa", "aluminium-6016", "2 um", step="0.67 um", tool="ground:Sa=0.1um")
    study = tb.Study({"sheet": sheet}, "aluminium-6016", pressure=["2 MPa", "7 MPa"], density="0.9 g/m^2")
    squeeze = tb.ehl.squeeze(tb.ehl.template("squeeze"))
    results: dict[str, Any] = {
        "contact.h5": contact, "film.h5": film, "friction.h5": tb.friction(contact, film), "slide.h5": slid,
        "fluid.h5": tb.fluid_film(contact, film, tb.Lubricant("0.1 Pa s"), "1 mm/s"), "sheet.h5": sheet,
        "wear.h5": tb.combine(sheet, slid.after, shift=(0, 0), match="none"), "numbers.json": sheet.parameters("height", "hybrid"),
        "solution.h5": squeeze.solve(), "sweep.h5": squeeze.sweep({"lubricant.viscosity": ["0.4 Pa s", "0.5 Pa s"]}),
        "study": study.run(tmp_path / "study")}
    for name, result in results.items():
        given = result.to_xarray()
        given.to_netcdf(tmp_path / "result.nc", engine="h5netcdf")
        with (xarray.open_dataarray if isinstance(given, xarray.DataArray) else xarray.open_dataset)(
                tmp_path / "result.nc", engine="h5netcdf") as read:
            assert read.equals(given), name
        if name != "study":
            result.save(tmp_path / name)
        again = tb.load(tmp_path / name)
        assert type(again) is type(result) and repr(again).split("\n")[0] == repr(result).split("\n")[0], name
        copy = pickle.loads(pickle.dumps(result))
        assert repr(copy) == repr(result), name


def test_9_a_slider_over_the_pressure(sheet: tb.Surface) -> None:
    widgets = pytest.importorskip("ipywidgets")
    seen: list[float] = []

    def show(pressure: float) -> None:
        seen.append(tb.contact(sheet, f"{pressure} MPa", "aluminium-6016").area_fraction)

    shown = widgets.interactive(show, pressure=widgets.FloatSlider(7, min=1, max=50))
    shown.update()
    shown.children[0].value = 20
    assert len(set(seen)) == 2 and seen[0] < seen[-1]  # versions differ in how often they call


def test_10_the_same_surface_in_surface_topography_and_back(sheet: tb.Surface) -> None:
    topography = pytest.importorskip("SurfaceTopography")
    theirs = topography.Topography(sheet.height.T, physical_sizes=sheet.lengths, unit="m", periodic=True)
    again = tb.Surface(theirs)
    np.testing.assert_array_equal(again.height, sheet.height)
    assert again.lengths == pytest.approx(sheet.lengths, rel=1e-15) and again.periodic
    assert theirs.rms_height_from_area() == pytest.approx(sheet.parameters("Sq").Sq, rel=1e-12)


def test_10_the_same_contact_in_tamaas(sheet: tb.Surface) -> None:
    tamaas = pytest.importorskip("tamaas")
    (lx, ly), (ny, nx) = sheet.lengths, sheet.shape
    elastic = tb.Solid("aluminium-6016", saturation_pressure="none")
    mine = tb.contact(sheet, "7 MPa", elastic, tolerance=1e-10)
    model = tamaas.Model(tamaas.model_type.basic_2d, [ly, lx], [ny, nx])
    model.E, model.nu = elastic.effective_modulus, 0
    tamaas.PolonskyKeerRey(model, sheet.height.copy(), 1e-12).solve(7e6)
    np.testing.assert_allclose(model.traction, mine.pressure, atol=1e-4 * mine.max_pressure)
    deformed = sheet.apply(lambda z: z - np.asarray(model.displacement), "pressed in Tamaas")
    assert np.ptp(deformed.height[mine.touching]) < 1e-3 * np.ptp(sheet.height)  # a flat lies on it
