"""Friction against the lubricant's density: the figure, what it says, and files that lack it or are damaged."""

import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

from study_case import StudyCase, draw, rows_of
from synthetic_single import write_single
from synthetic_study import Recipe
from synthetic_tables import DOSES, average_curves, density_curves
from tabor.report import areas, build, chart, page, page_single, page_study, style, units
from tabor.report import density_curves as density_curves_of_page
from tabor.report.figures import density_friction, single_curves

NAME = "friction_against_density"
CURVES = Recipe(density_curves=True)


class OfAStudy(StudyCase):
    def test_plotted_means_and_bands_are_those_of_the_file(self):
        source = self.study(CURVES)
        drawn = density_friction.of_study(source)
        panel = drawn.figure.panels[0]
        curves = [item for item in panel.items if isinstance(item, chart.Curve)]
        expected = [row for row in average_curves(density_curves(CURVES)) if row["group"] == "side A"]
        for curve, pressure in zip(curves, CURVES.pressures):
            means = [row["friction_lubricated_mean"] for row in expected if row["mean_pressure_Pa"] == pressure]
            np.testing.assert_array_equal(curve.x, DOSES)
            np.testing.assert_array_equal(curve.y, means)
        band = next(item for item in panel.items if isinstance(item, chart.Band))
        first = expected[0]
        low = first["friction_lubricated_mean"] - first["friction_lubricated_std"]
        self.assertAlmostEqual(band.low[0], low, places=14)
        self.assertEqual(len(rows_of(drawn.data[""])), 2 * 4 * len(DOSES))
        self.assertIn("n = 2", panel.title)

    def test_dry_friction_and_the_densities_asked_for_are_marked(self):
        drawn = density_friction.of_study(self.study(CURVES))
        guides = [item for item in drawn.figure.panels[0].items if isinstance(item, chart.Guide)]
        self.assertEqual([guide.at for guide in guides if guide.is_upright], list(CURVES.densities))
        series = density_friction.series_of.dry(self.study(CURVES), "side A")
        np.testing.assert_allclose([guide.at for guide in guides if not guide.is_upright], series.mean)

    def test_one_scan_has_no_band_and_says_so(self):
        drawn = density_friction.of_study(self.study(Recipe(groups=("one",), density_curves=True)))
        self.assertIn("n = 1", drawn.caption)
        self.assertTrue(all(row["spread"] == "nan" for row in rows_of(drawn.data[""])))

    def test_of_many_groups_six_are_drawn_and_all_are_in_the_table(self):
        groups = tuple(f"side {letter}" for letter in "ABCDEFGH")
        drawn = density_friction.of_study(self.study(Recipe(groups, (2e6, 5e6), density_curves=True)))
        self.assertEqual([len(row) for row in drawn.figure.rows], [2, 2, 2])
        self.assertEqual({row["group"] for row in rows_of(drawn.data[""])}, set(groups))
        self.assertIn("2 more groups", drawn.caption)

    def test_the_logarithmic_axis_has_several_labels_whatever_it_spans(self):
        for low, high in ((0.001, 10), (0.001, 0.05), (0.4, 0.9), (0.41, 0.46), (0.45, 0.450001)):
            found = style.round_numbers(low, high)
            self.assertGreaterEqual(len(found), 2, (low, high))
            self.assertLessEqual(len(found), 9, (low, high))
            self.assertTrue(all(low * 0.99 <= value <= high * 1.01 for value in found), found)

    def test_the_drawn_axis_carries_them(self):
        drawn = density_friction.of_study(self.study(CURVES))
        drawn.drawing.canvas.draw()
        labels = [label.get_text() for label in drawn.drawing.axes[0].get_xticklabels()]
        self.assertEqual(labels, ["0.001", "0.01", "0.1", "1", "10"])
        drawn.close()

    def test_groups_with_pressures_of_their_own_share_the_colours(self):
        def forget(folder):
            with h5py.File(folder / "results.h5", "a") as file:
                table = file["density_averages"]
                keep = (table["group"].asstr()[:] == "side A") | (table["mean_pressure_Pa"][:] == 5e6)
                for name in list(table):
                    values = table[name][:][keep]
                    del table[name]
                    table[name] = values

        drawn = density_friction.of_study(self.study(CURVES, forget))
        left, right = ([item for item in panel.items if isinstance(item, chart.Curve)] for panel in drawn.figure.panels)
        self.assertEqual((right[0].label, right[0].colour), (left[1].label, left[1].colour))


