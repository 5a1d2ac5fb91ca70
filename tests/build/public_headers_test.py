#!/usr/bin/python3
"""What public_headers.py finds in small include folders."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = pathlib.Path(__file__).with_name("public_headers.py")


class PublicHeaders(unittest.TestCase):
    def complaints(self, headers, public):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for path, text in headers.items():
                (folder / "include" / path).parent.mkdir(parents=True, exist_ok=True)
                (folder / "include" / path).write_text(text)
            (folder / "list").write_text("\n".join(public))
            done = subprocess.run([sys.executable, PROGRAM, folder / "list", folder / "include"],
                                  capture_output=True, text=True, check=False)
        self.assertEqual(done.stderr, "")
        return done.stdout.splitlines() if done.returncode == 1 else []

    def test_headers_that_include_each_other_are_right(self):
        headers = {"tabor/a.hpp": "#include <vector>\n#include <Eigen/Core>\n",
                   "tabor/b.hpp": '#include "tabor/a.hpp"\n'}
        self.assertEqual(self.complaints(headers, headers), [])

    def test_private_headers_are_found_where_they_are_included(self):
        self.assertEqual(self.complaints({"tabor/a.hpp": '#include "tabor/p.hpp"\n'}, ["tabor/a.hpp"]),
                         ["tabor/a.hpp includes tabor/p.hpp, which is not public"])

    def test_foreign_libraries_are_found(self):
        self.assertEqual(self.complaints({"tabor/a.hpp": "#include <hdf5.h>\n"}, ["tabor/a.hpp"]),
                         ["tabor/a.hpp includes <hdf5.h> of a foreign library"])

    def test_what_is_missing_or_too_much_is_found(self):
        self.assertEqual(self.complaints({"tabor/a.hpp": ""}, ["tabor/b.hpp"]),
                         ["tabor/b.hpp is not there", "tabor/a.hpp is installed but not public"])


if __name__ == "__main__":
    unittest.main()
