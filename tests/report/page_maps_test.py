"""Maps of a page in a headless browser: what is read, drawn, cut and saved is what the file has, pixel by pixel."""

import io
import itertools
import re
import unittest

import h5py
import numpy as np

from browser_test import WithMaps
from synthetic_maps import PIXEL, SATURATION
from synthetic_single import write_single
from synthetic_study import Recipe
from tabor.report import viewer

UNITS = {"mm": 1e-3, "µm": 1e-6, "nm": 1e-9, "Pa": 1.0, "MPa": 1e6, "GPa": 1e9}
FIELDS = {"height": None, "film": "film_thickness", "gap": "gap", "pressure": "pressure"}
POINTED = """([x, y]) => { const maps = tabor.maps.maps, [factor] = maps.data.length, [px, py] = maps.data.pixel
  tabor.moved("maps", {x: (x + 0.5) * px * factor, y: (y + 0.5) * py * factor}, 370)
  return document.getElementById("maps_reading").textContent }"""
PIXELS = """async (id) => { const image = new Image(), canvas = document.createElement("canvas")
  image.src = document.getElementById(id).src
  await image.decode();
  [canvas.width, canvas.height] = [image.naturalWidth, image.naturalHeight]
  const context = canvas.getContext("2d")
  context.drawImage(image, 0, 0, 1 * canvas.width, canvas.height, 0, 0, canvas.width, canvas.height)
  return [canvas.width, canvas.height, [...context.getImageData(0, 0, canvas.width, canvas.height).data]] }"""


def read(text):
    """{"x": (value [SI], half the last digit that is shown [SI]), ..., "contact": words} of a reading."""
    *numbers, words = text.split("  ·  ")
    found = {"contact": words}
    for part in numbers if "contact" in words else text.split("  ·  "):
        name, number, unit = part.replace("−", "-").split(" ")
        decimals = len(number.partition(".")[2])
        found[name] = float(number) * UNITS[unit], 0.5 * 10.0**-decimals * UNITS[unit]
    return found


class Exact(WithMaps):
    """Compares a page with its file."""

    recipe = Recipe(shape=(90, 130), pressures=(2e6, 5e6, 9e6), densities=(0.45, 0.9))

    @classmethod
    def make(cls):
        path = cls.folder / "one.h5"
        write_single(path, cls.recipe)
        with h5py.File(path, "r+") as file:
            cls.prepare(file)
            height = file["surface/height"][()].astype(float)
            cls.height = height - np.nanmean(height)
            cls.states = [{name: state[key][()].astype(float) for name, key in FIELDS.items() if key} for state in file["states"].values()]
        return cls.report(path, cls.folder / "page")

    @classmethod
    def prepare(cls, file):
        """Saturated contact is pressed in, as by a plastic solid, and one pixel holds next to no film."""
        for state in file["states"].values():
            pressed = state["pressure"][()] == SATURATION
            state["gap"][...] = np.where(pressed, -np.abs(file["surface/height"][()]) / 10, state["gap"][()])
            state["film_thickness"][3, 4] = 1e-16

    def shown(self, contact, film):
        return {"height": self.height, **self.states[len(self.recipe.densities) * contact + film]}

    def contact_of(self, shown, row, column):
        pressure = shown["pressure"][row, column]
        if pressure <= 0:
            return "no contact"
        wet = "wet" if shown["film"][row, column] > 0 else "dry"
        return f"contact, {wet}, {'saturated' if self.is_saturated(pressure) else 'elastic'}"

    def is_saturated(self, pressure):
        return pressure >= SATURATION

    def check_reading(self, text, shown, place=None):
        """place: (row, column) that is expected, else that which the reading names; returns that."""
        found = read(text)
        row, column = place or (round(found[axis][0] / PIXEL - 0.5) for axis in "yx")
        for axis, pixel in (("x", column), ("y", row)):
            self.assertAlmostEqual(found[axis][0] / PIXEL, pixel + 0.5, delta=0.05)
        for name, values in shown.items():
            value, half = found[name]
            self.assertLessEqual(abs(value - values[row, column]), half * (1 + 1e-6), (text, name, row, column))
            self.assertLess(half, 1e-5 * np.ptp(values), (text, name))
        self.assertEqual(found["contact"], self.contact_of(shown, row, column), text)
        return row, column

    def saved(self, selector):
        """[[cell]] of a table that a click saves."""
        with self.page.expect_download() as download:
            self.page.click(selector)
        return [line.split(",") for line in download.value.path().read_text().splitlines()]

    def map_of(self, panel):
        """(x, y, values) of a map's table."""
        (_, *x), *rows = self.saved(f"a[data-panel={panel}]")
        cells = np.array([[float(cell or "nan") for cell in row] for row in rows])
        return np.array(x, dtype=float), cells[:, 0], cells[:, 1:]

    def picture(self, layer):
        """uint8 (rows, columns, 3)"""
        columns, rows, values = self.page.evaluate(PIXELS, f"maps_{layer}_still")
        return np.array(values, dtype=np.uint8).reshape(rows, columns, 4)[..., :3]


