"""Errors are those that users of NumPy expect, and tabor's own."""

import pickle

import numpy as np
import pytest

import tabor as tb


@pytest.mark.parametrize("call", [lambda path: tb.read(path), lambda path: tb.load(path), lambda path: tb.Study.read(path),
                                  lambda path: tb.ehl.point(path), lambda path: tb.Results(path)])
def test_a_file_that_is_not_there_is_not_found(call, tmp_path):
    pytest.importorskip("h5py")
    for kind in (FileNotFoundError, OSError, ValueError, tb.InputError, tb.InputFileNotFound):
        with pytest.raises(kind, match="none.x: no such file|none.x: no results.csv") as raised:
            call(tmp_path / "none.x")
    assert raised.value.filename == str(tmp_path / "none.x")
    copy = pickle.loads(pickle.dumps(raised.value))
    assert (str(copy), copy.filename, type(copy)) == (str(raised.value), raised.value.filename, tb.InputFileNotFound)


def test_what_the_library_refuses_is_a_value_error(rough, tmp_path):
    for call in (lambda: rough.level("plain"), lambda: tb.Solid("nonsense")):
        with pytest.raises(tb.InputError) as raised:
            call()
        assert isinstance(raised.value, ValueError) and isinstance(pickle.loads(pickle.dumps(raised.value)), tb.InputError)


def test_advice_is_in_the_words_of_python():
    none = tb.Surface(np.zeros((4, 4)), pixel="1 um").apply(lambda z: z * np.nan)
    for call, words in ((lambda: none.level("plane"), r"lower degree \(treat\('level=mean'\)\)"),
                        (lambda: none.fill("harmonic"), r"check the channel \(channel=\) and the file"),
                        (lambda: none.psd(), r"fill them first \(treat\('fill=harmonic'\)\)")):
        with pytest.raises(tb.InputError, match=words) as raised:
            call()
        assert "--" not in str(raised.value)


def test_what_cannot_be_written_is_an_os_error(rough, tmp_path):
    with pytest.raises(tb.OutputError) as raised:
        rough.save(tmp_path / "none" / "a.sdf")
    assert isinstance(raised.value, OSError)


def test_versions_are_shown(capsys):
    tb.show_versions()
    said = capsys.readouterr().out
    assert f"tabor       {tb.__version__}" in said and "numpy" in said and "Python" in said
    assert "transforms  FFTW 3." in said or "transforms  ducc0 " in said


def test_what_reading_lacks_is_asked_for_as_an_argument(tmp_path):
    np.save(tmp_path / "heights.npy", np.ones((4, 4)))
    file = tmp_path / "heights.npy"
    for settings, words in (({}, "pixel='0.67um' unit='um'"), ({"pixel": "1um"}, "unit='um'"),
                            ({"pixel": "1um", "unit": "kg"}, "got unit='kg'; expected a length"),
                            ({"channel": "topography"}, "its number or name with channel=")):
        with pytest.raises(tb.InputError, match=words) as raised:
            tb.read(file, **settings)
        assert "--" not in str(raised.value)
    tb.read(file, pixel="1um", unit="um").save(tmp_path / "heights.h5")
    with pytest.raises(tb.InputError, match="drop pixel=; add override_unit=True"):
        tb.read(tmp_path / "heights.h5", pixel="2um")
