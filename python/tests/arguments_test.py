"""Every public function with wrong types for every argument: TypeError or ValueError that names it, and nothing else."""

import concurrent.futures
import functools
import importlib
import importlib.util
import inspect
import re
from types import SimpleNamespace

import numpy as np
import pytest

import tabor as tb
from tabor import _settings
from conftest import heights

pytest.importorskip("xarray", reason="no xarray: arguments of it are not asked")

#: None of them is what most arguments are; what an argument takes all the same is no fault.
WRONG = [None, object(), True, 1.5, -1, 0, 2**70, float("nan"), float("inf"), 1j, b"x", "nonsense", "5 m", "", [], {}, (),
         [object()], [None], {"a": object()}, {1: 2}, np.array(["x"]), np.ones((2, 2)), np.datetime64("2020-01-01"), print,
         SimpleNamespace(units="m")]

#: Classes that the package makes and a user does not.
MADE_BY_TABOR = {"Combination", "Contact", "DensityCurve", "Doubt", "Film", "FluidFilm", "Format", "Friction", "FrictionEntry",
                 "InputError", "InputFileNotFound", "InputIncomplete", "OutputError",
                 "Material", "Materials", "MeanSpectra", "MeanSpectrum", "NameNotFound", "NotConverged", "Parameter", "Parameters", "Plateau", "Progress", "Report", "Section", "Slide", "Spectra", "Spectrum",
                 "Value", "Volume", "ehl.Key", "ehl.Limit", "ehl.Solution", "ehl.Sweep", "ehl.Template"}


@functools.cache
def things():
    """One of each kind, small."""
    surface = tb.Surface(heights(16), pixel=1e-6, periodic=True)
    solid = tb.Solid(youngs_modulus="210 GPa", poissons_ratio=0.3, shear_strength="300 MPa", saturation_pressure="2 GPa")
    contact = tb.contact(surface, 5e7, solid)
    film = tb.rain(surface, "0.45 g/m^2")
    case = tb.ehl.squeeze(tb.ehl.template("squeeze"))
    return SimpleNamespace(surface=surface, solid=solid, contact=contact, film=film, friction=tb.friction(contact, film), case=case,
                           oil=tb.Lubricant("0.1 Pa s"), curve=tb.density_curve(contact), psd=surface.psd(), mean=tb.mean_spectra([surface.psd()]), section=surface.section((0, 0), (1e-5, 1e-5)), solved=case.solve(),
                           combined=tb.combine(surface, surface, search=False),
                           flowing=tb.fluid_film(contact, film, tb.Lubricant("0.1 Pa s"), "1 mm/s"),
                           slid=tb.slide(surface, 5e7, solid, surface.dx, tool="ground:Sa=10nm", check=False),
                           swept=case.sweep({"lubricant.viscosity": ["0.4 Pa s", "0.5 Pa s"]}))


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """With a scan, a study's results and room for files."""
    path = tmp_path_factory.mktemp("arguments")
    things().surface.save(path / "a.sdf")
    study = tb.Study({"a": str(path / "a.sdf")}, things().solid, pressure=["20 MPa", "50 MPa"], density="0.45 g/m^2")
    study.run(path / "results")
    return path


