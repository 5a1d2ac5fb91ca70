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


@pytest.mark.parametrize("text", ["225 mPa·s", "225 mPa.s", "225 millipascal * second", "0.225 Pa*s", "0.225 kg/m/s"])
def test_units_are_written_as_people_and_programs_write_them(text):
    assert tb.Lubricant(text).viscosity == pytest.approx(0.225, rel=1e-15)


@pytest.mark.parametrize("text", ["50 MPa", "7251.8868 psi", "0.9 g/m**2", "900 kg/m^3", "3 um", "0.2 N", "5 mm/s", "2e-8 1/Pa", "0.1 Pa s", "0.3"])
def test_quantities_of_pint_and_their_texts_are_the_same(text):
    """In all formats of pint that are no mathematics: "50 megapascal", "50 MPa", "0.9 g/m²"."""
    pint = pytest.importorskip("pint")
    quantity = pint.UnitRegistry()(text)
    dimension = {"MPa": "pressure", "psi": "pressure", "g/m**2": "areal_density", "kg/m^3": "density", "um": "length", "N": "force", "mm/s": "speed",
                 "1/Pa": "per_pressure", "Pa s": "viscosity", "": "none"}[text.partition(" ")[2]]
    number = tb._values.si(quantity, dimension, "x")
    for written in (text, str(quantity), f"{quantity:~}", f"{quantity:~P}", f"{quantity:P}", f"{quantity:C}", f"{quantity:~C}"):
        if "×" not in written:  # 2×10⁻⁸ is print, no number of a program
            assert tb._values.si(written, dimension, "x") == pytest.approx(number, rel=1e-12), written


def test_a_force_may_be_a_quantity(rough, steel):
    pint = pytest.importorskip("pint")
    found = tb.contact(rough, force=pint.UnitRegistry()("10 mN"), solid=steel, boundary="free")
    assert found.force == pytest.approx(0.01, rel=1e-9)


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


LISTS = {
    "generator": lambda: (value for value in (2e7, 5e7)), "range": lambda: range(20_000_000, 50_000_001, 30_000_000),
    "map": lambda: map(float, ("2e7", "5e7")), "texts": lambda: ["20 MPa", "50 MPa"], "mixed": lambda: (2e7, "50 MPa"),
    "single precision": lambda: np.array([2e7, 5e7], dtype=np.float32), "keys": lambda: {2e7: 0, 5e7: 0}.keys(),
}


@pytest.mark.parametrize("name", LISTS)
def test_many_values_may_come_in_any_order_of_things(rough, steel, name):
    assert [one.mean_pressure for one in tb.contact(rough, LISTS[name](), steel)] == [2e7, 5e7]
    assert [one.lubricant_density for one in tb.rain(rough, (1e-11 * value for value in (2e7, 5e7)))] == \
        pytest.approx([2e-4, 5e-4], rel=1e-15)


def test_lists_of_quantities_and_quantities_of_lists_are_taken(rough, steel):
    pint = pytest.importorskip("pint")
    unit = pint.UnitRegistry()
    for given in ([20 * unit.MPa, 50 * unit.MPa], np.array([20, 50]) * unit.MPa, (2e7 * unit.Pa, "50 MPa"),
                  (value * unit.MPa for value in (20, 50))):
        assert [one.mean_pressure for one in tb.contact(rough, given, steel)] == [2e7, 5e7]
    densities = [one.lubricant_density for one in tb.rain(rough, np.array([0.45, 0.9]) * unit.g / unit.m**2)]
    assert densities == pytest.approx([0.45e-3, 0.9e-3], rel=1e-15)
    scans = tb.Scans("a.x3p", pressure=np.array([20, 50]) * unit.MPa, density=[1 * unit.g / unit.m**2])
    assert scans._lines["pressure"] == '["20000000.0 Pa", "50000000.0 Pa"]' and scans._lines["density"] == '["0.001 kg/m^2"]'
    with pytest.raises(ValueError, match="pressure: got an array in millimeter; expected a quantity in Pa"):
        tb.contact(rough, np.array([20, 50]) * unit.mm, steel)


def test_quantities_of_astropy_and_unyt_are_taken(rough, steel):
    """As those packages build them: the unit is converted by to_value."""
    class Quantity(np.ndarray):
        unit = "MPa"

        def to(self, unit):
            raise AssertionError("to_value is asked")

        def to_value(self, unit):
            if unit != "Pa":
                raise TypeError(f"MPa are no {unit}")
            return 1e6 * np.asarray(self)

    assert [one.mean_pressure for one in tb.contact(rough, np.array([20.0, 50.0]).view(Quantity), steel)] == [2e7, 5e7]
    assert tb.contact(rough, np.array(50.0).view(Quantity), steel).mean_pressure == 5e7
    with pytest.raises(ValueError, match="density"):
        tb.rain(rough, np.array([20.0]).view(Quantity))


def test_quantities_of_astropy_themselves(rough, steel):
    units = pytest.importorskip("astropy.units")
    assert [one.mean_pressure for one in tb.contact(rough, [20, 50] * units.MPa, steel)] == [2e7, 5e7]
    assert tb.Surface(np.ones((4, 4)) * units.um, pixel=1 * units.um).height[0, 0] == pytest.approx(1e-6, rel=1e-15)


def test_arrays_of_xarray_are_taken_in_their_unit(rough, steel):
    xarray = pytest.importorskip("xarray")
    given = xarray.DataArray([20.0, 50.0], dims="p", attrs={"units": "MPa"})
    assert [one.mean_pressure for one in tb.contact(rough, given, steel)] == [2e7, 5e7]
    assert tb.contact(rough, given[1], steel).mean_pressure == 5e7
    assert [one.mean_pressure for one in tb.contact(rough, 1e6 * xarray.DataArray([20.0, 50.0]), steel)] == [2e7, 5e7]
    with pytest.raises(ValueError, match="pressure"):
        tb.contact(rough, xarray.DataArray([20.0], dims="p", attrs={"units": "mm"}), steel)


def test_series_of_pandas_are_taken(rough, steel):
    pandas = pytest.importorskip("pandas")
    assert [one.mean_pressure for one in tb.contact(rough, pandas.Series([2e7, 5e7]), steel)] == [2e7, 5e7]


@pytest.mark.parametrize("values", [{2e7, 5e7}, {"a": 2e7}, [2e7, None], [[2e7]], np.ones((2, 2)), (one for one in ("x", 2)), [1j]])
def test_what_has_no_order_or_is_no_number_is_refused(rough, steel, values):
    with pytest.raises((TypeError, ValueError), match="pressure"):
        tb.contact(rough, values, steel)
