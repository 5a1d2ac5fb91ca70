"""Power spectra of groups of scans."""

import json
import subprocess

import numpy as np
import pytest

import tabor as tb


@pytest.fixture(scope="module")
def scans():
    return [tb.generate("edt", pixels=48, pixel="1 um", seed=seed) for seed in (1, 2, 3)]


def test_a_mean_has_the_statistics_of_its_densities(scans):
    spectra = [scan.psd() for scan in scans]
    mean = tb.mean_spectra(spectra)
    for axis in ("x", "y", "radial"):
        one = getattr(mean, axis)
        densities = np.array([getattr(each, axis).density for each in spectra])
        np.testing.assert_array_equal(one.q, getattr(spectra[0], axis).q)
        np.testing.assert_allclose(one.density, densities.mean(axis=0), rtol=1e-12)
        np.testing.assert_allclose(one.standard_deviation, densities.std(axis=0, ddof=1), rtol=1e-9)
        np.testing.assert_allclose(one.standard_error, one.standard_deviation / np.sqrt(3), rtol=1e-12)
        assert (one.n, one.unit) == (3, getattr(spectra[0], axis).unit)


def test_the_terminal_prints_the_same(scans, program, tmp_path):
    files = [tmp_path / f"a{i}.npy" for i, _ in enumerate(scans)]
    for file, scan in zip(files, scans):
        np.save(file, scan.height)
    printed = subprocess.run([program, "psd", *files, "--pixel", "1um", "--unit", "m", "--group", "all=a*", "--json"],
                             capture_output=True, text=True, check=True)
    group = json.loads(printed.stdout)["groups"][0]["x"]
    mean = tb.mean_spectra([tb.read(file, pixel="1 um", unit="m").psd() for file in files]).x
    assert group["n"] == mean.n == 3
    np.testing.assert_allclose(group["q_rad_per_m"], mean.q, rtol=1e-9)
    np.testing.assert_allclose(group["mean"], mean.density, rtol=1e-9)
    np.testing.assert_allclose(group["std"], mean.standard_deviation, rtol=1e-9)


def test_one_spectrum_has_no_deviation(scans):
    mean = tb.mean_spectra([scans[0].psd()]).radial
    assert mean.n == 1 and np.isnan(mean.standard_deviation).all()
    np.testing.assert_array_equal(mean.density, scans[0].psd().radial.density)


def test_profiles_have_no_radial_mean():
    profile = tb.Surface(np.sin(np.arange(64.0)).reshape(1, -1) * 1e-6, pixel=1e-6)
    mean = tb.mean_spectra([profile.psd(), profile.psd()])
    assert mean.y is None and mean.radial is None and mean.x.n == 2
    assert "radial" not in repr(mean)


def test_bad_input(scans):
    spectra = scans[0].psd()
    with pytest.raises(ValueError, match="spectra: got none; expected a list of Spectra"):
        tb.mean_spectra([])
    with pytest.raises(TypeError, match="spectra: got list of Surface; expected a list of Spectra"):
        tb.mean_spectra(scans)
    with pytest.raises(ValueError, match="spectra: got the conventions jacobs and persson; expected one"):
        tb.mean_spectra([spectra, scans[1].psd("persson")])
    far = tb.Surface(scans[1].height, pixel="1 mm", periodic=True)
    with pytest.raises(ValueError, match="no two scans share"):
        tb.mean_spectra([spectra, far.psd()])


def test_it_is_drawn(scans):
    pyplot = pytest.importorskip("matplotlib.pyplot")
    figure, axes = pyplot.subplots()
    tb.mean_spectra([scan.psd() for scan in scans]).radial.plot(axes, label="mean")
    assert axes.get_xlabel() == "q [rad/m]" and axes.get_ylabel() == "density [m^4]"
    figure.canvas.draw()
    boxes = [label.get_window_extent() for label in axes.get_xticklabels(which="both") if label.get_text()]
    assert not any(a.overlaps(b) for i, a in enumerate(boxes) for b in boxes[:i] if a != b)
    pyplot.close(figure)