def calls(folder):
    """What each public function is called with when all is well: {name: (function, arguments)}."""
    t = things()
    file = folder / "a.sdf"
    shear = {"shear_strength": "300 MPa", "boundary_shear_strength": None, "boundary_shear_share": None, "area": None}
    table = tb.FrictionTable(folder / "results")
    deck = {"file": folder / "deck.k", "units": "mm,s,t"}
    oil = {"dry_below": 1e-9, "trapped": True, "bulk_modulus": 1.5e9}
    rain = {"oil_density": 900, "reading": "conserving", "edge": "closed"}
    study = tb.Study({"a": str(file)}, t.solid, pressure="20 MPa")
    picture = {"ax": None, "window": (0, 0, 5e-6, 5e-6), "cmap": "viridis"}
    return {
        "Surface": (tb.Surface, {"z": heights(8), "pixel": 1e-6, "unit": "m", "periodic": False, "name": "array"}),
        "Surface.parameters": (t.surface.parameters, {"symbols": ["Sq"], "progress": None}),
        "Surface.psd": (t.surface.psd, {"convention": "jacobs", "window": "none", "fit_min": None, "fit_max": None}),
        "Surface.save": (t.surface.save, {"file": folder / "b.sdf"}),
        "Surface.plot": (t.surface.plot, picture),
        "Surface.from_array": (tb.Surface.from_array, {"z": heights(8), "pixel": 1e-6, "unit": "m", "periodic": False, "name": "array"}),
        "Surface.from_xarray": (tb.Surface.from_xarray, {"array": t.surface.to_xarray()}),
        "Surface.apply": (t.surface.apply, {"function": np.cbrt, "note": "root"}),
        "Surface.section": (t.surface.section, {"p": (0, 0), "q": ("5 um", 1e-6)}),
        "Surface.treat": (t.surface.treat, {"progress": None}),
        **{f"Surface.{step}": (getattr(t.surface, step), {"progress": None}) for step in ("mirror",)},
        "read": (tb.read, {"file": file, "channel": None, "pixel": None, "unit": None, "z_scale": None, "override_unit": False}),
        "generate": (tb.generate, {"kind": "self-affine", "rms_slope": 0.1, "pixels": 16, "pixel": 1e-6, "seed": 1, "stage": "before", "periodic": True,
                                   "random_amplitudes": False, "hurst": 0.8, "roll_off": 8e-6, "long_cutoff": 0, "short_cutoff": 0, "stretch": 1}),
        "generate edt": (tb.generate, {"kind": "edt", "pixels": 16, "stage": "after", "pressure": 7e6, "density": 0, "mean_height": 1e-6, "hurst": 0.7,
                                       "waviness": 0, "plateau_share": 0.4, "plateau_roughness": 0, "noise": 0}),
        "generate ground": (tb.generate, {"kind": "ground", "pixels": 16, "rms_height": 1e-7, "hurst": 0.7, "groove_spacing": 1e-5, "groove_length": 1e-4}),
        "generate sinusoid": (tb.generate, {"kind": "sinusoid", "pixels": 16, "pixel": 1e-6, "amplitude": 1e-6, "wavelength_x": 8e-6, "wavelength_y": 8e-6}),
        "generate bump": (tb.generate, {"kind": "bump", "pixels": 16, "height": 1e-6, "radius": 5e-6}),
        "Solid": (tb.Solid, {"material": "aluminium-6016", "youngs_modulus": 7e10, "poissons_ratio": 0.3,
                             "saturation_pressure": "none", "shear_strength": 1e8, "counter_youngs_modulus": 7e10,
                             "counter_poissons_ratio": 0.3}),
        "contact": (tb.contact, {"surface": t.surface, "pressure": 5e7, "separation": None, "force": None, "solid": t.solid, "boundary": "periodic",
                                 "edges": "tile", "tolerance": 1e-6, "solver": "fast", "load_path": False, "tool": "ground:Sa=10nm", "tool_x": 0,
                                 "tool_lowpass": "gauss:8um", "tool_repeats": False, "check": True, "progress": None}),
        "rain": (tb.rain, {"surface": t.surface, "density": 1e-3, **rain, "droplet_height": 1e-7, "model": "droplets", "seed": 1}),
        "friction": (tb.friction, {"contact": t.contact, "film": t.film, **shear, **oil, "check": True, "progress": None}),
        "slide": (tb.slide, {"surface": t.surface, "pressure": 5e7, "solid": t.solid, "distance": t.surface.pixel[0], "density": 1e-4, "boundary": "periodic",
                             "tolerance": 1e-6, "solver": "fast", "tool": "ground:Sa=10nm", "tool_x": 0, "tool_lowpass": "gauss:8um",
                             "tool_repeats": False, "step": t.surface.pixel[0], "every": 1e-6, "displaced": "near", "reach": 2e-6, "wear_coefficient": 1e-15,
                             "hardening": None, "liquid": "both", "until_steady": False, "maps_at": 0, "checkpoint": folder / "slide", "trapped": False,
                             "bulk_modulus": 1.5e9, **rain,
                             "model": "droplets", "droplet_height": 1e-7, "seed": 1, **shear, "dry_below": 1e-9, "check": True,
                             "progress": None}),
        "fluid_film": (tb.fluid_film, {"contact": t.contact, "film": t.film, "lubricant": t.oil, "speed": 1e-3, **shear,
                                       "check": True, "progress": None}),
        "density_curve": (tb.density_curve, {"contact": t.contact, "density": 1e-3, **shear, **rain, "progress": None}),
        "Lubricant": (tb.Lubricant, {"viscosity": 0.1, "pressure_viscosity": 1e-8, "eyring_stress": 5e6}),
        "DensityCurve.says": (t.curve.says, {"density": 1e-3}),
        "combine": (tb.combine, {"first": t.surface, "second": t.surface, "mode": "wear", "search": False, "shift": (0, 0),
                                 "match": "plane", "threshold": 4.0, "progress": None}),
        "save": (tb.save, {"file": folder / "b.h5", "results": t.contact, "fields": "all", "double": False}),
        "load": (tb.load, {"file": folder / "b.h5"}),
        "show_versions": (tb.show_versions, {}), "cite": (tb.cite, {}), "formats": (tb.formats, {}), "materials": (tb.materials, {}),
        "set_threads": (tb.set_threads, {"n": 0}),
        "report": (tb.report, {"result": folder / "results", "out": folder / "page", "html": True, "static": False, "figures": None,
                               "scan": None, "all_scans": False, "pressure": None, "density": None, "error_bar": None}),
        "FrictionTable": (tb.FrictionTable, {"results": folder / "results", "group": None, "density": None, "keep": ()}),
        "FrictionTable.deck": (table.deck, {"program": "lsdyna", "units": "mm,s,t", "first_id": 1}),
        **{f"FrictionTable.to_{name}": (getattr(table, f"to_{name}"), deck) for name in ("abaqus", "csv")},
        **{f"FrictionTable.to_{name}": (getattr(table, f"to_{name}"), {**deck, "first_id": 1})
           for name in ("lsdyna", "ansys", "openradioss")},
        "Scans": (tb.Scans, {"files": file, "pressure": 1e6, "density": 0, "treatment": ["level=plane"], "contact": "elastic",
                             "reading": "literal", "channel": None, "pixel": None, "unit": None}),
        "Study": (tb.Study, {"scans": {"a": file}, "solid": t.solid, "slide": {"distance": 1e-6}, "pressure": 1e6, "density": 0, "treatment": (),
                             **shear, **oil, **rain, "solver": "fast", "tool": "ground:Sa=10nm", "tool_x": 0,
                             "tool_lowpass": "gauss:8um", "tool_repeats": False, "tool_places": 2,
                             "droplet_height": 1e-7, "model": "droplets", "seed": 1, "lubricant": None, "speed": None,
                             "boundary": "periodic", "edges": "tile", "tolerance": 1e-6, "title": "study"}),
        "Study.read": (tb.Study.read, {"file": folder / "results" / "study.toml"}),
        "Study.run": (study.run, {"folder": folder / "again", "jobs": 0, "retry": False, "executor": None, "threads": 1,
                                  "store": "shared", "progress": None}),
        "Results": (tb.Results, {"folder": folder / "results"}),
        "Results.friction_table": (tb.Results(folder / "results").friction_table, {"group": None, "density": None, "keep": ()}),
        **{f"{name}.plot": (one.plot, {"ax": None}) for name, one in
           {"Section": t.section, "Spectrum": t.psd.x, "Spectra": t.psd, "MeanSpectrum": t.mean.x, "DensityCurve": t.curve}.items()},
        "Film.plot": (t.film.plot, picture), "Combination.plot": (t.combined.plot, picture),
        **{f"{name}.plot": (one.plot, {"field": field, **picture}) for name, one, field in
           (("Contact", t.contact, "gap"), ("Friction", t.friction, "wet"), ("FluidFilm", t.flowing, "fill"))},
        "ehl.Sweep.plot": (t.swept.plot, {"field": "min_film_m", "ax": None}),
        "parameters": (tb.parameters, {"scans": [file, t.surface], "symbols": ["Sq"], "treatment": ["level=plane"], "fields": "{name}", "channel": None,
                                       "pixel": None, "unit": None, "z_scale": None, "override_unit": False}),
        "mean_spectra": (tb.mean_spectra, {"spectra": [t.psd, t.psd]}),
        **{f"{name}.save": (one.save, {"file": folder / "c.h5", "fields": "all", "double": False}) for name, one in
           {"Contact": t.contact, "Film": t.film, "Friction": t.friction, "FluidFilm": t.flowing, "Slide": t.slid}.items()},
        "Combination.save": (t.combined.save, {"file": folder / "f.h5"}), "Parameters.save": (t.surface.parameters("Sq").save, {"file": folder / "p.json"}),
        **{f"ehl.{name}": (getattr(tb.ehl, name), {"case": tb.ehl.template(name)}) for name in ("impact", "squeeze", "line", "point")},
        "ehl.keys": (tb.ehl.keys, {"program": "line"}), "ehl.template": (tb.ehl.template, {"program": "line"}),
        "ehl.Case": (tb.ehl.Case, {"program": "squeeze", "source": tb.ehl.template("squeeze"), "settings": {}}),
        "ehl.Case.solve": (t.case.solve, {"seed": 1, "check": True, "progress": None}),
        "ehl.Case.sweep": (t.case.sweep, {"values": {"lubricant.viscosity": ["0.4 Pa s"]}, "folder": None, "seed": 1, "jobs": 0,
                                          "retry": False, "check": True, "progress": None}),
        "ehl.Case.study": (tb.ehl.point(tb.ehl.template("point"), **{"grid.nodes": 65}).study,
                           {"name": "grid", "seed": 1, "jobs": 0, "check": True, "progress": None}),
        "ehl.Solution.save": (t.solved.save, {"file": folder / "d.h5"}), "ehl.Sweep.save": (t.swept.save, {"file": folder / "e.csv"}),
        "view": (tb.view, {"surface": t.surface, "port": 0, "browser": False, "keep": False, "recipe": "sheet"}),
    }


