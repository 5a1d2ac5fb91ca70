"""Figures of `tabor ehl` results show what the file holds."""

import csv
import io
import re
import tempfile
import types
import unittest
from pathlib import Path

import h5py
import numpy as np

from synthetic_file import new_file
from tabor.report import build, page, page_ehl, style
from tabor.report.figures import ehl_curves, ehl_impact, ehl_point, ehl_stribeck


def impact_file(path):
    """An impact of 100 us whose force is a half sine and whose film is a parabola."""
    time = np.linspace(0, 1e-4, 51)
    radius = np.linspace(0, 1e-4, 21)
    force = 10 * np.sin(np.pi * time / 1e-4)
    with new_file(path) as file:
        file.attrs["kind"] = "ehl impact"
        file.attrs["config_toml"] = '[ball]\nradius = "1 mm"\n'
        result = file.create_group("result")
        result.attrs.update(
            {"converged": 1, "turning_time_s": 5e-5, "restitution": 0.9, "primary_center_pressure_Pa": 1e9}
        )
        file.create_group("dry").attrs.update({"begin_s": 1e-5, "impact_time_s": 8e-5, "max_force_N": 12.0})
        curves = {
            "time": time,
            "force": force,
            "central_pressure": 1e8 * force,
            "central_film": 2e-6 + 0 * time,
            "min_film": 1e-6 + 0 * time,
            "film_radius": 1e-4 + 0 * time,
        }
        for name, values in curves.items():
            file[f"history/{name}"] = values
        file["profiles/time"], file["profiles/radius"] = time, radius
        file["profiles/pressure"] = 1e8 * force[:, None] * (1 - (radius / 1e-4) ** 2)[None, :]
        file["profiles/film"] = 1e-6 + 0 * time[:, None] + (radius**2 * 100)[None, :]


def line_file(path):
    """A contact of 100 um half width under 25 MPa, its track worn evenly for 8 h."""
    x = np.linspace(-5e-4, 2e-4, 701)
    dry = 25e6 * np.sqrt(np.clip(1 - (x / 1e-4) ** 2, 0, None))
    time = np.linspace(0, 8 * 3600, 9)
    with new_file(path) as file:
        file.attrs["kind"] = "ehl line"
        file.attrs["config_toml"] = '[cylinder]\nradius = "2.5 mm"\n'
        file.create_group("result").attrs.update({"converged": 1, "min_film_m": 83e-9})
        curves = {
            "profile": {"x": x, "pressure": 0.99 * dry, "film": 1e-7 + x**2 / 5e-3, "hertz_pressure": dry},
            "wear": {
                "time": time,
                "distance": 0.0158 * time,
                "mean_depth": 1e-10 * time,
                "max_depth": 2e-10 * time,
                "min_film": 83e-9 + 0 * time,
                "friction": 0.003 + 0 * time,
                "track": np.linspace(0, 1.5e-2, 50),
                "depth": np.full(50, 2.9e-6),
            },
        }
        for group, values in curves.items():
            for name, column in values.items():
                file[f"{group}/{name}"] = column


def point_file(path):
    """A parabolic film of 50 nm in a contact of 50 um under 1 GPa; half of it touches on x < 0."""
    x, y = np.linspace(-2e-4, 1e-4, 61), np.linspace(-1e-4, 1e-4, 41)
    radius = np.hypot(x[None, :], y[:, None])
    film = 5e-8 + 10 * np.clip(radius - 5e-5, 0, None) ** 2
    dry = 1e9 * np.sqrt(np.clip(1 - (radius / 5e-5) ** 2, 0, None))
    touches = (radius < 5e-5) & (x[None, :] < 0)
    with new_file(path) as file:
        file.attrs["kind"] = "ehl point"
        file.attrs["config_toml"] = '[roughness.bump]\nheight = "1 um"\nplace = ["1 um", "2 um"]\n'
        file.create_group("result").attrs.update({"converged": 1, "central_film_m": 5e-8})
        file.create_group("result/dry").attrs["friction_coefficient"] = 0.125
        file.attrs["warnings"] = ["nodes are far apart"]
        contact = {
            "x": x,
            "y": y,
            "film": np.where(touches, 0, film),
            "pressure": np.where(touches, 0, dry),
            "contact_pressure": np.where(touches, dry, 0),
            "plastic_depth": np.where(touches, 1e-9, 0),
            "roughness": 1e-9 * np.sin(1e5 * x)[None, :] + 0 * radius,
        }
        for name, values in contact.items():
            file[f"contact/{name}"] = values
        for group, place, cut in (("along", x, (20, slice(None))), ("across", y, (slice(None), 40))):
            for name in ("film", "pressure", "contact_pressure"):
                file[f"{group}/{name}"] = contact[name][cut]
            file[f"{group}/place"], file[f"{group}/hertz_pressure"] = place, dry[cut]
            file[f"{group}/smooth_film"], file[f"{group}/smooth_pressure"] = film[cut], dry[cut]
        for name in ("time", "central_film", "min_film", "max_pressure"):
            file[f"history/{name}"] = [0.0, 1.0]
        file["slice_plane/level"] = [0, 5e-8, 1e-7]
        file["slice_plane/share"] = [0.5, 1.0, 1.0]
        file["slice_plane/smooth_share"] = [0.0, 1.0, 1.0]