class Answers(StudyCase):
    def without_places(self):
        """As a file from before they were kept: its sentences stand on the page."""

        def forget(folder):
            with h5py.File(folder / "results.h5", "a") as file:
                del file["density_places"], file["density_plateaus"]

        return self.study(CURVES, forget)

    def test_of_each_group_the_lowest_and_highest_pressure_are_said_first(self):
        short, every = self.without_places().answers
        ends = [f"{group} at {p} MPa: full from 0.1 g/m²" for group in ("side A", "side B") for p in (2, 15)]
        self.assertEqual(short, ends)
        self.assertEqual(len(every), 8)

    def test_they_stand_above_the_warnings_and_figures_above_the_scans(self):
        source = self.study(Recipe(density_curves=True, warnings={0: "5 spikes"}))
        html = page.render(source, [], "tabor report x")
        places = [html.index(text) for text in ('id="answers"', 'id="warnings"', 'id="scans"')]
        self.assertEqual(places, sorted(places))
        self.assertIn("All 8 sentences", page.render(self.without_places(), [], "tabor report x"))

    def test_of_a_study_a_table_of_densities_and_pressures_stands_in_their_place(self):
        source = self.study(CURVES)
        self.assertEqual(source.answers, ([], []))
        table = source.places
        self.assertEqual(table["header"], [units.pressure(pressure) for pressure in CURVES.pressures])
        rows = dict(table["rows"])
        self.assertEqual(set(rows["plateau from (side A)"]), {"0.1 g/m²"})
        self.assertEqual(set(rows["plateau ends in (side B)"]), {"1 to 10 g/m²"})
        for density in CURVES.densities:
            self.assertEqual(set(rows[f"{density} g/m² (side A)"]), {"plateau (20 %)"})
        html = page.render(source, [], "x")
        self.assertIn('<table class="places">', html)
        self.assertNotIn("full from", html[html.index('id="answers"') : html.index('class="places"')])

    def test_a_plateau_on_which_hardly_any_contact_is_wet_is_dry(self):
        places = [("plateau", 0.002, True), ("plateau", 0.002, False), ("beyond", 0.2, True), ("", 0.2, False)]
        texts = [density_curves_of_page._place({"place": place, "lubricated_share": share}, is_dry) for place, share, is_dry in places]
        self.assertEqual(texts, ["dry (0.2 %)", "plateau (0.2 %)", "beyond (20 %)", "no plateau (20 %)"])
        self.assertTrue(density_curves_of_page._is_dry({"lubricated_share": 0.002}))
        self.assertFalse(density_curves_of_page._is_dry({}))  # of an older file

    def test_many_pressures_and_rows_are_cut_and_counted(self):
        pressures = tuple(1e6 * (place + 1) for place in range(12))
        groups = tuple(f"side {place}" for place in range(20))
        table = self.study(Recipe(groups, pressures, density_curves=True)).places
        self.assertEqual((len(table["header"]), table["pressures_left_out"]), (8, 4))
        self.assertEqual(len(table["rows"]) + table["left_out"], 20 * (2 + len(CURVES.densities)))

    def test_without_them_the_page_has_no_such_section(self):
        self.assertNotIn('id="answers"', page.render(self.default, [], "tabor report x"))

    def test_sentences_that_match_no_curve_are_all_said(self):
        def add(folder):
            with h5py.File(folder / "results.h5", "a") as file:
                del file["density_places"], file["density_plateaus"]
                file.attrs["answers"] = ["one <b>thing</b>"]

        source = self.study(CURVES, add)
        self.assertEqual(source.answers[0], ["one <b>thing</b>"])
        self.assertIn("one &lt;b&gt;thing&lt;/b&gt;", page.render(source, [], "x"))


class Damaged(StudyCase):
    def change(self, action):
        def run(folder):
            with h5py.File(folder / "results.h5", "a") as file:
                action(file)

        return self.study(CURVES, run)

    def test_an_older_file_has_no_such_figure_and_no_warning(self):
        self.assertNotIn(NAME, self.default_figures)
        self.assertFalse(any("density_averages" in warning for warning in self.default.warnings))

    def test_columns_of_two_lengths_are_said_once_and_left_out(self):
        def shorten(file):
            values = file["density_averages/n"][:-1]
            del file["density_averages/n"]
            file["density_averages/n"] = values

        source = self.change(shorten)
        self.assertEqual(sum("/density_averages: its columns are not of one length" in w for w in source.warnings), 1)
        figures = draw(source)
        self.assertNotIn(NAME, figures)
        self.assertIn("lubricated_friction", figures)

    def test_a_missing_column_a_text_for_numbers_and_no_table_are_named(self):
        def lose(file):
            del file["density_averages/friction_lubricated_mean"]

        def write_text(file):
            n = len(file["density_averages/n"])
            del file["density_averages/n"]
            file["density_averages/n"] = ["many"] * n

        def replace(file):
            del file["density_averages"]
            file["density_averages"] = np.zeros(3)

        for action, words in (
            (lose, "column friction_lubricated_mean is missing"),
            (write_text, "column n holds no numbers"),
            (replace, "got no table"),
        ):
            source = self.change(action)
            self.assertEqual(sum(words in warning for warning in source.warnings), 1, source.warnings)
            self.assertIsNone(density_friction.of_study(source))

    def test_rows_that_are_no_numbers_are_left_out_and_counted(self):
        def spoil(file):
            file["density_averages/friction_lubricated_mean"][3] = np.nan
            file["density_averages/lubricant_density_g_per_m2"][5] = 0
            file["density_averages/mean_pressure_Pa"][9] = np.inf

        source = self.change(spoil)
        self.assertTrue(any("3 of 40 rows hold no usable number" in warning for warning in source.warnings))
        drawn = density_friction.of_study(source)
        self.assertEqual(len(rows_of(drawn.data[""])), 37)

    def test_rows_that_are_all_spoiled_leave_no_figure(self):
        def spoil(file):
            file["density_averages/friction_lubricated_mean"][:] = np.nan

        self.assertNotIn(NAME, draw(self.change(spoil)))


