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
from tabor.view.opening import Opened, opened
from tabor.view.server import View
from tabor.view.state import State, Step

HINTS = ("GPU stall due to ReadPixels", "willReadFrequently")  # of the browser on the speed of WebGL, which plotly.js draws with
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

    def __init__(self, browser, scans, states, height=2000):
        self.view = View([Opened(scan, state) if scan is not None else opened(state) for scan, state in zip(scans, states)])
        self.said, self.asked = [], []
        self.context = browser.new_context(viewport={"width": 1280, "height": height}, permissions=["clipboard-read", "clipboard-write"])
        self.page = self.context.new_page()
        self.page.set_default_timeout(PATIENCE)
        self.page.on("console", lambda message: self.said.append((message.type, message.text)))
        self.page.on("pageerror", lambda error: self.said.append(("error", str(error))))
        self.page.on("request", lambda request: self.asked.append(request.url))
        self.page.on("websocket", lambda socket: self.asked.append(socket.url))
        self.page.goto(self.view.url)
        self.page.wait_for_selector("[data-name=Sdq]" if None not in scans else "text=Open")

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

    def press(self, name, label):
        self.widget(name, "").get_by_text(label, exact=True).click()

    def tab(self, title):
        self.page.locator(".bk-tab", has_text=title).first.click()

    def model(self, name, what):
        """What JavaScript finds of the model of this name, which it calls `model`."""
        return self.page.evaluate(f"(() => {{ const model = Bokeh.documents[0].get_model_by_name('{name}'); return {what} }})()")

    def saved(self, name, button, tmp_path):
        """The file that a click on a button of a figure saves."""
        with self.page.expect_download() as download:
            self.widget(name, f"[title='{button}']").click()
        file = tmp_path / download.value.suggested_filename
        download.value.save_as(file)
        return file

    def text(self, place):
        return self.page.evaluate(f"Bokeh.documents[0].get_model_by_name('text_{place}').text")

    def check(self):
        """Nothing was complained about, and no request left 127.0.0.1."""
        assert [said for said in self.said if said[0] in ("error", "warning") and not any(hint in said[1] for hint in HINTS)] == []
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


@pytest.mark.parametrize("kind, suffix", [("scan", ".x3p"), ("result", ".h5"), ("report", ".html")])
def test_files_are_written_and_handed_out(page, scan, tmp_path, kind, suffix):
    surface, state = scan
    page.waits_for(state, surface)
    if kind == "scan":
        page.choose("write_scan_format", suffix)
    page.widget(f"write_{kind}", "button").click()
    link = page.page.locator(f"a[href*='_{kind}{suffix}']")
    file = tmp_path / f"file{suffix}"
    file.write_bytes(page.context.request.get(urllib.parse.urljoin(page.view.url, link.get_attribute("href")), timeout=PATIENCE).body())
    if kind == "scan":
        assert tb.read(file).height.tolist() == surface.height.tolist()
    elif kind == "result":
        assert tb.load(file).lubricated == pytest.approx(float(page.value("friction_lubricated")))
    else:
        assert "<title>" in file.read_text("utf-8")
    page.check()


def test_a_click_on_a_written_file_downloads_it(page, scan):
    page.waits_for(scan[1], scan[0])
    page.widget("write_result", "button").click()
    with page.page.expect_download() as download:
        page.page.locator("a[href*='_result.h5']").click()
    assert download.value.suggested_filename == "small_result.h5"
    page.check()


FIGURES = {"height": "small_heights", "result": "small_result", "histogram": "small_histogram", "section": "small_section", "curve": "small_friction"}


@pytest.mark.parametrize("name", FIGURES)
def test_every_picture_is_saved_as_png_and_svg(page, scan, tmp_path, name):
    page.waits_for(scan[1], scan[0])
    png, svg = (page.saved(name, f"Save as {kind}", tmp_path) for kind in ("PNG", "SVG"))
    assert (png.name, svg.name) == (f"{FIGURES[name]}.png", f"{FIGURES[name]}.svg")
    assert png.read_bytes().startswith(b"\x89PNG") and png.stat().st_size > 3000
    assert svg.read_text("utf-8").lstrip().startswith("<svg") and svg.stat().st_size > 3000
    page.check()


