"""Which sources of a target can be compiled as one: those that keep out of each other's way.

usage: unity_groups.py MOST FILE...

Sources that follow each other in one file see what the others keep to themselves, in `namespace {`, and what they
include. Those that would mistake it for their own go into another group (may_follow). Prints one line per group, at
most MOST files parted by blanks. A clash that is missed here, the compiler reports: then one of the two names can say
more."""

import functools
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
FOLDERS = (ROOT / "src", ROOT / "tests")  # that includes are looked for in, after the file's own
NOT_CODE = re.compile(r'R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|//(?! namespace$)[^\n]*', re.M | re.S)
OWN = re.compile(r"^namespace \{$(.*?)^\}  // namespace$", re.M | re.S)
# As .clang-format lays it out, a declaration begins its line.
TYPE = re.compile(r"^(?:template <.*> )?(?:struct|class|enum class|enum|union|using) (\w+)(?: |;|$)", re.M)
VALUE = re.compile(r"^(?!using |namespace |TEST|INSTANTIATE)[A-Za-z][^=({;\n]*?\b(\w+)(?:\[[^\n]*\])?(?: =|\(|\{|;|$)", re.M)
VARIABLE = re.compile(r"^(?!using |namespace )[A-Za-z][^=({;\n]*? ((?!k[A-Z])[a-z]\w*)(?: =|\{|;)", re.M)
MACRO = re.compile(r"^#define (\w+)", re.M)
NAME = re.compile(r"\b(?:k[A-Z]|[A-Z])\w*")  # of a type or a constant
WORD = re.compile(r"\w+")
CALL = re.compile(r"(?<![.>:\w])(\w+)\(")
DECLARED = re.compile(r"\b(?:struct|enum class|class|enum|using|typename) (\w+)")
NAMESPACE = re.compile(r"^namespace (\w[\w:]*) \{", re.M)
QUALIFIER = re.compile(r"(?<![:\w])(\w+)::")
INCLUDE = re.compile(r'^#include "(.+)"$', re.M)


@functools.cache
def file_at(path):
    return File(path)


class File:
    def __init__(self, path):
        self.path = pathlib.Path(path)
        text = self.path.read_text(encoding="utf-8")
        self.code = NOT_CODE.sub('""', text)
        self.names = set(NAME.findall(self.code))
        self.words = self.names.union(CALL.findall(self.code))
        places = [[folder / name for folder in (self.path.parent, *FOLDERS)] for name in INCLUDE.findall(text)]
        self.includes = [found for place in places for found in [path for path in place if path.is_file()][:1]]

    @functools.cached_property
    def headers(self):
        """All of this tree that it includes, at whatever depth."""
        found = {}
        waiting = list(self.includes)
        while waiting:
            path = waiting.pop()
            if path not in found:
                found[path] = file_at(path)
                waiting += found[path].includes
        return found

    @functools.cached_property
    def own(self):
        """The names it keeps to itself."""
        inside = "\n".join(OWN.findall(self.code))
        return {*TYPE.findall(inside), *VALUE.findall(inside), *MACRO.findall(self.code)}

    @functools.cached_property
    def variables(self):
        """Those of its own that a variable of a function in another source would hide."""
        return set(VARIABLE.findall("\n".join(OWN.findall(self.code))))

    def mentions(self, variables):
        """Whether any of these words is in its code or in a header it includes."""
        return bool(variables) and any(variables & set(WORD.findall(file.code)) for file in (self, *self.headers.values()))

    @functools.cached_property
    def seen(self):
        """Its own words, and the types and constants of the headers it includes."""
        return self.words.union(*(header.names for header in self.headers.values()))

    @functools.cached_property
    def namespaces(self):
        """Those that it or a header it includes opens."""
        return set(NAMESPACE.findall(self.code)).union(*(NAMESPACE.findall(header.code) for header in self.headers.values()))

    @functools.cached_property
    def unexplained(self):
        """Its words, and the types in its first header, that neither it nor the headers it includes explain."""
        explained = self.own.union(*(header.words for header in self.headers.values()))
        return (self.words - explained).union(*(file_at(path).foreign_types for path in self.includes[:1]))

    @functools.cached_property
    def foreign_types(self):
        """The types that it mentions, as a header, and that no header of this tree which it includes does."""
        explained = set(DECLARED.findall(self.code)).union(*(header.words for header in self.headers.values()))
        return {name for name in self.names if name[0] != "k"} - explained

    def may_follow(self, other):
        """Whether it can stand below the other: no name means two things, and none that only the other's headers know is
        used, so that an include which it lacks is still found to be lacking."""
        if self.own & other.seen or other.own & self.seen:
            return False
        if other.mentions(self.variables) or self.mentions(other.variables):
            return False
        hiding = {name.split("::")[-1] for name in other.namespaces - self.namespaces}  # tabor::scan::test the outer test
        if hiding & set(QUALIFIER.findall(self.code)):
            return False
        return not any(self.unexplained & header.words for path, header in other.headers.items() if path not in self.headers)


def groups_of(files, most):
    groups = []
    for file in files:
        fitting = (group for group in groups if len(group) < most and all(map(file.may_follow, group)))
        group = next(fitting, None)
        if group is None:
            groups.append([file])
        else:
            group.append(file)
    return groups


def main():
    most, *paths = sys.argv[1:]
    for group in groups_of([File(path) for path in paths], int(most)):
        print(*(file.path for file in group))


if __name__ == "__main__":
    main()
