"""Studies give the rows of the command line, and either continues what the other began."""

import signal
import subprocess
import threading
import time

import numpy as np
import pytest

import tabor as tb

GROUPS = ("before", "after")


@pytest.fixture(scope="module")
def folder(tmp_path_factory, scan_file):
    folder = tmp_path_factory.mktemp("scans")
    sheet = tb.read(scan_file).level("plane")
    for i, group in enumerate(GROUPS):
        sheet.crop(96 * i, 96, 48, 48).save(folder / f"{group}_1.h5")
    return folder


def study_of(folder, **changes):
    settings = dict(pressure=["2 MPa", 7e6], density=["0.45 g/m^2", 0.9e-3], treatment=["level=plane"])
    return tb.Study({group: folder / f"{group}_*.h5" for group in GROUPS}, tb.Solid("aluminium-6016"),
                    **{**settings, **changes})


def test_rows_are_those_of_single_calls_to_the_last_bit(folder, tmp_path):
    found = study_of(folder).run(tmp_path / "r", jobs=2)
    assert not found.failures and len(found.rows) == 8 and len(found.averages) == 8
    surface = tb.read(folder / "before_1.h5").level("plane")
    one = tb.friction(tb.contact(surface, 7e6, tb.Solid("aluminium-6016")), tb.rain(surface, ["0.45 g/m^2", 0.9e-3])[1])
    row = [row for row in found.rows if str(row["scan"]).endswith("before_1.h5")
           and row["mean_pressure_Pa"] == 7e6 and row["lubricant_density_g_per_m2"] == 0.9]
    assert len(row) == 1
    assert row[0]["friction_lubricated"] == one.lubricated and row[0]["friction_dry"] == one.dry


def test_counts_are_whole_and_texts_stay_texts(folder, tmp_path):
    """A group that looks like a number or like none, the empty text of a row that counts, and numbers that are missing."""
    study = tb.Study({"007": folder / "before_1.h5", "NA": folder / "after_1.h5"}, "aluminium-6016", pressure="7 MPa", density="0.45 g/m^2",
                     treatment=["level=plane"], trapped=True)
    found = study.run(tmp_path / "r")
    for row, group in zip(found.averages, ("007", "NA"), strict=True):
        assert (row["group"], row["n"], row["left_out"]) == (group, 1, "") and type(row["n"]) is int
        assert np.isnan(row["friction_dry_std"])
    assert [(row["group"], type(row["n_pockets"]), type(row["friction_dry"])) for row in found.rows] == [("007", int, float), ("NA", int, float)]


def test_texts_of_the_data_frame_stay_texts(folder, tmp_path):
    pytest.importorskip("pandas")
    study = tb.Study({"007": folder / "before_1.h5", "NA": folder / "after_1.h5"}, "aluminium-6016", pressure="7 MPa", treatment=["level=plane"])
    assert list(study.run(tmp_path / "r").table["group"]) == ["007", "NA"]


def test_edges_are_those_of_single_calls(folder, tmp_path):
    found = study_of(folder, edges="cut", density=0.0, pressure=7e6).run(tmp_path / "r", jobs=2)
    surface = tb.read(folder / "before_1.h5").level("plane")
    one = tb.friction(tb.contact(surface, 7e6, tb.Solid("aluminium-6016"), edges="cut"), tb.rain(surface.mirror(), 0.0))
    row = [row for row in found.rows if str(row["scan"]).endswith("before_1.h5")]
    assert len(row) == 1 and row[0]["friction_dry"] == one.dry


def test_surfaces_in_memory_are_scans(program, folder, tmp_path):
    """The same bits as alone; the folder has all that the command line needs to go on."""
    sheets = [tb.read(folder / f"{group}_1.h5") for group in GROUPS]
    own = tb.Surface(sheets[0].height, pixel=sheets[0].pixel, name="a/b: mine", periodic=True)
    study = tb.Study({"both": sheets, "own": tb.Scans(own, pressure="5 MPa")}, "aluminium-6016", pressure=["2 MPa", "7 MPa"], density="0.9 g/m^2",
                     treatment=["level=plane"])
    assert study.n_cases == 5
    found = study.run(tmp_path / "r", jobs=2)
    for row, surface in zip([found.rows[1], found.rows[3], found.rows[4]], [*sheets, own]):
        alone = surface.level("plane")
        pressed = tb.contact(alone, row["mean_pressure_Pa"], "aluminium-6016")
        assert tb.friction(pressed, tb.rain(alone, "0.9 g/m^2")).lubricated == row["friction_lubricated"]
    assert {str(row["scan"]).partition("-")[0] for row in found.rows} == {"surfaces/before_1", "surfaces/after_1", "surfaces/b_mine"}
    assert study.run(tmp_path / "r").n_contacts == 0
    again = tb.Study({"both": sheets, "own": tb.Scans(own, pressure="5 MPa")}, "aluminium-6016", pressure=["2 MPa", "7 MPa"],
                     density="0.9 g/m^2", treatment=["level=plane"])
    assert again.run(tmp_path / "r").n_contacts == 0
    run = subprocess.run([program, "sweep", tmp_path / "r" / "study.toml", "-o", tmp_path / "r", "--json"], capture_output=True, text=True,
                         check=True)
    assert '"n_computed_contacts": 0' in run.stdout


