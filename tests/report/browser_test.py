"""The interactive page in a headless browser: nothing fetched or complained about, maps together, values of the file."""

import importlib.util
import json
import shutil
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

from report_test import run
from synthetic_single import write_single
from synthetic_study import Recipe
import synthetic_study
from tabor_report import encoding, interactive

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
LARGEST_PAGE = 10e6  # bytes
PANELS = ("height", "state", "gap", "film")
RECIPE = Recipe(shape=(120, 160), pressures=(2e6, 5e6, 9e6), densities=(0.45, 0.9))
RANGES = """["height", "state", "gap", "film"].map((panel) => {
  const plot = tabor.doc.get_model_by_name(`maps_${panel}_plot`)
  return [plot.x_range.start, plot.x_range.end, plot.y_range.start, plot.y_range.end] })"""


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


class OneScan(InBrowser):
    @classmethod
    def make(cls):
        write_single(cls.folder / "one.h5", RECIPE)
        return cls.report(cls.folder / "one.h5", cls.folder / "page")

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
        self.page.wait_for_function("tabor.maps.maps.canvases !== null")

    def test_nothing_is_fetched_or_complained_about_and_all_has_a_text(self):
        self.check_page()

    def test_the_values_under_the_pointer_are_those_of_the_file_within_a_step(self):
        with h5py.File(self.folder / "one.h5") as file:
            height = file["surface/height"][()]
            height = height - height.mean()
            for contact, film in ((0, 0), (2, 1)):
                state = file[f"states/{2 * contact + film:04d}"]
                stored = {"height": height, "gap": state["gap"][()], "film": state["film_thickness"][()]}
                self.choose(contact, film)
                for x, y in ((0.2, 0.3), (0.51, 0.77), (0.93, 0.11)):
                    found = self.point(x, y)
                    for name, values in stored.items():
                        step = np.ptp(values) / encoding.STEPS
                        error = abs(found[name] - values[found["y"], found["x"]])
                        self.assertLessEqual(error, 0.51 * step + 1e-7 * np.ptp(values))  # float32 beside half a step

    def test_the_contact_under_the_pointer_is_that_of_the_file(self):
        with h5py.File(self.folder / "one.h5") as file:
            for contact, film in ((0, 1), (2, 0)):
                state = file[f"states/{2 * contact + film:04d}"]
                pressure, wet = state["pressure"][()], state["film_thickness"][()] > 0
                self.choose(contact, film)
                touching = np.argwhere(pressure > 0)
                for row, column in [*touching[:: len(touching) // 20], (0, 0), (7, 100)]:
                    found = self.page.evaluate(f"tabor.maps.maps.state({column} + 0.5, {row} + 0.5)")
                    expected = (pressure[row, column] > 0) * (1 + 2 * wet[row, column])
                    self.assertIn(found - expected, (0, 1) if expected else (0,), (row, column))

    def test_the_reading_is_written_with_units(self):
        self.point(0.4, 0.4)
        text = self.page.inner_text("#maps_reading")
        self.assertRegex(text, r"x [\d.]+ µm\s+·\s+y [\d.]+ µm\s+·\s+height −?[\d.]+ (µm|nm)")
        self.assertRegex(text, r"film .* gap .* (no contact|contact)")

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

    def test_the_section_is_the_file_along_its_line(self):
        self.choose(1, 1)
        self.page.click("#maps_along")
        cut = self.page.evaluate("tabor.maps.maps.cut()")
        with h5py.File(self.folder / "one.h5") as file:
            height, state = file["surface/height"][()], file["states/0003"]
            height = height - height.mean()
            row = int(cut["y"][0] / self.page.evaluate("tabor.maps.maps.data.pixel[1]"))
            np.testing.assert_allclose(cut["solid"], height[row], atol=np.ptp(height) / encoding.STEPS)
            film, gap = state["film_thickness"][row], state["gap"][row]
            level = np.array([np.nan if value is None else value for value in cut["level"]], dtype=float)
            np.testing.assert_array_equal(np.isfinite(level), film > 0)
            np.testing.assert_allclose(cut["counter"], height[row] + gap, atol=1e-4 * np.ptp(height))

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
        self.page.emulate_media(media="print")
        try:
            seen = "[...document.querySelectorAll('{}')].map((part) => part.getBoundingClientRect().height > 0)"
            self.assertEqual(set(self.page.evaluate(seen.format("figure > .live .plot"))), {False})
            self.assertEqual(set(self.page.evaluate(seen.format(".frame, figure > img.still"))), {True})
            self.assertEqual(set(self.page.evaluate(seen.format("nav, .controls, .reading"))), {False})
        finally:
            self.page.emulate_media(media="screen")


class Study(InBrowser):
    @classmethod
    def make(cls):
        synthetic_study.write(cls.folder / "study", Recipe(shape=(60, 80)))
        return cls.report(cls.folder / "study", cls.folder / "page")

    def test_nothing_is_fetched_or_complained_about_and_all_has_a_text(self):
        self.check_page()

    def test_error_bars_measured_points_and_n_are_there(self):
        columns = self.page.evaluate(
            """[...tabor.doc._all_models.values()].filter((model) => model.type == "ColumnDataSource")
               .map((model) => Object.keys(model.data))"""
        )
        self.assertTrue(any({"error", "n"} <= set(names) for names in columns))
        labels = self.page.locator("button.entry").all_inner_texts()
        self.assertTrue(any(label.strip().startswith("experiment") for label in labels), labels)


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
        expected = {"heights": ["height"], "contact": ["height", "state", "gap"], "film": ["height", "film"]}
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
        from tabor_report import viewer

        rng = np.random.default_rng(3)
        noise = rng.standard_normal((900, 900)).astype(np.float32) * np.float32(1e-6)
        film = np.maximum(noise, 0)
        contact = lambda: {"state": lambda: (noise > 1e-6).astype(np.uint8), "gap": lambda: noise}
        maps = viewer.Maps(
            "maps",
            "noise",
            (1e-6, 1e-6),
            noise,
            [viewer.Choice(f"{number} MPa", contact()) for number in range(12)],
            [viewer.Choice("0.9 g/m²", {"film": lambda: film})],
        )
        budget = 4e6
        data, pictures = viewer.encoded(maps, budget)
        arrays = [data["height"], *data["films"], *(part["gap"] for part in data["contacts"] if "gap" in part)]
        size = sum(map(len, pictures.values())) + sum(len(part["array"]["data"]) for part in arrays)
        self.assertLess(size, 1.05 * budget)
        self.assertTrue(data["left_out"])
        self.assertIn("gap", data["contacts"][0])


if __name__ == "__main__":
    unittest.main()
