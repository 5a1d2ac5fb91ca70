"""A sweep may be stopped at any instant, shared and repeated: its tables are always the same."""

import shlex
import shutil
import signal
import subprocess
import time
import unittest

from program import SOURCE, TABOR, ProgramTest

STUDY = """
shear_strength = "70 MPa"
[material]
youngs_modulus = "70 GPa"
poissons_ratio = 0.33
saturation_pressure = "240 MPa"
[treatment]
steps = ["level=plane"]
[sweep]
mean_pressure = ["1 MPa", "2 MPa", "3 MPa", "4 MPa", "5 MPa", "6 MPa", "7 MPa", "8 MPa"]
lubricant_density = ["0.45 g/m^2", "0.9 g/m^2"]
[[scan]]
file = "a.h5"
[[scan]]
file = "b.h5"
"""
N_CASES = 2 * 8 * 2


class SweepTest(ProgramTest):
    def setUp(self):
        super().setUp()
        for seed, name in enumerate(["a.h5", "b.h5"], start=1):
            self.generate(name, "edt", 192, "--seed", seed)
        (self.folder / "study.toml").write_text(STUDY)

    def table(self, directory="out"):
        return (self.folder / directory / "results.csv").read_text()

    def count(self, pattern):
        return len(list(self.folder.glob(f"out/store/{pattern}")))

    def stop_after(self, n_contacts, stop, *words, n_cases=0):
        """Starts a sweep, sends `stop` when the store holds so many contacts and cases; returns the ended process."""
        process = self.start("sweep", "study.toml", "-o", "out", *words)
        return self.stop_when(
            lambda: self.count("contact-*.h5") >= n_contacts and self.count("case-*.json") >= n_cases, stop, process)

    def reference(self):
        done = self.tabor("sweep", "study.toml", "-o", "reference")
        self.assertEqual(done.returncode, 0, done.stderr)
        table = self.table("reference")
        self.assertEqual(len(table.splitlines()), 1 + N_CASES)
        return table


class Killed(SweepTest):
    def test_and_resumed_gives_the_same_table(self):
        expected = self.reference()
        for n_contacts in (1, 5, 11):
            code, _, _ = self.stop_after(n_contacts, signal.SIGKILL)
            self.assertEqual(code, -signal.SIGKILL)
        resumed = self.json("sweep", "study.toml", "-o", "out")
        self.assertEqual(self.table(), expected)
        self.assertLess(resumed["n_computed_contacts"], 16)


class Interrupted(SweepTest):
    def test_by_control_c_ends_with_130_keeps_what_was_finished_and_goes_on(self):
        expected = self.reference()
        code, _, err = self.stop_after(4, signal.SIGINT, n_cases=1)
        self.assertEqual(code, 130, err)
        self.assertIn("the same command continues with the finished cases in out", err)
        self.assertGreaterEqual(len(self.table().splitlines()), 2)
        resumed = self.json("sweep", "study.toml", "-o", "out")
        self.assertEqual(self.table(), expected)
        self.assertLess(resumed["n_computed_contacts"], 16 - 3)


class TwoSweeps(SweepTest):
    def test_on_one_store_are_rejected_while_one_works(self):
        first = self.start("sweep", "study.toml", "-o", "out")
        while not list(self.folder.glob("out/store/contact-*.h5")):
            self.assertIsNone(first.poll())
            time.sleep(0.002)
        first.send_signal(signal.SIGSTOP)
        try:
            self.assert_rejected(self.tabor("sweep", "study.toml", "-o", "out"), 3, "out")
        finally:
            first.send_signal(signal.SIGCONT)
            first.communicate(timeout=60)
        self.assertEqual(first.returncode, 0)

    def test_that_are_shards_share_the_work_and_the_table(self):
        expected = self.reference()
        shards = [self.start("sweep", "study.toml", "-o", "out", "--shard", f"{i}/2") for i in (1, 2)]
        for shard in shards:
            _, err = shard.communicate(timeout=120)
            self.assertEqual(shard.returncode, 0, err)
        done = self.json("sweep", "study.toml", "-o", "out")
        self.assertEqual(done["n_computed_contacts"], 0)
        self.assertEqual(self.table(), expected)