def test_a_finished_study_is_not_computed_again(folder, tmp_path):
    study = study_of(folder)
    assert study.run(tmp_path / "r").n_contacts == 4
    assert study.run(tmp_path / "r").n_contacts == 0
    assert tb.Study.read(tmp_path / "r" / "study.toml").run(tmp_path / "r").n_contacts == 0


def test_the_command_line_continues_it(program, folder, tmp_path):
    study_of(folder, pressure="2 MPa").run(tmp_path / "r")
    study_of(folder)._write(tmp_path / "r" / "study.toml")
    run = subprocess.run([program, "sweep", tmp_path / "r" / "study.toml", "-o", tmp_path / "r", "--json"],
                         capture_output=True, text=True, check=True)
    assert '"n_computed_contacts": 2' in run.stdout
    assert study_of(folder).run(tmp_path / "r").n_contacts == 0


def test_the_table_is_a_data_frame(folder, tmp_path):
    pytest.importorskip("pandas")
    found = study_of(folder).run(tmp_path / "r")
    table = found.table.pivot_table(index="mean_pressure_Pa", values="friction_lubricated",
                                    columns="lubricant_density_g_per_m2")
    assert table.shape == (2, 2) and np.isfinite(table.values).all()


def test_scans_have_settings_of_their_own(folder, tmp_path):
    before = folder / "before_1.h5"
    own = tb.Scans(before, pressure=["1 MPa", 3e6], density=0, treatment=["level=plane", "lowpass=gauss:2um"],
                   contact="elastic", reading="literal")
    study = tb.Study({"before": [before, folder / "after_1.h5"], "filtered": own}, tb.Solid("aluminium-6016"),
                     pressure="7 MPa", density="0.45 g/m^2", treatment=["level=plane"])
    assert study.n_cases == 4
    rows = {(row["group"], row["mean_pressure_Pa"]): row for row in study.run(tmp_path / "r").rows}
    assert rows["filtered", 3e6]["saturated_area_fraction"] == 0 < rows["before", 7e6]["saturated_area_fraction"]
    surface = tb.read(before).treat("level=plane", "lowpass=gauss:2um")
    one = tb.contact(surface, 3e6, tb.Solid("aluminium-6016", saturation_pressure="none"))
    assert rows["filtered", 3e6]["contact_area_fraction"] == one.area_fraction
    assert rows["filtered", 3e6]["lubricant_density_g_per_m2"] == 0


def test_curves_and_what_they_say_are_those_of_single_calls(folder, tmp_path):
    found = study_of(folder).run(tmp_path / "r")
    surface = tb.read(folder / "after_1.h5").level("plane")
    pressed = tb.contact(surface, 7e6, tb.Solid("aluminium-6016"))
    curve = tb.density_curve(pressed)
    rows = [row for row in found.density_curves if row["group"] == "after" and row["mean_pressure_Pa"] == 7e6]
    assert [row["friction_lubricated"] for row in rows] == curve.friction_lubricated.tolist()
    assert len(found.answers) == 4
    frictions = [tb.friction(pressed, film) for film in tb.rain(surface, [0.45e-3, 0.9e-3])]
    assert f"after at 7 MPa: {curve.says(frictions)}" in found.answers
    dry = study_of(folder, density=0).run(tmp_path / "dry")
    assert dry.density_curves == [] and dry.answers == ()


def test_ctrl_c_keeps_what_is_finished(tmp_path, scan_file):
    study = tb.Study({"all": scan_file}, tb.Solid("aluminium-6016"), pressure=np.linspace(1e6, 5e7, 100))
    sender = threading.Thread(target=lambda: (time.sleep(1), signal.raise_signal(signal.SIGINT)))
    sender.start()
    with pytest.raises(KeyboardInterrupt):
        study.run(tmp_path / "r")
    sender.join()
    assert len(tb.Results(tmp_path / "r").rows) < 100