class Saturating(Exact):
    def test_a_reading_is_of_one_pixel_and_equals_the_file_to_its_last_digit(self):
        rng = np.random.default_rng(1)
        for contact, film in itertools.product(range(3), range(2)):
            self.choose(contact, film)
            shown = self.shown(contact, film)
            places = [tuple(rng.integers(0, self.height.shape)) for _ in range(50)]
            places += [tuple(place) for place in np.argwhere(shown["pressure"] > 0)[::40]] + [(3, 4)]
            for row, column in places:
                self.check_reading(self.page.evaluate(POINTED, [int(column), int(row)]), shown, (row, column))

    def test_the_pointer_reads_the_pixel_it_is_on(self):
        self.choose(1, 0)
        for x, y in ((0.203, 0.302), (0.513, 0.772), (0.932, 0.114)):
            self.point(x, y)
            row, column = self.check_reading(self.page.inner_text("#maps_reading").replace(" · ", "  ·  "), self.shown(1, 0))
            np.testing.assert_allclose((column, row), (130 * x - 0.5, 90 * y - 0.5), atol=2)  # the frame is known to some points on the screen

    def test_a_reading_follows_the_choice_while_the_pointer_stays(self):
        self.choose(0, 0)
        row, column = np.argwhere(self.shown(2, 0)["pressure"] > self.shown(0, 0)["pressure"])[0]
        self.page.evaluate(POINTED, [int(column), int(row)])
        for contact, film in ((2, 0), (2, 1), (0, 1)):
            self.choose(contact, film)
            text = self.page.evaluate("document.getElementById('maps_reading').textContent")
            self.check_reading(text, self.shown(contact, film), (row, column))

    def test_tables_hold_every_pixel(self):
        self.choose(2, 1)
        shown = self.shown(2, 1)
        for panel, values in shown.items():
            x, y, cells = self.map_of(panel)
            np.testing.assert_allclose(x, (np.arange(130) + 0.5) * PIXEL, rtol=1e-9)
            np.testing.assert_allclose(y, (np.arange(90) + 0.5) * PIXEL, rtol=1e-9)
            np.testing.assert_allclose(cells, values, rtol=0, atol=0.51e-5 * np.ptp(values))
        touching, wet, saturated = shown["pressure"] > 0, shown["film"] > 0, self.is_saturated(shown["pressure"])
        np.testing.assert_array_equal(self.map_of("state")[2], touching * (1 + saturated + 2 * wet))

    def test_a_section_holds_every_pixel_of_its_row_or_column(self):
        self.choose(2, 1)
        shown = self.shown(2, 1)
        for button, take in (("along", lambda values, row, _: values[row]), ("across", lambda values, _, column: values[:, column])):
            self.page.click(f"#maps_{button}")
            names, *rows = self.saved("#maps_csv")
            table = dict(zip(names, np.array([[float(cell or "nan") for cell in row] for row in rows]).T))
            row, column = (round(table[axis][0] / PIXEL - 0.5) for axis in ("y_m", "x_m"))
            solid, film, gap = (take(shown[name], row, column) for name in ("height", "film", "gap"))
            step = 1e-5 * np.ptp(self.height)
            np.testing.assert_allclose(table["s_m"], np.arange(len(solid)) * PIXEL, rtol=1e-9)
            np.testing.assert_allclose(table["solid_m"], solid, rtol=0, atol=step)
            np.testing.assert_allclose(table["counterface_m"], solid + gap, rtol=0, atol=step)
            wet = film > step
            np.testing.assert_allclose(table["liquid_level_m"][wet], (solid + film)[wet], rtol=0, atol=step)
            self.assertTrue(np.isnan(table["liquid_level_m"][film == 0]).all())

    def test_solid_above_the_counterface_is_shaded_and_named(self):
        self.choose(2, 1)
        row = int(np.argmax((self.shown(2, 1)["gap"] < 0).sum(axis=1)))
        self.page.evaluate("(row) => { tabor.maps.maps.line = [[0.5, row + 0.5], [129.5, row + 0.5]]; tabor.maps.maps.section() }", row)
        source = self.page.evaluate(
            """(() => { const {data} = tabor.doc.get_model_by_name("maps_section")
               return {solid: [...data.solid], flattened: [...data.flattened]} })()"""
        )
        depth = (np.array(source["solid"]) - np.array(source["flattened"])) * 1e-6
        gap = self.shown(2, 1)["gap"][row]
        self.assertGreater(np.count_nonzero(gap < 0), 3)
        np.testing.assert_allclose(depth, np.maximum(-gap, 0), atol=1e-5 * np.ptp(self.height))
        self.assertIn("flattened: solid above the counterface", self.page.inner_text(".section .classes"))

    def test_the_pressure_is_drawn_with_its_unit(self):
        self.choose(2, 1)
        self.assertEqual(self.page.inner_text("#maps_pressure_title"), "Contact pressure at P = 9 MPa")
        self.assertRegex(self.page.inner_text("#maps_pressure_ends"), r"^0\s+120\s+240 MPa$")
        self.check_colours("pressure", self.shown(2, 1)["pressure"] > 0)

    def test_colours_follow_what_is_shown(self):
        self.choose(0, 0)
        self.setUp()
        whole = self.page.inner_text("#maps_height_ends")
        self.page.check("#maps_follow")
        try:
            self.page.evaluate("""(() => { const {x_range, y_range} = tabor.doc.get_model_by_name("maps_height_plot"), [factor] = tabor.maps.maps.data.length
                x_range.setv({start: 0.67e-6 * 30.5 * factor, end: 0.67e-6 * 49.5 * factor})
                y_range.setv({start: 0.67e-6 * 39.5 * factor, end: 0.67e-6 * 20.5 * factor}) })()""")
            self.page.wait_for_function(f"document.getElementById('maps_height_ends').innerText != {whole!r} && !tabor.maps.maps.loading")
            self.page.wait_for_timeout(600)
            part = self.height[20:40, 30:50]
            ends = self.page.evaluate("tabor.maps.maps.limits('height', tabor.maps.maps.data.height, tabor.maps.maps.now)")
            np.testing.assert_allclose(ends, np.percentile(part, [0.5, 99.5]), atol=0.01 * np.ptp(part))
            shown = [float(text.replace("−", "-").split(" ")[0]) for text in self.page.locator("#maps_height_ends span").all_inner_texts()]
            np.testing.assert_allclose(np.array(shown[::2]) * 1e-6, ends, atol=0.01 * np.ptp(part))
            picture = self.picture("height").astype(int)
            place = 1 + 254 * np.clip((self.height - ends[0]) / (ends[1] - ends[0]), 0, 1)
            table = viewer._table(viewer.COLOURS["height"]).astype(int)
            near = [np.abs(picture - table[np.clip(np.floor(place).astype(int) + step, 1, 255)]).max(axis=2) for step in (-1, 0, 1)]
            self.assertEqual(np.min(near, axis=0).max(), 0)
        finally:
            self.page.uncheck("#maps_follow")
        self.page.wait_for_function(f"document.getElementById('maps_height_ends').innerText == {whole!r}")

    def test_every_colour_is_one_of_the_scale(self):
        for contact, film in ((0, 1), (2, 0)):
            self.choose(contact, film)
            self.check_colours("film", self.shown(contact, film)["film"] > 0)
            self.check_colours("gap", np.ones((90, 130), dtype=bool))
            self.check_colours("height", np.ones((90, 130), dtype=bool))

    def check_colours(self, panel, is_valued):
        """Each pixel has the colour of its value, within one step, and what has none the colour of the ground."""
        picture, values = self.picture(panel), self.shown(*self.page.evaluate("[tabor.maps.maps.contact, tabor.maps.maps.film]"))[panel]
        self.assertEqual(picture.shape[:2], values.shape)
        self.assertEqual({tuple(colour) for colour in picture[~is_valued]} - {viewer.GROUNDS[panel]}, set())
        part = {"gap": "contacts[tabor.maps.maps.contact].gap", "pressure": "contacts[tabor.maps.maps.contact].pressure",
                "film": "films[tabor.maps.maps.film]"}.get(panel, panel)  # fmt: skip
        low, high = self.page.evaluate(f"tabor.maps.maps.data.{part}.limits")
        table = viewer._table(viewer.COLOURS[panel]).astype(int)
        place = 1 + 254 * np.clip((values - low) / (high - low), 0, 1)
        near = np.min([np.abs(picture - table[np.clip(np.floor(place).astype(int) + step, 1, 255)]).max(axis=2) for step in (-1, 0, 1)], axis=0)
        self.assertEqual(near[is_valued].max(), 0)

    def test_zoomed_oil_shows_colours_of_the_scale(self):
        self.choose(0, 0)
        self.page.click("#maps_height_plot", position={"x": 2, "y": 2})
        self.page.evaluate("""(() => { const {x_range, y_range} = tabor.doc.get_model_by_name("maps_film_plot"), [factor] = tabor.maps.maps.data.length
            x_range.setv({start: 0, end: 0.67e-6 * 13 * factor}); y_range.setv({start: 0.67e-6 * 9 * factor, end: 0}) })()""")
        self.page.evaluate("tabor.doc.get_model_by_name('maps_line').data = {x: [], y: []}")
        plot = self.page.locator("#maps_film_plot")
        plot.scroll_into_view_if_needed()
        self.page.wait_for_timeout(400)
        box = plot.bounding_box()
        clip = {"x": box["x"] + box["width"] - 300, "y": box["y"] + 60, "width": 260, "height": 150}
        from PIL import Image

        drawn = np.array(Image.open(io.BytesIO(self.page.screenshot(clip=clip))).convert("RGB")).reshape(-1, 3)
        known = {tuple(colour) for colour in viewer._table(viewer.COLOURS["film"])} | {viewer.GROUNDS["film"]}
        seen = {tuple(colour) for colour in drawn.tolist()}
        self.page.evaluate("tabor.maps.maps.section()")
        self.assertGreater(len(seen), 5)
        self.assertEqual(seen - known, set())

    def test_the_classes_have_the_colours_of_the_legend(self):
        self.choose(2, 1)
        shown, picture = self.shown(2, 1), self.picture("state")
        legend = self.page.evaluate("""[...document.querySelectorAll('.map .classes span')].map((entry) => [entry.innerText,
            getComputedStyle(entry.querySelector('i')).backgroundColor.match(/\\d+/g).map(Number)])""")
        self.assertEqual([text for text, _ in legend], ["dry, elastic", "dry, saturated", "wet, elastic", "wet, saturated"])
        classes = (shown["pressure"] > 0) * (1 + self.is_saturated(shown["pressure"]) + 2 * (shown["film"] > 0))
        for place, (_, colour) in enumerate([("", [255, 255, 255]), *legend]):
            self.assertTrue((classes == place).any())
            self.assertTrue((picture[classes == place] == colour).all(), (place, colour))

    def test_paper_has_axes_with_units(self):
        self.page.emulate_media(media="print")
        try:
            ticks = self.page.evaluate("""[...document.querySelectorAll('figure.map')].map((figure) => {
                const area = figure.querySelector('.layers').getBoundingClientRect()
                const found = (side, place) => [...figure.querySelectorAll(`.${side} span`)].map((tick) => {
                  const box = tick.getBoundingClientRect()
                  return [Number(tick.innerText), place(box, area), box.height > 0] })
                return {x: found("along", (box, area) => ((box.left + box.right) / 2 - area.left) / area.width),
                        y: found("up", (box, area) => ((box.top + box.bottom) / 2 - area.top) / area.height),
                        text: figure.querySelector(".frame").innerText, shape: area.width / area.height} })""")
        finally:
            self.page.emulate_media(media="screen")
        self.assertEqual(len(ticks), 5)
        for axes in ticks:
            self.assertIn("x (µm)", axes["text"])
            self.assertIn("y (µm)", axes["text"])
            self.assertAlmostEqual(axes["shape"], 130 / 90, delta=0.02)
            for axis, pixels in (("x", 130), ("y", 90)):
                self.assertGreaterEqual(len(axes[axis]), 3)
                for value, share, is_seen in axes[axis]:
                    self.assertTrue(is_seen)
                    self.assertAlmostEqual(share, value * 1e-6 / (pixels * PIXEL), delta=0.02)

    def test_marks_of_a_legend_are_those_of_its_curve(self):
        entries = self.page.evaluate("""[...document.querySelectorAll("#against_pressure button.entry")].map((button) => {
            const mark = button.querySelector("path"), plotted = [...tabor.doc._all_models.values()].filter((model) =>
              model.tags && model.tags.includes(button.dataset.tag) && model.glyph && model.glyph.marker).map((model) => model.glyph)
            return [button.innerText, mark && mark.getAttribute("class"), mark && mark.getAttribute("fill"),
                    [...new Set(plotted.map((glyph) => glyph.marker.value || glyph.marker))],
                    [...new Set(plotted.map((glyph) => glyph.fill_color.value === undefined ? glyph.fill_color : glyph.fill_color.value))]] })""")
        self.assertGreater(len({mark for _, mark, *_ in entries}), 1)
        for text, mark, fill, markers, fills in entries:
            self.assertEqual(([mark], [fill]), (markers, [colour or "none" for colour in fills]), text)


