"""Every kind of bad input ends with its exit code and one clear line."""

import os
import resource
import signal
import subprocess
import unittest
import zipfile

from program import ALUMINIUM, ProgramTest

MATRIX = ["--pixel", "1um", "--unit", "nm"]


def limit_file_size(n_bytes):
    """For preexec_fn: no file grows beyond n_bytes, as after `ulimit -f`."""

    def limit():
        resource.setrlimit(resource.RLIMIT_FSIZE, (n_bytes, n_bytes))

    return limit


def limit_memory():
    resource.setrlimit(resource.RLIMIT_AS, (2 << 30, 2 << 30))


class Units(ProgramTest):
    def test_missing_wrong_and_mixed_units_are_usage_errors(self):
        self.generate("scan.h5")
        for pressure, part in [("7", "--pressure 7MPa"), ("7um", "MPa"), ("7MPa,8", "--pressure 8MPa"),
                               ("7MPa,8kg", "MPa"), ("seven MPa", "number"), ("7MPaa", "MPaa")]:
            done = self.tabor("contact", "scan.h5", "--pressure", pressure, *ALUMINIUM)
            self.assert_rejected(done, 2, "--pressure", part)

    def test_a_scan_without_unit_is_rejected_with_the_option_to_add(self):
        (self.folder / "plain.txt").write_text("1 2 3\n4 5 6\n7 8 10\n")
        self.assert_rejected(self.tabor("params", "plain.txt"), 3, "plain.txt", "--pixel")
        self.assert_rejected(self.tabor("params", "plain.txt", "--pixel", "1um"), 3, "--unit")
        self.assertIn("--pixel", self.json("info", "plain.txt")["doubts"][0])
        self.assertEqual(self.json("info", "plain.txt", *MATRIX)["nx"], 3)


class Pressure(ProgramTest):
    def test_at_or_above_saturation_is_rejected(self):
        self.generate("scan.h5")
        for pressure in ["240MPa", "1GPa", "2MPa,240MPa"]:
            done = self.tabor("contact", "scan.h5", "--pressure", pressure, *ALUMINIUM,
                              "--saturation-pressure", "240MPa")
            self.assert_rejected(done, 3, "240 MPa", "saturation")


class Holes(ProgramTest):
    def test_are_rejected_with_the_option_that_fills_them(self):
        (self.folder / "holes.txt").write_text("1 2 3\n4 NaN 6\n7 8 10\n")
        done = self.tabor("contact", "holes.txt", *MATRIX, "--pressure", "1MPa", *ALUMINIUM)
        self.assert_rejected(done, 3, "1 missing", "--fill harmonic")
        done = self.tabor("lubricate", "holes.txt", *MATRIX, "--density", "1g/m^2")
        self.assert_rejected(done, 3, "--fill harmonic")

    def test_everywhere_are_rejected(self):
        (self.folder / "nothing.txt").write_text("NaN NaN NaN\n" * 3)
        for words in (["info"], ["params"], ["contact", "--pressure", "1MPa", *ALUMINIUM, "--fill", "harmonic"]):
            done = self.tabor(words[0], "nothing.txt", *MATRIX, *words[1:])
            self.assert_rejected(done, 3, "nothing.txt")


