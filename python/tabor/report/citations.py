"""BibTeX of the methods a result rests on, from the file that `tabor cite` also reads."""

from pathlib import Path

from tabor.report import hdf
from tabor.report.errors import InputError

_HERE = Path(__file__).resolve().parent
# Beside the installed package, or where the source tree keeps it.
_PLACES = (_HERE / "references.bib", _HERE.parents[2] / "src/tabor/results/references.bib")

_STUDY = ("polonsky1999", "stanley1997", "bowden1950", "costagliola2021", "barnes2021", "jacobs2017")


def bibtex(facts):
    """Entry of tabor itself, then those of the methods the root attributes name, as one text."""
    entries = references()
    found = [entries[key] for key in entries if key in _used(facts)]
    return "\n\n".join([_own(facts.get("software_version")), *found])


def references():
    """{key: entry}; raises InputError if the file was not installed."""
    path = next((place for place in _PLACES if place.is_file()), None)
    if path is None:
        raise InputError(f"{_PLACES[0]}: no such file; install tabor with 'cmake --install'")
    # Entries end with a closing brace in the first column.
    texts = [text.strip() + "\n}" for text in path.read_text(encoding="utf-8").split("\n}") if "@" in text]
    return {text[text.index("{") + 1 : text.index(",")]: text for text in texts}


def _used(facts):
    named = hdf.text_list(facts.get("methods"))
    return named or _STUDY + (("almqvist2007",) if facts.get("saturation_pressure_Pa") else ())


def _own(version):
    line = f",\n  version = {{{version}}}" if version else ""
    return "@software{tabor,\n  title   = {tabor: real contact area, lubricant and friction of scanned rough surfaces}" + line + "\n}"
