"""Doubts about numbers are warnings of Python, once for each code."""

import pickle
import warnings

import pytest

import tabor as tb


@pytest.fixture
def told():
    """Warnings of Python that are given meanwhile."""
    with warnings.catch_warnings(record=True) as found:
        warnings.simplefilter("always")
        yield found


def codes_of(told):
    return [one.message.code for one in told if one.category is tb.Doubt]


def test_each_code_is_told_once_where_the_user_stands(levelled, told):
    first = tb.contact(levelled, "7 MPa", "aluminium-6016")
    doubts = [one.code for one in first.warnings if one.kind == "doubt"]
    assert doubts and codes_of(told) == doubts
    assert {one.filename for one in told} == {__file__}
    assert str(told[0].message) == f"{first.warnings[0].text} [{doubts[0]}]"
    tb.contact(levelled, ["5 MPa", "6 MPa"], "aluminium-6016")
    assert codes_of(told) == doubts


def test_filters_that_change_let_them_be_told_again(levelled):
    for _ in range(2):
        with warnings.catch_warnings(record=True) as found:
            warnings.simplefilter("always")
            tb.contact(levelled, "7 MPa", "aluminium-6016")
        assert codes_of(found)


def test_they_are_filtered_as_others(levelled, told):
    warnings.simplefilter("error", tb.Doubt)
    for _ in range(2):  # an error each time
        with pytest.raises(tb.Doubt, match=r"\[[a-z-]+\]$") as raised:
            tb.contact(levelled, "7 MPa", "aluminium-6016")
    assert raised.value.code and issubclass(tb.Doubt, UserWarning)
    warnings.simplefilter("ignore", tb.Doubt)
    tb.contact(levelled, "7 MPa", "aluminium-6016")
    assert told == []


def test_information_is_not_told(rough, steel, told):
    found = tb.rain(rough, "0.45 g/m^2")
    assert set(codes_of(told)) == {one.code for one in (*rough.warnings, *found.warnings) if one.kind == "doubt"}


def test_studies_and_films_under_load_tell_theirs(scan_file, tmp_path, told):
    study = tb.Study({"all": scan_file}, "aluminium-6016", pressure="7 MPa", treatment=["crop=0,0,48,48", "level=plane"])
    found = study.run(tmp_path / "r")
    assert codes_of(told) and all(any(f"[{code}]" in line for line in found.warnings) for code in codes_of(told) if code)
    before = len(told)
    case = tb.ehl.point(tb.ehl.template("point"), **{"grid.nodes": 33})
    solved = case.solve(check=False)
    assert {one.code for one in solved.warnings if one.kind == "doubt"} <= {*codes_of(told)} and len(told) > before


def test_they_can_be_pickled():
    copy = pickle.loads(pickle.dumps(tb.Doubt("text [code]", "code")))
    assert (str(copy), copy.code) == ("text [code]", "code") and tb.Doubt.__module__ == "tabor"
