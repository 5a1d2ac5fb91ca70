"""The small pieces: units, reduction of maps, choice of the window, tables, files, command line."""

import base64
import contextlib
import io
import re
import stat
import sys
import tempfile
import unittest
import zlib
from pathlib import Path
from unittest import mock

import h5py
import numpy as np

from tabor.report import cli, dependencies, encoding, errors, hdf, live_page, maps, names, output, page, section, still, style, surface_numbers, units
from tabor.report.example import richest_window
from tabor.report.figures import Drawn, psd
from tabor.report.map_axes import round_length
from tabor.report.table import Table, converged


class Names(unittest.TestCase):
    def test_a_file_is_named_by_what_tells_it_from_the_others(self):
        files = {
            "scans/before.x3p": "before",
            "new/one.x3p": "new/one",
            "old/one.x3p": "old/one",
            "old/two.x3p": "two.x3p",
            "two.csv": "two.csv",
            "sheet_1.5MPa": "sheet_1.5MPa",
            "map.csv.gz": "map",
        }
        self.assertEqual(names.short(files), files)
        self.assertEqual(names.short(["a", "sub/a.x3p"]), {"a": "a", "sub/a.x3p": "a.x3p"})

    def test_names_of_files_are_told_apart_without_what_no_file_has_in_its_name(self):
        self.assertEqual(names.in_files(["before_1", "before 1 (side A)", "A", "a", "после", "?"]),
                         ["before_1", "before_1_side_A", "A_0002", "a_0003", "после", "0005"])  # fmt: skip
        self.assertEqual(names.of_state("P = 7 MPa (2nd), 0.45 g/m²"), "7MPa_2nd_0.45g_per_m2")

    def test_what_is_read_aloud_has_the_words_of_the_figures(self):
        said = page.spoken("μ = (A_real − A_lub)/A₀ · τ_y/P, dotted: P/p_sat of scans/A_real.x3p")
        self.assertEqual(page.spoken("τ_b · A_wet/(A₀ P)"), "boundary shear strength · wet contact area/(A₀ P)")
        self.assertEqual(said, "μ = (contact area − lubricated contact area)/A₀ · shear strength/P, dotted: P/saturation pressure of scans/A_real.x3p")

    def test_indices_stand_below_the_line_and_files_keep_their_names(self):
        for text, shown in (
            ("μ = (A_real − A_lub)/A₀ · τ_y/P", "μ = (A<sub>real</sub> − A<sub>lub</sub>)/A₀ · τ<sub>y</sub>/P"),
            ("μ = τ_y · A_dry/(A₀ P) + τ_b · A_wet/(A₀ P)",
             "μ = τ<sub>y</sub> · A<sub>dry</sub>/(A₀ P) + τ<sub>b</sub> · A<sub>wet</sub>/(A₀ P)"),
            ("A_b and p_dry", "A_b and p_dry"),
            ("tau_y/p_sat: <", "τ<sub>y</sub>/p<sub>sat</sub>: &lt;"),
            ("C1D along x", "C<sup>1D</sup> along x"),
            ("scans/p_y/A_real.x3p", "scans/p_y/A_real.x3p"),
        ):
            self.assertEqual(page.symbols(text), shown)