class DamagedPlaces(StudyCase):
    def test_what_is_damaged_is_said_and_the_sentences_stay(self):
        def lose(file):
            del file["density_places/place"]

        def spoil(file):
            n = len(file["density_plateaus/plateau_to_g_per_m2"])
            del file["density_plateaus/plateau_to_g_per_m2"]
            file["density_plateaus/plateau_to_g_per_m2"] = ["wide"] * n

        for action, words in ((lose, "column place is missing"), (spoil, "column plateau_to_g_per_m2 holds no numbers")):
            def run(folder):
                with h5py.File(folder / "results.h5", "a") as file:
                    action(file)

            source = self.study(CURVES, run)
            self.assertEqual(sum(words in warning for warning in source.warnings), 1, source.warnings)
            self.assertIsNone(source.places)
            self.assertEqual(len(source.answers[1]), 8)

    def test_a_curve_without_a_plateau_says_so(self):
        def flatten(folder):
            with h5py.File(folder / "results.h5", "a") as file:
                for name in ("plateau_from_g_per_m2", "plateau_to_g_per_m2", "beyond_plateau_g_per_m2"):
                    file[f"density_plateaus/{name}"][:] = np.nan
                n = len(file["density_places/place"])
                del file["density_places/place"]
                file["density_places/place"] = [""] * n

        rows = dict(self.study(CURVES, flatten).places["rows"])
        self.assertEqual(set(rows["plateau from (side A)"]), {"no plateau"})
        self.assertEqual(set(rows["plateau ends in (side A)"]), {"\N{EN DASH}"})
        self.assertEqual(set(rows["0.45 g/m² (side A)"]), {"no plateau (20 %)"})


class SettingsOfScans(StudyCase):
    def test_a_card_shows_the_contact_where_scans_differ_and_only_there(self):
        mixed = page_study.sections(self.study(Recipe(contacts={"side B": "elastic"})))["scans"]
        self.assertIn(("contact", "saturated"), mixed[0]["rows"])
        self.assertIn(("contact", "elastic"), mixed[3]["rows"])
        alike = page_study.sections(self.study())["scans"]
        self.assertFalse(any(name == "contact" for scan in alike for name, _ in scan["rows"]))

    def test_the_bound_of_the_area_is_said_of_saturated_contacts_only_where_some_are_elastic(self):
        mixed = draw(self.study(Recipe(contacts={"side B": "elastic"})))["contact_area"]
        self.assertIn("no solution of a saturated contact may lie below it", mixed.caption)
        self.assertIn("no solution may lie below it", self.default_figures["contact_area"].caption)

    def test_chains_of_treatment_are_named_by_groups(self):
        def treat(folder):
            with h5py.File(folder / "results.h5", "a") as file:
                for key in ("0002", "0003"):
                    file[f"scans/{key}"].attrs["treatment"] = [f"level=plane: tilt {key}"]

        names = [names for _, names in page_study.sections(self.study(change=treat))["treatments"]]
        self.assertEqual(names, [["side A"], ["side B"]])


