"""A state of the workbench: its numbers are those of the command line, of Python and of a study file, to the digit."""

import csv
import json
import shlex
import subprocess
from dataclasses import replace

import pytest

import tabor as tb
from conftest import ROOT

pytest.importorskip("bokeh", reason="no Bokeh: the workbench is not there")

from tabor.view import texts
from tabor.view.answers import PARAMETERS, Bench, answer_of, numbers
from tabor.view.previews import LIVE, coarser
from tabor.view.opening import opened, shortest
from tabor.view.recipes import RECIPES, recipe
from tabor.view.settings import option_words
from tabor.view.spectrum import cutoff
from tabor.view.state import History, State, Step

#: A study computes these from the maps of its store, which are in single precision (docs/results.md).
FROM_STORED_MAPS = ("spill_over_fraction", "trapped_fraction", "liquid_load_share", "leaked_fraction", "max_liquid_pressure_Pa", "friction_solid",
                    "trapped_mean_gap_m", "trapped_certificate")


@pytest.fixture(scope="module")
def small(tmp_path_factory, levelled):
    """A scan that is solved at once, with a name that a shell would take apart."""
    file = tmp_path_factory.mktemp("scan of a sheet") / "it's small.h5"
    levelled.save(file)
    return State(str(file), steps=(Step("level=plane"),))


def states(small):
    yield "levelled", small
    yield "off", small.adding("lowpass=gauss:8um").switching(1, False)
    yield "cropped", small.adding("crop=0,0,96,64", "lowpass=gauss:4um")
    yield "trapped", replace(small, trapped=True)
    yield "tool", replace(small, tool="ground:Sa=0.1um", pressure="3 MPa")
    yield "dry", replace(small, density="0 g/m^2")
    yield "shear", replace(small, material="copper", shear_strength="120 MPa")
    yield "contact alone", replace(small, material="glass")
    yield "pad", small.following("pad")
    yield "settings", replace(small, settings=(("seed", "7"), ("poissons_ratio", "0.3"), ("dry_below", "10 nm"), ("tolerance", "1e-7")))


NAMES = ("levelled", "off", "cropped", "trapped", "tool", "dry", "shear", "contact alone", "pad", "settings")


@pytest.fixture(params=NAMES)
def state(request, small):
    return dict(states(small))[request.param]


@pytest.fixture
def found(state):
    answer = answer_of(tb.read(state.scan), state)
    assert not answer.failures or not state.has_friction
    return numbers(answer)


