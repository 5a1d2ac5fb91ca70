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
from tabor_report import build, page, page_single, page_study, style
from tabor_report.figures import density_friction, single_curves

NAME = "friction_against_density"
CURVES = Recipe(density_curves=True)


class OfAStudy(StudyCase):
    def test_plotted_means_and_bands_are_those_of_the_file(self):
        source = self.study(CURVES)
        drawn = density_friction.of_study(source)
        panel = drawn.figure.axes[0]
        expected = [row for row in average_curves(density_curves(CURVES)) if row["group"] == "side A"]
        for curve, pressure in zip(panel.get_lines()[:8:2], CURVES.pressures):
            means = [row["friction_lubricated_mean"] for row in expected if row["mean_pressure_Pa"] == pressure]
            np.testing.assert_array_equal(curve.get_xdata(), DOSES)
            np.testing.assert_array_equal(curve.get_ydata(), means)
        band = panel.collections[0].get_paths()[0].vertices
        first = expected[0]
        low = first["friction_lubricated_mean"] - first["friction_lubricated_std"]
        self.assertAlmostEqual(band[band[:, 0] == DOSES[0], 1].min(), low, places=14)
        self.assertEqual(len(rows_of(drawn.data[""])), 2 * 4 * len(DOSES))
        self.assertIn("n = 2", panel.get_title(loc="left"))
        style.close(drawn.figure)

    def test_dry_friction_and_the_densities_asked_for_are_marked(self):
        drawn = density_friction.of_study(self.study(CURVES))
        lines = [line for line in drawn.figure.axes[0].get_lines() if len(line.get_xdata()) == 2]
        upright = sorted(line.get_xdata()[0] for line in lines if line.get_xdata()[0] == line.get_xdata()[1])
        self.assertEqual(upright, list(CURVES.densities))
        level = sorted(line.get_ydata()[0] for line in lines if line.get_ydata()[0] == line.get_ydata()[1])
        series = density_friction.series_of.dry(self.study(CURVES), "side A")
        np.testing.assert_allclose(level, sorted(series.mean))
        style.close(drawn.figure)

    def test_one_scan_has_no_band_and_says_so(self):
        drawn = density_friction.of_study(self.study(Recipe(groups=("one",), density_curves=True)))
        self.assertIn("n = 1", drawn.caption)
        self.assertTrue(all(row["spread"] == "nan" for row in rows_of(drawn.data[""])))
        style.close(drawn.figure)

    def test_of_many_groups_six_are_drawn_and_all_are_in_the_table(self):
        groups = tuple(f"side {letter}" for letter in "ABCDEFGH")
        drawn = density_friction.of_study(self.study(Recipe(groups, (2e6, 5e6), density_curves=True)))
        self.assertEqual(sum(panel.get_visible() for panel in drawn.figure.axes), 6)
        self.assertEqual({row["group"] for row in rows_of(drawn.data[""])}, set(groups))
        self.assertIn("2 more groups", drawn.caption)
        style.close(drawn.figure)

    def test_the_logarithmic_axis_has_several_labels_whatever_it_spans(self):
        for low, high in ((0.001, 10), (0.001, 0.05), (0.4, 0.9), (0.41, 0.46), (0.45, 0.450001)):
            found = style.round_numbers(low, high)
            self.assertGreaterEqual(len(found), 2, (low, high))
            self.assertLessEqual(len(found), 9, (low, high))
            self.assertTrue(all(low * 0.99 <= value <= high * 1.01 for value in found), found)

    def test_the_drawn_axis_carries_them(self):
        drawn = density_friction.of_study(self.study(CURVES))
        drawn.figure.canvas.draw()
        labels = [label.get_text() for label in drawn.figure.axes[0].get_xticklabels()]
        self.assertEqual(labels, ["0.001", "0.01", "0.1", "1", "10"])
        style.close(drawn.figure)

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
        left, right = drawn.figure.axes[:2]
        self.assertEqual(right.get_lines()[0].get_color(), left.get_lines()[2].get_color())
        style.close(drawn.figure)


