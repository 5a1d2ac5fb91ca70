"""Facts of spectra for the page."""

import math

from tabor.report.figures.spectra import wavelength
from tabor.report.spectra import NAMES


def sections(source):
    files = [(one.name, one.file) for one in source.sets if one.file not in ("", one.name)]
    return {"answer": _answer(source), "settings": [*_conditions(source), *files], "settings_title": "Scans and spectra"}


def _conditions(source):
    """What densities depend on beside the scan; all that occur, if scans differ."""
    rows = []
    for name in ("treatment", "convention", "window"):
        words = dict.fromkeys(one.conditions[name] for one in source.sets if name in one.conditions)
        if words:
            rows.append((name, "; ".join(words)))
    return rows


def _answer(source):
    """The range to be trusted: one column per spectrum of a scan, or one row per scan."""
    scans = [one for one in source.sets if one.curves]
    if not scans:
        return None
    if len(source.sets) > 1:
        axes = [axis for axis in source.axes if any(axis in one.exponents for one in scans)]
        header = ["points", "wavelengths to be trusted", *(f"Hurst exponent {NAMES[axis]}" for axis in axes)]
        rows = [
            (_heading(one), [_points(one), "\N{EN DASH}" if one.is_mean else _range(one), *(_exponent(one, axis) for axis in axes)])
            for one in scans
        ]
        has_means = any(one.is_mean for one in scans)
        return {"caption": f"Of each scan{' and mean' * has_means}", "header": header, "rows": rows, "note": ""}
    (only,) = scans
    rows = [
        ("points", [str(len(q)) for q, _ in only.curves.values()]),
        ("wavelengths to be trusted", [_range(only)] * len(only.curves)),
    ]
    if only.exponents:
        rows.append(("Hurst exponent", [_exponent(only, axis) for axis in only.curves]))
    return {"caption": "Of each spectrum", "header": [NAMES[axis] for axis in only.curves], "rows": rows, "note": ""}


def _heading(one):
    return f"{one.name}, mean of {one.n_scans}" if one.is_mean else one.name


def _points(one):
    counts = {axis: len(q) for axis, (q, _) in one.curves.items()}
    if len(set(counts.values())) == 1:
        return str(next(iter(counts.values())))
    return ", ".join(f"{count} {NAMES[axis]}" for axis, count in counts.items())


def _exponent(one, axis):
    """'0.78 ± 0.03'"""
    if axis not in one.exponents:
        return "\N{EN DASH}"
    hurst, error = one.exponents[axis]
    return f"{hurst:.2f} \N{PLUS-MINUS SIGN} {error:.2f}" if math.isfinite(error) else f"{hurst:.2f}"


def _range(one):
    low, high = one.trusted
    return f"{wavelength(high)} to {wavelength(low)}"
