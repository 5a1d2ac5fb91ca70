"""The interactive page in a headless browser: nothing fetched or complained about, maps together, values of the file."""

import importlib.util
import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import h5py
import numpy as np

from report_test import run
from synthetic_single import write_single
from synthetic_study import Recipe
import synthetic_study
from tabor.report import interactive, live_page, refusals

ROOT = Path(__file__).resolve().parents[2]
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
LARGEST_PAGE = 10e6  # bytes
RECIPE = Recipe(shape=(120, 160), pressures=(2e6, 5e6, 9e6), densities=(0.45, 0.9))
RANGES = """["height", "state", "pressure", "gap", "film"].map((panel) => {
  const plot = tabor.doc.get_model_by_name(`maps_${panel}_plot`)
  return [plot.x_range.start, plot.x_range.end, plot.y_range.start, plot.y_range.end] })"""

TOOLBARS = """(() => { const all = (root) => [...root.querySelectorAll("*")].flatMap((part) => [part, ...part.shadowRoot ? all(part.shadowRoot) : []])
  return all(document.querySelector(".section")).filter((part) => part.classList.contains("bk-Toolbar")).map((part) => part.getBoundingClientRect().height) })()"""


def browser_or_skip():
    missing = [name for name in ("playwright", "bokeh", "PIL") if importlib.util.find_spec(name) is None]
    if missing or CHROMIUM is None:
        raise unittest.SkipTest(f"no {', '.join(missing) or 'chromium'}: the page is not tried in a browser")
    from playwright.sync_api import sync_playwright

    playwright = sync_playwright().start()
    return playwright, playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])


class InBrowser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.playwright, cls.browser = browser_or_skip()
        cls.addClassCleanup(cls.playwright.stop)
        cls.addClassCleanup(cls.browser.close)
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.path = cls.make()
        cls.said, cls.asked = [], []
        cls.page = cls.browser.new_page(viewport={"width": 1200, "height": 1000})
        cls.page.set_default_timeout(120_000)  # ms; others may use the machine
        cls.page.on("console", lambda message: cls.said.append((message.type, message.text)))
        cls.page.on("pageerror", lambda error: cls.said.append(("error", str(error))))
        cls.page.on("request", lambda request: cls.asked.append(request.url))
        cls.page.goto(cls.path.as_uri())
        cls.ready = cls.page.evaluate("tabor.ready")

    @classmethod
    def report(cls, result, folder):
        done = run(result, "-o", folder)
        assert done.returncode == 0, done.stderr
        return folder / "report.html"

    def check_page(self):
        self.assertTrue(self.ready)
        self.assertEqual([said for said in self.said if said[0] in ("error", "warning")], [])
        others = [url for url in self.asked if not url.startswith(("data:", "blob:")) and url != self.path.as_uri()]
        self.assertEqual(others, [])
        self.assertLess(self.path.stat().st_size, LARGEST_PAGE)
        images = self.page.evaluate("[...document.querySelectorAll('figure img')].map((image) => [image.id, image.alt])")
        self.assertEqual([name for name, alt in images if not alt and not name.endswith("_wet_still")], [])
        plots = self.page.evaluate(
            """[...document.querySelectorAll('[role=img]')].map((plot) => [plot.id, plot.ariaLabel
               || document.getElementById(plot.getAttribute('aria-labelledby')).textContent])"""
        )
        self.assertTrue(plots)
        self.assertEqual([name for name, text in plots if not text], [])


