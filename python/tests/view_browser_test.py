"""The workbench in a headless browser: numbers are those of the library, nothing is fetched from elsewhere, no complaint."""

import importlib.util
import json
import re
import shlex
import shutil
import subprocess
import urllib.parse
from dataclasses import replace

import pytest

import tabor as tb

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
MISSING = [name for name in ("playwright", "bokeh") if importlib.util.find_spec(name) is None] + ([] if CHROMIUM else ["chromium"])
if MISSING:
    pytest.skip(f"no {', '.join(MISSING)}: the workbench is not tried in a browser", allow_module_level=True)

from playwright.sync_api import sync_playwright

from tabor.view.answers import PARAMETERS, answer_of, numbers
from tabor.view.page import Opened
from tabor.view.server import View
from tabor.view.state import State, Step

PATIENCE = 120_000  # ms; others may use the machine
SHOWN = ("contact_area_fraction", "mean_gap_m", "friction_dry", "friction_lubricated", "lubricated_share", "wet_fraction")


@pytest.fixture(scope="module")
def browser():
    with sync_playwright() as playwright:
        found = playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        yield found
        found.close()


class Page:
    """A page of a workbench, with what it said and asked for."""

    def __init__(self, browser, scans, states):
        self.view = View([Opened(scan, state) for scan, state in zip(scans, states)])
        self.said, self.asked = [], []
        self.context = browser.new_context(viewport={"width": 1280, "height": 2000}, permissions=["clipboard-read", "clipboard-write"])
        self.page = self.context.new_page()
        self.page.set_default_timeout(PATIENCE)
        self.page.on("console", lambda message: self.said.append((message.type, message.text)))
        self.page.on("pageerror", lambda error: self.said.append(("error", str(error))))
        self.page.on("request", lambda request: self.asked.append(request.url))
        self.page.on("websocket", lambda socket: self.asked.append(socket.url))
        self.page.goto(self.view.url)
        self.page.wait_for_selector("[data-name=Sdq]")

    def close(self):
        self.context.close()
        self.view.close()

    def value(self, name):
        return self.page.locator(f"[data-name='{name}']:visible").first.get_attribute("data-value")

    def waits_for(self, state, scan):
        """Waits until the page shows the numbers of this state, each to its last digit; they are computed here."""
        expected = numbers(answer_of(scan, state))
        for name in [name for name in (*PARAMETERS, *SHOWN) if name in expected]:
            self.page.wait_for_selector(f"[data-name='{name}'][data-value='{expected[name]!r}']:visible")
        self.page.wait_for_selector("[data-name=whole]:visible")
        return expected

    def widget(self, name, kind="input"):
        """The element of a control that has this name in the model of the page."""
        self.page.wait_for_function("""(name) => { let found = false
            const walk = (one) => { if (one.model.name == name) { one.el.setAttribute("data-control", name); found = true }
                for (const child of one.child_views ?? []) walk(child) }
            for (const view of Object.values(Bokeh.index)) walk(view)
            return found }""", arg=name)
        return self.page.locator(f"[data-control='{name}'] {kind}" if kind else f"[data-control='{name}']").first

    def type(self, name, text):
        field = self.widget(name)
        field.fill(text)
        field.press("Enter")

    def choose(self, name, text):
        self.widget(name, "select").select_option(text)

    def moves(self, name, key, times, unit):
        """Moves a slider by a key; the value in the field beside it, once that has followed."""
        handle = self.widget(name, ".noUi-handle")
        before = self.page.evaluate(f"Bokeh.documents[0].get_model_by_name('{name}').value")
        for _ in range(times):
            handle.press(key)
        power = self.page.evaluate(f"Bokeh.documents[0].get_model_by_name('{name}').value")
        assert abs(abs(power - before) - 0.01 * times) < 0.011  # the page does not move it back
        text = f"{10.0**power:.3g} {unit}"
        self.page.wait_for_function(f"Bokeh.documents[0].get_model_by_name('{name}_field').value == '{text}'")
        return text

    def text(self, place):
        return self.page.evaluate(f"Bokeh.documents[0].get_model_by_name('text_{place}').text")

    def check(self):
        """Nothing was complained about, and no request left 127.0.0.1."""
        assert [said for said in self.said if said[0] in ("error", "warning")] == []
        port = urllib.parse.urlsplit(self.view.url).port
        others = [url for url in self.asked if not re.match(rf"(http|ws)://127\.0\.0\.1:{port}/", url) and not url.startswith(("data:", "blob:"))]
        assert others == [] and len(self.asked) > 3


@pytest.fixture(scope="module")
def scan(levelled, tmp_path_factory):
    file = tmp_path_factory.mktemp("scans") / "small.h5"
    levelled.save(file)
    return tb.read(file), State(str(file))


@pytest.fixture
def page(browser, scan):
    found = Page(browser, [scan[0]], [scan[1]])
    yield found
    found.close()


