#!/usr/bin/python3
"""Checks the public headers: they include the standard library, Eigen and each other, nothing else.

usage: public_headers.py LIST FOLDER...

LIST names the public headers, one per line ("tabor/contact/contact.hpp"). With one FOLDER, an
installed include folder, exactly these are there; with several, the folders of a source tree, each
header is in one of them. Prints one line per finding; exit status 1 if there is any."""

import pathlib
import re
import sys

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.M)


def is_standard(name):
    return "/" not in name and "." not in name


def findings_in(name, text, public):
    for quote, included in INCLUDE.findall(text):
        if quote == '"' and included not in public:
            yield f"{name} includes {included}, which is not public"
        if quote == "<" and not is_standard(included) and not included.startswith("Eigen/"):
            yield f"{name} includes <{included}> of a foreign library"


def findings(public, folders):
    for name in sorted(public):
        places = [folder / name for folder in folders if (folder / name).is_file()]
        if not places:
            yield f"{name} is not there"
        else:
            yield from findings_in(name, places[0].read_text(encoding="utf-8"), public)
    if len(folders) == 1:
        there = {str(path.relative_to(folders[0])) for path in folders[0].rglob("*")
                 if path.is_file()}
        yield from (f"{name} is installed but not public" for name in sorted(there - public))


def main():
    public = set(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8").split())
    found = list(findings(public, [pathlib.Path(folder) for folder in sys.argv[2:]]))
    print("\n".join(found) if found else f"{len(public)} public headers")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
