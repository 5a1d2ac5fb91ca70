"""Contacts recomputed by a program of its own (tools/check/recompute_contact), and what it must see."""

import shutil
import subprocess
import unittest

import h5py

from program import ALUMINIUM, SOURCE, TABOR, ProgramTest

RECOMPUTE = SOURCE / "tools" / "check" / "recompute_contact"


class RecomputedContact(ProgramTest):
    def recompute(self, *words):
        return subprocess.run([RECOMPUTE, *words], cwd=self.folder, text=True, capture_output=True,
                              check=False, timeout=120)

    def contact(self, name, *words):
        done = self.tabor("contact", "scan.h5", "-o", name, "--double", "--quiet", *ALUMINIUM, *words)
        self.assertEqual(done.returncode, 0, done.stderr)

    def assert_fits(self, done, n_states):
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn(f"{n_states} contacts recomputed, 0 mismatches", done.stdout)

    def test_files_fit(self):
        self.generate("scan.h5", "edt", 48)
        cap = ["--saturation-pressure", "240MPa"]
        self.contact("elastic.h5", "--pressure", "2MPa,200MPa")
        self.contact("path.h5", "--pressure", "20MPa,200MPa,5MPa", "--load-path", *cap)
        self.contact("free.h5", "--pressure", "7MPa,239.9MPa", "--boundary", "free", *cap)
        self.assert_fits(self.recompute("elastic.h5", "path.h5", "free.h5"), 7)

    def test_waves_on_few_levels_fit(self):
        self.generate("scan.h5", "sinusoid", 16, "--pixel", "1um", "--amplitude", "1um",
                      "--wavelength-x", "4um", "--wavelength-y", "4um")
        self.contact("waves.h5", "--pressure", "1MPa")
        self.assert_fits(self.recompute("waves.h5"), 1)
        with h5py.File(self.folder / "waves.h5") as file:
            state = file["states/0000"].attrs
            self.assertEqual(state["contact_area_fraction_pixels"], 0.125)
            self.assertAlmostEqual(state["mean_gap_m"], 1e-6, delta=1e-9)

    def test_random_contacts_fit(self):
        done = self.recompute(TABOR, "--seconds", "60", "--runs", "8", "--seed", "4")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertRegex(done.stdout, r"[1-9]\d* contacts recomputed, 0 mismatches")

    def test_doctored_files_do_not_fit(self):
        self.generate("scan.h5", "edt", 32)
        self.contact("sound.h5", "--pressure", "50MPa", "--saturation-pressure", "5GPa")

        def first_pixel(name):
            return lambda state: state[name].__setitem__((0, 0), state[name][0, 0] + 1e-6)

        def scalar(name, factor):
            return lambda state: state.attrs.__setitem__(name, factor * state.attrs[name])

        for change, word in ((first_pixel("gap"), "gap"),
                             (lambda state: state["pressure"].write_direct(2 * state["pressure"][()]),
                              "load"),
                             (scalar("mean_gap_m", 1.001), "mean_gap_m"),
                             (scalar("separation_m", 1.001), "separation_m"),
                             (scalar("contact_area_fraction_pixels", 1.01), "contact_area"),
                             (scalar("saturated_area_fraction", 1.01), "saturated"),
                             (scalar("contact_gap_error_m", 0.5), "contact_gap_error_m"),
                             (scalar("elastic_energy_J_per_m2", 1.001), "elastic_energy"),
                             (scalar("certificate", 0.5), "certificate")):
            shutil.copy(self.folder / "sound.h5", self.folder / "doctored.h5")
            with h5py.File(self.folder / "doctored.h5", "r+") as file:
                change(file["states/0000"])
            done = self.recompute("doctored.h5")
            self.assertEqual(done.returncode, 1, f"{word}: {done.stdout}{done.stderr}")
            self.assertIn(word, done.stdout)
            self.assertIn("FAIL", done.stdout)


if __name__ == "__main__":
    unittest.main()