class Units(unittest.TestCase):
    def test_a_number_is_rounded_and_keeps_its_sign(self):
        self.assertEqual(units.number(0.291666), "0.2917")
        self.assertEqual(units.number(-2.0), "−2")
        self.assertEqual(units.number(4e-9, 2), "4×10⁻⁹")
        self.assertEqual(units.number(-4e-9, 2), "−4×10⁻⁹")
        self.assertEqual(units.number(float("nan")), "–")

    def test_pressures_and_lengths_take_the_prefix_that_suits_them(self):
        self.assertEqual(units.pressure(7e6), "7 MPa")
        self.assertEqual(units.pressure(78.55e9), "78.55 GPa")
        self.assertEqual(units.length(0.67e-6), "670 nm")
        self.assertEqual(units.length(2.278e-3), "2.278 mm")

    def test_any_unit_takes_the_prefix_that_suits_it(self):
        self.assertEqual(units.si(5.566e-5, "s"), "55.66 µs")
        self.assertEqual(units.si(60180.0, "N/m"), "60.18 kN/m")
        self.assertEqual(units.si(0.0325, "kg"), "0.0325 kg")
        self.assertEqual(units.si(0.0, "m"), "0 m")
        self.assertEqual(units.si(-3e-6, "m"), "−3 µm")
        self.assertEqual(units.si(float("nan"), "m"), "–")
        self.assertEqual(units.si(2e-8, "1/Pa"), "20 1/GPa")
        self.assertEqual(units.si(30.0, "%"), "30 %")

    def test_powers_of_lengths_take_the_length_that_suits_them(self):
        for value, unit, text in (
            (3e-12, "m²", "3 µm²"), (5e-12, "m³", "0.005 mm³"), (3e-15, "m³", "3000 µm³"), (2e6, "1/m", "2 1/µm"), (3e9, "1/m²", "3000 1/mm²"),
            (4e-8, "m³/m²", "40 nm³/nm²"), (900.0, "kg/m³", "900 kg/m³"), (0.0, "m³", "0 m³"),
        ):  # fmt: skip
            self.assertEqual(units.si(value, unit), text)
        self.assertEqual([units.signs(text) for text in ("m^3/m^2", "deg", "1", "")], ["m³/m²", "°", "", ""])

    def test_a_pressure_without_its_unit_is_rejected_with_the_corrected_form(self):
        self.assertEqual(units.parse_pressure("7 MPa"), 7e6)
        for wrong in ("7", "7 bar", "MPa", "7e MPa"):
            with self.assertRaises(errors.InputError):
                units.parse_pressure(wrong)
        self.assertEqual(units.parse_density("0.45g/m^2"), 0.45)
        with self.assertRaisesRegex(errors.InputError, "0.45g/m"):
            units.parse_density("0.45")

    def test_a_scale_bar_has_a_round_length_that_fits(self):
        self.assertEqual([round_length(value) for value in (0.57, 4.99, 5.0, 99.0)], [0.5, 2.0, 5.0, 50.0])


class Maps(unittest.TestCase):
    def test_block_mean_keeps_the_mean_of_whole_tiles(self):
        field = np.random.default_rng(1).random((12, 20))
        self.assertAlmostEqual(maps.block_mean(field, 4).mean(), field.mean(), places=14)

    def test_block_mean_leaves_holes_out_and_keeps_a_tile_of_holes_a_hole(self):
        field = np.ones((4, 4))
        field[0, 0] = np.nan
        field[2:, 2:] = np.nan
        reduced = maps.block_mean(field, 2)
        np.testing.assert_array_equal(reduced, [[1, 1], [1, np.nan]])

    def test_tiles_at_the_edge_average_what_they_have(self):
        field = np.arange(5.0)[None, :]
        np.testing.assert_array_equal(maps.block_mean(field, 2), [[0.5, 2.5, 4.0]])
        np.testing.assert_allclose(maps.tile_centres(0, 5, 2, 1.0, 1.0), [1.0, 3.0, 4.5])

    def test_a_single_pixel_of_contact_stays_visible_and_more_is_darker(self):
        touching = np.zeros((3456, 3456), dtype=bool)
        touching[1000, 2000] = True
        block = maps.block_size(touching.shape)
        darkness = maps.ink(maps.block_mean(touching, block))
        self.assertLessEqual(max(darkness.shape), maps.MAX_SIDE)
        self.assertEqual(np.count_nonzero(darkness), 1)
        self.assertGreaterEqual(darkness.max(), 0.35)
        self.assertTrue(np.all(np.diff(maps.ink(np.linspace(0, 1, 17))) > 0))

    def test_the_window_is_the_one_with_the_most_marked_pixels(self):
        interest = np.zeros((500, 700), dtype=bool)
        interest[310:340, 410:440] = True
        interest[10:20, 10:20] = True
        window = richest_window(interest)
        self.assertEqual(window.of(interest).sum(), 900)
        self.assertEqual(window.shape, (100, 100))

    def test_the_window_of_nothing_marked_is_next_to_the_middle(self):
        window = richest_window(np.zeros((500, 700), dtype=bool))
        self.assertEqual((window.y0, window.x0), (200, 300))

    def test_a_map_smaller_than_a_window_is_shown_whole(self):
        self.assertEqual(richest_window(np.ones((5, 9), dtype=bool)).shape, (5, 5))