def said_by(program, line):
    words = shlex.split(line)
    assert words[0] == "tabor"
    done = subprocess.run([program, *words[1:], "--json"], capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def test_the_command_line_gives_the_same_numbers_to_the_digit(program, state, found):
    measured, solved = (said_by(program, line) for line in texts.command_line(state).splitlines())
    assert measured["treatment"] == list(state.treatment)
    for symbol in PARAMETERS:
        assert measured["parameters"][symbol]["value"] == found[symbol]
    given = solved["states"][0]
    clocks = ("seconds", "fft_seconds", "peak_memory_bytes", "warning_codes")  # contact and friction warn of their own
    compared = [key for key in given if key in found and key not in clocks]
    assert {key: given[key] for key in compared} == {key: found[key] for key in compared}
    assert {"contact_area_fraction", "mean_gap_m", "certificate"} <= {*compared}
    assert ("friction_lubricated" in compared) == state.has_friction


def test_the_python_gives_the_same_numbers_to_the_digit(state, found):
    names = {}
    exec(texts.python(state), names)
    for symbol in PARAMETERS:
        assert names["surface"].parameters([symbol])[symbol].value == found[symbol]
    values = (names["friction"] if state.has_friction else names["contact"]).values
    for key in ("contact_area_fraction", "friction_dry", "friction_lubricated", "lubricated_share", "certificate"):
        assert values.get(key) == found.get(key)


def test_the_study_file_gives_the_same_numbers_to_the_digit(program, state, found, tmp_path):
    text = texts.study(state)
    if not state.has_friction:
        assert text.startswith("# ") and "shear strength" in text
        return
    (tmp_path / "study.toml").write_text(text)
    subprocess.run([program, "sweep", tmp_path / "study.toml", "-o", tmp_path / "out", "--quiet"], check=True, capture_output=True)
    with open(tmp_path / "out" / "results.csv", newline="") as file:
        (row,) = csv.DictReader(file)
    numbers_of = {key: float(cell) for key, cell in row.items() if key in found and cell not in ("", "true", "false") and not isinstance(found[key], str)}
    assert {"friction_dry", "friction_lubricated", "contact_area_fraction", "certificate"} <= {*numbers_of}
    for key, value in numbers_of.items():
        assert value == (pytest.approx(found[key], rel=1e-6) if key in FROM_STORED_MAPS else found[key]), key


def test_what_is_read_with_options_is_read_with_them_everywhere(program, tmp_path):
    file = tmp_path / "heights.txt"
    rows = [" ".join(f"{(7 * x * y + x) % 13 / 10}" for x in range(32)) for y in range(32)]
    file.write_text("\n".join(rows))
    state = State(str(file), (("pixel", "2 um"), ("unit", "um")), (Step("level=mean"),))
    names = {}
    exec(texts.python(state), names)
    measured = said_by(program, texts.parameters_command(state))
    assert measured["parameters"]["Sq"]["value"] == names["surface"].parameters(["Sq"]).Sq.value
    assert tb.Study  # the study reads the same two
    assert 'pixel = "2 um"' in texts.study(state) and 'unit = "um"' in texts.study(state)


def test_a_surface_in_memory_is_to_be_written_first():
    text = texts.command_line(State(""))
    assert text.startswith("# first, in Python: surface.save('surface.h5')") and "tabor friction surface.h5" in text


def test_a_written_surface_in_memory_has_the_numbers_of_the_page(levelled, tmp_path):
    levelled.save(tmp_path / "surface.h5")
    there = numbers(answer_of(tb.read(tmp_path / "surface.h5"), State("")))
    assert numbers(answer_of(levelled, State("")))["friction_lubricated"] == there["friction_lubricated"]


def test_steps_are_added_moved_switched_and_removed(small):
    state = small.adding("fill=harmonic", "mirror")
    assert state.treatment == ("level=plane", "fill=harmonic", "mirror")
    assert state.moving(2, -1).treatment == ("level=plane", "mirror", "fill=harmonic")
    assert state.moving(0, -1) == state and state.moving(2, 5) == state
    assert state.switching(1, False).treatment == ("level=plane", "mirror")
    assert state.without(0).treatment == ("fill=harmonic", "mirror")
    assert Step("mirror").argument == "" and Step("level=plane").name == "level"


def test_undo_goes_back_and_redo_forth():
    history = History(1)
    for value in (2, 2, 3):
        history.take(value)
    assert (history.undo(), history.undo(), history.undo(), history.can_undo) == (2, 1, 1, False)
    assert (history.redo(), history.can_redo) == (2, True)
    history.take(5)
    assert not history.can_redo and history.undo() == 2


@pytest.mark.parametrize("one", RECIPES, ids=lambda one: one.name)
def test_a_recipe_is_the_steps_it_prints(one, small, levelled):
    assert small.following(one.name).treatment == one.steps
    named = levelled.recipe(one.name)
    assert named.history == levelled.treat(*one.steps).history and (named.height == levelled.treat(*one.steps).height).all()


def test_an_unknown_recipe_names_the_nearest():
    with pytest.raises(ValueError, match="did you mean 'sheet'"):
        recipe("sheets")


def test_a_treatment_that_fails_says_why(levelled):
    answer = answer_of(levelled, State("", steps=(Step("level=plain"),)))
    assert "plane" in answer.failures["treatment"] and answer.contact is None and numbers(answer) == {}


def test_holes_are_said_where_they_are_in_the_way(levelled):
    heights = levelled.height.copy()
    heights[3, 4] = float("nan")
    answer = answer_of(tb.Surface(heights, pixel=levelled.pixel), State(""))
    assert answer.surface.n_holes == 1 and "fill" in answer.failures["contact"]


def test_a_preview_has_larger_pixels_and_is_named_so(levelled):
    bench, state = Bench(levelled), State("")
    assert coarser(levelled, LIVE) is None
    coarse = coarser(levelled, 4 * LIVE)
    assert coarse.shape == (64, 64)
    answer = bench.treated_answer(state)
    preview = bench.solved(answer, coarse)
    full = bench.solved(answer, answer.surface)
    assert preview.is_preview and not full.is_preview and full.is_whole
    assert full.friction.lubricated == answer_of(levelled, state).friction.lubricated != preview.friction.lubricated
    assert bench.expected(state, answer.surface) == 0  # all of it is at hand


def test_each_warning_is_said_once_beside_what_it_concerns(levelled):
    warnings = answer_of(levelled, State("")).warnings
    said_once = [one for part in warnings.values() for one in part]
    assert len(said_once) == len(set(said_once)) > 0
    assert "clamp" in {one.code for one in warnings["contact"]}


@pytest.mark.parametrize("one", RECIPES, ids=lambda one: one.name)
def test_the_program_prints_a_recipe_as_its_steps(program, small, one):
    words = [program, "params", small.scan, "--recipe", one.name]
    printed = subprocess.run(words, capture_output=True, text=True, check=True).stdout
    assert f"treatment {', '.join(one.steps)}" in " ".join(printed.split())
    measured = json.loads(subprocess.run([*words, "--json"], capture_output=True, text=True, check=True).stdout)
    assert measured["treatment"] == list(one.steps)
    assert measured["parameters"]["Sq"]["value"] == tb.read(small.scan).treat(*one.steps).parameters(["Sq"]).Sq.value


def test_a_study_takes_a_recipe_for_its_steps(program, small, tmp_path):
    """The same case under both names: the second run finds what the first one stored."""
    text = texts.study(small.following("sheet"))
    steps = text[text.index("steps = "):].splitlines()[0]
    said = []
    for name, line in (("typed", steps), ("named", 'steps = ["recipe=sheet"]')):
        (tmp_path / f"{name}.toml").write_text(text.replace(steps, line))
        subprocess.run([program, "sweep", tmp_path / f"{name}.toml", "-o", tmp_path / name, "--quiet"], check=True, capture_output=True)
        said.append((tmp_path / name / "results.csv").read_text())
    rows = [next(csv.DictReader(one.splitlines())) for one in said]
    assert {key: value for key, value in rows[0].items() if "seconds" not in key} == {key: value for key, value in rows[1].items() if "seconds" not in key}


def saved(result, tmp_path):
    result.save(tmp_path / "result.h5", double=True)
    return opened(State(str(tmp_path / "result.h5")))


def test_a_result_file_opens_with_its_settings(program, levelled, tmp_path):
    pressed = tb.contact(levelled, "5.5 MPa", tb.Solid("aluminium-6016", saturation_pressure="300 MPa"), tool="ground:Sa=0.1um")
    rubbed = tb.friction(pressed, tb.rain(levelled, "0.7 g/m^2", seed=5), trapped=True, shear_strength="150 MPa")
    found = saved(rubbed, tmp_path)
    state = found.state
    assert (state.pressure, state.density, state.tool, state.shear_strength) == ("5.5 MPa", "0.7 g/m^2", "ground:Sa=0.1um", "150 MPa")
    assert state.trapped and state.material == "aluminium-6016" and dict(state.settings).items() >= {"saturation_pressure": "300000000.0 Pa", "seed": "5"}.items()
    again = answer_of(found.scan, state)
    assert again.friction.lubricated == rubbed.lubricated and again.contact.values["mean_gap_m"] == pressed.values["mean_gap_m"]
    assert "--saturation-pressure" in texts.command_line(state) and "--seed 5" in texts.command_line(state)
    solved = said_by(program, texts.command_line(state).splitlines()[1])["states"][0]
    assert solved["friction_lubricated"] == rubbed.lubricated


def test_a_result_file_of_a_solid_of_its_own_opens(levelled, tmp_path):
    solid = tb.Solid(youngs_modulus="100 GPa", poissons_ratio=0.3)
    state = saved(tb.contact(levelled, "5 MPa", solid), tmp_path).state
    assert (state.material, state.solid.youngs_modulus, state.solid.saturation_pressure) == ("", 100e9, None)
    assert option_words(state.settings, "solid") == ["--youngs-modulus", "100000000000.0 Pa", "--poisson-ratio", "0.3"]


def test_a_file_of_a_surface_alone_opens_as_a_scan(levelled, tmp_path):
    levelled.save(tmp_path / "surface.h5")
    found = opened(State(str(tmp_path / "surface.h5")))
    assert found.state == State(str(tmp_path / "surface.h5")) and not found.note and not found.asks


def test_a_file_without_a_pixel_asks(tmp_path):
    (tmp_path / "heights.txt").write_text("1 2 3\n2 3 4\n1 1 2\n")
    found = opened(State(str(tmp_path / "heights.txt")))
    assert found.scan is None and "pixel" in found.asks
    known = opened(State(str(tmp_path / "heights.txt"), (("pixel", "1 um,2 um"), ("unit", "um"))))
    assert known.scan.pixel == pytest.approx((1e-6, 2e-6)) and not known.asks
    with pytest.raises(ValueError, match="no such file"):
        opened(State(str(tmp_path / "nothing.txt")))


def test_the_shortest_text_is_exact():
    for value in (7e6, 5.5e6, 1e6 / 3, 123456.789):
        assert tb._tabor.parse_si(shortest(value, "MPa", "pressure"), "pressure", "") == value
    assert shortest(7e6, "MPa", "pressure") == "7 MPa"


def test_cutoffs_are_those_of_the_filters(levelled):
    assert cutoff("lowpass=gauss:8um", levelled) == pytest.approx(8e-6)
    lx, ly = levelled.lengths
    assert cutoff("lowpass=hann:16/L", levelled) == pytest.approx((lx * ly) ** 0.5 / 16)


def test_a_spectrum_shows_what_filters_take_away(levelled):
    bench, state = Bench(levelled), State("").adding("lowpass=gauss:8um")
    found = bench.analysed(bench.treated_answer(state)).spectra
    short = found.treated.radial.q > 2 * 3.1415926 / 2e-6
    assert (found.treated.radial.density[short] < 1e-3 * found.unfiltered.radial.density[short]).all()
    plain = bench.analysed(bench.treated_answer(State(""))).spectra
    assert plain.unfiltered is None and (plain.treated.radial.density == found.unfiltered.radial.density).all()


def test_a_spectrum_with_holes_says_what_to_do(levelled):
    heights = levelled.height.copy()
    heights[3, 4] = float("nan")
    bench = Bench(tb.Surface(heights, pixel=levelled.pixel))
    assert "fill" in bench.analysed(bench.treated_answer(State(""))).failures["spectrum"]


@pytest.mark.parametrize("mode, match, search", [("wear", "plane", True), ("difference", "none", False), ("wear", "offset", False)])
def test_the_texts_of_a_difference_give_its_numbers_to_the_digit(program, levelled, small, tmp_path, mode, match, search):
    worn = levelled.height.copy()
    worn[30:60, 40:70] -= 0.5e-6
    tb.Surface(worn, pixel=levelled.pixel).save(tmp_path / "worn.h5")
    asked = texts.Combined(small, replace(small, scan=str(tmp_path / "worn.h5")), mode, match, search)
    expected = tb.combine(tb.read(small.scan).level("plane"), tb.read(tmp_path / "worn.h5").level("plane"), mode, match=match, search=search).values
    printed = said_by(program, texts.combined_command(asked))
    names = {}
    exec(texts.combined_python(asked), names)
    assert names["found"].values == expected and {key: printed[key] for key in expected} == dict(expected)


def test_a_difference_of_scans_treated_differently_has_no_command(small):
    asked = texts.Combined(small, small.adding("mirror"), "wear", "plane", True)
    assert texts.combined_command(asked).startswith("# ") and "mirror" in texts.combined_python(asked)