class WithMaps(InBrowser):
    """A page with one scan's maps: seen whole before each test."""

    def setUp(self):
        self.page.click("#maps_height_plot", position={"x": 2, "y": 2})
        self.page.evaluate("""(() => { const {x_range, y_range} = tabor.doc.get_model_by_name("maps_height_plot")
            const {data} = tabor.maps.maps, [factor] = data.length
            x_range.setv({start: 0, end: data.size[0] * data.pixel[0] * factor})
            y_range.setv({start: data.size[1] * data.pixel[1] * factor, end: 0}) })()""")

    def point(self, x, y, panel="height"):
        """Moves the pointer to this share of a map's frame; its reading."""
        plot = self.page.locator(f"#maps_{panel}_plot")
        plot.scroll_into_view_if_needed()
        box, frame = plot.bounding_box(), self.page.evaluate(
            f"""(() => {{ const plot = tabor.doc.get_model_by_name('maps_{panel}_plot')
                return [plot.inner_width, plot.inner_height] }})()"""
        )
        left = box["width"] - frame[0] - 7
        self.page.mouse.move(box["x"] + left + x * frame[0], box["y"] + 34 + y * frame[1])
        self.page.wait_for_timeout(150)
        return self.page.evaluate("tabor.maps.maps.reading")

    def choose(self, contact, film):
        self.page.select_option("#maps_contact", index=contact)
        self.page.select_option("#maps_film", index=film)
        self.page.wait_for_function("!tabor.maps.maps.loading")


class OneScan(WithMaps):
    @classmethod
    def make(cls):
        write_single(cls.folder / "one.h5", RECIPE)
        return cls.report(cls.folder / "one.h5", cls.folder / "page")

    def test_nothing_is_fetched_or_complained_about_and_all_has_a_text(self):
        self.check_page()

    def test_the_reading_is_written_with_units(self):
        self.point(0.4, 0.4)
        text = self.page.inner_text("#maps_reading")
        self.assertRegex(text, r"x [\d.]+ µm\s+·\s+y [\d.]+ µm\s+·\s+height −?[\d.]+ (µm|nm)")
        self.assertRegex(text, r"film .* gap .* pressure .* MPa .* (no contact|contact)")

    def test_all_maps_zoom_and_move_together(self):
        before = self.page.evaluate(RANGES)
        self.point(0.5, 0.5)
        self.page.keyboard.down("Control")
        self.page.mouse.wheel(0, -400)
        self.page.keyboard.up("Control")
        self.page.wait_for_timeout(300)
        zoomed = self.page.evaluate(RANGES)
        self.assertLess(zoomed[0][1] - zoomed[0][0], before[0][1] - before[0][0])
        self.assertEqual(len({tuple(ranges) for ranges in zoomed}), 1)
        self.page.mouse.down()
        self.page.mouse.move(600, 500, steps=4)
        self.page.mouse.up()
        moved = self.page.evaluate(RANGES)
        self.assertNotEqual(moved, zoomed)
        self.assertEqual(len({tuple(ranges) for ranges in moved}), 1)

    def test_an_end_of_the_section_follows_the_pointer_and_the_map_stays(self):
        self.page.click("#maps_across")
        before = self.page.evaluate(RANGES)
        x, _ = self.page.evaluate("tabor.maps.maps.line[0]")
        self.point((x + 0.5) / 160, 0.01)
        self.page.mouse.down()
        self.point(0.85, 0.4)
        self.page.mouse.up()
        line = self.page.evaluate("tabor.maps.maps.line")
        np.testing.assert_allclose(line[0], [0.85 * 160, 0.4 * 120], atol=4)
        self.assertEqual(self.page.evaluate(RANGES), before)

    def test_tables_are_named_by_the_scan_and_what_is_chosen(self):
        self.choose(1, 0)
        names = {"height": "one_height.csv", "gap": "one_gap_5MPa.csv", "film": "one_film_0.45g_per_m2.csv", "state": "one_state_5MPa_0.45g_per_m2.csv"}
        for selector, name in ({f"a[data-panel={panel}]": name for panel, name in names.items()} | {"#maps_csv": "one_section_5MPa_0.45g_per_m2.csv"}).items():
            with self.page.expect_download() as download:
                self.page.click(selector)
            self.assertEqual(download.value.suggested_filename, name)

    def test_a_name_in_the_legend_hides_its_curve(self):
        button = self.page.locator("#against_pressure button.entry").first
        tag = button.get_attribute("data-tag")
        shown = f"""[...tabor.doc._all_models.values()].filter((model) => model.tags.includes({json.dumps(tag)}))
            .map((model) => model.visible)"""
        self.assertEqual(set(self.page.evaluate(shown)), {True})
        button.click()
        self.assertEqual(set(self.page.evaluate(shown)), {False})
        button.click()
        self.assertEqual(set(self.page.evaluate(shown)), {True})

    def test_print_shows_still_figures_instead(self):
        self.assertGreater(self.page.evaluate(TOOLBARS)[0], 0)
        self.page.emulate_media(media="print")
        try:
            seen = "[...document.querySelectorAll('{}')].map((part) => part.getBoundingClientRect().height > 0)"
            self.assertEqual(set(self.page.evaluate(seen.format("figure > .live .plot"))), {False})
            self.assertEqual(set(self.page.evaluate(seen.format(".frame, figure > img.still"))), {True})
            self.assertEqual(set(self.page.evaluate(seen.format("nav, .controls, .reading"))), {False})
            self.assertEqual(self.page.evaluate(TOOLBARS), [0])
        finally:
            self.page.emulate_media(media="screen")


