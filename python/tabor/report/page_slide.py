"""Facts and tables of a slide for the page."""

import math

from tabor.report import page_single, units

# What a reader wants to know of the way, by the keys of states.
_ASKED = ("friction_dry", "friction_lubricated", "friction_lubricated_squeezed", "liquid_load_share", "friction_ploughing",
          "contact_area_fraction_pixels", "lubricated_share", "rms_height_m", "moved_volume_m3_per_m2")  # fmt: skip
_CALLED = {
    "friction_lubricated": "friction, oil stays on its pixels",
    "friction_lubricated_squeezed": "friction, oil is squeezed out",
    "liquid_load_share": "trapped oil carries",
    "friction_ploughing": "of it ploughing",
    "moved_volume_m3_per_m2": "displaced so far, over the area",
}


def sections(slide):
    return {**page_single.sections(slide), "answer": _answer(slide), "highlights": []}


def _answer(slide):
    """One line per question, one column per state."""
    shown = [slide.states[place] for place in page_single.evenly(len(slide.states), page_single.MOST_COLUMNS)]
    rows = [(_CALLED.get(key, slide.column[key].heading), [_show(slide, state, key) for state in shown]) for key in _ASKED]
    rows = [(name, cells) for name, cells in rows if any(cell != "\N{EN DASH}" for cell in cells)]
    pressure = units.pressure(slide.states[0].pressure)
    left_out = len(slide.states) - len(shown)
    note = f"The results hold {left_out} more states." if left_out else ""
    return {"caption": f"Along the way, under {pressure}", "header": [state.name for state in shown], "rows": rows, "note": note}


def _show(slide, state, key):
    value = state.facts.get(key, math.nan)
    return "\N{EN DASH}" if math.isnan(value) else slide.column[key].show(value)