def test_the_section_has_the_heights_along_its_line(page, scan):
    surface, state = scan
    page.waits_for(state, surface)
    lx, ly = (1e6 * side for side in surface.lengths)
    row = 40
    y = (row + 0.5) * 1e6 * surface.dy
    page.page.evaluate(f"Bokeh.documents[0].get_model_by_name('ends').data = {{x: [0, {lx}], y: [{y}, {y}]}}")
    expected = (1e6 * surface.height[row]).tolist()
    page.page.wait_for_function("(first) => Math.abs(Array.from(Bokeh.documents[0].get_model_by_name('profile').data.z)[0] - first) < 1e-9", arg=expected[0])
    drawn = page.page.evaluate("Array.from(Bokeh.documents[0].get_model_by_name('profile').data.z)")
    assert drawn == pytest.approx(expected, rel=1e-12)
    page.check()


def test_a_box_on_the_map_crops_the_scan(page, scan):
    surface, state = scan
    page.waits_for(state, surface)
    page.widget("height", "[title='Box Zoom']").click()
    frame = page.model("height", "(({left, top, width, height}) => [left, top, width, height])(model.document.views_manager.find_one(model).frame.bbox)")
    place = page.widget("height", "").bounding_box()
    begin = (place["x"] + frame[0] + 0.25 * frame[2], place["y"] + frame[1] + 0.25 * frame[3])
    page.page.mouse.move(*begin)
    page.page.mouse.down()
    page.page.mouse.move(begin[0] + 0.5 * frame[2], begin[1] + 0.5 * frame[3], steps=5)
    page.page.mouse.up()
    page.page.wait_for_function("Bokeh.documents[0].get_model_by_name('height').x_range.start > 1")
    page.widget("crop", "button").click()
    page.page.wait_for_selector("[data-name=pixels]:not([data-value='128 x 128']):visible")
    step = page.widget("argument_0").input_value()
    state = state.adding(f"crop={step}")
    page.waits_for(state, surface)
    assert surface.crop(step).shape[1] == pytest.approx(64, abs=3)
    page.check()


def test_a_filter_is_shown_with_the_spectrum_and_the_trusted_wavelengths(page, scan):
    surface, state = scan
    page.choose("add", "lowpass=gauss:8um")
    page.waits_for(state.adding("lowpass=gauss:8um"), surface)
    page.page.wait_for_function("Bokeh.documents[0].get_model_by_name('spectrum_source').data.density.length > 10")
    drawn = page.page.evaluate("Array.from(Bokeh.documents[0].get_model_by_name('spectrum_source').data.density)")
    radial = surface.lowpass("gauss:8um").psd(window=surface.psd().window).radial
    assert drawn == pytest.approx(radial.density[radial.density > 0].tolist(), rel=1e-12)
    shortest, longest = surface.psd().trusted
    assert page.model("trusted", "[model.right, model.left]") == pytest.approx([1e6 * shortest, 1e6 * longest])
    page.check()


def test_the_surface_is_shown_in_three_dimensions(page, scan):
    pytest.importorskip("plotly", reason="no plotly: there is no 3-D view")
    page.waits_for(scan[1], scan[0])
    page.press("aside", "3-D")
    frame = page.page.frame_locator("iframe")
    frame.locator("canvas").first.wait_for()
    assert re.fullmatch(r"[\d.]+ times.*", frame.locator("output").inner_text())
    page.check()


@pytest.fixture(scope="module")
def worn(scan, tmp_path_factory):
    heights = scan[0].height.copy()
    heights[30:60, 40:70] -= 0.5e-6
    file = tmp_path_factory.mktemp("worn") / "worn.h5"
    tb.Surface(heights, pixel=scan[0].pixel).save(file)
    return tb.read(file), State(str(file))


