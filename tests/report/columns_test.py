"""What numbers are called and how they are shown: as the file says, else by their keys."""

import re
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

from study_case import StudyCase
from tabor.report import columns, page, units
from tabor.report.columns import Column

SOURCE = Path(__file__).resolve().parents[2] / "src/tabor"


def columns_of_the_program():
    """{(key, unit)} of the columns whose keys end in a unit."""
    texts = (path.read_text(encoding="utf-8") for path in (SOURCE / "cases").rglob("*.cpp"))
    found = (re.findall(r'\{"([\w.]+_(?:Pa|N|K|kg|s|m\d?))",\s*"([^"_]*)"', text) for text in texts)
    return {(key, units.signs(unit)) for pairs in found for key, unit in pairs}


def settings_of_the_program():
    """{(key, unit)}: a setting of each kind that has a unit, "x_per_Pa" of "1/Pa"."""
    text = (SOURCE / "record/parameter.cpp").read_text(encoding="utf-8")
    found = re.findall(r'\{dimension::\w+, "([^"]+)"\}', text)
    endings = [unit.removeprefix("1").replace("/", "_per_").replace(" ", "_").replace("^", "").lstrip("_") for unit in found]
    return {(f"x_{ending}", units.signs(unit)) for ending, unit in zip(endings, found)}


class ByKeys(unittest.TestCase):
    def test_keys_are_read_with_the_whole_unit_they_end_in(self):
        described = columns.Columns()
        for key, value, name, text in (
            ("sliding_speed_m_per_s", 0.05, "sliding speed", "50 mm/s"),
            ("viscosity_Pa_s", 0.225, "oil viscosity η", "0.225 Pa s"),
            ("pressure_viscosity_per_Pa", 2.2e-8, "pressure-viscosity coefficient α", "22 1/GPa"),
            ("max_force_N_per_m", 6.018e4, "max force", "60.18 kN/m"),
            ("deposited_volume_m3", 3e-15, "deposited volume", "3000 µm³"),
            ("oil_density_kg_per_m3", 900.0, "oil density", "900 kg/m³"),
            ("peak_memory_bytes", 3 * 2**20, "peak memory", "3 MiB"),
            ("load_N", 16.6, "load", "16.6 N"),
            ("lag_s", 5e-5, "lag", "50 µs"),
            ("converged", 1, "converged", "yes"),
            ("fluid_converged", 0, "fluid converged", "no"),
            ("newton_iterations", 77, "newton iterations", "77"),
            ("contact_area_fraction", 0.02134, "contact area", "2.134 %"),
            ("lubricant_density_g_per_m2", 0.45, "lubricant", "0.45 g/m²"),
            ("certificate", 2.13e-7, "certificate", "2.1×10⁻⁷"),
            ("speeds_m_per_s", [0.001, 1.0], "speeds", "1 mm/s, 1 m/s"),
            ("mean_gap_m", None, "mean gap", "–"),
            ("mean_gap_m", np.float64("nan"), "mean gap", "–"),
            ("area", "corrected", "area used for friction", "corrected"),
            ("lost_volume_m3_per_m2", 0.0, "lost volume", "0 m³/m²"),
            ("worn_volume_m3_per_m2", 3e-9, "worn volume", "3 nm³/nm²"),
            ("lubricant_density_kg_per_m2", 0.00045, "lubricant density", "0.45 g/m²"),
            ("contact_stiffness_Pa_per_m", 3e13, "contact stiffness", "30 MPa/µm"),
            ("fit_q_max_rad_per_m", 2e6, "fit q max", "2 rad/µm"),
            ("radial_c2d_m4", 2e-24, "radial c2d", "2 µm⁴"),
            ("roller_mass_kg_per_m", 0.25, "roller mass", "0.25 kg/m"),
            ("last_cutoff_per_m", 2e6, "last cutoff", "2 1/µm"),
        ):
            self.assertEqual((described[key].heading, described[key].show(value)), (name, text), key)

    def test_every_key_of_the_program_is_read_with_its_unit(self):
        known = columns_of_the_program()
        self.assertLess({("worn_volume_m3_per_m2", "m"), ("friction_force_N_per_m", "N/m"), ("volume_per_width_m2", "m²")}, known)
        for key, unit in known:
            expected = "m³/m²" if key.endswith("_m3_per_m2") else unit
            self.assertEqual(columns.Columns()[key].unit, expected, key)

    def test_every_unit_of_a_setting_is_cut_off_as_a_whole(self):
        known = settings_of_the_program()
        self.assertLess({("x_Pa_per_m", "Pa/m"), ("x_per_Pa", "1/Pa"), ("x_kg_per_m2", "kg/m²")}, known)
        for key, unit in known:
            self.assertEqual((columns.words(key), columns.Columns()[key].unit), ("x", unit), key)

    def test_films_under_load_have_the_words_of_their_program(self):
        described = columns.Columns(is_ehl=True)
        self.assertEqual([described[key].heading for key in ("max_pressure_Pa", "newton_iterations", "seconds")], ["largest pressure", "iterations", "seconds"])

    def test_a_column_of_plain_numbers_has_one_unit(self):
        described = columns.Columns()
        for key, values, title, text in (
            ("mean_pressure_Pa", [2e6, 15e6], "pressure (MPa)", "2"),
            ("lubricated_share", [0.25, np.nan], "wet share (%)", "25"),
            ("lubricant_density_g_per_m2", [0.45, 0.9], "lubricant (g/m²)", "0.45"),
            ("friction_dry", [0.3, 0.2], "friction dry", "0.3"),
            ("mean_gap_m", [np.nan], "mean gap (m)", "–"),
        ):
            factor, unit = described[key].scale(values)
            self.assertEqual((described[key].title(unit), described[key].number(values[0], factor)), (title, text))


