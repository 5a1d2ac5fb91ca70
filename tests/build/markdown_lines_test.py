"""tools/markdown_lines.py wraps paragraphs and entries of lists, and leaves everything else as it is."""

import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools"))

from markdown_lines import wrapped  # noqa: E402


class Wrapped(unittest.TestCase):
    def assert_stays(self, text, width=20):
        self.assertEqual(wrapped(text, width), text)

    def test_a_paragraph_ends_at_the_width(self):
        self.assertEqual(wrapped("one two three four five six\nseven\n", 14), "one two three\nfour five six\nseven\n")

    def test_a_paragraph_that_fits_stays(self):
        self.assert_stays("one\ntwo\n")

    def test_entries_of_a_list_are_indented_and_wrapped_alone(self):
        self.assertEqual(wrapped("- one two three four\n- five\n", 12), "- one two\n  three four\n- five\n")
        self.assertEqual(wrapped("10. one two three\n", 9), "10. one\n    two\n    three\n")

    def test_no_line_begins_as_something_else(self):
        self.assertEqual(wrapped("speed is 12 > 3 here\n", 12), "speed is\n12 > 3 here\n")
        self.assertEqual(wrapped("it was so in 1987. Then - as - now\n", 13), "it was so\nin 1987.\nThen - as -\nnow\n")

    def test_code_in_a_line_is_not_broken(self):
        self.assertEqual(wrapped("type `tabor info a.x3p` now\n", 12), "type\n`tabor info a.x3p`\nnow\n")

    def test_tables_code_headings_and_equations_stay(self):
        for text in ("| a long row of a table | b |\n|---|---|\n", "```\na long line of code in a block\n```\n",
                     "    a long line of code that is indented\n", "# a long heading of many words\n",
                     "$$\n\\frac{a}{b} + \\frac{c}{d} = \\int_0^1\n$$\n", "---\ntitle: a long title of a page\n---\n"):
            self.assert_stays(text)

    def test_nothing_but_blanks_changes_and_the_second_time_nothing(self):
        text = "Words of *many* kinds: `a b`, [a link](page.md), 3 - 2, and more.\n\n1. First of all this.\n2. Then that one.\n"
        once = wrapped(text, 24)
        self.assertEqual("".join(once.split()), "".join(text.split()))
        self.assertEqual(wrapped(once, 24), once)


if __name__ == "__main__":
    unittest.main()
