"""What is saved is the file that the command line writes, to the last number of each map and attribute."""

import pickle
import re
import subprocess

import numpy as np
import pytest

import tabor as tb

h5py = pytest.importorskip("h5py")
#: Of the run, not of the result.
RUN = {"command", "created", "seconds", "fft_seconds", "peak_memory_bytes"}
STEPS = ["--level", "plane", "--crop", "96,96,64,64", "--mirror"]
SOLID = tb.Solid("aluminium-6016")
CONTACT = ["--pressure", "2MPa,7MPa", "--material", "aluminium-6016"]
DENSITY = ["--density", "0.9g/m^2,0.45g/m^2"]


def without_advice(warning):
    """What a warning says; its advice names options there and arguments here."""
    return re.sub(r"; .*?(?= \(\d+ of | \[)", "", warning)


def content(file):
    """Of a result file: {path: values}, {path: {name: attribute}}, without what belongs to the run."""
    maps, attributes = {}, {}
    with h5py.File(file) as opened:
        def visit(name, thing):
            attributes[name] = {key: np.asarray(value).tolist() for key, value in thing.attrs.items()
                                if key not in RUN and "REFERENCE_LIST" not in key and "DIMENSION_LIST" not in key}
            if name == "/":  # how many threads there were is of the run, too
                lines = attributes[name]["config_toml"].splitlines()
                attributes[name]["config_toml"] = [line for line in lines if not line.startswith("threads =")]
            if "warnings" in attributes[name]:
                attributes[name]["warnings"] = [without_advice(one) for one in attributes[name]["warnings"]]
            if isinstance(thing, h5py.Dataset):
                maps[name] = thing[()]
        visit("/", opened)
        opened.visititems(visit)
    return maps, attributes


def assert_same_file(mine, theirs):
    (maps, attributes), (other_maps, other_attributes) = content(mine), content(theirs)
    assert attributes == other_attributes
    assert maps.keys() == other_maps.keys()
    for name, values in maps.items():
        np.testing.assert_array_equal(values, other_maps[name], err_msg=name)


@pytest.fixture(scope="module")
def tile(scan_file):
    return tb.read(scan_file).level("plane").crop("96,96,64,64").mirror()


@pytest.fixture(scope="module")
def written(program, scan_file, tmp_path_factory):
    """Runs a verb with -o; returns the file."""
    def run(verb, *words):
        file = tmp_path_factory.mktemp("cli") / f"{verb}.h5"
        subprocess.run([program, verb, scan_file, *STEPS, *words, "-o", file, "--quiet"], check=True, capture_output=True)
        return file
    return run


@pytest.mark.parametrize("words, options", [([], {}), (["--double"], {"double": True}),
                                            (["--fields", "contact"], {"fields": "contact"}),
                                            (["--fields", "none"], {"fields": "none"})])
def test_contacts(written, tile, tmp_path, words, options):
    tb.save(tmp_path / "a.h5", tb.contact(tile, ["2 MPa", "7 MPa"], SOLID), **options)
    assert_same_file(tmp_path / "a.h5", written("contact", *CONTACT, *words))


def test_films(written, tile, tmp_path):
    tb.save(tmp_path / "a.h5", tb.rain(tile, ["0.9 g/m^2", "0.45 g/m^2"]))
    assert_same_file(tmp_path / "a.h5", written("lubricate", *DENSITY))


def test_frictions_with_their_curves_also_after_pickling(written, tile, tmp_path):
    films = tb.rain(tile, ["0.9 g/m^2", "0.45 g/m^2"])
    found = [tb.friction(dry, film) for dry in tb.contact(tile, ["2 MPa", "7 MPa"], SOLID) for film in films]
    expected = written("friction", *CONTACT, *DENSITY)
    tb.save(tmp_path / "a.h5", found)
    assert_same_file(tmp_path / "a.h5", expected)
    tb.save(tmp_path / "b.h5", pickle.loads(pickle.dumps(found)))
    assert_same_file(tmp_path / "b.h5", expected)


def test_a_flowing_film(written, tile, tmp_path):
    dry = tb.contact(tile, "2 MPa", SOLID)
    found = tb.fluid_film(dry, tb.rain(tile, "0.9 g/m^2"), tb.Lubricant("0.225 Pa s"), "5 mm/s")
    pickle.loads(pickle.dumps(found)).save(tmp_path / "a.h5")
    assert_same_file(tmp_path / "a.h5", written("friction", "--pressure", "2MPa", "--material", "aluminium-6016", "--density",
                                                "0.9g/m^2", "--fluid", "reynolds", "--speed", "5mm/s", "--viscosity",
                                                "0.225Pa*s"))