def test_two_scans_stand_side_by_side_with_their_difference(browser, scan, worn, program, tmp_path):
    page = Page(browser, [scan[0], worn[0]], [scan[1], worn[1]])
    try:
        page.tab("Side by side")
        page.page.wait_for_selector("[data-name=worn]:visible")
        line = page.text("combine")
        found = json.loads(subprocess.run([program, *shlex.split(line)[1:], "--json"], capture_output=True, check=True).stdout)
        assert float(page.value("worn")) == found["wear"]["worn"]["volume_m3"] and float(page.value("shift_x_m")) == found["shift_x_m"]
        ranges = page.page.evaluate("new Set(['beside_0', 'beside_1', 'difference'].map((name) => Bokeh.documents[0].get_model_by_name(name).x_range.id)).size")
        assert ranges == 1
        page.choose("mode", "difference")
        page.page.wait_for_function("document.body && !Bokeh.documents[0].get_model_by_name('difference_numbers').text.includes('worn')")
        page.choose("write_difference_format", ".gsf")
        page.widget("write_difference", "button").click()
        link = page.page.locator("a[href*='difference.gsf']").get_attribute("href")
        (tmp_path / "d.gsf").write_bytes(page.context.request.get(urllib.parse.urljoin(page.view.url, link)).body())
        expected = tb.combine(scan[0], worn[0], "difference").surface.height
        assert tb.read(tmp_path / "d.gsf").height == pytest.approx(expected, rel=1e-6, abs=1e-15, nan_ok=True)
        page.check()
    finally:
        page.close()


def test_a_file_without_unit_and_pixel_asks_for_them(browser, tmp_path, levelled):
    file = tmp_path / "heights.txt"
    file.write_text("\n".join(" ".join(f"{1e6 * z:.6f}" for z in row) for row in levelled.height[:64, :64]))
    page = Page(browser, [None], [State(str(file))])
    try:
        page.type("ask_pixel", "0.67 bananas")
        page.widget("open", "button").click()
        page.page.wait_for_selector("text=bananas")
        page.type("ask_pixel", "0.67 um")
        page.type("ask_unit", "um")
        page.widget("open", "button").click()
        page.page.wait_for_selector("[data-name=Sdq]")
        state = State(str(file), (("pixel", "0.67 um"), ("unit", "um")))
        page.waits_for(state, tb.read(file, pixel="0.67 um", unit="um"))
        assert "--pixel '0.67 um' --unit um" in page.text(0)
        page.check()
    finally:
        page.close()


def test_another_scan_is_the_tool(browser, scan, worn):
    page = Page(browser, [scan[0], worn[0]], [scan[1], worn[1]])
    try:
        page.choose("tool", "scan: worn.h5")
        page.waits_for(replace(scan[1], tool=worn[1].scan), scan[0])
        page.check()
    finally:
        page.close()


def test_the_page_is_usable_by_keyboard_on_a_small_screen(browser, scan):
    """At 1280 x 720 nothing stands beyond the right edge, the maps and the sliders are in sight, and Tab reaches every control."""
    page = Page(browser, [scan[0]], [scan[1]], height=720)
    try:
        page.waits_for(scan[1], scan[0])
        assert page.page.evaluate("document.scrollingElement.scrollWidth <= 1280")
        for name in ("height", "pressure", "density", "result"):
            place = page.widget(name, "").bounding_box()
            assert place["y"] >= 0 and place["y"] + min(place["height"], 300) <= 720 and place["x"] + place["width"] <= 1280
        reached = set()
        focused = """() => { let one = document.activeElement
            while (one?.shadowRoot?.activeElement) one = one.shadowRoot.activeElement
            for (let host = one; host; host = host.getRootNode().host ?? host.parentElement)
                if (host.getAttribute?.("data-control")) return host.getAttribute("data-control")
            return "" }"""
        wanted = {"pressure", "pressure_field", "density", "density_field", "material", "tool", "shear", "add", "recipe", "crop", "write_report", "copy_0", "draw"}
        for name in wanted:
            page.widget(name, "")
        for _ in range(120):
            page.page.keyboard.press("Tab")
            reached.add(page.page.evaluate(focused))
        assert wanted <= reached, wanted - reached
        page.check()
    finally:
        page.close()


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