#: Names that messages have for an argument beside its own.
ALSO = {"z": "heights", "results": "save|results.csv", "folder": "results.csv|folder", "source": "case", "double": "double",
        "values": "values|viscosity", "settings": "settings|a", "symbols": "symbol", "function": "function", "scans": "scans|scan|no such file", "program": "program", "tolerance": "tolerance",
        "jobs": "jobs", "speed": "speed|lubricant", "lubricant": "lubricant|speed", "pressure": "pressure|scan",
        "counter_youngs_modulus": "counter|modulus", "counter_poissons_ratio": "counter|Poisson|ratio",
        "youngs_modulus": "modulus", "poissons_ratio": "Poisson|ratio", "shift": "shift|overlap", "fit_min": "fit_min|fit_max|range",
        "fit_max": "fit_min|fit_max|range", "figures": "figures|figure", "material": "material|solid",
        "solid": "material", "density": "mean film", "droplet_height": "droplet", "units": "unit", "name": "study", "short_cutoff": "cutoffs",
        "long_cutoff": "cutoffs"}


def complaint(function, given, name, value):
    """What is wrong with how a function refuses a value; None if it takes it or names the argument."""
    try:
        function(**{**given, name: value})
        return None
    except (TypeError, ValueError) as error:
        text = str(error)
        names_it = re.search(rf"{name.replace('_', '[ _-]')}|{ALSO.get(name, name)}", text, re.IGNORECASE) or \
            (isinstance(value, str) and value and value in text)
        if names_it and "_tabor" not in text and "incompatible function" not in text:
            return None
        return f"{type(error).__name__}: {text}"
    except tb.NotConverged:  # a speed that no film carries
        return None
    except ImportError as error:
        return None if "needs" in str(error) else repr(error)
    except OSError as error:  # a name that no file can have
        return None if isinstance(value, str) else repr(error)
    except Exception as error:
        return f"{type(error).__name__}: {error}"


