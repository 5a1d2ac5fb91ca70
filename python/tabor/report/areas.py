"""The two shares of a scan that touch, and which of them friction was computed with: one of them per table."""

CORRECTED, PIXELS = "contact_area_fraction", "contact_area_fraction_pixels"
KEYS = (CORRECTED, PIXELS)
MEANINGS = {CORRECTED: "contact area (perimeter-corrected)", PIXELS: "counted contact (pixels that touch)"}
_OF_SETTING = {"corrected": CORRECTED, "pixels": PIXELS}


def of_state(facts):
    """The key of what the friction of a state was computed with; without friction the contact area."""
    return _OF_SETTING.get(facts.get("area"), CORRECTED)


def of_states(states):
    """The same for a table of several states: the contact area where they do not agree."""
    found = {of_state(state.facts) for state in states}
    return found.pop() if len(found) == 1 else CORRECTED


def of_study(study):
    """What the friction of all scans was computed with; the contact area where they do not agree."""
    shared = study.facts.get("area", "corrected")
    found = {_OF_SETTING.get(scan.facts.get("area", shared), CORRECTED) for scan in study.scans}
    found = found or {_OF_SETTING.get(shared, CORRECTED)}
    key = found.pop() if len(found) == 1 else CORRECTED
    return key if key in study.table else CORRECTED


def share(value):
    """0.02134 -> '2.13 %'"""
    return f"{100 * value:.3g} %"
