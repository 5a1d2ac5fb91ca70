"""Names that users of NumPy, xarray and other packages try: each is there, or the error says what to write."""

import types

import numpy as np
import pytest

import tabor as tb
from tabor import _guesses

#: What was tried and not found, as users wrote it.
TRIED = {
    "tabor": """load open read_result load_result hertz datasets lubricants oils set_num_threads get_threads threads show_versions
                Value stribeck parameters compare wear psd plot press solve film write Oil""",
    "type Surface": "from_array from_xarray read", "type Contact": "read",
    "Surface": """heights z data values dx dy pixel_size x y nx ny Lx Ly extent physical_sizes nb_grid_pts mask name unit ndim std mean Sa
                  Sq rms_height detrend remove_form gaussian filter rotate T downsample tile copy hist profile section acf plot_3d show
                  save attrs to_dataframe""",
    "Contact": """p load force max_pressure approach contact mask touching patches iterations shape x y to_dict to_dataframe saturated
                  plot""",
    "Film": "mean_thickness h density mask oil_density",
    "Friction": "mu cof mixed plot surface to_xarray",
    "Parameters": "Sa get keys items to_dict to_series",
    "DensityCurve": "density friction to_dataframe to_xarray interp",
    "Slide": "plot values rows to_xarray after",
    "Results": "values data to_dataframe plot errors rows", "FrictionTable": "values rows save entries",
    "Sweep": "min_film_m values plot",
    "Solution": "to_xarray plot film pressure central_film min_film",
    "Case": "replace",
}

#: Those that are there.
THERE = {
    "tabor": "load show_versions Value parameters", "type Surface": "from_array from_xarray",
    "Surface": "dx dy x y extent mask name unit ndim section save", "Contact": "force max_pressure touching patches saturated plot",
    "Friction": "plot to_xarray", "Parameters": "Sa get keys items", "DensityCurve": "to_xarray", "Slide": "to_xarray after", "Results": "rows",
    "FrictionTable": "entries", "Sweep": "min_film_m plot",
    "Solution": "to_xarray",
}


@pytest.fixture(scope="module")
def things(tmp_path_factory):
    surface = tb.generate("edt", pixels=32, seed=1)
    contact = tb.contact(surface, "10 MPa", "aluminium-6016")
    film = tb.rain(surface, "0.45 g/m^2")
    case = tb.ehl.squeeze(tb.ehl.template("squeeze"))
    results = tb.Study({"a": surface}, "aluminium-6016", pressure="10 MPa").run(tmp_path_factory.mktemp("names"))
    return {"tabor": tb, "Results": results, "FrictionTable": results.friction_table(), "type Surface": tb.Surface, "type Contact": tb.Contact, "Surface": surface, "Contact": contact, "Film": film,
            "Friction": tb.friction(contact, film), "Parameters": surface.parameters(), "DensityCurve": tb.density_curve(contact),
            "Slide": tb.slide(surface, "10 MPa", "aluminium-6016", "0.67 um", tool="ground:Sa=50nm", check=False),
            "Sweep": case.sweep({"lubricant.viscosity": ["0.4 Pa s"]}), "Solution": case.solve(), "Case": case}


@pytest.mark.parametrize("kind, name", [(kind, name) for kind, names in TRIED.items() for name in names.split()])
def test_it_is_there_or_the_error_says_what_to_write(things, kind, name):
    if name in THERE.get(kind, "").split():
        getattr(things[kind], name)
        return
    with pytest.raises(AttributeError) as raised:
        getattr(things[kind], name)
    title = kind.removeprefix("type ")
    start = f"module 'tabor' has no {name!r}; " if kind == "tabor" else f"{title} has no {name!r}; "
    assert str(raised.value).startswith(start) and len(str(raised.value)) > len(start) + 10, str(raised.value)
    assert not hasattr(things[kind], name)


def test_what_the_tables_know_is_not_there_and_what_they_advise_is(things):
    """A remedy that begins with a name is about one that there is."""
    for title, names in _guesses.GUESSES.items():
        thing = {"tabor": tb, "tabor.ehl": tb.ehl, "FluidFilm": tb.FluidFilm}.get(title, things.get(title))
        for name, text in names.items():
            with pytest.raises(AttributeError):
                getattr(thing, name)
            text = text.format(name=name)
            first = text.split("(")[0].split("[")[0].split(".")[0].split(" ")[0]
            if first.isidentifier() and title not in ("FluidFilm",):
                known = {*dir(thing), "Surface", "numpy", "tabor", "pandas", "a", "the", "point", "dict", "load"}
                assert first in known, (title, name, text)