def public():
    """Names of all that a user calls with arguments."""
    names = set()
    for prefix, module, listed in (("", tb, tb.__all__), ("ehl.", tb.ehl, tb.ehl.__all__)):
        for name in listed:
            thing = getattr(module, name)
            if not isinstance(thing, type):
                names |= {prefix + name} if inspect.isfunction(thing) else set()
                continue
            if prefix + name not in MADE_BY_TABOR:
                names.add(prefix + name)
            names |= {f"{prefix}{name}.{method}" for method in dir(thing)
                      if not method.startswith("_") and (inspect.isfunction(getattr(thing, method)) or inspect.ismethod(getattr(thing, method)))
                      and method not in ("to_xarray", "count", "index", "get", "items", "keys", "values")}
    steps = {f"Surface.{name}" for name, argument, _ in tb._tabor.treatment_steps() if argument}
    return {name for name in names - steps if not name.endswith((".Template",)) and not name.startswith("ehl.Template.")
            and not name.startswith(("Doubt.", "InputError.", "InputFileNotFound.", "InputIncomplete.", "NameNotFound.", "NotConverged.", "OutputError.", "Progress"))}


def test_every_public_function_is_asked(folder):
    assert public() <= set(calls(folder)), public() - set(calls(folder))


@pytest.fixture
def everything(folder, monkeypatch):
    monkeypatch.chdir(folder)
    monkeypatch.setattr("tabor._report._made", lambda arguments: [str(folder / "page" / "report.html")])
    if importlib.util.find_spec("bokeh"):
        server = importlib.import_module("tabor.view.server")  # tabor.view itself is the function
        monkeypatch.setattr(server, "View", lambda *_: SimpleNamespace(url="", show=lambda: None))
    return calls(folder)