def stribeck_file(path):
    """Two surfaces at three speeds, the fastest first."""
    with new_file(path) as file:
        file.attrs["kind"] = "ehl point sweep"
        file.attrs["config_toml"] = '[motion]\nspeed = "7 m/s"\n'
        file.create_group("sweep").attrs["axes"] = ["roughness.kind", "motion.speed"]
        file["sweep/axes/roughness.kind"] = [0.0, 1.0]
        file["sweep/axes/roughness.kind"].attrs.update({"words": ["lapped", "polished"], "long_name": "kind"})
        file["sweep/axes/motion.speed"] = [10.0, 1.0, 0.1]
        file["sweep/axes/motion.speed"].attrs.update({"units": "m/s", "long_name": "motion.speed"})
        file["sweep/shape"] = [2, 3]
        file["sweep/warnings"] = np.array(["thin\nhot", "thin", "", "", "", ""], dtype=h5py.string_dtype())
        columns = {
            "friction_coefficient": [0.08, 0.09, 0.12, 0.08, 0.07, 0.06],
            "friction_fluid": [0.08, 0.07, 0.04, 0.08, 0.07, 0.06],
            "friction_solid": [0.0, 0.02, 0.08, 0.0, 0.0, 0.0],
            "central_film_m": [8e-7, 1.7e-7, 4e-8, 8e-7, 1.7e-7, 4e-8],
            "solid_contact_fraction": [0, 0.1, 0.4, 0, 0, 0],
            "plastic_fraction": [0, 0.08, 0.35, 0, 0, 0],
            "converged": [1, 1, 0, 1, 1, 1],
        }
        for name, values in columns.items():
            file[f"sweep/{name}"] = np.array(values, dtype=float)
            unit = "m" if name.endswith("_m") else ""
            long_name = name.removesuffix("_m").replace("_", " ")
            file[f"sweep/{name}"].attrs.update({"units": unit, "long_name": long_name})


def many_file(path):
    """Nine surfaces at two speeds; the friction of the first case is not known."""
    with new_file(path) as file:
        file.attrs["kind"] = "ehl point sweep"
        file.attrs["config_toml"] = ""
        file.attrs["warnings"] = ["no friction is known (1 of 18 cases: seed 1 / 0.1 m/s) [boundary-friction]"]
        file.create_group("sweep").attrs["axes"] = ["roughness.seed", "motion.speed"]
        file["sweep/axes/roughness.seed"] = np.arange(1.0, 10.0)
        file["sweep/axes/motion.speed"] = [0.1, 1.0]
        for key in ("roughness.seed", "motion.speed"):
            file[f"sweep/axes/{key}"].attrs["long_name"] = key
        file["sweep/axes/roughness.seed"].attrs["words"] = [f"seed {n}" for n in range(1, 10)]
        file["sweep/shape"] = [9, 2]
        for name, value in (("warnings", "no friction is known"), ("warning_codes", "boundary-friction")):
            file[f"sweep/{name}"] = np.array([value] + 17 * [""], dtype=h5py.string_dtype())
        for name in ehl_stribeck._Curve.NAMES:
            file[f"sweep/{name}"] = np.linspace(0.1, 0.2, 18)
            file[f"sweep/{name}"].attrs.update({"units": "", "long_name": name})
        file["sweep/friction_coefficient"][0] = np.nan
        file["sweep/converged"] = np.ones(18)


def sweep_file(path):
    with new_file(path) as file:
        file.attrs["kind"] = "ehl impact sweep"
        file.create_group("sweep").attrs["axes"] = ["ball.speed", "ball.mass"]
        file["sweep/axes/ball.speed"] = [0.1, 1.0, 10.0]
        file["sweep/axes/ball.mass"] = [1.0, 2.0]
        file["sweep/shape"] = [3, 2]
        file["sweep/restitution"] = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6]
        file["sweep/restitution"].attrs.update({"units": "", "long_name": "restitution"})


