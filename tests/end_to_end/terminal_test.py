"""Completion in the shells themselves, and manual pages as the programs that show them read them."""

import os
import pty
import select
import shutil
import subprocess
import time
import unittest

from program import TABOR, ProgramTest

ASK_BASH = """
source "$1"
COMP_LINE=$2 COMP_POINT=${#2}
_tabor
printf '%s\\n' "${COMPREPLY[@]}"
"""


def needs(program):
    return unittest.skipUnless(shutil.which(program), f"{program} is not installed")


class Terminal(ProgramTest):
    def script_of(self, shell):
        done = self.tabor("completion", shell)
        self.assertEqual(done.returncode, 0, done.stderr)
        script = self.folder / f"tabor.{shell}"
        script.write_text(done.stdout)
        return script

    def run_quietly(self, *words):
        """Output of a program that has nothing to complain about."""
        done = subprocess.run([*map(str, words)], cwd=self.folder, capture_output=True, text=True, timeout=60, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""), words)
        return done.stdout


class Bash(Terminal):
    def replies(self, line):
        script = self.script_of("bash")
        return self.run_quietly("bash", "--norc", "-c", ASK_BASH, "bash", script, line).split()

    def test_completes_verbs(self):
        self.assertEqual(self.replies("tabor fric"), ["friction"])
        self.assertEqual(sorted(self.replies("tabor co")), ["combine", "completion", "contact", "convert"])
        self.assertEqual(self.replies("tabor help mater"), ["materials"])

    def test_completes_options_of_the_verb(self):
        self.assertEqual(self.replies("tabor contact a.x3p --youngs"), ["--youngs-modulus"])
        self.assertEqual(self.replies("tabor info a.x3p --youngs"), [])
        self.assertIn("--help", self.replies("tabor info -"))

    def test_completes_choices(self):
        self.assertEqual(self.replies("tabor contact a.x3p --solver "), ["fast", "polonsky-keer"])
        self.assertEqual(self.replies("tabor contact a.x3p --edges=e"), ["end"])
        self.assertEqual(self.replies("tabor contact a.x3p --material steel-"),
                         [line.split()[0] for line in self.tabor("materials").stdout.splitlines()
                          if line.startswith("steel-") and line.split()[1:2] and line.split()[1][0].isdigit()])
        self.assertEqual(self.replies("tabor lubricate a.x3p --model dr"), ["droplets"])
        self.assertEqual(sorted(self.replies("tabor ehl ")), ["impact", "line", "point", "squeeze"])
        self.assertEqual(self.replies("tabor --explain spill"), ["spill-over"])

    def test_leaves_out_what_readline_has_before_a_colon(self):
        self.assertEqual(self.replies("tabor contact a.x3p --highpass gauss:2"), ["250um"])

    def test_offers_nothing_where_a_number_stands(self):
        (self.folder / "7_files").touch()
        self.assertEqual(self.replies("tabor contact a.x3p --pressure "), [])

    def test_completes_files_as_one_types(self):
        """At a terminal: with blanks in their names, and none behind an option that takes a number."""
        script = self.script_of("bash")
        (self.folder / "my scan.x3p").touch()
        typed = [f"source {script}", "tabor() { printf '<%s>' \"$@\"; echo; }", "tabor info my\t", "tabor contact --press\t7MPa my\t",
                 "exit"]
        shown = self.at_a_terminal(typed)
        self.assertIn("<info><my scan.x3p>", shown)
        self.assertIn("<contact><--pressure><7MPa><my scan.x3p>", shown)

    def at_a_terminal(self, lines):
        process, terminal = pty.fork()
        if process == 0:
            os.chdir(self.folder)
            os.execvp("bash", ["bash", "--norc", "--noprofile", "-i"])
        shown = ""
        deadline = time.monotonic() + 60
        for line in lines:
            shown += self.shown_until_quiet(terminal, deadline)
            os.write(terminal, (line + "\n").encode())
        shown += self.shown_until_quiet(terminal, deadline)
        os.close(terminal)
        os.waitpid(process, 0)
        return shown

    @staticmethod
    def shown_until_quiet(terminal, deadline):
        """What appears until nothing has for half a second."""
        shown = b""
        while time.monotonic() < deadline and select.select([terminal], [], [], 0.5)[0]:
            try:
                shown += os.read(terminal, 65536)
            except OSError:  # the shell has ended
                break
        return shown.decode(errors="replace")


class OtherShells(Terminal):
    @needs("zsh")
    def test_zsh_reads_its_script(self):
        self.run_quietly("zsh", "-n", self.script_of("zsh"))

    @needs("fish")
    def test_fish_completes(self):
        script = self.script_of("fish")
        (self.folder / "scan.x3p").touch()

        def replies(line):
            lines = self.run_quietly("fish", "--no-config", "-c", f"source {script}; complete -C '{line}'").splitlines()
            return [one.split("\t")[0] for one in lines]

        self.assertEqual(replies("tabor fric"), ["friction"])
        self.assertEqual(replies("tabor contact --youngs"), ["--youngs-modulus"])
        self.assertEqual(replies("tabor contact --solver "), ["fast", "polonsky-keer"])
        self.assertEqual(replies("tabor info sca"), ["scan.x3p"])

    def test_of_another_name_is_a_usage_error(self):
        done = self.tabor("completion", "bsh")
        self.assertEqual(done.returncode, 2)
        self.assertIn("did you mean 'bash'", done.stderr)


class ManualPages(Terminal):
    def setUp(self):
        super().setUp()
        done = self.tabor("man", "-o", "man1")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.pages = sorted((self.folder / "man1").iterdir())

    def test_there_is_one_for_the_program_and_each_verb(self):
        names = {page.name for page in self.pages}
        self.assertIn("tabor.1", names)
        overview = self.tabor("--help").stdout
        verbs = {line.split()[0] for line in overview.splitlines() if line.startswith("  ") and line[2] != " "}
        self.assertEqual(names - {"tabor.1"}, {f"tabor-{verb}.1" for verb in verbs})
        self.assertEqual(self.tabor("man", "contact").stdout, (self.folder / "man1/tabor-contact.1").read_text())

    @needs("groff")
    def test_groff_has_no_warning(self):
        for page in self.pages:
            text = self.run_quietly("groff", "-man", "-ww", "-Tutf8", "-P-cbou", page)
            self.assertIn("EXIT STATUS", text)

    @needs("mandoc")
    def test_mandoc_has_no_warning_but_of_the_date(self):
        """Pages have a version in place of a date, so that they are the same whenever they are made."""
        for page in self.pages:
            done = subprocess.run(["mandoc", "-T", "lint", "-W", "warning", page], capture_output=True, text=True, check=False)
            others = [line for line in (done.stdout + done.stderr).splitlines() if "missing date" not in line]
            self.assertEqual(others, [])

    @needs("man")
    def test_man_shows_options_as_they_are_typed(self):
        text = self.run_quietly("env", "MANWIDTH=80", "man", "--local-file", "--encoding=UTF-8", self.folder / "man1/tabor-contact.1")
        self.assertIn("--youngs-modulus E", text)
        self.assertIn("tabor contact surfaces/edt_before.x3p", text)


if __name__ == "__main__":
    unittest.main()