class Jobs(SweepTest):
    def test_and_threads_do_not_change_the_table(self):
        expected = self.reference()
        done = self.tabor("sweep", "study.toml", "-o", "out", "--jobs", "2", "--threads", "1")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.table(), expected)


class BadStudies(SweepTest):
    def rejected(self, old, new, *parts):
        self.assertIn(old, STUDY)
        (self.folder / "study.toml").write_text(STUDY.replace(old, new))
        self.assert_rejected(self.tabor("sweep", "study.toml", "-o", "out"), 3, "study.toml", *parts)

    def test_are_rejected_with_line_and_key(self):
        self.rejected("youngs_modulus", "youngs_modulos", "youngs_modulus")
        self.rejected('"70 GPa"', "70", "unit")
        self.rejected('"8 MPa"', '"240 MPa"', "240 MPa")
        self.rejected('"a.h5"', '"absent.h5"', "absent.h5")
        self.rejected('"level=plane"', '"levle=plane"', "level")
        self.rejected("[material]", "[material", "study.toml")

    def test_output_that_cannot_be_written_is_code_5(self):
        (self.folder / "out").write_text("a file where the folder should be")
        self.assert_rejected(self.tabor("sweep", "study.toml", "-o", "out"), 5, "out")

    def test_a_scan_that_cannot_be_read_fails_its_cases_only(self):
        (self.folder / "b.h5").write_bytes(b"\x89HDF\r\n\x1a\n but no more")
        done = self.tabor("sweep", "study.toml", "-o", "out")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("b.h5", done.stderr)
        self.assertEqual(sum(line.endswith(",true") for line in self.table().splitlines()), N_CASES // 2)


class ContactInterrupted(ProgramTest):
    def test_by_control_c_ends_with_130_and_keeps_finished_states(self):
        self.generate("scan.h5", "edt", 256)
        pressures = ",".join(f"{1 + 0.02 * i:.2f}MPa" for i in range(400))
        process = subprocess.Popen(
            [TABOR, "contact", "scan.h5", "--pressure", pressures, "--youngs-modulus", "70GPa",
             "--poisson-ratio", "0.33", "-o", "out.h5"],
            cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        time.sleep(2.5)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, err)
        self.assertIn("Interrupted. Only the finished states are shown", err)
        n_rows = sum(line.rstrip().count(" MPa") > 0 and "yes" in line for line in out.splitlines())
        self.assertGreater(n_rows, 0, out)
        self.assertTrue((self.folder / "out.h5").exists())


def report_libraries_are_installed():
    names = "numpy, h5py, matplotlib, jinja2"
    return subprocess.run(["/usr/bin/python3", "-c", f"import {names}"], capture_output=True, check=False).returncode == 0


class Report(SweepTest):
    @unittest.skipUnless(report_libraries_are_installed(), "the Python libraries of the report are not installed")
    def test_of_a_study_and_of_a_result_file_is_one_page(self):
        self.reference()
        files = self.json("report", "reference")["files"]
        self.assertTrue(any(name.endswith("report.html") for name in files), files)
        self.assertTrue((self.folder / "reference/report.html").exists())

    def test_of_nothing_is_rejected(self):
        done = self.tabor("report", "absent")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertIn("absent", done.stderr)

    def test_with_a_wrong_word_is_a_usage_error(self):
        self.assert_rejected(self.tabor("report", "reference", "--presure", "7MPa"), 2, "--pressure")
        self.assert_rejected(self.tabor("report", "reference", "--figures", "png,jpeg"), 2, "png, svg, pdf")


class HelpExamples(ProgramTest):
    def test_of_sweep_work(self):
        shutil.copytree(SOURCE / "examples/06_study", self.folder / "examples/06_study")
        help_text = self.tabor("sweep", "--help").stdout
        for line in help_text.split("Examples:\n")[1].replace("\\\n", "").splitlines():
            done = self.tabor(*shlex.split(line)[1:])
            self.assertEqual(done.returncode, 0, f"{line}\n{done.stderr}")


if __name__ == "__main__":
    unittest.main()