class BrokenFiles(ProgramTest):
    def test_truncated_anywhere_are_rejected_without_a_crash(self):
        for extension in ("x3p", "sdf", "gsf", "gwy", "h5", "npy"):
            whole = self.generate(f"whole.{extension}", "edt", 16).read_bytes()
            cut = self.folder / f"cut.{extension}"
            for share in (0, 1, 25, 50, 75, 99):
                cut.write_bytes(whole[:len(whole) * share // 100])
                done = self.tabor("info", cut.name)
                self.assertEqual(done.returncode, 3, f"{extension} {share} %: {done.stderr}")
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)

    def test_that_claim_more_than_they_hold_do_not_take_memory(self):
        header = "Gwyddion Simple Field 1.0\nXRes = 2000000000\nYRes = 2000000000\nXReal = 1\nYReal = 1\nXYUnits = m\nZUnits = m\n"
        (self.folder / "lying.gsf").write_bytes(header.encode() + b"\0" * 8)
        done = self.tabor("info", "lying.gsf", preexec_fn=limit_memory)
        self.assert_rejected(done, 3, "lying.gsf")

    def test_of_an_unknown_kind_are_rejected(self):
        (self.folder / "noise.x3p").write_bytes(bytes(range(256)) * 8)
        self.assert_rejected(self.tabor("info", "noise.x3p"), 3, "noise.x3p")
        (self.folder / "empty.x3p").write_bytes(b"")
        self.assert_rejected(self.tabor("info", "empty.x3p"), 3, "empty.x3p")

    def test_that_are_folders_or_absent_are_rejected(self):
        (self.folder / "folder.x3p").mkdir()
        self.assert_rejected(self.tabor("info", "folder.x3p"), 3, "folder.x3p")
        self.assert_rejected(self.tabor("info", "absent.x3p"), 3, "absent.x3p")


class HostileFiles(ProgramTest):
    """Made to hurt: rejected within seconds, in bounded memory, in one line that a terminal can show."""

    def reject(self, name, *words):
        done = self.tabor("info", name, *words, preexec_fn=limit_memory, timeout=20)
        self.assert_rejected(done, 3, name)
        self.assertTrue(all(character.isprintable() for character in done.stderr.rstrip("\n")), done.stderr)
        return done.stderr

    def archive(self, name, entries):
        with zipfile.ZipFile(self.folder / name, "w", zipfile.ZIP_DEFLATED) as archive:
            for entry, content in entries:
                archive.writestr(entry, content)

    def test_archives_that_unpack_to_gigabytes(self):
        self.archive("inner.zip", [("main.xml", b" " * (1 << 29))])
        (self.folder / "inner.zip").rename(self.folder / "bomb.x3p")
        self.reject("bomb.x3p")
        self.archive("nested.x3p", [("main.xml", (self.folder / "bomb.x3p").read_bytes())])
        self.reject("nested.x3p")
        self.archive("many.x3p", [(f"{i}/main.txt", b"") for i in range(20000)])
        self.reject("many.x3p")

    def test_archives_whose_entries_point_elsewhere(self):
        (self.folder / "secret.txt").write_text("1 2\n3 4\n")
        link = zipfile.ZipInfo("main.xml")
        link.create_system = 3
        link.external_attr = 0o120777 << 16
        self.archive("link.x3p", [(link, str(self.folder / "secret.txt"))])
        self.reject("link.x3p")
        self.archive("up.x3p", [("../main.xml", "<a/>"), ("/tmp/main.xml", "<a/>")])
        before = self.files()
        self.reject("up.x3p")
        self.assertEqual(self.files(), before)

    def test_xml_that_grows_or_nests(self):
        entities = "".join(f'<!ENTITY e{i} "{f"&e{i - 1};" * 10}">' for i in range(1, 30))
        self.archive("laughs.x3p", [("main.xml", f'<!DOCTYPE a [<!ENTITY e0 "ha">{entities}]><a>&e29;</a>')])
        self.reject("laughs.x3p")
        self.archive("deep.x3p", [("main.xml", "<a>" * 200000 + "</a>" * 200000)])
        self.reject("deep.x3p")

    def test_texts_that_command_the_terminal(self):
        (self.folder / "escape.txt").write_bytes(b"1 2 3\n4 \x1b]0;owned\x07\x1b[2J 6\n")
        self.reject("escape.txt", *MATRIX)
        (self.folder / "endless.txt").write_text("1 2 3\n4 " + "x" * 1000000 + " 6\n")
        self.assertLess(len(self.reject("endless.txt", *MATRIX)), 10000)

    def test_studies_that_nest(self):
        for name, text in [("keys.toml", "[" + "a." * 200000 + "a]\n"), ("lists.toml", "a = " + "[\n" * 100000)]:
            (self.folder / name).write_text(text)
            self.assert_rejected(self.tabor("sweep", name, timeout=20), 3, name)

    def test_absurd_scales(self):
        (self.folder / "plain.txt").write_text("1 2 3\n4 5 6\n7 8 10\n")
        for code, words in [(3, ["--pixel", "0um"]), (3, ["--pixel=-1um"]), (2, ["--pixel", "nanum"]), (2, ["--pixel", "1e400m"])]:
            self.assert_rejected(self.tabor("info", "plain.txt", "--unit", "nm", *words), code, "--pixel")


class Lubricant(ProgramTest):
    def test_that_more_than_floods_the_surface_is_said(self):
        self.generate("scan.h5")
        result = self.json("lubricate", "scan.h5", "--density", "1kg/m^2")
        self.assertTrue(result["states"][0]["flooded"])
        self.assertEqual(result["states"][0]["wet_fraction"], 1)
        self.assertIn("flood", " ".join(warning["text"] for warning in result["warnings"]))

    def test_negative_is_rejected(self):
        self.generate("scan.h5")
        done = self.tabor("lubricate", "scan.h5", "--density=-1g/m^2")
        self.assert_rejected(done, 3, "--density")


class Words(ProgramTest):
    def test_unknown_ones_name_the_nearest(self):
        self.assert_rejected(self.tabor("lubricte", "scan.h5"), 2, "'lubricate'")
        self.assert_rejected(self.tabor("info", "scan.h5", "--pixle", "1um"), 2, "'--pixel'")
        self.assert_rejected(self.tabor("params", "scan.h5", "--fill", "harmonik"), 2, "harmonic")

    def test_missing_ones_are_named(self):
        self.assert_rejected(self.tabor("contact", "scan.h5", *ALUMINIUM), 2, "--pressure")
        self.assert_rejected(self.tabor("info"), 2, "SCAN")


class Output(ProgramTest):
    def contact(self, *words, **options):
        return self.tabor("contact", "scan.h5", "--pressure", "7MPa", *ALUMINIUM, *words, **options)

    def test_into_an_absent_folder_is_rejected_before_computing(self):
        self.generate("scan.h5")
        self.assert_rejected(self.contact("-o", "absent/out.h5"), 5, "absent")

    def test_onto_a_folder_is_rejected(self):
        self.generate("scan.h5")
        (self.folder / "out.h5").mkdir()
        self.assert_rejected(self.contact("-o", "out.h5"), 5, "out.h5")

    @unittest.skipIf(os.geteuid() == 0, "root may write everywhere")
    def test_into_a_read_only_folder_is_rejected(self):
        self.generate("scan.h5")
        (self.folder / "closed").mkdir(mode=0o500)
        self.assert_rejected(self.contact("-o", "closed/out.h5"), 5, "closed")

    def test_of_an_unknown_extension_is_rejected(self):
        self.generate("scan.h5")
        done = self.tabor("convert", "scan.h5", "out.docx")
        self.assert_rejected(done, 3, "out.docx")

    def test_to_a_full_disk_leaves_nothing_behind(self):
        self.generate("scan.h5")
        before = self.files()
        done = self.contact("-o", "out.h5", preexec_fn=limit_file_size(4096))
        self.assert_rejected(done, 5, "out.h5")
        self.assertEqual(self.files(), before)
        for extension in ("gwy", "x3p", "npy", "h5", "txt"):
            done = self.tabor("convert", "scan.h5", f"out.{extension}",
                              preexec_fn=limit_file_size(512))
            self.assert_rejected(done, 5, f"out.{extension}")
            self.assertEqual(self.files(), before)

    def test_that_would_replace_the_scan_is_rejected(self):
        before = self.generate("scan.h5").read_bytes()
        os.link(self.folder / "scan.h5", self.folder / "same.h5")
        for name in ("scan.h5", "./scan.h5", "same.h5", self.folder / "scan.h5"):
            self.assert_rejected(self.contact("-o", name), 5, "never written over")
        self.assertEqual((self.folder / "scan.h5").read_bytes(), before)

    def test_of_a_killed_program_is_cleared_away_by_the_next(self):
        self.generate("scan.h5", "edt", 256)
        pressures = ["--pressure", ",".join(f"{p}MPa" for p in range(1, 40)), *ALUMINIUM]
        process = self.start("contact", "scan.h5", *pressures, "-o", "out.h5")
        self.stop_when(lambda: len(self.files()) == 2, signal.SIGKILL, process)
        self.assertNotIn("out.h5", self.files())
        self.assertEqual(len(self.files()), 2)
        self.assertEqual(self.contact("-o", "out.h5").returncode, 0)
        self.assertEqual(self.files(), ["out.h5", "scan.h5"])

    def test_stopped_before_its_first_state_is_not_made(self):
        self.generate("scan.h5", "edt", 1024)
        process = self.start("contact", "scan.h5", "--pressure", "40MPa", *ALUMINIUM, "-o", "out.h5")
        code, out, err = self.stop_when(lambda: len(self.files()) == 2, signal.SIGINT, process)
        self.assertEqual((code, out, err), (130, "", "tabor: interrupted\n"))
        self.assertEqual(self.files(), ["scan.h5"])

    def test_to_a_full_standard_output_is_noticed(self):
        with open("/dev/full", "w") as full:
            done = self.tabor("formats", stdout=full, stderr=subprocess.PIPE)
        self.assertEqual(done.returncode, 5)
        self.assertIn("standard output", done.stderr)


if __name__ == "__main__":
    unittest.main()