class Elastic(Exact):
    """A result without a saturation pressure has no saturated pixels, however high its pressures are."""

    @classmethod
    def prepare(cls, file):
        for state in file["states"].values():
            del state.attrs["saturation_pressure_Pa"]
            state["pressure"][...] = state["pressure"][()] * (1 + file["surface/height"][()] * 1e5)

    def is_saturated(self, pressure):
        return np.zeros(np.shape(pressure), dtype=bool)

    def test_contact_is_elastic_under_the_pointer_in_the_table_and_in_the_legend(self):
        self.choose(2, 1)
        shown = self.shown(2, 1)
        for row, column in np.argwhere(shown["pressure"] > 0)[::25]:
            self.check_reading(self.page.evaluate(POINTED, [int(column), int(row)]), shown, (row, column))
        touching, wet = shown["pressure"] > 0, shown["film"] > 0
        np.testing.assert_array_equal(self.map_of("state")[2], touching * (1 + 2 * wet))
        legend = self.page.locator(".map .classes span").all_inner_texts()
        self.assertEqual(legend, ["dry, elastic", "wet, elastic"])
        self.assertNotIn("flattened", self.page.inner_text("#maps"))


class Thinned(Exact):
    """More than 1024 pixels along a side."""

    recipe = Recipe(shape=(37, 2051), pressures=(5e6, 9e6), densities=(0.9,))

    def choose(self, contact, film):
        self.page.select_option("#maps_contact", index=contact)
        self.page.wait_for_function("!tabor.maps.maps.loading")

    def test_one_constant_step_serves_readings_sections_and_tables_and_is_said(self):
        self.assertIn("Values under the pointer come from every 3rd pixel", self.page.inner_text("#maps"))
        self.choose(1, 0)
        shown = self.shown(1, 0)
        for row, column in np.random.default_rng(2).integers(0, self.height.shape, (100, 2)):
            found = self.check_reading(self.page.evaluate(POINTED, [int(column), int(row)]), shown)
            self.assertEqual(found, (row - row % 3, column - column % 3))
        for panel, values in shown.items():
            x, y, cells = self.map_of(panel)
            np.testing.assert_allclose(x, (np.arange(0, 2051, 3) + 0.5) * PIXEL, rtol=1e-9)
            np.testing.assert_allclose(y, (np.arange(0, 37, 3) + 0.5) * PIXEL, rtol=1e-9)
            np.testing.assert_allclose(cells, values[::3, ::3], rtol=0, atol=0.51e-5 * np.ptp(values))
        self.page.click("#maps_along")
        cut = self.page.evaluate("tabor.maps.maps.cut()")
        np.testing.assert_allclose(cut["x"], (np.arange(0, 2051, 3) + 0.5) * PIXEL, rtol=1e-9)

    def test_the_map_of_contact_has_every_pixel(self):
        self.choose(1, 0)
        shown = self.shown(1, 0)
        touching = self.page.evaluate(PIXELS, "maps_state_still")
        veil = np.array(touching[2], dtype=np.uint8).reshape(37, 2051, 4)[..., 3]
        np.testing.assert_array_equal(veil == 255, shown["pressure"] == 0)
        np.testing.assert_array_equal(veil == 0, self.is_saturated(shown["pressure"]))


