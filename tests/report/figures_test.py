"""What the figures plot is what the study holds."""

import unittest

import numpy as np

from study_case import StudyCase, draw, rows_of
from synthetic_study import Recipe
from synthetic_tables import average, measured
from tabor.report import errors, friction_series
from tabor.report.example import choose
from tabor.report.figures import contact_area, dry_friction, mixed_friction


class Friction(StudyCase):
    def test_plotted_means_and_bars_are_the_averages(self):
        source = self.default
        averages = average(self.default_rows)
        plotted = rows_of(self.default_figures["lubricated_friction"].data[""])
        for line in averages:
            match = [
                row
                for row in plotted
                if row["series"] == "computed"
                and row["group"] == line["group"]
                and float(row["mean_pressure_Pa"]) == line["mean_pressure_Pa"]
                and float(row["lubricant_density_g_per_m2"]) == line["lubricant_density_g_per_m2"]
            ]
            self.assertEqual(len(match), 1)
            for column, key in (("friction", "mean"), ("std", "std"), ("sem", "sem")):
                self.assertEqual(float(match[0][column]), line[f"friction_lubricated_{key}"])
            self.assertEqual(float(match[0]["n"]), 2)

    def test_the_drawn_curve_carries_the_means(self):
        source = self.default
        drawn = dry_friction.draw(source)
        series = friction_series.dry(source, "side A")
        curve = drawn.figure.panels[0].items[0]
        np.testing.assert_array_equal(curve.x, series.pressure * 1e-6)
        np.testing.assert_array_equal(curve.y, series.mean)
        np.testing.assert_array_equal(curve.error, series.std)
        np.testing.assert_array_equal(curve.notes["n"], series.n)

    def test_one_scan_has_no_error_bar_and_says_so(self):
        source = self.study(Recipe(groups=("only",), experiment=False))
        series = friction_series.dry(source, "only")
        self.assertTrue(np.isnan(series.bar("std")).all())
        drawn = dry_friction.draw(source)
        self.assertFalse(drawn.figure.panels[0].items[0].has_bars)
        self.assertIn("n = 1", drawn.caption)

    def test_experiment_points_are_plotted_as_measured(self):
        source = self.default
        plotted = [
            row
            for row in rows_of(self.default_figures["dry_friction"].data[""])
            if row["series"] == "experiment"
        ]
        self.assertEqual(
            [float(row["friction"]) for row in plotted],
            [row["friction"] for row in measured(Recipe())],
        )

    def test_a_case_that_did_not_converge_is_drawn_by_itself_and_in_no_mean(self):
        source = self.study(Recipe(not_converged=((1, 2),)))
        series = friction_series.dry(source, "side A")
        loose = [row["friction_dry"] for row in self.rows if not row["converged"]]
        self.assertEqual((list(series.loose_pressure), list(series.loose_friction)), ([10e6], loose[:1]))
        self.assertEqual(list(series.n), [2, 2, 1, 2])
        self.assertEqual(len(friction_series.dry(source, "side B").loose_pressure), 0)
        self.assertIn("did not converge", draw(source)["dry_friction"].caption)

    def test_the_saturated_limit_is_drawn_only_if_there_is_one(self):
        self.assertAlmostEqual(dry_friction.limit(self.default), 70 / 240)
        self.assertIsNone(dry_friction.limit(self.study(Recipe(saturated=False))))