class StillPictures(unittest.TestCase):
    """Figures of noise, whose pictures no format packs well."""

    def setUp(self):
        style.apply()
        self.noise = np.random.default_rng(3).random((300, 400))

    def shown(self, name, is_map, is_viewed=True):
        figure, grid = style.new_figure(2.0, width=3.0)
        grid[0][0].imshow(self.noise) if is_map else grid[0][0].plot(self.noise.ravel()[:2000])
        shown = page.Shown.of(Drawn(name, name, "", figure, is_map=is_map, is_viewed=is_viewed), None, {})
        style.close(figure)
        return shown

    def sizes(self, figures):
        return sum(4 * len(shown.picture) / 3 for shown in figures)

    def require_webp(self):
        from PIL import features

        if not features.check("webp"):
            self.skipTest("Pillow writes no WebP")

    def test_maps_lose_quality_before_anything_is_left_out(self):
        self.require_webp()
        fine, left_out = still.fitted([self.shown("map", True), self.shown("curve", False)], 1e9)
        room = 0.7 * self.sizes(fine)
        coarse, nothing = still.fitted([self.shown("map", True), self.shown("curve", False)], room)
        self.assertEqual((left_out, nothing), ([], []))
        self.assertLessEqual(self.sizes(coarse), room)
        self.assertEqual(still.kind(coarse[0].picture), ("image/webp", "webp"))
        self.assertEqual(coarse[1].picture, fine[1].picture)

    def test_sections_go_before_maps_and_curves_stay(self):
        self.require_webp()
        figures = [self.shown("map", True), self.shown("section", False), self.shown("curve", False, is_viewed=False)]
        room = 4 / 3 * len(figures[2].picture) + 1
        kept, left_out = still.fitted(figures, room)
        self.assertEqual(([shown.drawn.name for shown in kept], left_out), (["curve"], ["map", "section"]))
        worst = 4 / 3 * len(figures[0].picture)
        _, left_out = still.fitted([self.shown("map", True), figures[1], figures[2]], room + worst)
        self.assertEqual(left_out, ["section"])

    def test_curves_are_rounded_to_a_hundredth_of_a_point(self):
        figure, grid = style.new_figure(2.0)
        grid[0][0].plot([0, 1 / 3, 1], [0, 2 / 3, 1])
        paths = re.findall(rb' d="([^"]*)"', style.svg(figure))
        style.close(figure)
        self.assertGreater(len(paths), 5)
        self.assertFalse([path for path in paths if re.search(rb"\.\d\d\d", path)])


def unpacked(array, shape, height):
    """The codes of encoding.packed, pixel by pixel, as a browser finds them."""
    data = np.frombuffer(zlib.decompress(base64.b64decode(array["data"])), dtype=np.uint8).reshape(array["planes"], *shape).astype(np.int64)
    folded = sum(plane << 8 * number for number, plane in enumerate(data))
    codes, base = (folded >> 1) ^ -(folded & 1), height if array["on_height"] else np.zeros(shape, dtype=np.int64)
    for y, x in np.ndindex(*shape):
        before = {(dy, dx): (codes[y - dy, x - dx], base[y - dy, x - dx]) for dy, dx in ((0, 1), (1, 0), (1, 1)) if y >= dy and x >= dx}
        if array["is_level"]:
            film, ground = next((before[place] for place in ((0, 1), (1, 0)) if before.get(place, (0, 0))[0] > 0), (0, 0))
            codes[y, x] += max(0, film + ground - base[y, x]) if film > 0 else 0
        else:
            signs = {(0, 1): 1, (1, 0): 1, (1, 1): -1}
            codes[y, x] += sum(signs[place] * sum(pair) for place, pair in before.items()) - base[y, x]
    return codes


