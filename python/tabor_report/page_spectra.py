"""Facts of spectra for the page."""

from tabor_report.figures.spectra import wavelength
from tabor_report.spectra import NAMES


def sections(source):
    return {"answer": _answer(source)}


def _answer(source):
    """The range to be trusted: one column per spectrum of a scan, or one row per scan."""
    scans = [one for one in source.sets if one.curves]
    if not scans:
        return None
    if len(source.sets) > 1:
        header = ["points", "wavelengths to be trusted"]
        rows = [(_heading(one), [_points(one), "\N{EN DASH}" if one.is_mean else _range(one)]) for one in scans]
        return {"caption": "Of each scan and mean", "header": header, "rows": rows, "note": ""}
    (only,) = scans
    rows = [
        ("points", [str(len(q)) for q, _ in only.curves.values()]),
        ("wavelengths to be trusted", [_range(only)] * len(only.curves)),
    ]
    return {"caption": "Of each spectrum", "header": [NAMES[axis] for axis in only.curves], "rows": rows, "note": ""}


def _heading(one):
    return f"{one.name}, mean of {one.n_scans}" if one.is_mean else one.name


def _points(one):
    return ", ".join(f"{len(q)} {NAMES[axis]}" for axis, (q, _) in one.curves.items())


def _range(one):
    low, high = one.trusted
    return f"{wavelength(high)} to {wavelength(low)}"