class Study(InBrowser):
    @classmethod
    def make(cls):
        synthetic_study.write(cls.folder / "study", Recipe(shape=(60, 80)))
        return cls.report(cls.folder / "study", cls.folder / "page")

    def test_nothing_is_fetched_or_complained_about_and_all_has_a_text(self):
        self.check_page()

    def test_a_list_chooses_among_the_scans_that_the_page_has_room_for(self):
        self.assertEqual(self.page.locator("#maps_scan option").all_inner_texts(),
                         ["before_1, side A", "before_2, side A", "before_3, side B", "before_4, side B"])  # fmt: skip
        self.assertNotIn("--all-scans", self.page.inner_text("main"))

    def test_the_page_says_how_the_scans_without_room_are_shown(self):
        for name, value, said in (("MOST_SCANS", 2, "Maps of 2 scans of 4: tabor report --all-scans"), ("ROOM", 0, "Maps of one scan of 4: tabor report --all-scans")):
            with mock.patch.object(live_page, name, value):
                path = self.report(self.folder / "study", self.folder / name)
            self.page.goto(path.as_uri())
            self.assertTrue(self.page.evaluate("tabor.ready"))
            self.assertIn(said, self.page.inner_text("main"))
        self.page.goto(self.path.as_uri())
        self.page.evaluate("tabor.ready")

    def test_error_bars_measured_points_and_n_are_there(self):
        columns = self.page.evaluate(
            """[...tabor.doc._all_models.values()].filter((model) => model.type == "ColumnDataSource")
               .map((model) => Object.keys(model.data))"""
        )
        self.assertTrue(any({"error", "n"} <= set(names) for names in columns))
        labels = self.page.locator("button.entry").all_inner_texts()
        self.assertTrue(any(label.strip().startswith("experiment") for label in labels), labels)


class AllScans(InBrowser):
    @classmethod
    def make(cls):
        synthetic_study.write(cls.folder / "study", Recipe(groups=("side A", "side B"), pressures=(2e6, 5e6), shape=(32, 40)))
        done = run(cls.folder / "study", "--all-scans", "-o", cls.folder / "page")
        assert done.returncode == 0, done.stderr
        return cls.folder / "page/report.html"

    def seen(self):
        return self.page.evaluate("[...document.querySelectorAll('section.maps')].filter((one) => one.offsetHeight > 0).map((one) => one.id)")

    def test_one_list_chooses_the_scan_and_the_state_stays(self):
        self.assertTrue(self.ready, self.said)
        self.assertEqual(self.page.locator("#maps_scan option").all_inner_texts(), ["before_1, side A", "before_2, side B"])
        self.assertEqual(self.seen(), ["maps_scan0000"])
        self.page.select_option("#maps_scan0000_contact", index=0)
        self.page.select_option("#maps_scan0000_film", index=1)
        self.page.select_option("#maps_scan", index=1)
        self.page.wait_for_function("tabor.maps.maps_scan0001.started && !tabor.maps.maps_scan0001.loading")
        self.assertEqual(self.seen(), ["maps_scan0001"])
        self.assertEqual(self.page.evaluate("[tabor.maps.maps_scan0001.contact, tabor.maps.maps_scan0001.film]"), [0, 1])
        self.assertEqual(self.page.inner_text("#maps_scan0001_state_title"), "Contact at P = 2 MPa with 0.9 g/m²")
        self.assertGreater(self.page.evaluate("tabor.doc.get_model_by_name('maps_scan0001_height_plot').inner_width"), 300)
        self.assertEqual([said for said in self.said if said[0] in ("error", "warning")], [])