def test_its_surface_is_read_again(tile, tmp_path):
    tb.contact(tile, "2 MPa", SOLID).save(tmp_path / "a.h5", double=True)
    again = tb.read(tmp_path / "a.h5")
    np.testing.assert_array_equal(again.height, tile.height)
    assert again.periodic and "{polonsky1999," in tb.cite(tmp_path / "a.h5")


def test_the_command_line_reports_it(program, rough, steel, tmp_path):
    tb.contact(rough, "50 MPa", steel).save(tmp_path / "a.h5")
    run = subprocess.run([program, "report", tmp_path / "a.h5", "--quiet"], capture_output=True, text=True, check=False)
    if run.returncode and "python3-h5py" in run.stderr:
        pytest.skip("no h5py for the report")
    assert run.returncode == 0, run.stderr


def test_what_does_not_belong_into_one_file_is_refused(rough, levelled, steel, tmp_path):
    one, other = tb.contact(rough, 5e7, steel), tb.contact(levelled, 5e6, steel)
    film, soft = tb.rain(rough, "0.2 g/m^2"), tb.Solid("aluminium-6016")
    for results, text in [([one, other], "several surfaces"), ([one, film], "got Contact and Film; expected .* of one kind"),
                          ([], "got an empty list; expected .* of one kind"),
                          ([one, tb.contact(rough, 5e7, soft)], "several solids"),
                          ([film, tb.rain(rough, "0.2 g/m^2", seed=2)], "several rains"),
                          ([tb.friction(one, film), tb.friction(one, film, boundary_shear_share=0.1)],
                           "several shear strengths")]:
        with pytest.raises(ValueError, match=text):
            tb.save(tmp_path / "a.h5", results)
    with pytest.raises(ValueError, match="ends with .h5"):
        one.save(tmp_path / "a.npz")
    with pytest.raises(ValueError, match="fields: got 'most'"):
        one.save(tmp_path / "a.h5", fields="most")
    with pytest.raises(OSError):
        one.save(tmp_path / "none" / "a.h5")
    assert not list(tmp_path.iterdir())


def test_the_scan_is_not_written_over(levelled, steel, tmp_path):
    levelled.save(tmp_path / "scan.h5")
    found = tb.contact(tb.read(tmp_path / "scan.h5"), 5e6, steel)
    with pytest.raises(ValueError, match="choose another name"):
        found.save(tmp_path / "scan.h5")


def test_xarray_opens_its_maps(rough, steel, tmp_path):
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("h5netcdf")
    found = tb.contact(rough, "50 MPa", steel)
    found.save(tmp_path / "a.h5", double=True)
    with xarray.open_dataset(tmp_path / "a.h5", group="states/0000", engine="h5netcdf") as data:
        np.testing.assert_array_equal(data.pressure.values, found.pressure)
        assert data.pressure.attrs["units"] == "Pa" and data.pressure.dims == ("y", "x")
        assert float(data.x[0]) == pytest.approx(0.5e-6, rel=1e-12)


def test_maps_for_paraview_are_those_of_the_result_file(tile, program, tmp_path):
    contact = tb.contact(tile, "2 MPa", SOLID)
    for name in ("a.vti", "a.h5"):
        contact.save(tmp_path / name)
    subprocess.run([program, "convert", tmp_path / "a.h5", tmp_path / "b.vti", "--field", "all"], check=True,
                   capture_output=True)
    assert (tmp_path / "a.vti").read_bytes() == (tmp_path / "b.vti").read_bytes()


def test_maps_of_a_load_path_are_those_of_their_own_state(rough, tmp_path):
    soft = tb.Solid(youngs_modulus="210 GPa", poissons_ratio=0.3, saturation_pressure="400 MPa", shear_strength="70 MPa")
    path = tb.contact(rough, [5e7, 2e8, 5e7], soft, load_path=True)
    film = tb.rain(rough, "0.05 g/m^2")
    tb.save(tmp_path / "path.h5", [tb.friction(one, film) for one in path])
    with h5py.File(tmp_path / "path.h5") as file:
        for state, contact in zip(file["states"].values(), path, strict=True):
            np.testing.assert_allclose(state["gap"][()], contact.gap, rtol=1e-6, atol=1e-12)
            np.testing.assert_array_equal(state["state"][()] > 0, contact.pressure > 0)
