"""SI numbers, texts with a unit and quantities of pint mean the same; what is no value is refused."""

import numpy as np
import pytest

import tabor as tb


def area(surface, solid, pressure):
    return tb.contact(surface, pressure, solid).area_fraction


def test_number_text_and_numpy_scalar_are_the_same_pressure(rough, steel):
    assert area(rough, steel, 5e7) == area(rough, steel, "50 MPa") == area(rough, steel, np.float32(5e7))


def test_a_quantity_of_pint_is_taken(rough, steel):
    pint = pytest.importorskip("pint")
    assert area(rough, steel, pint.UnitRegistry()("50 MPa")) == area(rough, steel, 5e7)


def test_a_quantity_of_another_dimension_is_refused(rough, steel):
    pint = pytest.importorskip("pint")
    with pytest.raises(ValueError, match="pressure: got 5 millimeter; expected a quantity in Pa"):
        tb.contact(rough, pint.UnitRegistry()("5 mm"), steel)


@pytest.mark.parametrize("text, part", [("7", "unit"), ("7 mm", "pressure"), ("7 MPx", "MPx"), ("", "pressure")])
def test_a_text_without_its_unit_is_refused_in_one_line(rough, steel, text, part):
    with pytest.raises(ValueError, match=part) as refused:
        tb.contact(rough, text, steel)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize("value", [None, True, object(), b"7 MPa", {}])
def test_what_is_no_value_is_a_type_error(rough, steel, value):
    with pytest.raises(TypeError, match="pressure"):
        tb.contact(rough, value, steel)


def test_nan_is_refused(rough, steel):
    with pytest.raises(ValueError, match="pressure: got NaN"):
        tb.contact(rough, float("nan"), steel)


def test_an_empty_list_is_refused(rough, steel):
    with pytest.raises(ValueError, match="pressure: got an empty list"):
        tb.contact(rough, [], steel)