class Parts(InBrowser):
    """Files that hold less: heights alone, a contact without film, a film without contact."""

    WITHOUT = {"heights": {"film": False, "contact": False}, "contact": {"film": False}, "film": {"contact": False}}

    @classmethod
    def make(cls):
        for name, parts in cls.WITHOUT.items():
            write_single(cls.folder / f"{name}.h5", Recipe(shape=(40, 50), pressures=(5e6,), densities=(0.9,)), **parts)
            cls.report(cls.folder / f"{name}.h5", cls.folder / name)
        return cls.folder / "heights/report.html"

    def test_each_page_shows_what_there_is(self):
        expected = {"heights": ["height"], "contact": ["height", "state", "pressure", "gap"], "film": ["height", "film"]}
        for name, panels in expected.items():
            self.page.goto((self.folder / name / "report.html").as_uri())
            self.assertTrue(self.page.evaluate("tabor.ready"), (name, self.said))
            shown = self.page.evaluate("[...document.querySelectorAll('figure.map .live')].map((plot) => plot.id)")
            self.assertEqual(shown, [f"maps_{panel}_plot" for panel in panels])
        self.assertEqual([said for said in self.said if said[0] in ("error", "warning")], [])


class Size(unittest.TestCase):
    def test_a_page_of_many_pressures_stays_below_its_budget(self):
        if not interactive.is_possible():
            self.skipTest("no Bokeh")
        from tabor.report import viewer

        rng = np.random.default_rng(3)
        noise = rng.standard_normal((900, 900)).astype(np.float32) * np.float32(1e-6)
        film = np.maximum(noise, 0)
        touching = noise > 2.5e-6
        contact = lambda: {"contact": lambda step: (touching.astype(np.uint8), 240e6 * touching[::step, ::step]), "gap": lambda: noise}
        maps = viewer.Maps(
            "maps",
            "noise",
            "noise",
            (1e-6, 1e-6),
            noise.shape,
            lambda: noise,
            [viewer.Choice(f"{number} MPa", contact()) for number in range(12)],
            [viewer.Choice("0.9 g/m²", {"film": lambda: film})],
        )
        data, pictures = viewer.encoded(maps, share=0.5)
        parts = [data["height"], *data["films"], *(part[name] for part in data["contacts"] for name in ("gap", "pressure") if name in part)]
        classes = [*(part["state"] for part in data["contacts"]), *(part["wet"] for part in data["films"])]
        size = sum(map(len, pictures.values())) + sum(len(part["array"]["data"]) for part in parts) + sum(len(part["data"]) for part in classes)
        self.assertLess(size, 1.05 * 0.5 * viewer.BUDGET)
        self.assertTrue(data["left_out"])
        self.assertIn("gap", data["contacts"][0])


