"""Oil that carries load, trapped or as it flows: answers and captions say what was computed."""

import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

from study_case import StudyCase
from synthetic_single import write_single
from synthetic_study import Recipe
from tabor.report import build, oil, page_single, page_study, viewer
from tabor.report.figures import lubricated_friction, single_curves, single_maps

PLAIN = "(A_real − A_lub)/A₀"


class OfOneScan(unittest.TestCase):
    def opened(self, key=None, facts=()):
        """Four states, the share of the load of each in the key."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        path = Path(folder.name) / "one.h5"
        write_single(path, Recipe(shape=(20, 24), pressures=(2e6, 5e6), densities=(0.45, 0.9)))
        with h5py.File(path, "a") as file:
            for state, share in zip(file["states"].values(), (0.0, 0.02, 0.0476, 0.131)):
                state.attrs.update({**dict(facts), **({key: share} if key else {})})
        source = build.open_result(path)
        self.addCleanup(source.file.close)
        return source

    def test_trapped_oil_has_its_formula_and_its_share_of_the_load(self):
        source = self.opened(oil.TRAPPED)
        answer, caption = page_single.sections(source)["answer"], single_curves.draw(source).caption
        for text in (answer["note"], caption):
            self.assertIn(f"{oil.FORMULA}, where", text)
            self.assertIn("carries 0 % to 13.1 % of the load", text)
        self.assertNotIn("A_lub", caption)
        rows = dict(answer["rows"])
        self.assertEqual(rows["trapped oil carries, 0.45 g/m²"], ["0 %", "4.76 %"])
        self.assertEqual(rows["trapped oil carries, 0.9 g/m²"], ["2 %", "13.1 %"])

    def test_a_share_that_did_not_converge_is_not_in_the_range(self):
        source = self.opened(oil.TRAPPED)
        source.states[3].facts["converged"] = False
        self.assertIn("carries 0 % to 4.76 % of the load", page_single.answer(source.states, source.column)["note"])

    def test_oil_that_flows_is_told_from_the_oil_at_rest_that_is_drawn(self):
        source = self.opened(oil.FLOWING, {"friction_mixed": 0.123, "sliding_speed_m_per_s": 0.005})
        answer, caption = page_single.sections(source)["answer"], single_curves.draw(source).caption
        for text in (PLAIN, "The oil of these curves is at rest", "carries 0 % to 13.1 % of the load"):
            self.assertIn(text, caption)
        self.assertIn("Friction without a speed beside it is that of oil at rest.", answer["note"])
        self.assertEqual(dict(answer["rows"])["oil that flows carries, 0.9 g/m², 5 mm/s"], ["2 %", "13.1 %"])

    def test_maps_of_the_contact_are_those_before_oil_carries_load(self):
        for key, said in ((oil.TRAPPED, oil.BEFORE), (oil.FLOWING, oil.BEFORE), (None, "")):
            source = self.opened(key)
            self.assertEqual(viewer.of_single(source).of_contact, said)
            captions = [figure.caption for figure in single_maps.draw(source)]
            self.assertTrue(any(caption.startswith(f"Gap between the surfaces{said} (") for caption in captions))
            self.assertTrue(any(caption.startswith(f"Real contact{said} (black)") for caption in captions))

    def test_oil_that_only_separates_needs_no_word(self):
        source = self.opened()
        self.assertEqual(page_single.sections(source)["answer"]["note"], "")
        self.assertIn(PLAIN, single_curves.draw(source).caption)
        self.assertNotIn("carries", single_curves.draw(source).caption)


def trap(folder):
    """Gives a study the shares of trapped oil: 0.1 in the first row, rising to 0.2 in the last."""
    with h5py.File(folder / "results.h5", "a") as file:
        file["table/liquid_load_share"] = np.linspace(0.1, 0.2, len(file["table/group"]))
        n = len(file["averages/group"])
        for kind, value in (("mean", 0.15), ("std", 0.01), ("sem", 0.005)):
            file[f"averages/liquid_load_share_{kind}"] = np.full(n, value)


class OfAStudy(StudyCase):
    def test_trapped_oil_has_its_formula_and_its_share_of_the_load(self):
        source = self.study(Recipe(pressures=(2e6, 5e6), densities=(0.9,), shape=(24, 32)), trap)
        answer, caption = page_study.answer(source), lubricated_friction.draw(source).caption
        for text in (answer["note"], caption):
            self.assertIn(f"{oil.FORMULA}, where", text)
            self.assertIn("carries 10 % to 20 % of the load", text)
        self.assertNotIn("A_lub", caption)
        self.assertNotIn("Costagliola", caption)  # whose oil carries nothing
        name = next(name for name, _ in answer["rows"] if name.startswith("trapped oil carries, 0.9 g/m²"))
        self.assertRegex(dict(answer["rows"])[name][0], r"^15( ± 1)? %$")
        header = page_study.sections(source)["averages"]["header"]
        self.assertIn("oil carries (%)", header)

    def test_oil_that_flows_is_told_from_the_oil_at_rest_that_is_drawn(self):
        source = self.study(Recipe(pressures=(2e6, 5e6), densities=(0.9,), speeds=(0.01,), shape=(24, 32)))
        caption = lubricated_friction.draw(source).caption
        for text in (PLAIN, "The oil of these curves is at rest; while it flows, it carries"):
            self.assertIn(text, caption)

    def test_oil_that_only_separates_needs_no_word(self):
        self.assertEqual(page_study.answer(self.default)["note"], "")
        self.assertIn(PLAIN, self.default_figures["lubricated_friction"].caption)


if __name__ == "__main__":
    unittest.main()
