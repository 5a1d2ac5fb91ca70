"""Figures of `tabor ehl` results show what the file holds."""

import csv
import io
import tempfile
import unittest
from pathlib import Path

import numpy as np

from synthetic_file import new_file
from tabor_report import build, style
from tabor_report.cli import _parser
from tabor_report.figures import ehl_impact


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

    def drawings(self, make):
        path = self.folder / "result.h5"
        make(path)
        source = build.open_result(path)
        self.addCleanup(source.file.close)
        drawn = {drawing.name: drawing for drawing in build.ehl_figures(source)}
        for drawing in drawn.values():
            style.close(drawing.figure)
        return drawn

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
        top, bottom = drawn["line_wear"].figure.axes
        self.assertEqual(bottom.get_xlabel(), "time (h)")
        self.assertGreater(*drawn["line_track"].figure.axes[0].get_ylim())

    def test_the_page_of_an_impact_is_written(self):
        path = self.folder / "impact.h5"
        impact_file(path)
        source = build.open_result(path)
        with source.file:
            options = _parser().parse_args([str(path)])
            files = build.build(source, self.folder / "out", options, "tabor report impact.h5")
        text = files[-1].read_text("utf-8")
        self.assertIn("restitution", text)
        self.assertIn("ball.radius", text)


if __name__ == "__main__":
    unittest.main()
