"""tools/check/layers finds what it is there to find: each test breaks one rule in a small tree."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

CHECK = pathlib.Path(__file__).resolve().parents[2] / "tools/check/layers"

TABLES = """# Architecture

## Layers

| layer | folder | what it is for | must not know |
|---|---|---|---|
| 0 | `core` | x | |
| 2 | `topography` | x | |
| 3 | `contact` | x | `topography` |

## Foreign libraries

| library | header | only in |
|---|---|---|
| FFTW | `fftw3.h` | `core/fft.cpp` |
| OpenMP | `omp.h` | `core/parallel.cpp` |
"""


def run_check(files, links=""):
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name, text in {"docs/architecture.md": TABLES, **files}.items():
            path = root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        (root / "links").write_text(links)
        return subprocess.run([sys.executable, CHECK, "--root", root, "--links", root / "links"],
                              capture_output=True, text=True, check=False)


class Layers(unittest.TestCase):
    def assert_rejected(self, complaint, name, text, links=""):
        result = run_check({"src/tabor/" + name: text}, links)
        self.assertEqual(result.returncode, 1, result.stdout)
        self.assertIn(complaint, result.stdout)

    def assert_accepted(self, name, text, links=""):
        result = run_check({"src/tabor/" + name: text}, links)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def test_lower_layers_may_be_included(self):
        self.assert_accepted("contact/a.cpp", '#include "tabor/core/types.hpp"\n#include <vector>\n')

    def test_higher_layers_may_not_be_included(self):
        self.assert_rejected("core may not include contact", "core/a.cpp",
                            '#include "tabor/contact/contact.hpp"\n')

    def test_forbidden_modules_may_not_be_included_although_they_are_lower(self):
        self.assert_rejected("contact may not include topography", "contact/a.hpp",
                            '#include "tabor/topography/file.hpp"\n')

    def test_unknown_folders_are_rejected(self):
        self.assert_rejected("not in the layer table", "extra/a.cpp", "")

    def test_relative_includes_are_rejected(self):
        self.assert_rejected('write "tabor/', "core/a.cpp", '#include "types.hpp"\n')

    def test_a_foreign_library_belongs_in_its_file(self):
        self.assert_accepted("core/fft.cpp", "#include <fftw3.h>\n")
        self.assert_rejected("belongs in core/fft.cpp", "core/other.cpp", "#include <fftw3.h>\n")

    def test_unlisted_foreign_libraries_are_rejected(self):
        self.assert_rejected("not in the table", "core/a.cpp", "#include <boost/any.hpp>\n")

    def test_openmp_pragmas_belong_in_one_file(self):
        self.assert_accepted("core/parallel.cpp", "#pragma omp parallel for\n")
        self.assert_rejected("pragmas belong", "core/a.cpp", "  #pragma omp parallel for\n")

    def test_links_follow_the_same_table(self):
        self.assert_accepted("core/a.cpp", "", "contact: core\n")
        self.assert_rejected("contact may not link topography", "core/a.cpp", "",
                            "contact: core topography\n")

    def test_an_empty_tree_is_not_a_success(self):
        self.assertEqual(run_check({}).returncode, 1)


if __name__ == "__main__":
    unittest.main()
