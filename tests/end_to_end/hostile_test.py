"""Downloaded folders: nothing in them is run, followed, waited for or written to a terminal as it is."""

import csv
import json
import os
import pathlib
import resource
import shutil
import signal
import socket
import subprocess
import unittest

from program import ALUMINIUM, SOURCE, TABOR, ProgramTest

try:
    import h5py
    import numpy as np
except ImportError:
    h5py = None

MODULES = ["jinja2", "h5py", "numpy", "matplotlib", "sitecustomize", "usercustomize", "argparse", "csv"]
STUDY = """shear_strength = "70 MPa"
[material]
youngs_modulus = "70 GPa"
poissons_ratio = 0.33
[treatment]
steps = ["level=mean"]
[sweep]
mean_pressure = ["5 MPa"]
lubricant_density = ["0.9 g/m^2"]
[[scan]]
file = {files}
"""


def limit_memory():
    resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))


class Hostile(ProgramTest):
    def tabor(self, *words, **options):
        return super().tabor(*words, **{"timeout": 60, **options})

    def contact(self, name="contact.h5"):
        self.generate("scan.h5", "edt", 24)
        done = self.tabor("contact", "scan.h5", "--pressure", "1MPa", *ALUMINIUM, "-o", name)
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.folder / name


@unittest.skipIf(h5py is None, "needs python3-h5py")
class Folder(Hostile):
    """`tabor report` in a folder that would like to be run."""

    def put_traps(self, folder):
        mark = self.folder / "mark"
        code = f"open({str(mark)!r}, 'a').write(__file__ + '\\n')\n"
        (folder / "tabor/report").mkdir(parents=True)
        for name in ["tabor/__init__", "tabor/report/__init__", "tabor/report/__main__", "tabor/report/cli", *MODULES]:
            (folder / f"{name}.py").write_text(code)
        for name in ["python3", "python", "gwyddion", "sh"]:
            (folder / name).write_text(f"#!/bin/sh\necho {name} >> {mark}\n")
            (folder / name).chmod(0o755)
        (folder / "matplotlibrc").write_text("backend: module://jinja2\n")
        return mark

    def hostile_environment(self, folder):
        return {**os.environ, "PYTHONPATH": f".:{folder}", "PYTHONHOME": str(folder), "PYTHONSTARTUP": "csv.py",
                "PYTHONUSERBASE": str(folder), "PATH": f".::/usr/bin:{os.environ['PATH']}"}

    def report(self, program, folder, **options):
        result = os.path.relpath(self.generate("scan.h5", "edt", 24), folder)
        done = subprocess.run([program, "report", result, "--no-html"], cwd=folder, capture_output=True, text=True,
                              timeout=120, check=False, **options)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("topography.png", done.stdout)

    def test_runs_nothing_of_it(self):
        hostile = self.folder / "hostile"
        mark = self.put_traps(hostile)
        self.report(TABOR, hostile, env=self.hostile_environment(hostile))
        self.assertFalse(mark.exists(), mark.exists() and mark.read_text())

    def test_takes_no_interpreter_from_it(self):
        hostile = self.folder / "hostile"
        mark = self.put_traps(hostile)
        self.report(TABOR, hostile, env={**self.hostile_environment(hostile), "TABOR_PYTHON": "python3"})
        self.assertFalse(mark.exists(), mark.exists() and mark.read_text())

    def test_takes_no_converter_from_it(self):
        hostile = self.folder / "hostile"
        mark = self.put_traps(hostile)
        (hostile / "unknown.dat").write_bytes(b"\1\2\3")
        done = subprocess.run([TABOR, "info", "unknown.dat"], cwd=hostile, capture_output=True, text=True, check=False,
                              timeout=120, env={**os.environ, "PATH": ".::relative"})
        self.assert_rejected(done, 3, "unknown.dat")
        self.assertFalse(mark.exists())

    def test_works_in_the_source_tree_and_installed(self):
        self.report(TABOR, SOURCE)
        prefix = self.folder / "prefix"
        (prefix / "bin").mkdir(parents=True)
        shutil.copy(TABOR, prefix / "bin")
        package = prefix / "share/tabor/python/tabor/report"
        shutil.copytree(SOURCE / "python/tabor/report", package)
        shutil.copy(SOURCE / "src/tabor/results/references.bib", package)
        (package / "cli.py").write_text((package / "cli.py").read_text() + "\nprint('the installed one')\n")
        done = subprocess.run([prefix / "bin/tabor", "report", self.generate("scan.h5")], capture_output=True, text=True,
                              timeout=120, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("the installed one", done.stdout)


class Interpreter(Hostile):
    """However Python ends, the report ends in one line."""

    def with_python(self, script):
        path = self.folder / "python"
        path.write_text(f"#!/bin/sh\n{script}\n")
        path.chmod(0o755)
        return {**os.environ, "TABOR_PYTHON": str(path)}

    def test_that_crashes_is_a_result_that_cannot_be_drawn(self):
        done = self.tabor("report", "result.h5", env=self.with_python("kill -SEGV $$"))
        self.assert_rejected(done, 3, "result.h5", "signal 11")

    def test_that_fails_shows_its_last_line_alone(self):
        script = "echo 'Traceback (most recent call last):' >&2; echo 'ValueError: a\033[2J' >&2; exit 1"
        done = self.tabor("report", "result.h5", env=self.with_python(script))
        self.assert_rejected(done, 1, "ValueError: a\\x1b[2J")

    def test_that_is_not_found_is_named(self):
        done = self.tabor("report", "result.h5", env={**os.environ, "TABOR_PYTHON": "no-such-python"})
        self.assert_rejected(done, 3, "no-such-python")

    def test_is_ended_by_an_interrupt(self):
        mark = self.folder / "begun"
        environment = self.with_python(f"touch {mark}; sleep 60")
        process = subprocess.Popen([TABOR, "report", "result.h5", "--quiet"], cwd=self.folder, env=environment,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        code, _, message = self.stop_when(mark.exists, signal.SIGINT, process)
        self.assertEqual((code, message), (130, "tabor: interrupted\n"))


@unittest.skipIf(h5py is None, "needs python3-h5py")
class Hdf5(Hostile):
    """Values that lie anywhere but in the file."""

    def scan(self, change):
        path = self.generate("scan.h5", "edt", 16)
        with h5py.File(path, "a") as file:
            change(file)
        return path.name

    def reject(self, name, part="", verbs=("info", "report")):
        for words in ([verb, name] for verb in verbs):
            self.assert_rejected(self.tabor(*words, preexec_fn=limit_memory), 3, name, part)

    def replace(self, file, **parts):
        attributes = dict(file["surface/height"].attrs)
        del file["surface/height"]
        made = file.create_dataset("surface/height", **parts)
        made.attrs["units"] = attributes["units"]

    def test_in_another_file_as_it_is(self):
        def raw(file):
            self.replace(file, shape=(16, 16), dtype="u1", external=[("/etc/passwd", 0, 256)])

        self.reject(self.scan(raw), "other files")

    def test_in_a_pipe(self):
        os.mkfifo(self.folder / "pipe")

        def raw(file):
            self.replace(file, shape=(16, 16), dtype="u1", external=[("pipe", 0, 256)])

        self.reject(self.scan(raw), "other files")

    def test_in_data_sets_of_other_files(self):
        self.generate("other.h5", "edt", 16)
        os.mkfifo(self.folder / "pipe.h5")
        for source in ("other.h5", "pipe.h5"):
            def virtual(file, source=source):
                del file["surface/height"]
                layout = h5py.VirtualLayout((16, 16), "f8")
                layout[:] = h5py.VirtualSource(source, "surface/height", (16, 16))
                file.create_virtual_dataset("surface/height", layout)

            self.reject(self.scan(virtual), "other files")

    def test_behind_links(self):
        self.generate("other.h5", "edt", 16)
        (self.folder / "store").mkdir()
        os.mkfifo(self.folder / "pipe.h5")
        os.mkfifo(self.folder / "store/pipe.h5")
        for target in ("other.h5", str(self.folder / "other.h5"), "pipe.h5", "store/pipe.h5", "/dev/zero"):
            def link(file, target=target):
                del file["surface/height"]
                file["surface/height"] = h5py.ExternalLink(target, "/surface/height")

            def soft(file, target=target):
                del file["surface/height"]
                file["away"] = h5py.ExternalLink(target, "/surface")
                file["surface/height"] = h5py.SoftLink("/away/height")

            self.reject(self.scan(link))
            self.reject(self.scan(soft), verbs=["info"])

    def test_a_link_inside_the_file_is_followed(self):
        def soft(file):
            file.move("surface/height", "kept")
            file["surface/height"] = h5py.SoftLink("/kept")

        self.assertEqual(self.tabor("info", self.scan(soft)).returncode, 0)

    def test_a_result_that_lacks_something_is_rejected_in_one_line(self):
        for place in ("surface/height", "surface/x", "surface", "states/0000/gap"):
            path = self.contact()
            with h5py.File(path, "a") as file:
                self.assertIn(place, file)
                del file[place]
            done = self.tabor("report", path.name)
            if done.returncode == 0:  # a map less is drawn without it
                self.assertIn("states/", place)
                continue
            self.assert_rejected(done, 3, path.name)

    def test_sources_of_methods_are_not_looked_for_elsewhere(self):
        with h5py.File(self.folder / "result.h5", "w") as file:
            file.attrs["format"] = "tabor"
            os.mkfifo(self.folder / "pipe.h5")
            file["table"] = h5py.ExternalLink("pipe.h5", "/table")
        self.assertLess(self.tabor("cite", "result.h5").returncode, 4)


class NoFiles(Hostile):
    """Pipes, devices, sockets and folders where a file is expected: rejected at once, nowhere waited for."""

    def setUp(self):
        super().setUp()
        os.mkfifo(self.folder / "pipe.h5")
        os.symlink("/dev/zero", self.folder / "zero.h5")
        (self.folder / "folder.h5").mkdir()
        listening = socket.socket(socket.AF_UNIX)
        self.addCleanup(listening.close)
        before = os.getcwd()
        os.chdir(self.folder)  # names of sockets are short
        listening.bind("socket.h5")
        os.chdir(before)
        self.names = ["pipe.h5", "zero.h5", "folder.h5", "socket.h5"]

    def reject(self, *words, **options):
        self.assert_rejected(self.tabor(*words, timeout=20, preexec_fn=limit_memory, **options), 3)

    def test_as_scans_and_results(self):
        for name in self.names:
            for words in (["info", name], ["params", name], ["cite", name], ["convert", name, "out.h5"],
                          ["psd", name], ["combine", name, name, "-o", "out.h5"],
                          ["ehl", "line", name], ["sweep", name]):
                if words[0] == "params":
                    self.assertEqual(self.tabor(*words, timeout=20).returncode, 3, words)
                    continue
                self.reject(*words)

    @unittest.skipIf(h5py is None, "needs python3-h5py")
    def test_as_results_to_draw(self):
        for name in self.names[:2]:
            self.reject("report", name)

    def test_in_studies(self):
        for name in self.names:
            (self.folder / "study.toml").write_text(STUDY.format(files=json.dumps([name])))
            self.reject("sweep", "study.toml", "-o", "out", "--quiet")
        (self.folder / "study.toml").write_text(STUDY.format(files='["*.h5"]'))
        self.reject("sweep", "study.toml", "-o", "out", "--quiet")
        self.generate("scan.gsf", "edt", 16)
        for name in self.names:
            (self.folder / "study.toml").write_text(
                STUDY.format(files='["scan.gsf"]') + f'[experiment]\nfile = "{name}"\n')
            self.reject("sweep", "study.toml", "-o", "out", "--quiet")


class Names(Hostile):
    """Names of files that terminals, spreadsheets or JSON would take for something else."""

    def test_reach_no_terminal(self):
        for name in ("a\u009b2J\u202e.gsf", "b\x1b[31m\u200b.gsf", "c\u2066.gsf"):
            self.generate("plain.gsf", "edt", 16)
            os.rename(self.folder / "plain.gsf", self.folder / name)
            for words in (["info", name], ["contact", name, "--pressure", "1MPa", *ALUMINIUM], ["params", name, name]):
                done = self.tabor(*words)
                self.assertEqual(done.returncode, 0, done.stderr)
                shown = (done.stdout + done.stderr).replace("\n", "")
                self.assertTrue(all(letter.isprintable() for letter in shown), [c for c in shown if not c.isprintable()])
            done = self.tabor("info", name, "--json")
            self.assertEqual(json.loads(done.stdout)["scan"]["path"], name)
            self.assertTrue(all(letter.isprintable() or letter == "\n" for letter in done.stdout))

    def test_that_are_not_utf8_are_shown(self):
        name = b"scan\xff.gsf"
        self.generate("plain.gsf", "edt", 16)
        os.rename(self.folder / "plain.gsf", os.path.join(os.fsencode(self.folder), name))
        done = subprocess.run([TABOR, "info", name], cwd=self.folder, capture_output=True, check=False, timeout=60)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("scan\\xff.gsf", done.stdout.decode("utf-8"))
        done = subprocess.run([TABOR, "info", name, "--json"], cwd=self.folder, capture_output=True, check=False, timeout=60)
        self.assertIn("scan", json.loads(done.stdout.decode("utf-8"))["scan"]["path"])

    @unittest.skipIf(h5py is None, "needs python3-h5py")
    def test_that_are_not_utf8_are_drawn(self):
        self.generate("plain.gsf", "edt", 16)
        scan, result = b"scan\xff.gsf", b"result\xff.h5"
        os.rename(self.folder / "plain.gsf", os.path.join(os.fsencode(self.folder), scan))
        subprocess.run([TABOR, "convert", scan, result], cwd=self.folder, capture_output=True, check=True, timeout=60)
        done = subprocess.run([TABOR, "report", result, "--json"], cwd=self.folder, capture_output=True, check=False,
                              timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(json.loads(done.stdout.decode("utf-8"))["files"])
        page = pathlib.Path(os.fsdecode(os.path.join(os.fsencode(self.folder), b"result\xff_report/report.html")))
        self.assertIn("scan\\xff.gsf", page.read_text(encoding="utf-8"))

    def test_are_no_formulas(self):
        names = ["=1+1.gsf", "@a.gsf", "+b.gsf", "-c.gsf", "'=d.gsf", "e.gsf"]
        self.generate("plain.gsf", "edt", 16)
        for name in names:
            shutil.copy(self.folder / "plain.gsf", self.folder / name)
        (self.folder / "study.toml").write_text(STUDY.format(files=json.dumps(names)))
        done = self.tabor("sweep", "study.toml", "-o", "out", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.folder / "out/results.csv", newline="") as file:
            cells = [row["scan"] for row in csv.DictReader(file)]
        self.assertEqual(cells, ["'=1+1.gsf", "'@a.gsf", "'+b.gsf", "'-c.gsf", "''=d.gsf", "e.gsf"])


if __name__ == "__main__":
    unittest.main()
