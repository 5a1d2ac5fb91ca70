"""Every code of a warning in the sources stands in the list of codes, and every code of the list is given by a source."""

import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
LIST = ROOT / "src/tabor/cases/warning.cpp"
CODE = r'"([a-z]+(?:-[a-z]+)*)"'
# Warning{"code", ...}, warnings.push_back({"code", ...}), {.code = "code", ...}
GIVEN = re.compile(rf"(?:Warning\{{|(?:warnings|list|found)\.push_back\(\s*\{{|\.code = (?={CODE},\s*\.text))\s*{CODE}")


def sources():
    return [path.read_text(encoding="utf-8") for path in (ROOT / "src/tabor").rglob("*.cpp") if path != LIST]


def codes_in(text):
    return {code for _, code in GIVEN.findall(text)}


class WarningCodes(unittest.TestCase):
    known = set(re.findall(rf"^ +\{{{CODE}, About::", LIST.read_text(encoding="utf-8"), re.M))

    def test_what_the_sources_give_is_in_the_list(self):
        given = set().union(*map(codes_in, sources()))
        self.assertGreater(len(given), 25)
        self.assertEqual(given - self.known, set())

    def test_what_is_in_the_list_is_given(self):
        texts = sources()
        self.assertEqual({code for code in self.known if not any(f'"{code}"' in text for text in texts)}, set())

    def test_a_code_is_found_however_it_is_written(self):
        for text in ('Warning{"a-b", fmt', 'warnings.push_back(\n        {"a-b",', '{.code = "a-b", .text'):
            self.assertEqual(codes_in(text), {"a-b"})


if __name__ == "__main__":
    unittest.main()
