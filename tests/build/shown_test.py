"""tools/check/shown finds what it is there to find: each test shows one thing that a program does not print."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

CHECK = pathlib.Path(__file__).resolve().parents[2] / "tools/check/shown"
PROGRAM = """#!/bin/sh
printf 'one\\ntwo   2.5\\nthree\\nfour and more\\n'
echo 'half done' >&2
echo 'warning: steep' >&2
[ "$1" != fail ]
"""


def check(block):
    """(exit status, printed) of the check for a page with one block."""
    with tempfile.TemporaryDirectory() as folder:
        program, page = pathlib.Path(folder, "program"), pathlib.Path(folder, "page.md")
        program.write_text(PROGRAM)
        program.chmod(0o755)
        page.write_text(f"# Page\n\n```console\n{block}\n```\n")
        done = subprocess.run([sys.executable, CHECK, program, page], capture_output=True, text=True, check=False)
    if done.stderr:
        raise AssertionError(done.stderr)
    return done.returncode, done.stdout


class Shown(unittest.TestCase):
    def assert_accepted(self, block):
        self.assertEqual(check(block)[0], 0, check(block)[1])

    def assert_rejected(self, complaint, block):
        status, printed = check(block)
        self.assertEqual(status, 1)
        self.assertIn(complaint, printed)

    def test_the_whole_output_is_accepted(self):
        self.assert_accepted("$ tabor\none\ntwo   2.5\nthree\nfour and more\nwarning: steep")

    def test_lines_may_be_left_out_and_cut_where_the_page_says_so(self):
        self.assert_accepted("$ tabor\n...\ntwo   2.5\n...\nfour ...\n...")
        self.assert_accepted("$ tabor\none\n...")

    def test_another_number_is_found(self):
        self.assert_rejected("page.md:4: tabor: shown: 'two   2.6'; printed: 'two   2.5'", "$ tabor\none\ntwo   2.6\n...")
        self.assert_rejected("shown: 'two   2.6'; printed: 'two   2.5'", "$ tabor\n...\ntwo   2.6\n...")

    def test_lines_left_out_silently_are_found(self):
        self.assert_rejected("shown: 'three'", "$ tabor\none\nthree\n...")
        self.assert_rejected("write '...' where lines are left out", "$ tabor\none\ntwo   2.5")

    def test_warnings_come_last_and_progress_does_not_count(self):
        self.assert_accepted("$ tabor\n...\nwarning: steep")
        self.assert_rejected("shown: 'half done'", "$ tabor\n...\nhalf done\n...")

    def test_the_order_counts(self):
        self.assert_rejected("shown: 'one'", "$ tabor\n...\nthree\n...\none\n...")

    def test_a_command_that_fails_is_found(self):
        self.assert_rejected("exit status 1", "$ tabor fail\n...")


if __name__ == "__main__":
    unittest.main()