def test_a_misspelt_name_has_the_nearest(things):
    for kind, name, near in (("Surface", "heigth", "height"), ("Contact", "presure", "pressure"), ("tabor", "surface", "Surface"),
                             ("Film", "Thickness", "thickness"), ("Results", "row", "rows"), ("tabor", "densty_curve", "density_curve")):
        with pytest.raises(AttributeError, match=f"has no '{name}'; did you mean '{near}'"):
            getattr(things[kind], name)
    with pytest.raises(AttributeError, match="has no 'xyzzy'$"):
        things["Surface"].xyzzy


def test_protocols_of_others_are_not_answered(things):
    for name in ("_repr_mimebundle_", "__array_interface__", "_ipython_display_", "__dataframe__"):
        for thing in things.values():
            assert not hasattr(thing, name)
    assert np.mean(things["Surface"]) == np.mean(things["Surface"].height)


@pytest.mark.parametrize("call, text", [
    (lambda s: tb.Solid(E=1e11, nu=0.3), "did you mean 'youngs_modulus'"), (lambda s: tb.Solid(youngs_modulus=1e11, nu=0.3), "did you mean 'poissons_ratio'"),
    (lambda s: tb.contact(s, 1e6, "aluminium-6016", tol=1e-3), "did you mean 'tolerance'"), (lambda s: tb.Lubricant(eta=0.1), "viscosity"),
    (lambda s: s.level(), "level: got no value; expected none|mean|poly2"), (lambda s: s.level(2), "level: got '2'; expected none|mean|poly2"),
    (lambda s: s.level("quadratic"), "level: got 'quadratic'; expected"), (lambda s: s.lowpass("gaussian:8um"), "got 'gaussian'; expected hann, .*gauss"),
    (lambda s: s.lowpass("gauss", "8 um"), "then ':' and a cutoff"), (lambda s: s.lowpass(8e-6), "then ':' and a cutoff"),
    (lambda s: s.resample(256), "expected nx,ny in pixels"), (lambda s: s.parameters(["Ra"]), "got 'Ra'; expected some of N, Sa")])
def test_arguments_that_are_tried_are_answered(things, call, text):
    with pytest.raises((TypeError, ValueError), match=text):
        call(things["Surface"])


def test_arguments_that_are_tried_and_taken(things):
    surface = things["Surface"]
    assert surface.crop((0, 0, 8, 6)).shape == (6, 8) == surface.crop("0,0,8,6").shape
    assert "Sdq" in surface.parameters(["hybrid"])
    case = tb.ehl.point(tb.ehl.template("point"), motion={"speed": "0.1 m/s"})
    assert "speed = 0.1" in case.toml or "100 mm/s" in case.toml or "0.1 m/s" in case.toml


def test_materials_by_name():
    assert tb.materials()["aluminium-6016"] == next(one for one in tb.materials() if one.name == "aluminium-6016") == tb.materials()[
        [one.name for one in tb.materials()].index("aluminium-6016")]
    with pytest.raises(KeyError) as raised:
        tb.materials()["aluminum"]
    assert str(raised.value).startswith("materials() has no 'aluminum'; did you mean 'aluminium-")


@pytest.mark.parametrize("kind", [kind for kind in TRIED if kind != "tabor"])
def test_completion_of_an_object_offers_what_is_explained(things, kind):
    """No module, no helper of the package, and nothing without a word about it."""
    pytest.importorskip("pandas")  # which makes a table
    thing = things[kind]
    names = [name for name in dir(thing) if not name.startswith("_")]
    assert names == sorted(set(names))
    for name in names:
        found = getattr(thing, name)
        assert not isinstance(found, types.ModuleType), name
        if callable(found):
            assert found.__doc__ and getattr(found, "__module__", "tabor").partition(".")[0] in ("tabor", "collections", "typing", "abc"), name


def test_what_completion_offers_is_public():
    assert set(dir(tb.ehl)) == set(tb.ehl.__all__) and set(dir(tb)) == {*tb.__all__, "Warning", "__version__"}
    names = {}
    exec("from tabor import *", names)
    assert "Warning" not in names and names["Surface"] is tb.Surface
