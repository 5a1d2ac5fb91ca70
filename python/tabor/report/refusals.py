"""Which numbers of friction `tabor table` leaves out, and why: the rule of src/tabor/study/friction_table.cpp."""

import math

UNCONVERGED = "not-converged"
OF_FLOW = ("fluid-film", "fluid-pressure", "viscosity-law", "density-law")
CODES = (UNCONVERGED, "flood", "frictionless", "flooded", "implausible-friction", *OF_FLOW)  # the gravest first
DRY, LUBRICATED, MIXED = "friction_dry", "friction_lubricated", "friction_mixed"
KEYS = (DRY, LUBRICATED, MIXED)
_OF_DRY = (UNCONVERGED, "implausible-friction")  # without oil no warning about the oil counts
_OF_REST = tuple(code for code in CODES if code not in OF_FLOW)
_OF_ONE_SCAN = ("failed", UNCONVERGED)  # the mean over the other scans stays; with any other reason it is wrong
_SIGNS = "†‡§¶‖#◊※&"
_DENSITY, _PRESSURE, _SPEED = "lubricant_density_g_per_m2", "mean_pressure_Pa", "sliding_speed_m_per_s"


def of_rows(rows):
    """[{key of a friction: why it is left out}] of rows of a study's table, or facts of the states of one scan."""
    dry = _dry_rows(rows)
    return [_of_row(row, dry[_dry_place(row)]) for row in rows]


def of_means(rows):
    """{(group, pressure, density, speed): {key: why the mean over the scans of the group is left out}}"""
    means = {}
    for row, reasons in zip(rows, of_rows(rows)):
        scans = means.setdefault(place_of_mean(row), {})
        for key in KEYS:
            if key in row:
                scans.setdefault(key, []).append(reasons.get(key, ""))
    return {place: _without_none({key: _of_mean(found) for key, found in scans.items()}) for place, scans in means.items()}


def place_of_mean(row):
    """What a row of averages is told by; densities and speeds as they were printed."""
    return (row.get("group", ""), *(_rounded(row.get(name)) for name in (_PRESSURE, _DENSITY, _SPEED)))


class Signs:
    """A sign for each reason that a page has, the gravest reason's first."""

    def __init__(self, reasons):
        """reasons: {key: reason} of rows or means."""
        found = {reason for of_row in reasons for reason in of_row.values() if reason in CODES}
        self._signs = dict(zip((code for code in CODES if code in found), _SIGNS))

    def mark(self, text, reason, met):
        """The text of a cell with its sign; the reasons of signs that were set are added to the set `met`."""
        if reason not in self._signs or text == "\N{EN DASH}":
            return text
        met.add(reason)
        return f"{text}\N{NO-BREAK SPACE}{self._signs[reason]}"

    def notes(self, met):
        """[(sign, code)] of those that a table holds."""
        return [(sign, code) for code, sign in self._signs.items() if code in met]


def _of_row(row, dry):
    reasons = {DRY: _reason(dry, _OF_DRY, DRY)}
    flows = MIXED in row
    for key, codes in ((LUBRICATED, _OF_REST if flows else CODES), (MIXED, CODES)):
        if key in row:  # friction without oil is dry friction, whatever its column is called
            reasons[key] = reasons[DRY] if row.get(_DENSITY) == 0 else _reason(row, codes, key)
    return _without_none(reasons)


def _reason(row, codes, key):
    """The gravest of these codes; "" for a number that is used."""
    if row.get("error"):
        return "failed"
    if not _is_converged(row) or math.isnan(row.get(key, math.nan)):
        return UNCONVERGED
    said = _codes(row)
    return next((code for code in codes if code in said), "")


def _dry_rows(rows):
    """{place: the row whose dry friction counts}: one that converged, and of those one without oil; else the first."""
    found = {}
    for row in rows:
        place, rank = _dry_place(row), (not row.get("error") and _is_converged(row), row.get(_DENSITY) == 0)
        if place not in found or rank > found[place][0]:
            found[place] = rank, row
    return {place: row for place, (_, row) in found.items()}


def _dry_place(row):
    return (row.get("scan", ""), row.get("group", ""), row.get("visit", 0), _rounded(row.get(_PRESSURE)), _rounded(row.get(_SPEED)))


def _of_mean(reasons):
    whole = sorted(reason for reason in reasons if reason and reason not in _OF_ONE_SCAN)
    if whole:
        return whole[0]
    return min(reasons) if all(reasons) else ""


def _is_converged(row):
    value = row.get("converged", True)
    return value.strip().lower() in ("1", "true", "yes") if isinstance(value, str) else bool(value)


def _codes(row):
    codes = row.get("warning_codes", ())
    return codes.split() if isinstance(codes, str) else codes or ()


def _rounded(value):
    """A number to the 9 digits in which equal ones agree; None where there is none."""
    return None if value is None or math.isnan(value) else float(f"{value:.9g}")


def _without_none(reasons):
    return {key: reason for key, reason in reasons.items() if reason}
