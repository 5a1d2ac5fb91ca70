"""Roughness parameters as a mapping, and of many scans as a table."""

import pickle

import numpy as np
import pytest

import tabor as tb
from conftest import heights


@pytest.fixture(scope="module")
def found(levelled):
    return levelled.parameters()


def test_they_are_a_mapping(found, levelled):
    assert list(found)[:2] == ["Sa", "Sq"] or "Sa" in found
    assert len(found) == len(list(found.items())) and found.get("none") is None
    assert dict(found)["Sq"] == found["Sq"] == found.Sq == levelled.parameters("Sq").Sq
    assert "Sq" in dir(found) and float(np.std(levelled.height)) == pytest.approx(found.Sq, rel=1e-9)


def test_one_is_a_number_that_knows_its_unit(found):
    one = found.Sq
    assert isinstance(one, float) and one.value == one and 1e6 * one == pytest.approx(1e6 * one.value)
    assert (one.symbol, one.unit, one.set) == ("Sq", "m", "height") and "square" in one.definition
    assert repr(one).startswith("Sq = ") and repr(one).endswith(" m")
    with pytest.raises(AttributeError, match="does not change"):
        one.unit = "um"
    with pytest.raises(AttributeError, match="does not change"):
        found.Sq = 1


def test_sets_stand_for_their_parameters(found, levelled):
    hybrid = levelled.parameters(["hybrid"])
    assert dict(hybrid) == dict(found.sets["hybrid"]) and {"Sdq", "Sdr"} <= set(hybrid)
    assert list(levelled.parameters(["Sq", "hybrid", "Sq"])) == ["Sq", *hybrid]
    assert list(levelled.parameters("Sq")) == ["Sq"]
    assert dict(levelled.parameters("Sa", "Sq", "hybrid")) == dict(levelled.parameters(["Sa", "Sq", "hybrid"]))


def test_a_name_that_is_none_has_its_nearest(found, levelled):
    with pytest.raises(KeyError) as raised:
        found["sa"]
    assert str(raised.value).startswith("Parameters has no 'sa'; did you mean 'Sa'")
    with pytest.raises(AttributeError, match="has no 'sdq'; did you mean 'Sdq'"):
        found.sdq
    with pytest.raises(ValueError, match="symbols: got 'Ra'; expected some of .*, or the sets .*hybrid"):
        levelled.parameters(["Ra"])
    with pytest.raises(ValueError, match="symbols: got 'sq'; .*did you mean 'Sq'"):
        levelled.parameters(["sq"])


def test_they_know_their_surface(found, levelled):
    assert (found.source, found.history, found.warnings) == (levelled.source, levelled.history, levelled.warnings)
    assert found.sets["hybrid"].source == levelled.parameters("Sa").source == levelled.source


def test_a_pickle_keeps_them(found):
    copy = pickle.loads(pickle.dumps(found))
    assert list(copy) == list(found) and copy.Sq.definition == found.Sq.definition
    np.testing.assert_array_equal([*copy.values()], [*found.values()])


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    path = tmp_path_factory.mktemp("scans")
    for i, name in enumerate(("before_1", "before_2", "after_10")):
        tb.Surface(heights(16, i), pixel=1e-6).save(path / f"{name}.sdf")
    return path


def test_scans_of_a_folder_are_a_table(folder):
    pandas = pytest.importorskip("pandas")
    table = tb.parameters(folder / "*.sdf", ["Sa", "hybrid"], treatment=["level=plane"], fields="{group}_{place}")
    assert list(table.columns)[:3] == ["group", "place", "Sa"] and "Sdq" in table
    assert list(table.index) == ["after_10.sdf", "before_1.sdf", "before_2.sdf"] and table.index.name == "scan"
    assert list(table.place) == [10, 1, 2] and list(table.group) == ["after", "before", "before"]
    assert table.attrs["units"]["Sa"] == "m"
    one = tb.read(folder / "before_1.sdf").level("plane").parameters("Sa").Sa
    assert table.loc["before_1.sdf", "Sa"] == float(one)
    assert isinstance(table.groupby("group").Sa.mean(), pandas.Series)


def test_surfaces_and_files_may_be_mixed(folder):
    pytest.importorskip("pandas")
    surface = tb.read(folder / "before_1.sdf")
    table = tb.parameters([surface, str(folder / "before_2.sdf"), folder / "after_*.sdf", surface], "Sq")
    assert len(table) == 4 and table.Sq.iloc[0] == table.Sq.iloc[3] and table.index.is_unique


@pytest.mark.parametrize("fields, text", [("{a}-{b}", "does not fit the name 'after_10.sdf'"), ("plain", "without a name in braces"),
                                          ("{a}_{a}", "different names in braces"), ("{}", "different names")])
def test_forms_of_names_are_checked(folder, fields, text):
    pytest.importorskip("pandas")
    with pytest.raises(ValueError, match=f"fields: .*{text}"):
        tb.parameters(folder / "*.sdf", "Sq", fields=fields)


def test_a_pattern_without_files_and_an_empty_list_are_refused(folder):
    pytest.importorskip("pandas")
    for scans, text in ((folder / "*.x3p", "which no file fits"), ([], "empty list"), (folder / "none.sdf", "none.sdf")):
        with pytest.raises(ValueError, match=text):
            tb.parameters(scans)
    with pytest.raises(TypeError, match="scans: got int 3"):
        tb.parameters(3)


def test_a_scan_that_cannot_be_treated_is_named(folder):
    pytest.importorskip("pandas")
    with pytest.raises(tb.InputError, match=r"before_2\.sdf: crop: got 0,0,64,64 pixels"):
        tb.parameters([folder / "before_2.sdf"], "Sq", treatment=["crop=0,0,64,64"])


def test_pandas_is_asked_for(monkeypatch, folder):
    monkeypatch.setitem(__import__("sys").modules, "pandas", None)
    with pytest.raises(ImportError, match="needs pandas; pip install pandas"):
        tb.parameters(folder / "*.sdf")
