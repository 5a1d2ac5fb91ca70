"""Results of others: damaged, hostile, or of another kind. Rejected in one line, never followed, waited for or crashed over."""

import hashlib
import os
import resource
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import h5py
import numpy as np

from study_case import StudyCase, draw
from tabor.report import errors, guard, hdf, output


class Guard(StudyCase):
    def file(self, change, name="results.h5"):
        path = Path(self.temporary_folder()) / name
        with h5py.File(path, "w") as file:
            file.attrs["format"] = "tabor"
            change(file)
        return path

    def temporary_folder(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        return folder.name

    def reject(self, change, part):
        path = self.file(change)
        with self.assertRaises(errors.InputError) as caught:
            hdf.open_file(path)
        self.assertIn(part, str(caught.exception))
        self.assertNotIn("\n", str(caught.exception))

    def test_a_sound_file_is_opened(self):
        def fill(file):
            file["map"] = np.zeros((300, 400))
            file["texts"] = ["a", "b"]
            file["soft"] = h5py.SoftLink("/map")
            file["scans/0000/surface"] = h5py.ExternalLink("store/absent.h5", "/surface")

        with hdf.open_file(self.file(fill)) as file:
            self.assertEqual(file["soft"].shape, (300, 400))

    def test_values_in_other_files_are_rejected(self):
        def raw(file):
            file.create_dataset("map", (4, 4), "u1", external=[("/etc/passwd", 0, 16)])

        def virtual(file):
            layout = h5py.VirtualLayout((4, 4), "f8")
            layout[:] = h5py.VirtualSource("other.h5", "map", (4, 4))
            file.create_virtual_dataset("map", layout)

        self.reject(raw, "values kept in other files")
        self.reject(virtual, "values kept in other files")

    def test_links_that_lead_out_are_rejected(self):
        for place, target in [
            ("surface", "other.h5"),
            ("scans/0000/surface", "/tmp/other.h5"),
            ("scans/0000/surface", "store/../other.h5"),
            ("table", "store/a.h5"),
        ]:
            self.reject(lambda file: file.__setitem__(place, h5py.ExternalLink(target, "/")), "not in its store")

    def test_a_pipe_in_the_store_is_not_waited_for(self):
        def link(file):
            folder = Path(file.filename).parent / "store"
            folder.mkdir()
            os.mkfifo(folder / "a.h5")
            file["scans/0000/surface"] = h5py.ExternalLink("store/a.h5", "/surface")

        self.reject(link, "not in its store")

    def test_pipes_and_devices_are_not_opened(self):
        pipe = Path(self.temporary_folder()) / "pipe"
        os.mkfifo(pipe)
        for path in (pipe, "/dev/zero", pipe.parent):
            self.assertIn("folder, device or pipe", guard.problem(str(path)))

    def test_a_claim_of_more_than_the_file_holds_is_rejected(self):
        self.reject(lambda file: file.create_dataset("map", (100000, 100000), "f8"), "claims more")

    def test_a_reader_that_crashes_or_never_returns_is_a_damaged_file(self):
        path = str(self.file(lambda file: None))

        def work_for_ever():
            while True:
                pass

        def one_second(size):
            resource.setrlimit(resource.RLIMIT_CPU, (1, 1))

        for ending in (os.abort, work_for_ever):
            guard.forget()
            with mock.patch.multiple(guard, _read_all=lambda file, share: ending(), _limit=one_second):
                self.assertEqual(guard.problem(path), "a damaged file")

    def test_files_tried_together_take_one_copy(self):
        paths = [str(self.file(lambda file: None, f"{name}.h5")) for name in "abc"]
        with mock.patch("os.fork", side_effect=os.fork) as fork:
            guard.try_together([*paths, paths[0]])
            self.assertEqual([guard.problem(path) for path in paths], ["", "", ""])
        self.assertEqual(fork.call_count, 1)

    def test_of_files_tried_together_the_damaged_one_alone_is_rejected(self):
        paths = [str(self.file(lambda file: None, name)) for name in ("a.h5", "bad.h5", "c.h5")]
        pipe = os.path.join(self.temporary_folder(), "pipe")
        os.mkfifo(pipe)

        def abort_over_one(file, share):
            if file.filename.endswith("bad.h5"):
                os.abort()

        with mock.patch.multiple(guard, _read_all=abort_over_one):
            guard.try_together([*paths, pipe])
            found = [guard.problem(path) for path in (*paths, pipe)]
        self.assertEqual(found, ["", "a damaged file", "", "a folder, device or pipe"])

    def test_no_process_is_a_rejection(self):
        path = str(self.file(lambda file: None))
        guard.forget()
        with mock.patch("os.fork", side_effect=OSError(11, "Resource temporarily unavailable")):
            self.assertIn("no process", guard.problem(path))
        guard.forget()

    def test_a_bit_that_turned_over_in_a_sealed_file_is_found(self):
        path = self.file(lambda file: file.attrs.update({"scalar": 0.125}))
        content = path.read_bytes()
        sealed = content + b"tabor-sha256 " + hashlib.sha256(content).hexdigest().encode() + b"\n"
        for bit in [None, *range(3, 8 * len(sealed), 8 * len(sealed) // 40)]:
            changed = bytearray(sealed)
            if bit is not None:
                changed[bit // 8] ^= 1 << bit % 8
            path.write_bytes(changed)
            guard.forget()
            # Without its first word the line is no seal, and the bytes before it are as they were.
            is_sealed = changed[len(content):].startswith(b"tabor-sha256 ")
            found = "not those that were written" in guard.problem(str(path))
            self.assertEqual(found, bit is not None and is_sealed, bit)
        guard.forget()

    def test_a_damaged_store_file_is_left_out_and_named(self):
        def damage(folder):
            path = next((folder / "store").glob("film-*"))
            path.write_bytes(path.read_bytes()[:200])

        source = self.study(change=damage)
        draw(source)
        self.assertTrue(any("film-" in warning and "damaged" in warning for warning in source.warnings))


class Texts(unittest.TestCase):
    def test_bytes_that_are_not_utf8_are_shown(self):
        self.assertEqual(errors.readable("a\udcff\u00b5"), "a\\xff\u00b5")
        self.assertEqual(hdf.text(b"a\xff"), "a\\xff")
        self.assertEqual(errors.printable("a\x1b\u009b\u202e\n\udcff\u00b5"), "a\\x1b\\u{9b}\\u{202e}\\x0a\\xff\u00b5")

    def test_no_cell_is_a_formula(self):
        text = output.table_text({"=a": ["=1+1", "-1", "@x", "'=1", "plain"], "b": [-1.5, 2, 3, 4, 5]})
        self.assertEqual(text, "'=a,b\n'=1+1,-1.5\n-1,2\n'@x,3\n''=1,4\nplain,5\n")


if __name__ == "__main__":
    unittest.main()