class OfOneScan(unittest.TestCase):
    def single(self, **changes):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        path = Path(folder.name) / "one.h5"
        recipe = {"shape": (20, 20), "pressures": (5e6, 10e6), "densities": (0.9, 0.45), "density_curves": True}
        write_single(path, Recipe(**{**recipe, **changes}))
        source = build.open_result(path)
        self.addCleanup(source.file.close)
        style.apply()
        return source

    def test_the_curves_are_those_of_the_file_with_the_dry_friction_of_its_states(self):
        drawn = density_friction.of_single(self.single())
        rows = rows_of(drawn.data[""])
        expected = density_curves(Recipe(groups=("",), pressures=(5e6, 10e6)))
        self.assertEqual(
            [float(row["friction_lubricated"]) for row in rows], [row["friction_lubricated"] for row in expected]
        )
        self.assertEqual({row["friction_dry"] for row in rows}, {f"{0.3:.17g}"})
        self.assertNotIn("Means over", drawn.caption)
        dots = [item for item in drawn.figure.panels[0].items if isinstance(item, chart.Curve) and item.marker == "o"]
        found = sorted(zip(np.concatenate([dot.x for dot in dots]), np.concatenate([dot.y for dot in dots])))
        states = self.single().states
        self.assertEqual(found, sorted((state.density, state.facts["friction_lubricated"]) for state in states))

    def test_both_figures_come_first_and_the_answers_are_said(self):
        source = self.single()
        drawn = build.single_figures(source)
        names = []
        for figure in (next(drawn), next(drawn)):
            names.append(figure.name)
        self.assertEqual(names, ["against_pressure", NAME])
        self.assertEqual(source.answers[0], [f"At {p} MPa: full from 0.1 g/m²" for p in (5, 10)])

    def test_states_are_named_by_pressure_and_density(self):
        header = page_single.sections(self.single())["results"]["tables"][0]["header"]
        self.assertEqual(header, ["", *(f"{p} MPa, {d} g/m²" for p in (5, 10) for d in (0.9, 0.45))])

    def test_of_several_states_the_range_stands_first(self):
        found = dict(page_single.sections(self.single())["highlights"])
        self.assertEqual(found["pressure"], "5 MPa to 10 MPa")
        self.assertEqual(found["lubricant"], "0.45 g/m² to 0.9 g/m²")
        self.assertEqual(found["friction dry"], "0.3")

    def test_friction_against_pressure_is_drawn_dry_and_by_rising_density(self):
        drawn = single_curves.draw(self.single())
        self.assertEqual([item.label for item in drawn.figure.panels[1].items], ["dry", "0.45 g/m²", "0.9 g/m²"])

    def test_a_file_without_curves_is_drawn_without(self):
        source = self.single(density_curves=False)
        self.assertIsNone(density_friction.of_single(source))
        self.assertEqual((source.answers, source.warnings), (([], []), []))


class AreasOfFriction(StudyCase):
    """A page pairs friction with the area that it was computed with, under one name."""

    def counted(self):
        def change(folder):
            with h5py.File(folder / "results.h5", "a") as file:
                file.attrs["area"] = "pixels"
                values = 1.25 * file["table/contact_area_fraction"][()]
                del file["table/contact_area_fraction_pixels"]
                file["table/contact_area_fraction_pixels"] = values

        return self.study(change=change)

    def test_of_a_study_with_pixels_is_the_counted_contact_in_answer_and_figure(self):
        source = self.counted()
        answer = page_study.answer(source)
        names = [name for name, _ in answer["rows"]]
        self.assertIn("counted contact (side A)", names)
        self.assertFalse(any("contact area" in name for name in names))
        self.assertIn(areas.MEANINGS[areas.PIXELS], answer["caption"])
        figure = draw(source)["contact_area"]
        self.assertEqual(figure.title, "Counted contact against pressure")
        self.assertIn("Counted contact (pixels that touch)", figure.caption)
        self.assertNotIn("Area counted", figure.caption)
        drawn = {float(row["contact_area_fraction_pixels"]) for row in rows_of(figure.data[""])}
        self.assertTrue(drawn <= set(source.table["contact_area_fraction_pixels"]))

    def test_of_a_study_with_the_corrected_area_it_is_the_contact_area(self):
        answer = page_study.answer(self.default)
        self.assertIn("contact area (side A)", [name for name, _ in answer["rows"]])
        self.assertIn("Contact area (perimeter-corrected)", self.default_figures["contact_area"].caption)

    def test_of_one_scan_the_answer_has_the_area_of_its_friction(self):
        class State:
            def __init__(self, area):
                self.key, self.pressure, self.pressure_text, self.density, self.visit = "0000", 5e6, "5 MPa", 0.9, 0
                self.facts = {"contact_area_fraction": 0.02, "contact_area_fraction_pixels": 0.025,
                              "friction_dry": 0.3, "friction_lubricated": 0.2, "area": area}

        for area, name, text in (("pixels", "counted contact", "2.5 %"), ("corrected", "contact area", "2 %")):
            found = page_single.answer([State(area)])
            self.assertEqual(found["rows"][0], (name, [text]))
            self.assertIn(f"friction on the {name}", found["caption"])


if __name__ == "__main__":
    unittest.main()
