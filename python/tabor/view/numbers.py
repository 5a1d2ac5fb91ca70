"""Tables of numbers with the warnings that concern them."""

from __future__ import annotations

from typing import Any

from .answers import Answer
from .looks import failure_html, percent, si_text, table_html, warnings_html

Row = tuple[str, str, str, str]
#: Heading, key of ``--json``, unit; "%" for a share. Those of trapped oil are shown where they are.
_CONTACT = (("area", "contact_area_fraction", "%"), ("counted", "contact_area_fraction_pixels", "%"),
            ("yielded", "saturated_area_fraction", "%"), ("mean gap", "mean_gap_m", "m"), ("max pressure", "max_pressure_Pa", "Pa"),
            ("certificate", "certificate", ""))
_OIL = (("wet surface", "wet_fraction", "%"), ("mean film", "mean_film_m", "m"), ("thickest film", "max_film_m", "m"))
_FRICTION = (("dry", "friction_dry", ""), ("lubricated", "friction_lubricated", ""),
             ("wet share", "lubricated_share", "%"), ("load on oil", "liquid_load_share", "%"))


def _text(value: Any, unit: str) -> str:
    return percent(value) if unit == "%" else si_text(value, unit)


def _rows(values: Any, lines: tuple[tuple[str, str, str], ...]) -> list[Row]:
    return [(heading, key, repr(values[key]), _text(values[key], unit)) for heading, key, unit in lines if values.get(key) is not None]


def scan_html(answer: Answer) -> str:
    """Pixels, holes, tilt and roughness of the treated surface."""
    surface = answer.surface
    if surface is None:
        return failure_html(answer.failures.get("treatment", ""))
    ny, nx = surface.shape
    dx, dy = (si_text(side, "m") for side in surface.pixel)
    rows: list[Row] = [("pixels", "pixels", f"{nx} x {ny}", f"{nx} x {ny} of {dx if dx == dy else dx + ' x ' + dy}"),
                       ("holes", "holes", repr(surface.n_holes), f"{surface.n_holes} pixels" if surface.n_holes else "none")]
    if answer.tilt is not None:
        rows.append(("tilt x, y", "tilt", repr(answer.tilt), ", ".join(f"{round(1e3 * slope, 6) + 0.0:.3g}" for slope in answer.tilt) + " µm/mm"))
    rows += [(one.symbol, one.symbol, repr(one.value), si_text(one.value, one.unit)) for one in (answer.parameters or {}).values()]
    return table_html(rows, 2) + failure_html(answer.failures.get("treatment", "")) + warnings_html(answer.warnings["scan"])


def results_html(answer: Answer) -> str:
    """Numbers of contact, oil and friction."""
    parts = (("Contact", answer.contact, _CONTACT), ("Oil", answer.film, _OIL), ("Friction", answer.friction, _FRICTION))
    return "".join(f"<h2>{title}</h2>{table_html(_rows(record.values, lines))}" for title, record, lines in parts if record is not None)


def remarks_html(answer: Answer, name: str) -> str:
    """Why "contact", "oil" or "friction" cannot be computed, and its warnings."""
    return failure_html(answer.failures.get(name, "")) + warnings_html(answer.warnings[name])


def preview_html(answer: Answer) -> str:
    """Which answer this is: a preview with its pixel, or the full one with its time."""
    surface = answer.pressed
    if surface is None:
        return ""
    if answer.is_preview:
        return f"<span class='preview' data-name='preview'>Preview on pixels of {si_text(surface.pixel[0], 'm')}</span>"
    took = f"Full answer in {answer.seconds:.2g} s" if answer.seconds > 1e-3 else "Full answer, computed before"
    return f"<span class='note' data-name='whole'>{took}</span>"
