"""tools/check/headers finds what it is there to find: each test breaks one rule in a small header."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

CHECK = pathlib.Path(__file__).resolve().parents[2] / "tools/check/headers"

SOUND = """#pragma once

#include <vector>

// Computes the mean of values, and their scatter.
namespace tabor {

/// Returns the mean of the values.
double mean(const std::vector<double>& values);

/// Returns the scatter of the values.
double scatter(const std::vector<double>& values);

}  // namespace tabor
"""
ALONE = """#pragma once

namespace tabor {

/// Returns the mean of two values.
double mean(double a, double b);

}  // namespace tabor
"""


def run_check(text, source=""):
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / "src/tabor/core").mkdir(parents=True)
        if text is not None:
            (root / "src/tabor/core/a.hpp").write_text(text)
            (root / "src/tabor/core/a.cpp").write_text(source)
        return subprocess.run([sys.executable, CHECK, "--root", root], capture_output=True, text=True, check=False)


class Headers(unittest.TestCase):
    def assert_accepted(self, text):
        result = run_check(text)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def assert_rejected(self, complaint, line, text):
        result = run_check(text)
        self.assertEqual(result.returncode, 1, result.stdout)
        self.assertIn(f"src/tabor/core/a.hpp:{line}: ", result.stdout)
        self.assertIn(complaint, result.stdout)

    def replaced(self, old, new):
        self.assertIn(old, SOUND)
        return SOUND.replace(old, new)

    def test_a_sentence_before_the_namespace_opens_a_header(self):
        self.assert_accepted(SOUND)
        self.assert_rejected("no sentence opens", 1, self.replaced("// Computes the mean of values, and their scatter.\n", ""))

    def test_the_comment_of_the_only_declaration_opens_a_header_too(self):
        self.assert_accepted(ALONE)
        self.assert_rejected("no sentence opens", 1, ALONE.replace("/// Returns the mean of two values.\n", ""))

    def test_an_opening_is_a_sentence(self):
        for opening in ("mean", "Means.", "mean and scatter of some values", "Whether the values scatter much."):
            self.assert_rejected("write a sentence", 5, self.replaced("Computes the mean of values, and their scatter.", opening))

    def test_comments_begin_with_subject_and_verb(self):
        for beginning in ("What of the values is their mean.", "Whether the values scatter.", "Of the values.",
                          "Those of the values.", "The same of the values."):
            text = self.replaced("Returns the scatter of the values.", beginning)
            self.assert_rejected("begin with subject and verb", 11, text)

    def test_a_beginning_inside_a_comment_is_no_matter(self):
        self.assert_accepted(self.replaced("/// Returns the scatter of the values.", "/// Returns the scatter of the values.\n/// Those of one value have none."))

    def test_words_of_the_glossary_are_used(self):
        for word in ("kept", "doubts", "usual", "passage", "refused", "rooms", "Room", "makes no sense"):
            self.assert_rejected(f"'{word}' in a comment", 8, self.replaced("Returns the mean of the values.", f"Returns the {word} mean."))

    def test_words_of_comments_behind_code_count_too(self):
        self.assert_rejected("'kept' in a comment; write stored", 9, self.replaced("values);\n\n/// Returns the sc", "values);  ///< not kept\n\n/// Returns the sc"))

    def test_names_and_code_may_have_any_word(self):
        self.assert_accepted(self.replaced("Returns the mean of the values.", 'Returns "doubt", `kept`, Doubts::usual, room() or kept_values.'))
        self.assert_accepted(self.replaced("double mean(", "double kept("))
        self.assert_accepted(self.replaced("namespace tabor {\n", 'namespace tabor {\nconst char* const kPage = "https://tabor/kept";\n'))

    def test_comments_of_sources_count_too(self):
        self.assertEqual(run_check(SOUND, "// Opens no header.\n").returncode, 0)
        for comment in ("/// Whether the values scatter.\n", "int n = 0;  // kept for later\n"):
            result = run_check(SOUND, comment)
            self.assertEqual(result.returncode, 1, comment)
            self.assertIn("src/tabor/core/a.cpp:1: ", result.stdout)

    def test_an_empty_tree_is_not_a_success(self):
        self.assertEqual(run_check(None).returncode, 1)


if __name__ == "__main__":
    unittest.main()