class FlowingOil(StudyCase):
    recipe = Recipe(pressures=(2e6, 5e6), speeds=(0.01, 0.1, 1.0), shape=(24, 32))

    def figure(self, recipe):
        self.source = self.study(recipe)
        return mixed_friction.draw(self.source)

    def test_a_study_without_flow_has_no_such_figure(self):
        self.assertNotIn("mixed_friction", self.default_figures)

    def test_plotted_stribeck_curve_is_the_averages(self):
        drawn = self.figure(self.recipe)
        self.assertEqual(drawn.title, "Stribeck curve")
        plotted = rows_of(drawn.data[""])
        averages = average(self.rows)
        self.assertEqual(len(plotted), len(averages))
        names = ("mean_pressure_Pa", "lubricant_density_g_per_m2", "sliding_speed_m_per_s")
        for line in averages:
            match = [
                row
                for row in plotted
                if row["group"] == line["group"] and all(float(row[name]) == line[name] for name in names)
            ]
            self.assertEqual(len(match), 1)
            for name in ("friction_mixed_mean", "friction_mixed_std", "fluid_load_share_sem"):
                self.assertEqual(float(match[0][name]), line[name])

    def test_at_one_speed_it_is_drawn_against_pressure(self):
        drawn = self.figure(Recipe(speeds=(0.1,), shape=(24, 32)))
        self.assertEqual(drawn.title, "Friction with oil that flows")
        self.assertIn("mean pressure", drawn.figure.panels[-1].x.label)

    def test_the_other_curves_hold_each_pressure_once(self):
        source = self.study(self.recipe)
        series = friction_series.lubricated(source, "side A", 0.9)
        self.assertEqual(list(series.pressure), [2e6, 5e6])
        plain = Recipe(pressures=(2e6, 5e6), shape=(24, 32))
        np.testing.assert_array_equal(
            series.mean, friction_series.lubricated(self.study(plain), "side A", 0.9).mean
        )

    def test_a_film_that_did_not_converge_is_ringed_and_named_and_no_warning_about_the_contact(self):
        recipe = Recipe(pressures=(2e6,), densities=(0.9,), speeds=(0.01, 1.0), unsteady=((1, 0),), shape=(24, 32))
        drawn = self.figure(recipe)
        self.assertIn("did not converge", drawn.caption)
        loose = [row for row in rows_of(drawn.data[""]) if row["series"] == "not converged"]
        self.assertEqual([float(row["sliding_speed_m_per_s"]) for row in loose], [0.01])
        self.assertEqual(len(friction_series.dry(self.source, "side A").loose_pressure), 0)
        self.assertTrue(any("0.01 m/s: film NOT CONVERGED" in text for text in self.source.warnings))


class Area(StudyCase):
    def test_every_scan_and_pressure_appears_once_whatever_the_densities(self):
        source = self.default
        plotted = rows_of(self.default_figures["contact_area"].data[""])
        self.assertEqual(len(plotted), 4 * 4)
        expected = {
            (row["scan"], row["mean_pressure_Pa"]): row["contact_area_fraction"] for row in self.default_rows
        }
        self.assertEqual(
            {
                (row["scan"], float(row["mean_pressure_Pa"])): float(row["contact_area_fraction"])
                for row in plotted
            },
            expected,
        )

    def test_the_mean_is_over_the_scans_at_that_pressure(self):
        states = [
            {"pressure": 1.0, "area": 0.1, "sure": True},
            {"pressure": 1.0, "area": 0.3, "sure": True},
            {"pressure": 2.0, "area": 0.5, "sure": True},
            {"pressure": 2.0, "area": 0.9, "sure": False},
        ]
        pressures, mean, n = contact_area.means(states)
        np.testing.assert_allclose(mean, [0.2, 0.5])
        self.assertEqual((list(pressures), list(n)), ([1.0, 2.0], [2, 1]))


class MapFigures(StudyCase):
    def test_a_study_draws_what_its_figures_are_named(self):
        self.assertEqual(
            list(self.default_figures),
            ["topography", "psd", "contact_map", "contact_area", "dry_friction", "lubricant_map", "contact_clusters", "lubricated_friction"],
        )

    def test_the_contact_map_is_the_stored_state(self):
        source = self.default
        state = source.scans[0].contacts()[2].state()
        text = self.default_figures["contact_map"].data[""].splitlines()
        values = np.array([[float(cell) for cell in line.split(",")[1:]] for line in text[1:]])
        np.testing.assert_array_equal(values, state > 0)

    def test_dry_and_wet_clusters_add_up_to_the_contact(self):
        source = self.default
        drawn = self.default_figures["contact_clusters"]
        wet, dry = (
            np.array(
                [[float(cell) for cell in line.split(",")[1:]] for line in drawn.data[key].splitlines()[1:]]
            )
            for key in ("", "_dry")
        )
        shown = choose(source.scans[0])
        np.testing.assert_array_equal(wet + dry, shown.window.of(shown.state) > 0)

    def test_the_section_lies_on_the_stored_maps(self):
        source = self.default
        shown = choose(source.scans[0])
        rows = rows_of(self.default_figures["lubricant_map"].data[""])
        gaps = np.array([float(row["counterface_m"]) - float(row["solid_m"]) for row in rows])
        stored = shown.gap[shown.row, shown.window.x0 : shown.window.x1]
        np.testing.assert_allclose(gaps, stored, atol=1e-12)

    def test_the_wanted_state_and_every_scan_can_be_asked_for(self):
        source = self.default
        self.assertIn("15 MPa", draw(source, pressure=14e6)["contact_map"].caption)
        self.assertIn("0.9 g/m²", draw(source, density=1.0)["contact_clusters"].caption)
        self.assertIn("contact_map_before_4", draw(source, all_scans=True))
        with self.assertRaises(errors.InputError):
            draw(source, scan=4)


if __name__ == "__main__":
    unittest.main()