def test_every_setting_of_a_generated_surface_is_asked(everything):
    asked = {name for function, given in everything.values() if function is tb.generate for name in given}
    assert {one.argument for one in _settings.PIXELS + _settings.RECIPE} <= asked


def test_what_they_are_called_with_is_right(everything):
    for name, (function, given) in everything.items():
        if ".plot" not in name:
            function(**given)


def test_wrong_types_are_refused_by_name(everything):
    found = []
    for name, (function, given) in everything.items():
        parameters = {one.name for one in inspect.signature(function).parameters.values()
                      if one.kind in (one.KEYWORD_ONLY, one.POSITIONAL_OR_KEYWORD)}
        of_kinds = {one.argument for one in _settings.PIXELS + _settings.RECIPE} | {"seed"} if function is tb.generate else set()
        assert parameters - set(given) <= {"progress", "outcome", "n_contacts", "warnings", "args"} | of_kinds, (name, parameters - set(given))
        for argument in sorted(parameters & set(given)):
            for value in WRONG:
                told = complaint(function, given, argument, value)
                if told:
                    found.append(f"{name}({argument}={value!r}): {told}")
    assert not found, "\n".join(found)


def test_lists_of_arguments_are_asked_too(everything):
    surface = things().surface
    for value in WRONG:
        for name, call in {"steps": lambda: surface.treat(value), "results": lambda: tb.cite(value),
                           "rms.slope": lambda: tb.generate("self-affine", pixels=16, rms_slope=value),
                           "roller.speed": lambda: tb.ehl.squeeze(tb.ehl.template("squeeze"), **{"roller.speed": value}),
                           **{step: lambda step=step: getattr(surface, step)(value)
                              for step, argument, _ in tb._tabor.treatment_steps() if argument}}.items():
            try:
                call()
            except (TypeError, ValueError) as error:
                assert re.search(rf"{name}|treatment|self-affine", str(error)) or (isinstance(value, str) and value in str(error)), \
                    (name, value, str(error))


@pytest.mark.parametrize("call, text", [
    (lambda t: tb.contact(t.surface.height, 5e7, t.solid), "surface: got ndarray; expected a Surface"),
    (lambda t: tb.friction(t.contact, None), "film: got None; expected a Film, as tabor.rain returns it"),
    (lambda t: tb.friction(t.contact, [t.film, t.film]), "film: got list of Film; expected a Film"),
    (lambda t: tb.fluid_film(t.contact, t.film, "0.1 Pa s", 1), r'lubricant: got str \'0.1 Pa s\'; expected a Lubricant, such as'),
    (lambda t: tb.Study("study.toml", t.solid), "scans: got str .*; tabor.Study.read takes a study file"),
    (lambda t: tb.Study({"a": t.film}, t.solid), "scans: got Film; expected a file, a pattern, a Surface or tabor.Scans in group 'a'"),
    (lambda t: tb.save("x.h5", t.surface), "results: got Surface; .*; Surface.save writes a surface"),
    (lambda t: tb.rain(t.surface, 0, seed=1.5), "seed: got float 1.5; expected a whole number"),
])
def test_the_type_that_came_and_the_one_that_was_expected_are_said(call, text):
    with pytest.raises(TypeError, match=text):
        call(things())


