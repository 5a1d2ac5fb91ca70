"""Generated surfaces, formats and citations are those of the command line."""

import json
import subprocess

import numpy as np
import pytest

import tabor as tb


@pytest.mark.parametrize("kind, words, arguments", [
    ("edt", ["--stage", "after", "--pressure", "10MPa", "--plateau-share", "0.4", "--not-periodic"],
     {"stage": "after", "pressure": "10 MPa", "plateau_share": 0.4, "periodic": False}),
    ("self-affine", ["--rms-slope", "0.1", "--random-amplitudes"], {"rms_slope": 0.1, "random_amplitudes": True}),
    ("ground", ["--groove-spacing", "10um"], {"groove_spacing": 1e-5})])
def test_surfaces_are_those_of_the_command_line_to_the_last_bit(program, tmp_path, kind, words, arguments):
    file = tmp_path / "a.h5"
    subprocess.run([program, "generate", kind, "-o", file, "--pixels", "48,32", "--pixel", "1um", "--seed", "3", *words,
                    "--quiet"], check=True, capture_output=True)
    found = tb.generate(kind, pixels=(48, 32), pixel="1 um", seed=3, **arguments)
    np.testing.assert_array_equal(found.height, tb.read(file).height)
    assert found.shape == (32, 48) and found.periodic == tb.read(file).periodic


def test_a_wave_is_its_closed_form():
    found = tb.generate("sinusoid", pixels=32, pixel=1e-6, amplitude="2 um", wavelength_x="16 um")
    np.testing.assert_allclose(found.height[5], 2e-6 * np.cos(2 * np.pi * np.arange(32) / 16), atol=1e-20)


@pytest.mark.parametrize("kind, arguments, text", [
    ("sinusiod", {}, "did you mean 'sinusoid'"), ("bump", {"height": 1e-6}, "radius is missing"),
    ("sphere", {"radius": "1 mm", "noise": 0}, "noise does not belong"),
    ("edt", {"stage": "later"}, "stage: got 'later'"),
    ("edt", {"noise": "1 MPa"}, "noise"), ("edt", {"pixels": 0}, "pixel"), ("edt", {"pixel": 1.5}, "craters of 50"),
    ("ground", {"pixel": 1.5}, "groove spacing"), ("sphere", {"pixel": 1.5, "radius": 1e-3}, "two pixels"),
    ("bump", {"height": float("inf"), "radius": 1e-4}, "height: got inf"), ("edt", {"seed": -1}, "seed: got -1")])
def test_what_no_surface_can_be_is_refused(kind, arguments, text):
    with pytest.raises(ValueError, match=text):
        tb.generate(kind, **arguments)


def test_numbers_are_explained():
    assert "plateau_share : edt: share of the area" in tb.generate.__doc__


def test_a_setting_that_no_surface_has_is_refused_with_the_nearest():
    with pytest.raises(TypeError, match="generate.* unexpected keyword argument 'noize'; did you mean 'noise'"):
        tb.generate("edt", noize=0)


def test_formats_are_those_of_the_command_line(program):
    run = subprocess.run([program, "formats", "--json"], capture_output=True, text=True, check=True)
    told = [(row["name"], tuple(row["extensions"]), row["writes"]) for row in json.loads(run.stdout)["formats"]]
    assert told == [(one.name, one.extensions, one.writes) for one in tb.formats()]


def test_a_file_is_cited_as_on_the_command_line(program, tmp_path):
    file = tmp_path / "a.h5"
    subprocess.run([program, "generate", "edt", "-o", tmp_path / "scan.h5", "--pixels", "32"], check=True,
                   capture_output=True)
    subprocess.run([program, "contact", tmp_path / "scan.h5", "--level", "plane", "--pressure", "1MPa", "--material", "aluminium-6016",
                    "-o", file], check=True, capture_output=True)
    assert tb.cite(file) == subprocess.run([program, "cite", file], capture_output=True, text=True, check=True).stdout
    assert tb.cite() == subprocess.run([program, "cite"], capture_output=True, text=True, check=True).stdout


def test_results_are_cited_with_the_software_below_them(rough, steel):
    dry = tb.contact(rough, 5e7, steel)
    text = tb.cite(dry, tb.rain(rough, "0.2 g/m^2"))
    transforms = "{ducc0," if tb._tabor.transforms.startswith("ducc0") else "{frigo2005,"
    assert text.startswith("@software{tabor,") and transforms in text and "{salmon2011," in text
    for key in dry.references:
        assert f"{{{key}," in text
    assert "{hdf5," not in text and "{salmon2011," not in tb.cite(dry)
    with pytest.raises(TypeError, match="results: got int"):
        tb.cite(1)


def test_a_file_of_others_is_not_cited(tmp_path):
    with pytest.raises(ValueError, match="none.h5"):
        tb.cite(tmp_path / "none.h5")