class ByTheFile(unittest.TestCase):
    def described(self, write):
        with tempfile.TemporaryDirectory() as folder, h5py.File(Path(folder) / "a.h5", "w") as file:
            write(file)
            return columns.of_file(file)

    def test_attributes_of_a_column_come_before_its_key(self):
        def write(file):
            file["table/friction_dry"] = [0.3]
            file["table/friction_dry"].attrs.update({"heading": "dry coefficient", "units": "1", "style": "exponent"})
            file["averages/wet_m"] = [1e-6]
            file["averages/wet_m"].attrs["long_name"] = "depth of oil"

        described = self.described(write)
        self.assertEqual(described["friction_dry"], Column("friction_dry", "dry coefficient", "", "exponent"))
        self.assertEqual(described["wet_m"], Column("wet_m", "depth of oil", "m", "by_unit"))

    def test_a_table_of_columns_describes_numbers_of_states(self):
        def write(file):
            rows = [("volume", "oil held", "m^3", "by_unit"), ("share", "held", "", "percent"), ("mean_gap_m", "", "m", "")]
            for name, column in zip(("key", "heading", "units", "style"), zip(*rows)):
                file[f"columns/{name}"] = list(column)

        described = self.described(write)
        self.assertEqual((described["volume"].heading, described["volume"].show(2e-12)), ("oil held", "0.002 mm³"))
        self.assertEqual(described["share"].show(0.5), "50 %")
        self.assertEqual(described["mean_gap_m"].heading, "mean gap")

    def test_a_volume_over_an_area_is_a_length_only_under_a_heading_of_the_file(self):
        def write(file):
            rows = [("lost_volume_m3_per_m2", "", "m", ""), ("worn_volume_m3_per_m2", "worn", "m", "")]
            for name, column in zip(("key", "heading", "units", "style"), zip(*rows)):
                file[f"columns/{name}"] = list(column)

        described = self.described(write)
        shown = [(described[key].heading, described[key].show(0.0)) for key in ("lost_volume_m3_per_m2", "worn_volume_m3_per_m2")]
        self.assertEqual(shown, [("lost volume", "0 m³/m²"), ("worn", "0 m")])

    def test_what_is_damaged_is_as_if_it_were_not_there(self):
        def numbers(file):
            for name in ("key", "heading", "units", "style"):
                file[f"columns/{name}"] = [1.0, 2.0]

        def incomplete(file):
            file["columns/key"] = ["friction_dry"]

        def no_table(file):
            file["columns"], file["table"] = [1], [2]

        def odd_attributes(file):
            file["table/friction_dry"] = [0.3]
            file["table/friction_dry"].attrs.update({"heading": 7, "units": [1, 2]})

        for write in (numbers, incomplete, no_table, odd_attributes):
            described = self.described(write)
            self.assertEqual(described["friction_dry"].heading, "friction dry")


class OnThePage(StudyCase):
    def test_the_words_of_the_file_stand_on_the_page_of_a_study(self):
        def name(folder):
            with h5py.File(folder / "results.h5", "a") as file:
                file["table/friction_dry"].attrs["heading"] = "coefficient <b>without</b> oil"
                file["table/mean_gap_m"].attrs.update({"heading": "distance", "units": "m"})

        html = page.render(self.study(change=name), [], "tabor report x")
        self.assertIn("coefficient &lt;b&gt;without&lt;/b&gt; oil", html)
        self.assertRegex(html, r">distance \([nµ]m\)<")


if __name__ == "__main__":
    unittest.main()