class Grid(unittest.TestCase):
    """Numbers of the grid of a page."""

    def test_codes_are_packed_without_loss(self):
        rng = np.random.default_rng(5)
        shape = 17, 23
        height = np.rint(rng.standard_normal(shape) * 3e5).astype(np.int64)
        film = np.maximum(0, 2000 - height) * (rng.random(shape) < 0.7)
        gap = np.cumsum(rng.integers(-3, 4, shape), axis=1) - height
        spikes = np.where(rng.random(shape) < 0.05, encoding.LARGEST_CODE, -encoding.LARGEST_CODE)
        for codes, under, is_level in ((height, None, False), (gap, height, False), (film, height, True), (spikes, None, False), (spikes, -spikes, False)):
            array = encoding.packed(codes, under, is_level)
            np.testing.assert_array_equal(unpacked(array, shape, under), codes)

    def test_a_step_is_decimal_and_leaves_five_digits_and_a_spike_takes_none_of_them(self):
        self.assertEqual(encoding.power_of(3e-6), -11)
        self.assertEqual(encoding.power_of(3e-6, span=1e-4), -11)
        self.assertEqual(encoding.power_of(240e6), 3)
        self.assertLessEqual(1e3 / 10.0 ** encoding.power_of(1e-9, span=1e3), encoding.LARGEST_CODE)

    def test_holes_have_a_code_that_no_value_has(self):
        codes, hole = encoding.codes_of(np.array([[1.0, np.nan, -2.0]]), 0)
        self.assertEqual(codes.tolist(), [[1, hole, -2]])
        self.assertNotIn(hole, (1, -2))
        self.assertIsNone(encoding.codes_of(np.array([[1.0]]), 0)[1])

    def test_all_pixels_are_kept_up_to_the_largest_grid_and_then_every_nth(self):
        steps = {(1024, 1024): 1, (1, 1025): 2, (2048, 3): 2, (2049, 3): 3, (3456, 3456): 4}
        self.assertEqual({shape: encoding.thinning(shape, encoding.LARGEST_GRID) for shape in steps}, steps)
        self.assertEqual([units.nth(step) for step in (2, 3, 4, 11, 12, 21, 112)], ["2nd", "3rd", "4th", "11th", "12th", "21st", "112th"])

    def test_a_large_map_is_packed_piece_by_piece(self):
        rng = np.random.default_rng(6)
        shape = 3 * encoding.ROWS_AT_ONCE + 5, 7
        under = rng.integers(0, 9, shape)
        for is_level in (False, True):
            codes = rng.integers(0, 9, shape)
            np.testing.assert_array_equal(unpacked(encoding.packed(codes, under, is_level), shape, under), codes)
        values = np.where(rng.random(shape) < 0.1, np.nan, rng.standard_normal(shape))
        codes, hole = encoding.codes_of(values, -3)
        np.testing.assert_array_equal(codes, np.where(np.isfinite(values), np.rint(1e3 * np.nan_to_num(values)), hole))

    def test_bits_are_the_pixels_that_were_marked(self):
        rng = np.random.default_rng(7)
        maps = [rng.integers(0, 3, (2 * encoding.ROWS_AT_ONCE + 3, 21)) * (rng.random(21) < 0.3) for _ in range(2)]
        bits = encoding.Bits(maps[0])
        np.testing.assert_array_equal(bits.mask(), maps[0] > 0)
        bits.add(maps[1])
        np.testing.assert_array_equal(bits.mask(), (maps[0] > 0) | (maps[1] > 0))
        self.assertTrue(bits.any)
        self.assertFalse(encoding.Bits(np.zeros((3, 3))).any)

    def test_every_nth_pixel_is_read_whatever_the_chunks(self):
        values = np.arange(200 * 90, dtype=np.float32).reshape(200, 90)
        with h5py.File("thinned.h5", "w", driver="core", backing_store=False) as file:
            for number, chunks in enumerate((None, (64, 32), (7, 90), (200, 90))):
                dataset = file.create_dataset(str(number), data=values, chunks=chunks)
                for step in (1, 2, 3, 5, 64, 300):
                    np.testing.assert_array_equal(hdf.thinned(dataset, step), values[::step, ::step])

    def test_the_distribution_is_that_of_all_heights(self):
        rng = np.random.default_rng(8)
        height = rng.standard_normal((40, 51)).astype(np.float32) * np.float32(1e-6)
        height[rng.random(height.shape) < 0.1] = np.nan
        given = height.copy()
        found = surface_numbers.distribution(height)
        np.testing.assert_array_equal(height, given)
        z = np.sort(height[np.isfinite(height)].astype(float) - height[np.isfinite(height)].astype(float).mean())[::-1] * 1e6
        self.assertEqual(found.unit, "µm")
        share, edges = np.histogram(z, bins=surface_numbers.BINS)
        np.testing.assert_allclose(found.edges, edges)
        np.testing.assert_allclose(found.density * np.diff(edges) * z.size, share)
        np.testing.assert_allclose(found.curve, np.interp(found.ratio, np.linspace(0, 100, z.size), z))
        self.assertIsNone(surface_numbers.distribution(np.ones((3, 3))))

    def test_ticks_of_an_axis_are_round_and_within_it(self):
        for length in (0.9, 1.0, 7.3, 343.04, 9999.0):
            ticks = live_page._ticks(length)
            self.assertTrue(2 <= len(ticks) <= 1 + live_page.MOST_TICKS, (length, ticks))
            for text, share in ticks:
                self.assertAlmostEqual(float(text), share * length, places=9)
                self.assertLessEqual(share, 1 + 1e-9)