@pytest.mark.parametrize("changes, text", [
    ({"pressure": "7"}, "pressure: got '7' without a unit"),
    ({"pressure": "1 GPa"}, "study:[0-9]+: sweep.mean_pressure.*saturation"),
    ({"density": "-1 g/m^2"}, "lubricant_density"),
    ({"treatment": ["levle=plane"]}, "did you mean 'level'"),
    ({"pressure": None}, "pressure: missing for group '.*'; give Study a pressure, or each of its Scans one of its own"),
    ({"edges": "cut", "boundary": "free"}, "contact.edges: .* contradict"),
    ({"model": "droplet"}, "did you mean 'droplets'")])
def test_what_no_study_can_be_is_refused(folder, changes, text):
    with pytest.raises(ValueError, match=text):
        study_of(folder, **changes)


@pytest.mark.parametrize("own, text", [
    ({"pressure": "1 GPa"}, "saturation"), ({"contact": "plastic"}, "elastic or saturated"),
    ({"reading": "literl"}, "did you mean 'literal'"), ({"density": "-1 g/m^2"}, "zero or more"),
    ({"treatment": ["levle=plane"]}, "did you mean 'level'"), ({"pixel": "1 MPa"}, "pixel")])
def test_settings_that_no_scan_can_have_are_refused(folder, own, text):
    with pytest.raises(ValueError, match=text):
        tb.Study({"a": tb.Scans(folder / "before_1.h5", **own)}, tb.Solid("aluminium-6016"), pressure=1e6)


def test_missing_scans_and_folders_are_named(tmp_path):
    with pytest.raises(ValueError, match="scans: no file 'none_"):
        tb.Study({"a": "none_*.x3p"}, tb.Solid("aluminium-6016"), pressure=1e6)
    with pytest.raises(ValueError, match="no results.csv"):
        tb.Results(tmp_path)


def test_decks_are_those_of_the_command_line(program, folder, tmp_path):
    table = study_of(folder).run(tmp_path / "r").friction_table(group="before", keep=["flood"])
    assert len(table.entries) == 4 and all(0 < one.friction < 1 and one.n == 1 for one in table.entries)
    for name, write in [("lsdyna", table.to_lsdyna), ("abaqus", table.to_abaqus), ("ansys", table.to_ansys),
                        ("openradioss", table.to_openradioss), ("csv", table.to_csv)]:
        run = subprocess.run([program, "table", tmp_path / "r", "--for", name, "--units", "mm,s,t", "--group", "before",
                              "--keep", "flood"], capture_output=True, text=True, check=True)
        write(tmp_path / "deck", units="mm,s,t")
        cards = [[line for line in text.splitlines() if not line.startswith(("$", "**", "!", "#"))]
                 for text in (run.stdout, (tmp_path / "deck").read_text("utf-8"))]
        assert len(cards[0]) >= 3 and cards[0] == cards[1]
    with pytest.raises(ValueError, match="before"):
        tb.FrictionTable(tmp_path / "r")
    with pytest.raises(ValueError, match="units|parsec"):
        table.to_csv(tmp_path / "deck", units="parsec,s,t")


FLOWING = """
shear_strength = "70 MPa"
[material]
youngs_modulus = "69 GPa"
poissons_ratio = 0.33
saturation_pressure = "240 MPa"
[treatment]
steps = ["crop=8,8,24,24", "level=plane", "mirror"]
[sweep]
mean_pressure = "2 MPa"
lubricant_density = "0.9 g/m^2"
sliding_speed = ["2 mm/s", "5 mm/s"]
[lubricant]
oil_density = "900 kg/m^3"
fluid = "reynolds"
viscosity = "0.225 Pa s"
eyring_stress = "5 MPa"
[[scan]]
file = "FILE"
group = "a"
"""


def test_oil_flows_in_a_study_as_in_that_of_the_command_line(program, folder, tmp_path):
    (tmp_path / "study.toml").write_text(FLOWING.replace("FILE", str(folder / "before_1.h5")), "utf-8")
    subprocess.run([program, "sweep", tmp_path / "study.toml", "-o", tmp_path / "theirs"], capture_output=True, check=True)
    solid = tb.Solid(youngs_modulus="69 GPa", poissons_ratio=0.33, saturation_pressure="240 MPa", shear_strength="70 MPa")
    oil = tb.Lubricant("0.225 Pa s", eyring_stress="5 MPa")
    mine = tb.Study({"a": folder / "before_1.h5"}, solid, lubricant=oil, speed=["2 mm/s", 0.005], pressure="2 MPa",
                    density="0.9 g/m^2", treatment=["crop=8,8,24,24", "level=plane", "mirror"]).run(tmp_path / "mine")
    of_run = ("case_id", "scan", "seconds", "fluid_seconds")
    numbers = [[{key: value for key, value in row.items() if key not in of_run} for row in rows] for rows in
               (mine.rows, tb.Results(tmp_path / "theirs").rows)]
    assert numbers[0] == numbers[1] and [row["sliding_speed_m_per_s"] for row in mine.rows] == [0.002, 0.005]
    tile = tb.read(folder / "before_1.h5").crop(8, 8, 24, 24).level("plane").mirror()
    alone = tb.fluid_film(tb.contact(tile, "2 MPa", solid), tb.rain(tile, "0.9 g/m^2"), oil, "5 mm/s")
    # A study's film starts from maps of single precision; both balance the load to this error, times friction.
    bound = (abs(alone.values["fluid_load_error"]) + abs(mine.rows[1]["fluid_load_error"])) * alone.dry
    assert abs(alone.friction_mixed - mine.rows[1]["friction_mixed"]) <= bound < 1e-3