class Ehl(unittest.TestCase):
    def setUp(self):
        style.apply()
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def drawings(self, make, figures=build.ehl_figures, ending=""):
        path = self.folder / f"{make.__name__}{ending}.h5"
        make(path)
        source = build.open_result(path)
        self.addCleanup(source.file.close)
        drawn = {drawing.name: drawing for drawing in figures(source)}
        for drawing in drawn.values():
            if drawing.is_declared:
                drawing.close()
            else:
                style.close(drawing.figure)
        return drawn

    def curves(self, make):
        """Every column of a sweep against what was varied, by name."""
        return self.drawings(make, ehl_curves.sweep, "_curves")

    def page(self, make):
        """The text of report.html without its figures."""
        path = self.folder / "page.h5"
        make(path)
        source = build.open_result(path)
        with source.file:
            html = page.render(source, [], "tabor report page.h5")
        body = re.sub("<[^>]*>", " ", html[html.index("<body>") :])
        return " ".join(body.split())

    def rows(self, drawing):
        return list(csv.DictReader(io.StringIO(drawing.data[""])))

    def test_an_impact_has_its_five_pictures(self):
        drawn = self.drawings(impact_file)
        self.assertEqual(
            set(drawn),
            {"impact_force", "impact_central_pressure", "impact_film", "impact_profiles", "impact_film_map"},
        )
        rows = self.rows(drawn["impact_force"])
        self.assertAlmostEqual(float(rows[25]["force_N"]), 10)
        self.assertEqual(float(rows[0]["dry_force_N"]), 0)

    def test_the_dry_ball_carries_most_in_the_middle(self):
        dry = {"begin_s": 1e-5, "impact_time_s": 8e-5, "max_force_N": 12.0}
        self.assertAlmostEqual(float(ehl_impact.dry_force(dry, np.array([5e-5]))[0]), 12)
        np.testing.assert_array_equal(ehl_impact.dry_force(dry, np.array([0, 1e-5, 1e-4])), 0)

    def test_captions_say_what_the_numbers_say(self):
        drawn = self.drawings(impact_file)
        self.assertIn("thinnest, 1 µm, after 0 µs, in a ring", drawn["impact_film"].caption)
        self.assertIn("2 µm thick in the centre", drawn["impact_film"].caption)
        self.assertNotIn("spike", drawn["impact_central_pressure"].caption)  # its pressure has one peak only
        # The synthetic film is thinnest in the middle, not before the outlet.
        line = self.drawings(line_file)["line_profile"].caption
        self.assertIn("thinnest, 83 nm, at 0 µm; its pressure ends at 99 µm", line)  # the number of the result, between nodes

    def test_a_roller_film_that_closes_before_the_force_is_largest_is_said_so(self):
        history = {"time": np.array([0, 1e-3, 2e-3]), "min_film": np.array([2.0, 1.0, 3.0])}
        history["force"] = np.array([0, 1.0, 2.0])
        source = types.SimpleNamespace(scalars={})
        caption = ehl_curves._squeeze_caption(source, history)
        self.assertEqual(caption, "The force is largest after 2 ms, the film thinnest after 1 ms.")
        history["force"] = np.array([2.0, 1.0, 0])
        self.assertIn("goes on closing", ehl_curves._squeeze_caption(source, history))
        source.scalars = {"time_max_force_s": 1.9e-3, "time_min_film_s": 1.1e-3}  # of the result, between steps
        caption = ehl_curves._squeeze_caption(source, history)
        self.assertEqual(caption, "The force is largest after 1.9 ms, the film thinnest after 1.1 ms.")

    def test_no_two_of_many_curves_look_alike(self):
        for n in (1, 7, 8, 9, 30):
            looks = style.curve_styles(n)
            self.assertEqual(len({look["colour"] for look in looks}), n)
        drawn = {**self.drawings(many_file), **self.curves(many_file)}
        for name in ("stribeck", "sweep_friction_coefficient"):
            self.assertEqual(len({curve.colour for curve in drawn[name].figure.panels[0].items if curve.dash == "-"}), 9)

    def test_a_sweep_marks_the_cases_of_its_warnings_and_leaves_gaps(self):
        text = self.page(many_file)
        self.assertEqual(text.count("1 of 18 cases"), 1)
        self.assertIn("warnings", text)
        drawn = {**self.drawings(many_file), **self.curves(many_file)}
        self.assertIn("Gaps", drawn["stribeck"].caption)
        rows = self.rows(drawn["sweep_friction_coefficient"])
        self.assertEqual([row["warnings"] for row in rows[:2]], ["boundary-friction", ""])
        self.assertEqual(rows[0]["friction_coefficient"], "nan")

    def test_a_sweep_keeps_each_value_at_its_place(self):
        rows = self.rows(self.drawings(sweep_file)["sweep_restitution"])
        self.assertEqual(len(rows), 6)
        found = {(row["ball.speed"], row["ball.mass"]): float(row["restitution"]) for row in rows}
        self.assertEqual(found[("10", "1")], 0.5)

    def test_a_line_contact_shows_its_film_before_hertz_and_its_wear(self):
        drawn = self.drawings(line_file)
        self.assertEqual(set(drawn), {"line_profile", "line_wear", "line_track"})
        rows = self.rows(drawn["line_profile"])
        self.assertAlmostEqual(float(rows[500]["hertz_pressure_Pa"]) / 25e6, 1)
        self.assertAlmostEqual(float(rows[500]["pressure_Pa"]) / 25e6, 0.99)
        self.assertAlmostEqual(float(self.rows(drawn["line_wear"])[-1]["mean_depth_m"]) / 2.88e-6, 1)
        self.assertEqual(drawn["line_wear"].figure.panels[1].x.label, "time (h)")
        track = drawn["line_track"].figure.panels[0].y
        self.assertGreater(track.low, track.high)

    def test_a_point_contact_has_its_maps_and_curves(self):
        drawn = self.drawings(point_file)
        self.assertEqual(
            set(drawn),
            {"point_along", "point_across", "point_film", "point_pressure", "point_plastic", "point_roughness",
             "point_slice_plane", "point_history"},
        )
        rows = self.rows(drawn["point_along"])
        self.assertAlmostEqual(float(rows[40]["smooth_film_m"]), 5e-8)
        self.assertEqual(float(rows[36]["contact_pressure_Pa"]), float(rows[36]["hertz_pressure_Pa"]))
        self.assertIn("pressure of solids", drawn["point_along"].figure.labelled())
        self.assertEqual(float(self.rows(drawn["point_slice_plane"])[0]["share"]), 0.5)
        # Of liquid and solids together the pressure is that of Hertz on either side.
        self.assertAlmostEqual(drawn["point_pressure"].figure.axes[0].images[0].get_array().max(), 1.0)

    def test_thick_films_show_no_fringes_and_none_is_dark(self):
        colours = ehl_point.interference(np.full((3, 3), 0.0))
        np.testing.assert_allclose(colours, 0)
        np.testing.assert_allclose(ehl_point.interference(np.full((3, 3), 2e-5)), 0.5)
        half = ehl_point.LIGHT[1] / (4 * ehl_point.REFRACTION)  # of a fringe in green light
        self.assertGreater(ehl_point.interference(np.full((3, 3), half))[1, 1, 1], 0.9)

    def test_a_stribeck_curve_goes_from_slow_to_fast(self):
        rows = self.rows(self.drawings(stribeck_file)["stribeck"])
        self.assertEqual([float(row["motion.speed (m/s)"]) for row in rows], [0.1, 1, 10])
        self.assertEqual([float(row["lapped friction_coefficient"]) for row in rows], [0.12, 0.09, 0.08])
        self.assertEqual([row["lapped converged"] for row in rows], ["0", "1", "1"])
        self.assertEqual(float(rows[0]["polished friction_solid"]), 0)

    def test_a_stribeck_curve_is_one_figure_of_panels_that_share_their_speeds(self):
        def with_ratio(path):
            stribeck_file(path)
            with h5py.File(path, "a") as file:
                film = file["sweep/central_film_m"][()]
                file["sweep/lambda_ratio"] = film / 50e-9
                file["sweep/lambda_ratio"].attrs.update({"units": "", "long_name": "lambda ratio"})

        for make, n_panels in ((stribeck_file, 3), (with_ratio, 4)):
            drawn = self.drawings(make)
            self.assertEqual(set(drawn), {"stribeck"})
            figure = drawn["stribeck"].figure
            self.assertEqual([len(row) for row in figure.rows], [1] * n_panels)
            self.assertEqual(len({(axis.low, axis.high) for axis in (figure.settled(panel, "x") for panel in figure.panels)}), 1)
        _, film, ratio, _ = figure.panels
        self.assertEqual(ratio.y.label, "film / rms roughness")
        np.testing.assert_allclose(ratio.items[0].y, film.items[0].y / 50)

    def test_a_stribeck_curve_names_the_shares_of_the_contact(self):
        figure = self.drawings(stribeck_file)["stribeck"].figure
        self.assertLessEqual({"lapped: touching", "polished: touching"}, set(figure.samples()))

    def test_quantities_of_a_case_have_the_signs_of_print(self):
        for text, shown in (("20 um", "20 µm"), ("2.8e-15 m^2/N", "2.8e-15 m²/N"), ("950 kg/m^3", "950 kg/m³"), ("barus", "barus")):
            self.assertEqual(page_ehl._readable(text), shown)

    def test_words_make_curves_not_maps(self):
        figure = self.curves(stribeck_file)["sweep_central_film_m"].figure
        self.assertEqual(set(figure.samples()), {"lapped", "polished"})

    def test_the_page_of_a_point_contact_shows_tables_in_tables(self):
        text = self.page(point_file)
        self.assertIn("roughness.bump.height", text)
        self.assertIn("1 µm, 2 µm", text)
        self.assertIn("dry: friction coefficient 0.125", text)
        self.assertIn("nodes are far apart", text)

    def test_a_page_without_a_scan_has_no_section_for_it_and_knows_no_certificate(self):
        for make in (point_file, stribeck_file):
            text = self.page(make)
            self.assertNotIn("Scans and treatment", text)
            self.assertNotIn("certificate", text)

    def test_the_page_of_a_sweep_says_what_was_varied_and_lists_its_cases(self):
        text = self.page(stribeck_file)
        self.assertIn("motion.speed 100 mm/s to 10 m/s, 3 values", text)
        self.assertNotIn("motion.speed 7 m/s", text)  # of the case: no result is of it
        self.assertIn("roughness.kind lapped, polished", text)
        self.assertIn("lapped 1 m/s 0.09 0.07 0.02 170 nm", text)
        self.assertIn("1 of 6 cases did not converge", text)
        self.assertIn("Rows in red did not converge.", text)
        self.assertIn("hot (1 of 6 cases) thin (2 of 6 cases)", text)

    def test_axes_of_a_sweep_have_units_that_read_well(self):
        (panel,) = self.curves(stribeck_file)["sweep_central_film_m"].figure.panels
        self.assertEqual((panel.x.label, panel.y.label), ("motion.speed (m/s)", "central film (nm)"))
        self.assertAlmostEqual(panel.items[0].y[0], 800)

    def test_lines_of_equal_film_only_where_the_film_is_smooth(self):
        def rough_file(path):
            point_file(path)
            with h5py.File(path, "a") as file:
                film = file["contact/film"][()]
                file["contact/film"][...] = film * (1 + (np.indices(film.shape).sum(axis=0) % 2))

        def lines(make):
            drawing = self.drawings(make)["point_film"]
            return len(drawing.figure.axes[0].collections), "equal film" in drawing.caption

        def smooth_file(path):
            point_file(path)
            with h5py.File(path, "a") as file:
                file["contact/film"][...] = np.maximum(file["contact/film"][()], 5e-8)

        n_lines, are_said = lines(smooth_file)
        self.assertGreater(n_lines, 0)
        self.assertTrue(are_said)
        self.assertEqual(lines(rough_file), (0, False))

    def test_a_mixed_line_contact_shows_what_asperities_carry(self):
        def mixed_file(path):
            line_file(path)
            with h5py.File(path, "a") as file:
                file["profile/asperity_pressure"] = 0.5 * file["profile/hertz_pressure"][()]

        drawing = self.drawings(mixed_file)["line_profile"]
        self.assertAlmostEqual(float(self.rows(drawing)[500]["asperity_pressure_Pa"]) / 12.5e6, 1)
        self.assertIn("pressure of asperities", drawing.figure.samples())

    def test_curves_have_the_units_of_their_file_else_those_of_their_names(self):
        path = self.folder / "line.h5"
        line_file(path)
        with h5py.File(path, "a") as file:
            file["wear/depth"].attrs["units"], file["wear/friction"].attrs["units"] = "um", "1"
        source = build.open_result(path)
        with source.file:
            self.assertEqual(list(source.table("wear", ("time", "friction", "depth", "none"))), ["time_s", "friction", "depth_um"])
            self.assertEqual(list(source.table("profile")), ["film_m", "hertz_pressure_Pa", "pressure_Pa", "x_m"])

    def test_the_page_of_an_impact_is_written(self):
        text = self.page(impact_file)
        self.assertIn("restitution", text)
        self.assertIn("ball.radius", text)
        self.assertIn("50 µs", text)


if __name__ == "__main__":
    unittest.main()
