"""Facts of spectra for the page."""

from tabor_report.figures.spectra import wavelength
from tabor_report.spectra import NAMES


def sections(source):
    return {
        "answer": _answer(source),
        "highlights": [],
        "scans": [],
        "treatments": [],
        "settings": [],
        "results": {"intro": "", "header": [], "rows": [], "n_total": 0, "n_text": 0},
        "averages": {"header": [], "rows": [], "n_text": 0},
    }


def _answer(source):
    """The range to be trusted, one column per spectrum."""
    if not source.curves:
        return None
    low, high = source.trusted
    wavelengths = f"{wavelength(high)} to {wavelength(low)}"
    rows = [
        ("points", [str(len(q)) for q, _ in source.curves.values()]),
        ("wavelengths to be trusted", [wavelengths] * len(source.curves)),
    ]
    return {"caption": "Of each spectrum", "header": [NAMES[axis] for axis in source.curves], "rows": rows, "note": ""}
