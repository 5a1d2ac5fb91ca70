"""Studies that are damaged, incomplete or hardly begun."""

import unittest

import h5py

from study_case import StudyCase, draw
from synthetic_study import Recipe
from tabor.report import friction_series, page, page_study, remarks


class Damaged(StudyCase):
    def test_a_missing_store_file_is_named_and_the_rest_is_drawn(self):
        def lose(folder):
            next((folder / "store").glob("film-*")).unlink()

        source = self.study(Recipe(groups=("one",)), lose)
        figures = draw(source)
        self.assertNotIn("contact_clusters", figures)
        self.assertIn("contact_map", figures)
        self.assertTrue(any("film-" in warning and "missing" in warning for warning in source.warnings))

    def test_a_study_without_its_store_still_draws_its_tables(self):
        def lose(folder):
            for path in (folder / "store").iterdir():
                path.unlink()

        self.assertEqual(
            list(draw(self.study(change=lose))),
            ["contact_area", "dry_friction", "lubricated_friction"],
        )

    def test_an_incomplete_study_says_how_much_is_there(self):
        source = self.study(Recipe(missing_cases=((0, 0), (1, 3))))
        self.assertTrue(any("28 of 32 cases" in warning for warning in source.warnings))
        self.assertEqual(list(friction_series.dry(source, "side A").n), [1, 2, 2, 1])

    def test_a_study_in_which_nothing_is_done_yet_is_no_error(self):
        def empty(folder):
            with h5py.File(folder / "results.h5", "a") as file:
                for name in ("table", "averages"):
                    for column in list(file[name]):
                        values = file[name][column][:0]
                        del file[name][column]
                        file[name][column] = values

        self.assertIn("psd", draw(self.study(change=empty)))

    def test_a_scan_that_is_not_treated_yet_is_listed_without_maps(self):
        def forget(folder):
            with h5py.File(folder / "results.h5", "a") as file:
                scan = file["scans/0000"]
                for name in ("nx", "ny", "pixel_x_m", "pixel_y_m", "rms_height_m", "rms_slope", "treatment"):
                    del scan.attrs[name]
                for name in ("surface", "psd"):
                    del scan[name]

        source = self.study(Recipe(groups=("one", "two")), forget)
        self.assertEqual("Contact map: before_2, 10 MPa", draw(source)["contact_map"].title)
        scans = page_study.sections(source)["scans"]
        self.assertEqual(scans[0]["rows"], [("file", "before_1.x3p"), ("surface", "not treated yet")])
        self.assertIn(("pixels", "128 × 96"), scans[1]["rows"])

    def test_warnings_of_the_table_are_said_once_and_in_place_of_warnings(self):
        lines = ["5 spikes (0.1 %) (16 of 32 cases: before_1.x3p) [spikes]", "spill-over 27 % [spill-over]"]

        def warn(folder):
            with h5py.File(folder / "results.h5", "a") as file:
                file.attrs["warnings"] = lines

        source = self.study(Recipe(warnings={0: "5 spikes (0.1 %)"}), warn)
        self.assertEqual(source.warnings, lines)

    def test_the_class_that_the_file_gives_a_warning_parts_doubts_from_information(self):
        lines = ["pixel replaced [override]", "40 % not fit [spill-over]", "spikes taken out [despiked]"]

        def warn(folder):
            with h5py.File(folder / "results.h5", "a") as file:
                file.attrs["warnings"], file.attrs["warning_classes"] = lines, ["information", "doubt", "information"]

        source = self.study(Recipe(), warn)
        self.assertEqual(remarks.parted(source.warnings), ([lines[1]], [lines[0], lines[2]]))
        html = page.render(source, [], "")
        doubts, notes = (html[html.index(f'id="{name}"') :].split("</section>")[0] for name in ("warnings", "notes"))
        self.assertEqual([doubts.count("<li>"), notes.count("<li>")], [1, 2])
        self.assertIn(lines[1], doubts)

        def unclassed(folder):
            warn(folder)
            with h5py.File(folder / "results.h5", "a") as file:
                file.attrs["warning_classes"] = ["doubt"]

        self.assertEqual(remarks.parted(self.study(Recipe(), unclassed).warnings), (lines, []))

    def test_without_warnings_of_the_table_those_of_scans_are_said(self):
        self.assertIn("before_1.x3p: 5 spikes (0.1 %)", self.study(Recipe(warnings={0: "5 spikes (0.1 %)"})).warnings)

    def test_a_failed_case_is_named_with_its_message(self):
        def fail(folder):
            with h5py.File(folder / "results.h5", "a") as file:
                n = len(file["table/case_id"])
                file["table/error"] = ["the load cannot be carried"] + [""] * (n - 1)

        source = self.study(Recipe(groups=("one",)), fail)
        self.assertIn("Failed: the load cannot be carried", source.warnings)


if __name__ == "__main__":
    unittest.main()
