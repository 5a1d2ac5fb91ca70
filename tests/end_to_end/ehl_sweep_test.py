"""A sweep of `tabor ehl` may be stopped at any instant: repeated, it says the same to the last bit."""

import itertools
import json
import signal
import unittest

import h5py
import numpy as np

from program import SOURCE, ProgramTest

# Solids touch and flow at the lower speeds: films that are not found without the one before.
STRIBECK = ["ehl", "point", "ball.toml", "--set", "roughness.kind=lapped-like,polished-like", "--set",
            "motion.speed=0.01m/s..10m/s:log:4", "--set", "grid.nodes=33"]
IMPACT = ["ehl", "impact", "ball.toml", "--set", "grid.nodes=120", "--set", "ball.speed=0.1m/s..0.5m/s:8"]
N_CASES = 8


class EhlSweepTest(ProgramTest):
    def copy(self, example):
        (self.folder / "ball.toml").write_text((SOURCE / "examples" / example / "ball.toml").read_text())

    def n_kept(self):
        return len(list(self.folder.glob("out.h5.cases/case-*.json")))

    def stop_after(self, n_cases, stop, words):
        """Starts the sweep and sends `stop` when so many cases are kept, one of them its own; returns the ended process."""
        n_cases = max(n_cases, self.n_kept() + 1)  # before that it may not listen to signals yet
        process = self.start(*words, "-o", "out.h5")
        return self.stop_when(lambda: self.n_kept() >= n_cases, stop, process)

    def numbers(self, name):
        with h5py.File(self.folder / name) as file:
            found = {}
            file["sweep"].visititems(lambda path, node: found.update({path: node[()]} if hasattr(node, "shape") else {}))
            return found

    def results(self, name, words):
        done = self.tabor(*words, "--json", "-o", name)
        self.assertIn(done.returncode, (0, 4), done.stderr)
        said = json.loads(done.stdout)
        del said["command"]  # names the file
        return done.returncode, said, done.stderr

    def assert_goes_on(self, words, stops):
        """Stopped after each of these numbers of cases, the sweep ends as one that nobody stopped."""
        code, expected, _ = self.results("whole.h5", words)
        for n_cases, (stop, ending) in zip(stops, itertools.cycle([(signal.SIGKILL, -9), (signal.SIGTERM, 130)])):
            ended, out, err = self.stop_after(n_cases, stop, words)
            self.assertEqual(ended, ending, err)
            self.assertEqual(out, "")
            self.assertFalse((self.folder / "out.h5").exists())
            if stop == signal.SIGTERM:
                self.assertIn("the same command continues with ", err)
        again, said, err = self.results("out.h5", words)
        self.assertRegex(err, rf"[{stops[-1]}-{N_CASES}] of {N_CASES} finished cases were found in out.h5.cases")
        self.assertEqual(said, expected)
        self.assertEqual(again, code)
        whole, out = self.numbers("whole.h5"), self.numbers("out.h5")
        self.assertEqual(set(out), set(whole))
        for name, values in whole.items():
            np.testing.assert_array_equal(out[name], values, name)
        self.assertEqual(self.files(), ["ball.toml", "out.h5", "whole.h5"])


class Stopped(EhlSweepTest):
    def test_and_repeated_a_stribeck_curve_has_the_same_bits(self):
        self.copy("12_stribeck")
        self.assert_goes_on(STRIBECK, (1, 3, 5))

    def test_and_repeated_so_do_cases_that_do_not_begin_where_another_ended(self):
        self.copy("10_restitution_map")
        self.assert_goes_on(IMPACT, (1, 2, 4))


class SharedOut(EhlSweepTest):
    def assert_same(self, name, said, words):
        """The file and the object of a run are those of one that does all by itself."""
        _, expected, _ = self.results("whole.h5", [*words, "--jobs", "1"])
        self.assertEqual(said, expected)
        whole, out = self.numbers("whole.h5"), self.numbers(name)
        self.assertEqual(set(out), set(whole))
        for path, values in whole.items():
            np.testing.assert_array_equal(out[path], values, path)

    def test_to_jobs_a_stribeck_curve_has_the_same_bits(self):
        self.copy("12_stribeck")
        _, said, _ = self.results("two.h5", [*STRIBECK, "--jobs", "2"])
        self.assert_same("two.h5", said, STRIBECK)

    def test_to_shards_so_does_it_even_if_one_is_killed(self):
        self.copy("12_stribeck")
        ended, _, err = self.stop_after(1, signal.SIGKILL, [*STRIBECK, "--shard", "2/2"])
        self.assertEqual(ended, -9, err)
        for shard, n_computed in (("2/2", None), ("1/2", 4)):
            said = self.json(*STRIBECK, "-o", "out.h5", "--shard", shard)
            self.assertEqual((said["shard"], said["n_cases"], said["converged"]), (shard, N_CASES, True))
            self.assertEqual(said["n_computed"], n_computed or said["n_computed"])
            self.assertFalse((self.folder / "out.h5").exists())
        self.assertEqual(said["n_done"], N_CASES)
        _, said, err = self.results("out.h5", STRIBECK)
        self.assertIn(f"{N_CASES} of {N_CASES} finished cases were found", err)
        self.assert_same("out.h5", said, STRIBECK)
        self.assertEqual(self.files(), ["ball.toml", "out.h5", "whole.h5"])

    def test_and_retried_it_computes_what_made_no_sense_and_what_follows(self):
        self.copy("12_stribeck")
        words = ["ehl", "point", "ball.toml", "--set", "motion.speed=5m/s,-1m/s,10m/s", "--set", "grid.nodes=33"]
        self.assertEqual(self.tabor(*words, "-o", "out.h5", "--shard", "1/1").returncode, 4)
        said = json.loads(self.tabor(*words, "-o", "out.h5", "--shard", "1/1", "--json").stdout)
        self.assertEqual(said["n_computed"], 0)
        said = json.loads(self.tabor(*words, "-o", "out.h5", "--shard", "1/1", "--json", "--retry").stdout)
        self.assertEqual(said["n_computed"], 3)  # -1 m/s needs the film before it, whose own start is gone
        _, said, _ = self.results("out.h5", words)
        self.assert_same("out.h5", said, words)

    def test_only_where_there_is_a_folder_for_it(self):
        self.copy("12_stribeck")
        for words in (["--shard", "1/2"], ["--retry"], ["-o", "out.h5", "--shard", "1/2"]):
            swept = ["--set", "grid.nodes=33,65"] if "-o" not in words else []
            self.assert_rejected(self.tabor("ehl", "point", "ball.toml", *swept, *words), 2, "-o OUT.h5")


if __name__ == "__main__":
    unittest.main()