def test_loading_levelling_and_both_sliders_give_the_numbers_of_the_library(page, scan, program):
    surface, state = scan
    page.waits_for(state, surface)
    page.choose("add", "level=plane")
    state = state.adding("level=plane")
    page.waits_for(state, surface)

    state = replace(state, pressure=page.moves("pressure", "ArrowRight", 12, "MPa"))
    assert 7 < tb._tabor.parse_si(state.pressure, "pressure", "") / 1e6 < 12
    page.waits_for(state, surface)

    state = replace(state, density=page.moves("density", "ArrowLeft", 20, "g/m^2"))
    assert 0.3 < 1e3 * tb._tabor.parse_si(state.density, "areal_density", "") < 0.9
    expected = page.waits_for(state, surface)

    measured, rubbed = page.text(0).splitlines()
    given = json.loads(subprocess.run([program, *shlex.split(rubbed)[1:], "--json"], capture_output=True, check=True).stdout)["states"][0]
    assert {key: given[key] for key in SHOWN if key in given} == {key: expected[key] for key in SHOWN if key in given}
    assert given["friction_lubricated"] == float(page.value("friction_lubricated"))
    sheet = json.loads(subprocess.run([program, *shlex.split(measured)[1:], "--json"], capture_output=True, check=True).stdout)
    assert sheet["parameters"]["Sq"]["value"] == float(page.value("Sq"))
    page.check()


def test_copying_puts_the_command_on_the_clipboard(page):
    page.widget("copy_0", "button").click()
    page.page.wait_for_function("navigator.clipboard.readText().then((text) => text.startsWith('tabor params '))")
    assert page.page.evaluate("navigator.clipboard.readText()") == page.text(0)
    page.check()


def test_exact_values_material_tool_and_trapped_oil_are_taken(page, scan):
    surface, state = scan
    page.type("pressure_field", "3.3 MPa")
    page.type("density_field", "1.25 g/m^2")
    state = replace(state, pressure="3.3 MPa", density="1.25 g/m^2")
    page.waits_for(state, surface)
    page.widget("trapped").check()
    state = replace(state, trapped=True)
    page.waits_for(state, surface)
    page.choose("tool", "ground tool, Sa 0.1 µm")
    state = replace(state, tool="ground:Sa=0.1um", trapped=True)
    page.waits_for(state, surface)
    page.choose("material", "steel-dc04")
    page.waits_for(replace(state, material="steel-dc04"), surface)
    page.check()


def test_what_makes_no_sense_is_said_beside_its_control(page):
    page.type("pressure_field", "3.3 bananas")
    page.page.wait_for_selector("text=bananas")
    page.choose("add", "lowpass=gauss:8um")
    page.type("argument_0", "gauss:8apples")
    page.page.locator(".failure:visible", has_text="apples").first.wait_for()
    page.check()


def test_steps_are_switched_moved_removed_and_undone(page, scan):
    surface, state = scan
    page.choose("recipe", "part")
    state = state.following("part")
    page.waits_for(state, surface)
    page.widget("on_0").uncheck()
    page.waits_for(state.switching(0, False), surface)
    page.widget("remove_3", "button").click()
    page.waits_for(state.switching(0, False).without(3), surface)
    for _ in range(2):
        page.widget("undo", "button").click()
    page.waits_for(state, surface)
    page.widget("up_3", "button").click()
    page.waits_for(state.moving(3, -1), surface)
    page.check()


def test_files_are_written_and_handed_out(page, scan, tmp_path):
    surface, state = scan
    page.waits_for(state, surface)
    for kind in ("scan", "result"):
        page.widget(f"write_{kind}", "button").click()
        link = page.page.locator(f"a[href*='_{kind}.']")
        with page.page.expect_download() as download:
            link.click()
        download.value.save_as(tmp_path / f"{kind}.h5")
    assert tb.read(tmp_path / "scan.h5").height.tolist() == surface.height.tolist()
    assert (tmp_path / "result.h5").stat().st_size > 1000


def test_friction_against_pressure_is_drawn(page):
    page.widget("draw", "button").click()
    page.page.wait_for_function("""[...Bokeh.documents[0]._all_models.values()].some((model) => model.type == "ColumnDataSource"
        && model.data instanceof Object && (model.data.pressure ?? model.data.get?.("pressure") ?? []).length >= 9)""")
    page.check()


def test_a_long_answer_is_previewed_and_can_be_stopped(browser):
    rough = tb.generate("self-affine", pixels=1536, pixel="1 um", rms_height="1 um", seed=2)
    page = Page(browser, [rough], [State("", steps=(Step("level=mean"),))])
    try:
        page.type("density_field", "3 g/m^2")
        preview = page.page.wait_for_selector("[data-name=preview]")
        assert re.fullmatch(r"Preview on pixels of \d+(\.\d+)? µm", preview.inner_text())
        page.widget("stop", "button").click()
        page.page.wait_for_selector("text=Stopped")
        assert page.page.locator("[data-name=preview]").count() == 1
        page.check()
    finally:
        page.close()


def test_two_scans_have_a_tab_each_and_maps_that_move_together(browser, scan):
    surface, state = scan
    page = Page(browser, [surface, surface], [state, state.adding("level=plane")])
    try:
        assert page.page.locator(".bk-tab").filter(has_text="small.h5").count() == 2
        page.page.locator(".bk-tab", has_text="small.h5").nth(1).click()
        page.waits_for(state.adding("level=plane"), surface)
        ranges = page.page.evaluate("""new Set([...Bokeh.documents[0]._all_models.values()]
            .filter((model) => ["height", "result"].includes(model.name)).map((model) => model.x_range.id)).size""")
        assert ranges == 1
        page.check()
    finally:
        page.close()


def test_the_server_ends_when_the_last_page_closes(browser, scan):
    page = Page(browser, [scan[0]], [scan[1]])
    page.page.reload()
    page.page.wait_for_selector("[data-name=Sdq]")
    assert page.view.is_open
    page.context.close()
    assert page.view.wait(60)
