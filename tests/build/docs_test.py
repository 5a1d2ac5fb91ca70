"""tools/check/docs finds what it is there to find: each test breaks one rule in a small tree."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

CHECK = pathlib.Path(__file__).resolve().parents[2] / "tools/check/docs"

SOUND = {
    "docs/theory.md": "# Theory\n\nSee [Contact](../src/tabor/contact/README.md#contact) and `contact/solve.hpp`.\n",
    "src/tabor/contact/README.md": "# contact\n\nSolves contacts.\n\n- `solve.hpp`, tested by `tests/contact/solve_test.cpp`.\n",
    "src/tabor/contact/solve.hpp": "#pragma once\n",
    "tests/contact/solve_test.cpp": "",
}


def findings(changes):
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name, text in {**SOUND, **changes}.items():
            path = root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            if text is not None:
                path.write_text(text)
        result = subprocess.run([sys.executable, CHECK, "--root", root], capture_output=True, text=True, check=False)
    if result.stderr:
        raise AssertionError(result.stderr)
    return [line for line in result.stdout.splitlines() if not line.endswith(" is missing")]  # of the project's documents


class Docs(unittest.TestCase):
    def assert_accepted(self, changes):
        self.assertEqual(findings(changes), [])

    def assert_rejected(self, complaint, changes):
        found = findings(changes)
        self.assertEqual(len(found), 1, found)
        self.assertIn(complaint, found[0])

    def page(self, text):
        return {"docs/theory.md": "# Theory\n\n" + text + "\n"}

    def test_a_sound_tree_is_accepted(self):
        self.assert_accepted({})

    def test_links_lead_to_files_and_headings(self):
        self.assert_rejected("link to gone.md", self.page("[gone](gone.md)"))
        self.assert_rejected("no such heading", self.page("[gone](#gone)"))

    def test_paths_in_code_exist(self):
        self.assert_rejected("docs/theory.md:3: tools/gone does not exist", self.page("`tools/gone` does it."))
        self.assert_rejected("docs/theory.md:5: tests/contact/gone_test.cpp", self.page("Run\n\n    tests/contact/gone_test.cpp --all"))
        self.assert_rejected("src/tabor/gone", {"README.md": "# tabor\n\n`src/tabor/gone`\n"})

    def test_prose_ends_at_column_100(self):
        words = "word " * 30
        self.assert_rejected("docs/theory.md:3: longer than 100 columns", self.page(words.strip()))
        self.assert_rejected("docs/theory.md:5: longer than 100 columns", self.page("Words.\n\n- " + words.strip()))
        self.assert_accepted(self.page(f"| {words}|\n|---|\n\n    {words}\n\n```\n{words}\n```\n\n$$\n{words}\n$$"))

    def test_patterns_and_names_for_any_name_are_no_paths(self):
        self.assert_accepted(self.page("`tests/contact/*.cpp`, `tests/<module>`, `tests/contact/NAME_test.cpp`, `src/tabor/contact/`"))

    def test_files_of_a_module_exist(self):
        self.assert_rejected("contact/gone.hpp does not exist", self.page("`contact/gone.hpp`"))
        self.assert_accepted(self.page("`nlohmann/json.hpp`"))

    def test_decisions_and_the_changelog_may_name_what_is_gone(self):
        self.assert_accepted({"docs/decisions/001-a.md": "`tools/gone`\n", "CHANGELOG.md": "`tools/gone`\n"})

    def test_every_folder_of_sources_has_a_readme(self):
        self.assert_rejected("src/tabor/elastic/README.md: is missing; say", {"src/tabor/elastic/line.cpp": ""})

    def test_a_readme_of_a_module_is_short(self):
        self.assert_rejected("README.md:26: 27 lines", {"src/tabor/contact/README.md": "# contact\n" + 26 * "\n"})

    def test_files_that_a_readme_of_a_module_names_exist(self):
        self.assert_rejected("README.md:3: gone.hpp does not exist", {"src/tabor/contact/README.md": "# contact\n\n`gone.hpp`\n"})

    def test_the_index_links_to_every_page(self):
        index = {"docs/README.md": "# Documents\n\n[theory](theory.md)\n"}
        self.assert_accepted(index)
        self.assert_rejected("no link to films.md", {**index, "docs/films.md": "# Films\n"})

    def test_the_version_is_that_of_the_build(self):
        tree = {"CMakeLists.txt": "project(tabor VERSION 1.2.3 LANGUAGES CXX)\n", "CITATION.cff": "version: 1.2.3\n",
                "CHANGELOG.md": "# Changelog\n\n## 1.2.3\n\n## 1.2.2\n", "debian/changelog": "tabor (1.2.3-1) UNRELEASED; urgency=medium\n",
                "packaging/conda/recipe.yaml": "context:\n  version: 1.2.3\n", "debian/control": "Package: libtabor1.2\n",
                "docs/README.md": "[theory](theory.md) [install](install.md)\n", "docs/install.md": "`libtabor1.2`\n"}
        self.assert_accepted(tree)
        self.assert_rejected("CITATION.cff: has version 1.2.2; CMakeLists.txt has 1.2.3", {**tree, "CITATION.cff": "version: 1.2.2\n"})
        self.assert_rejected("CHANGELOG.md: has version -", {**tree, "CHANGELOG.md": "# Changelog\n"})
        self.assert_rejected("debian/changelog: has version 1.2.2", {**tree, "debian/changelog": "tabor (1.2.2-1) UNRELEASED\n"})
        self.assert_rejected("debian/control: has libtabor1.1;", {**tree, "debian/control": "Package: libtabor1.1\nDepends: libtabor1.2\n"})

    def test_paths_of_a_machine_are_found(self):
        self.assert_rejected("docs/theory.md:3: path of a machine", self.page("It lies in /" + "home/somebody."))


if __name__ == "__main__":
    unittest.main()
