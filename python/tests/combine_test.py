"""Combined scans: the numbers and warnings of the command line."""

import json
import pickle
import subprocess

import numpy as np
import pytest

import tabor as tb


@pytest.fixture(scope="module")
def scans(tmp_path_factory):
    """A sheet before and after: moved by two pixels, with a pit of 20 x 30 pixels, 2 um deep."""
    folder = tmp_path_factory.mktemp("scans")
    sheet = tb.generate("edt", pixels=160, seed=5, periodic=False)
    before = tb.Surface(sheet.height[:128, :128], pixel=sheet.pixel)
    worn = sheet.height[:128, 2:130].copy()
    worn[50:70, 40:70] -= 2e-6
    after = tb.Surface(worn, pixel=sheet.pixel)
    for name, surface in (("before", before), ("after", after)):
        surface.save(folder / f"{name}.h5")
    return folder


@pytest.fixture(scope="module")
def combined(scans):
    return tb.combine(tb.read(scans / "before.h5"), tb.read(scans / "after.h5"))


def test_it_is_that_of_the_command_line(program, scans, combined):
    run = subprocess.run([program, "combine", scans / "before.h5", scans / "after.h5", "--json"], capture_output=True,
                         text=True, check=True)
    told = json.loads(run.stdout)
    assert combined.values and all(told[key] == value for key, value in combined.values.items())


def test_shift_and_volume_are_found(combined):
    pixel = combined.surface.pixel[0]
    assert combined.shift == pytest.approx((-2 * pixel, 0), abs=0.02 * pixel)
    assert combined.worn.volume == pytest.approx(600 * pixel**2 * 2e-6, rel=0.02)
    assert combined.net.volume == pytest.approx(combined.worn.volume, rel=0.05)
    assert combined.references == ("padfield2012",) and "padfield2012" in tb.cite(combined)
    assert "worn" in repr(combined) and "<table>" in combined._repr_html_()


def test_it_does_not_change_and_can_be_pickled(combined):
    with pytest.raises(AttributeError, match="does not change"):
        combined.shift = (0, 0)
    copy = pickle.loads(pickle.dumps(combined))
    assert dict(copy.values) == dict(combined.values)
    np.testing.assert_array_equal(copy.surface.height, combined.surface.height)


def test_two_faces_add_up():
    face = 1e-6 * np.random.default_rng(2).standard_normal((32, 32))
    flat = tb.Surface(np.zeros((32, 32)), pixel="1 um")
    found = tb.combine(tb.Surface(face, pixel="1 um"), flat, "composite", match="none")
    assert found.worn is None and found.references == ()
    np.testing.assert_allclose(found.surface.height, face, rtol=0, atol=1e-15)


def test_holes_that_leave_much_out_are_said():
    before = tb.generate("edt", pixels=64, seed=3)
    holes = before.height.copy()
    holes[::4, ::4] = np.nan
    found = tb.combine(before, tb.Surface(holes, pixel=before.pixel), shift=(0, 0))
    assert any("in or beside holes" in text for text in found.warnings)


@pytest.mark.parametrize("options, text", [({"mode": "wears"}, "mode: got 'wears'; expected wear, difference or composite"),
                                           ({"match": "tilt"}, "match: got 'tilt'; expected none, offset or plane"),
                                           ({"shift": ["1 um"]}, "shift: got 1 lengths; expected two"),
                                           ({"shift": ("1 MPa", 0)}, "shift"),
                                           ({"shift": ("1 m", 0)}, "overlap")])
def test_what_makes_no_sense_is_refused(rough, options, text):
    with pytest.raises(ValueError, match=text):
        tb.combine(rough, rough, **options)
