"""cmake/unity_groups.py parts sources that would mistake each other's names, or an include, for their own."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "cmake/unity_groups.py"


def own(text):
    return f"namespace {{\n{text}\n}}  // namespace\n"


class Groups(unittest.TestCase):
    def groups(self, sources, most=8):
        """The groups of these sources, by name; those that begin with h are headers."""
        with tempfile.TemporaryDirectory() as folder:
            for name, text in sources.items():
                (pathlib.Path(folder) / name).write_text(text)
            files = [name for name in sources if not name.startswith("h")]
            done = subprocess.run([sys.executable, SCRIPT, str(most), *files], cwd=folder, capture_output=True, text=True, check=True)
        return [line.split() for line in done.stdout.splitlines()]

    def test_have_no_more_members_than_asked_for(self):
        self.assertEqual(self.groups({"a": "", "b": "", "c": ""}, most=2), [["a", "b"], ["c"]])

    def test_part_two_meanings_of_a_name(self):
        for declared in ("constexpr int kMost = 3;", "struct Row {\n};", "double mean(int n) { return n; }",
                         "using Row = std::vector<int>;", "std::vector<int> rows_of(\n    int n);"):
            self.assertEqual(self.groups({"a": own(declared), "b": own(declared)}), [["a"], ["b"]], declared)

    def test_part_a_name_of_one_source_and_its_use_in_another(self):
        self.assertEqual(self.groups({"a": own("struct Row {\n};"), "b": "Row row;"}), [["a"], ["b"]])
        self.assertEqual(self.groups({"a": "double x = mean(2);", "b": own("int mean(int n);")}), [["a"], ["b"]])
        self.assertEqual(self.groups({"h.hpp": "struct Row {};", "a": '#include "h.hpp"\n', "b": own("struct Row {\n};")}), [["a"], ["b"]])

    def test_let_methods_variables_and_text_have_any_name(self):
        uses = 'double x = list.mean(2) + std::mean(3);\ndouble mean = 2;  // mean(x)\nauto text = "mean(x)";\n'
        self.assertEqual(self.groups({"a": own("int mean(int n);"), "b": uses}), [["a", "b"]])

    def test_part_a_variable_from_those_that_would_hide_it(self):
        self.assertEqual(self.groups({"a": own("std::atomic<bool> flag{false};"), "b": "void f(int flag);"}), [["a"], ["b"]])
        self.assertEqual(self.groups({"a": "void f(int flag);", "b": own("bool flag = false;")}), [["a"], ["b"]])

    def test_part_two_namespaces_of_one_name(self):
        inner = "namespace tabor::scan::test {\n}  // namespace tabor::scan::test\n"
        self.assertEqual(self.groups({"a": inner, "b": "test::Folder folder;"}), [["a"], ["b"]])
        self.assertEqual(self.groups({"a": inner, "b": inner + "test::Folder folder;"}), [["a", "b"]])

    def test_part_a_source_that_forgot_an_include_from_one_that_has_it(self):
        header = {"h1.hpp": "struct Row {};\nRow first();\n", "h2.hpp": '#include "h1.hpp"\n'}
        with_it = '#include "h2.hpp"\n'
        for use in ("Row row;", "auto row = first();"):
            self.assertEqual(self.groups({**header, "a": with_it, "b": use}), [["a"], ["b"]], use)
            self.assertEqual(self.groups({**header, "a": with_it, "b": '#include "h1.hpp"\n' + use}), [["a", "b"]], use)

    def test_part_a_source_whose_header_forgot_an_include_from_one_that_has_it(self):
        headers = {"h1.hpp": "struct Row {};\n", "h2.hpp": "struct Table {\n  Row first;\n};\n"}
        self.assertEqual(self.groups({**headers, "a": '#include "h1.hpp"\n', "b": '#include "h2.hpp"\n'}), [["a"], ["b"]])
        headers["h2.hpp"] = '#include "h1.hpp"\n' + headers["h2.hpp"]
        self.assertEqual(self.groups({**headers, "a": '#include "h1.hpp"\n', "b": '#include "h2.hpp"\n'}), [["a", "b"]])


if __name__ == "__main__":
    unittest.main()