class Answers(StudyCase):
    def test_of_each_group_the_lowest_and_highest_pressure_are_said_first(self):
        short, every = self.study(CURVES).answers
        ends = [f"{group} at {p} MPa: full from 0.1 g/m²" for group in ("side A", "side B") for p in (2, 15)]
        self.assertEqual(short, ends)
        self.assertEqual(len(every), 8)

    def test_they_stand_above_the_warnings_and_figures_above_the_scans(self):
        source = self.study(Recipe(density_curves=True, warnings={0: "5 spikes"}))
        html = page.render(source, [], "tabor report x")
        places = [html.index(text) for text in ('id="answers"', 'id="warnings"', 'id="scans"')]
        self.assertEqual(places, sorted(places))
        self.assertIn("All 8 sentences", html)

    def test_without_them_the_page_has_no_such_section(self):
        self.assertNotIn('id="answers"', page.render(self.default, [], "tabor report x"))

    def test_sentences_that_match_no_curve_are_all_said(self):
        def add(folder):
            with h5py.File(folder / "results.h5", "a") as file:
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
        self.assertIn("fig09_lubricated_friction", figures)

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
        style.close(drawn.figure)

    def test_rows_that_are_all_spoiled_leave_no_figure(self):
        def spoil(file):
            file["density_averages/friction_lubricated_mean"][:] = np.nan

        self.assertNotIn(NAME, draw(self.change(spoil)))


class SettingsOfScans(StudyCase):
    def test_a_card_shows_the_contact_where_scans_differ_and_only_there(self):
        mixed = page_study.sections(self.study(Recipe(contacts={"side B": "elastic"})))["scans"]
        self.assertIn(("contact", "saturated"), mixed[0]["rows"])
        self.assertIn(("contact", "elastic"), mixed[3]["rows"])
        alike = page_study.sections(self.study())["scans"]
        self.assertFalse(any(name == "contact" for scan in alike for name, _ in scan["rows"]))

    def test_the_bound_of_the_area_is_said_of_saturated_contacts_only_where_some_are_elastic(self):
        mixed = draw(self.study(Recipe(contacts={"side B": "elastic"})))["fig10_contact_area"]
        self.assertIn("no solution of a saturated contact may lie below it", mixed.caption)
        self.assertIn("no solution may lie below it", self.default_figures["fig10_contact_area"].caption)

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
        style.close(drawn.figure)

    def test_both_figures_come_first_and_the_answers_are_said(self):
        source = self.single()
        drawn = build.single_figures(source)
        names = []
        for figure in (next(drawn), next(drawn)):
            names.append(figure.name)
            style.close(figure.figure)
        self.assertEqual(names, ["against_pressure", NAME])
        self.assertEqual(source.answers[0], [f"At {p} MPa: full from 0.1 g/m²" for p in (5, 10)])

    def test_states_are_named_by_pressure_and_density(self):
        header = page_single.sections(self.single())["results"]["tables"][0]["header"]
        self.assertEqual(header, ["", *(f"{p} MPa, {d} g/m²" for p in (5, 10) for d in (0.9, 0.45))])

    def test_of_several_states_the_range_stands_first(self):
        found = dict(page_single.sections(self.single())["highlights"])
        self.assertEqual(found["mean pressures"], "5 MPa to 10 MPa")
        self.assertEqual(found["lubricant densities"], "0.45 g/m² to 0.9 g/m²")
        self.assertEqual(found["dry friction"], "0.3")

    def test_friction_against_pressure_is_drawn_dry_and_by_rising_density(self):
        drawn = single_curves.draw(self.single())
        labels = [line.get_label() for line in drawn.figure.axes[1].get_lines()]
        self.assertEqual(labels, ["dry", "0.45 g/m²", "0.9 g/m²"])
        style.close(drawn.figure)

    def test_a_file_without_curves_is_drawn_without(self):
        source = self.single(density_curves=False)
        self.assertIsNone(density_friction.of_single(source))
        self.assertEqual((source.answers, source.warnings), (([], []), []))


if __name__ == "__main__":
    unittest.main()