class WithHoles(WithMaps):
    """Heights alone, with pixels that were not measured."""

    @classmethod
    def make(cls):
        write_single(cls.folder / "one.h5", Recipe(shape=(40, 50), pressures=(5e6,), densities=(0.9,)), film=False, contact=False)
        with h5py.File(cls.folder / "one.h5", "r+") as file:
            cls.height = file["surface/height"][()]
            cls.height[5:9, 10:30] = np.nan
            cls.height[0, 0] = np.nan
            cls.height[20, 20] = 1e-3  # a spike takes no digits from the rest
            file["surface/height"][...] = cls.height
        return cls.report(cls.folder / "one.h5", cls.folder / "page")

    def test_a_hole_is_unknown_and_its_neighbours_are_not(self):
        height = self.height - np.nanmean(self.height)
        for row, column in ((0, 0), (0, 1), (5, 9), (5, 10), (8, 29), (9, 29), (20, 20), (20, 21), (39, 49)):
            text = self.page.evaluate(POINTED, [column, row])
            if np.isnan(height[row, column]):
                self.assertRegex(text, "height unknown$")
                continue
            value, half = read(text)["height"]
            self.assertLessEqual(abs(value - height[row, column]), half * (1 + 1e-6), text)
            self.assertLess(half, 1e-10)


if __name__ == "__main__":
    unittest.main()