def test_an_executor_is_no_number_of_workers(folder):
    study = tb.Study({"a": str(folder / "a.sdf")}, things().solid, pressure="20 MPa")
    with pytest.raises(TypeError, match="executor: got int 4; expected an executor of concurrent.futures"):
        study.run(folder / "more", executor=4)
    with concurrent.futures.ThreadPoolExecutor(1) as executor:
        assert len(study.run(folder / "more", executor=executor).rows) == 1


def test_seeds_end_at_2_to_the_64():
    with pytest.raises(ValueError, match="seed: got 1180591620717411303424; expected 0 to 18446744073709551615"):
        tb.rain(things().surface, 0, seed=2**70)
    with pytest.raises(ValueError, match="seed: got -1; expected zero or more"):
        tb.generate("edt", pixels=16, seed=-1)
    assert tb.rain(things().surface, 0, seed=np.int64(2**62)).wet_fraction == 0


def test_the_name_of_a_material_is_a_solid(folder):
    surface = things().surface
    by_name = tb.contact(surface, 5e7, "aluminium-6016")
    assert by_name.solid == tb.Solid("aluminium-6016")
    assert by_name.area_fraction == tb.contact(surface, 5e7, by_name.solid).area_fraction
    with pytest.raises(ValueError, match="did you mean 'aluminium-6016'"):
        tb.contact(surface, 5e7, "aluminium-6061")
    assert tb.Study({"a": str(folder / "a.sdf")}, "aluminium-6016", pressure="20 MPa").n_cases == 1


@pytest.mark.parametrize("arguments, name", [((-1,), "viscosity"), ((0,), "viscosity"), (("0.1 Pa s", -1e-8), "pressure_viscosity"),
                                             (("0.1 Pa s", None, 0), "eyring_stress"), ((float("inf"),), "viscosity")])
def test_an_oil_that_does_not_exist_is_refused_when_it_is_made(arguments, name):
    with pytest.raises(ValueError, match=name):
        tb.Lubricant(*arguments)


@pytest.mark.parametrize("call, text", [
    (lambda t: tb.Surface(np.zeros((4, 4)), "1 um"), r"^Surface\(\) takes 1 argument by position \(z\); got 2; give the others by name: pixel=, unit="),
    (lambda t: tb.Solid("70 GPa", 0.33), r"^Solid\(\) takes 1 argument by position \(material\); got 2; give .* youngs_modulus=, poissons_ratio="),
    (lambda t: tb.contact(t.surface, 5e7, t.solid, 1), r"^contact\(\) takes 3 arguments by position .*; got 4; give .*, \.\.\.$"),
    (lambda t: t.surface.section((0, 0), (1e-6, 0), 1), r"^Surface.section\(\) takes 2 arguments by position \(p, q\); got 3$"),
    (lambda t: t.surface.mirror("x"), r"^Surface.mirror\(\) takes no arguments by position; got 1"),
    (lambda t: tb.Surface.from_array(np.zeros((4, 4)), 1e-6, "um"), r"^Surface.from_array\(\) takes 2 arguments by position \(z, pixel\); got 3")])
def test_too_many_arguments_by_position_are_answered_with_the_names(call, text):
    with pytest.raises(TypeError, match=text):
        call(things())


def test_arguments_by_place_and_by_name_are_asked_alike():
    for arguments, named in (((things().contact, 3), {}), ((things().contact,), {"film": 3}), ((), {"contact": 3, "film": 3})):
        with pytest.raises(TypeError, match="got int 3"):
            tb.friction(*arguments, **named)
    with pytest.raises(TypeError, match="missing 1 required positional argument: 'film'"):
        tb.friction(things().contact)
    assert str(inspect.signature(tb.set_threads)) == "(n: 'Count') -> 'None'"