class Section(unittest.TestCase):
    def test_flattened_solid_is_named_where_there_is_some(self):
        height, gap = np.array([[1.0, 2.0, 3.0]]), np.array([[2.0, 0.0, -1.0]])
        for values, labels in ((gap, ["solid", "flattened", "counterface: solid + gap"]), (np.maximum(gap, 0), ["solid", "counterface: solid + gap"])):
            figure, grid = style.new_figure(2.0)
            section.draw(grid[0][0], section.cut(0, (0, 3), 2.0, height, None, values), 1, "m", 1, "m")
            self.assertEqual(grid[0][0].get_legend_handles_labels()[1], labels)
            style.close(figure)

    def test_lines_are_solid_plus_film_and_solid_plus_gap(self):
        height, film, gap = (
            np.array([[1.0, 2.0, 3.0]]),
            np.array([[0.5, 0.0, 0.25]]),
            np.array([[2.0, 1.0, 0.0]]),
        )
        lines = section.cut(0, (0, 3), 2.0, height, film, gap)
        np.testing.assert_array_equal(lines["x_m"], [1, 3, 5])
        np.testing.assert_array_equal(lines["liquid_level_m"], [1.5, np.nan, 3.25])
        np.testing.assert_array_equal(lines["counterface_m"], [3, 3, 3])


class Spectra(unittest.TestCase):
    def test_spectra_on_one_grid_are_averaged_and_on_another_kept_apart(self):
        q, other = np.array([1.0, 2.0]), np.array([1.0, 3.0])
        curves = psd.mean_by_grid(
            [
                (q, np.array([2.0, 4.0]), 0.8),
                (other, np.array([9.0, 9.0]), 0.5),
                (q, np.array([4.0, 8.0]), 0.6),
            ]
        )
        self.assertEqual([curve[3] for curve in curves], [2, 1])
        np.testing.assert_array_equal(curves[0][1], [3, 6])
        self.assertAlmostEqual(curves[0][2], 0.7)


class Tables(unittest.TestCase):
    def test_converged_is_read_from_numbers_and_from_words(self):
        self.assertEqual(list(converged(Table(converged=np.array([1, 0], dtype=np.uint8)))), [True, False])
        words = np.array(["true", "false", "1"], dtype=object)
        self.assertEqual(list(converged(Table(converged=words))), [True, False, True])

    def test_numbers_survive_the_csv(self):
        values = [0.1, 1 / 3, 6.02e23]
        lines = output.table_text({"value": values}).splitlines()
        self.assertEqual([float(line) for line in lines[1:]], values)


class Files(unittest.TestCase):
    def test_a_file_is_complete_or_absent_and_leaves_nothing_behind(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "table.csv"
            output.write(path, "a\n")
            self.assertEqual([entry.name for entry in Path(folder).iterdir()], ["table.csv"])
            self.assertTrue(path.stat().st_mode & stat.S_IRUSR)
            with mock.patch("os.replace", side_effect=OSError(28, "No space left on device")):
                with self.assertRaisesRegex(errors.OutputError, "No space left"):
                    output.write(path, "b\n")
            self.assertEqual([entry.name for entry in Path(folder).iterdir()], ["table.csv"])
            self.assertEqual(path.read_text(), "a\n")


class CommandLine(unittest.TestCase):
    def run_cli(self, *arguments):
        stream = io.StringIO()
        with contextlib.redirect_stderr(stream), contextlib.redirect_stdout(io.StringIO()):
            code = cli.main([str(argument) for argument in arguments])
        return code, stream.getvalue()

    def test_what_cannot_be_read_ends_with_3_and_one_line(self):
        with tempfile.TemporaryDirectory() as folder:
            noise = Path(folder) / "noise.h5"
            noise.write_bytes(b"not HDF5 at all")
            for argument in (Path(folder) / "absent.h5", folder, noise):
                code, message = self.run_cli(argument)
                self.assertEqual(code, 3)
                self.assertEqual(message.count("\n"), 1, message)
                self.assertIn(str(argument), message)

    def test_a_missing_library_is_named_with_the_line_that_installs_it(self):
        for base, expected in ((sys.prefix, "apt install python3-h5py"), ("/elsewhere", f"{sys.executable} -m pip install h5py")):
            with (mock.patch.object(dependencies, "_is_importable", lambda name: name != "h5py"),
                  mock.patch.object(sys, "base_prefix", base)):
                code, message = self.run_cli("any.h5")
            self.assertEqual(code, 3)
            self.assertIn(expected, message)

    def test_a_pressure_without_unit_ends_with_3(self):
        self.assertEqual(self.run_cli("any.h5", "--pressure", "7")[0], 3)


if __name__ == "__main__":
    unittest.main()