@pytest.mark.parametrize("changes, text", [({"speed": "1 m/s"}, "both a lubricant and a speed"),
                                           ({"lubricant": tb.Lubricant(0.1)}, "both a lubricant and a speed"),
                                           ({"lubricant": tb.Lubricant(0.1), "speed": "1 MPa"}, "speed"),
                                           ({"lubricant": tb.Lubricant(0.1), "speed": 1, "boundary": "free"}, "periodic"),
                                           ({"lubricant": tb.Lubricant(0.1), "speed": 1, "edges": "end"}, "repeats")])
def test_oil_that_cannot_flow_is_refused(folder, changes, text):
    with pytest.raises(ValueError, match=text):
        study_of(folder, **changes)


def test_a_folder_tells_the_warnings_and_failures_of_its_run(folder, tmp_path):
    """Of the numbers, of scans that are there twice, and of what failed."""
    twice = tmp_path / "before_2.h5"
    twice.write_bytes((folder / "before_1.h5").read_bytes())
    study = tb.Study({"before": [folder / "before_1.h5", twice], "small": tb.Scans(folder / "after_1.h5", treatment=["crop=0,0,500,500"])},
                     tb.Solid("aluminium-6016"), pressure=["2 MPa", "7 MPa"], density="0.45 g/m^2", treatment=["level=plane"])
    ran = study.run(tmp_path / "r")
    assert len(ran.warnings) > 2 and any("are the same file" in one for one in ran.warnings) and len(ran.failures) == 1
    read = tb.Results(tmp_path / "r")
    assert read.warnings == ran.warnings and read.failures == ran.failures
    assert study.run(tmp_path / "r").warnings == ran.warnings


def test_a_folder_of_the_command_line_does_too(program, folder, tmp_path):
    study_of(folder)._write(tmp_path / "study.toml")
    subprocess.run([program, "sweep", tmp_path / "study.toml", "-o", tmp_path / "r"], capture_output=True, check=True)
    told = tb.Results(tmp_path / "r").warnings
    assert told == tb.Study.read(tmp_path / "study.toml").run(tmp_path / "r").warnings != ()


def test_sheets_slide_in_a_study_as_alone(folder, tmp_path):
    settings = {"tool": "ground:Sa=0.1um,length=100um", "edges": "cut", "trapped": True}
    sliding = {"distance": "4 um", "step": "0.67 um"}
    found = study_of(folder, pressure=7e6, slide=sliding, **settings).run(tmp_path / "r")
    assert not found.failures and len({(row["scan"], row["lubricant_density_g_per_m2"]) for row in found.slides}) == 4
    one = tb.slide(tb.read(folder / "before_1.h5").level("plane").mirror(), 7e6, "aluminium-6016", density="0.9 g/m^2", tool=settings["tool"],
                   trapped=True, **sliding)
    rows = [row for row in found.slides if str(row["scan"]).endswith("before_1.h5") and row["lubricant_density_g_per_m2"] == 0.9]
    for key in ("distance_m", "friction_lubricated_squeezed", "friction_ploughing_upper", "liquid_load_share", "dale_height_m"):
        np.testing.assert_array_equal([row[key] for row in rows], one.states[key])
    assert study_of(folder, density=0.0, pressure=7e6).run(tmp_path / "none").slides == []


@pytest.mark.parametrize("slide, error, text", [
    ({"distance": "4 um", "stp": "1 um"}, ValueError, "'stp'"), ({"step": "1 um"}, ValueError, "slide.distance"), ("4 um", TypeError, "slide"),
    ({"distance": "4 s"}, ValueError, "distance"),
])
def test_slides_that_cannot_be_are_rejected(folder, slide, error, text):
    with pytest.raises(error, match=text):
        study_of(folder, slide=slide, tool="ground:Sa=0.1um,length=100um")