class Quickstart(InBrowser):
    """The page that tools/quickstart makes: its sentences, its tables and its curves say the same."""

    @classmethod
    def make(cls):
        program = os.environ.get("TABOR")
        if not program:
            raise unittest.SkipTest("TABOR names no program: the page of quickstart is not made")
        script = (ROOT / "tools" / "quickstart").read_text()
        command = re.search(r'"\$tabor" friction (.*?)-o ', script, re.DOTALL).group(1).replace("\\\n", " ")
        subprocess.run([program, "friction", *command.split(), "-o", cls.folder / "friction.h5"], cwd=ROOT, check=True,
                       capture_output=True)
        return cls.report(cls.folder / "friction.h5", cls.folder / "page")

    def texts(self, selector):
        return self.page.evaluate(f"[...document.querySelectorAll('{selector}')].map((one) => one.textContent.trim())")

    def table(self, selector):
        """{row: {column: text}}"""
        columns = self.texts(f"{selector} thead th")
        rows = self.page.evaluate(f"""[...document.querySelectorAll('{selector} tbody tr')].map((row) =>
            [...row.querySelectorAll('th, td')].map((cell) => cell.textContent.trim()))""")
        return {cells[0]: dict(zip(columns, cells[1:])) for cells in rows}

    def curve(self, pressure):
        """[(density, wet share, friction)] of the file."""
        with h5py.File(self.folder / "friction.h5") as file:
            columns = {name: node[()] for name, node in file["density_curves"].items()}
        here = columns["mean_pressure_Pa"] == pressure
        names = ("lubricant_density_g_per_m2", "lubricated_share", "friction_lubricated")
        return list(zip(*(columns[name][here] for name in names)))

    def test_every_number_of_the_sentences_is_that_of_the_tables(self):
        sentences = list(dict.fromkeys(self.texts("#answers li")))
        places = self.table("table.places")
        self.assertEqual(len(sentences), 3)
        words = {"below": "below", "less": "less wet", "between": "plateau", "there": "plateau", "beyond": "beyond"}
        n_words = 0
        for sentence in sentences:
            pressure, text = re.match(r"At (\d+ MPa): (.*)", sentence).groups()
            first, friction = re.search(r"full (?:from|at) (\S+) g/m² (?:on|already) \(friction (\S+)\)", text).groups()
            self.assertEqual(places["plateau from"][pressure], f"{first} g/m²")
            points = self.curve(1e6 * float(pressure.split()[0]))
            at_first = next(point for point in points if f"{point[0]:.4g}" == first)
            self.assertEqual(f"{at_first[2]:.3g}", friction)
            edge = re.search(r"above (\S+ to \S+ g/m²)", text)
            self.assertEqual(places["plateau ends in"][pressure], edge.group(1))
            for clause in text.split("; "):
                word = re.search(r"\b(?:lies?|wets?) (\w+),", clause)
                for density, share in re.findall(r"(\S+) g/m² \((\S+) % wet\)", clause):
                    droplets = ", single droplets" if "single droplets" in clause else ""
                    self.assertEqual(places[f"{density} g/m²"][pressure], f"{words[word.group(1)]} ({share} %){droplets}")
                    n_words += 1
        self.assertEqual(n_words, 12)

    def test_the_tables_are_those_of_the_states_and_the_curves_pass_by_them(self):
        places, answer = self.table("table.places"), self.table("table.answer")
        with h5py.File(self.folder / "friction.h5") as file:
            states = [dict(node.attrs) for node in file["states"].values()]
        for state in states:
            pressure, density = state["mean_pressure_Pa"], state["lubricant_density_g_per_m2"]
            column, row = f"{pressure / 1e6:g} MPa", f"{density:g} g/m²"
            self.assertIn(f"({100 * state['lubricated_share']:.3g} %)", places[row][column])
            friction, *sign = answer[f"friction, {row}"][column].split()
            self.assertAlmostEqual(float(friction), state["friction_lubricated"], delta=6e-4)
            self.assertEqual(bool(sign), bool({*refusals.CODES} & {*state["warning_codes"]}))
            area = {"counted contact": "contact_area_fraction_pixels", "contact area": "contact_area_fraction"}
            name = "counted contact" if state["area"] == "pixels" else "contact area"
            self.assertEqual(answer[name][column], f"{100 * state[area[name]]:.3g} %")
            point = next(point for point in self.curve(pressure) if abs(point[0] / density - 1) < 1e-9)
            if "few-droplets" not in state["warning_codes"]:
                self.assertAlmostEqual(point[1], state["lubricated_share"], delta=0.01)  # droplets beside their limit
            plateau = [float(text) for text in re.findall(r"[\d.]+", places["plateau from"][column])[:1]]
            ends = [float(text) for text in re.findall(r"[\d.]+", places["plateau ends in"][column])[:2]]
            if plateau[0] <= density <= ends[0]:
                self.assertIn(places[row][column].split(" (")[0], ("plateau", "less wet"))
                self.assertEqual("less wet" in places[row][column], "single droplets" in places[row][column])
            elif density >= ends[1]:
                self.assertIn("beyond", places[row][column])


if __name__ == "__main__":
    unittest.main()
