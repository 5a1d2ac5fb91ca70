"""What the page says of oil that carries load, in closed pockets or as it flows: friction is then not that of oil that only separates."""

import math

from tabor.report import areas, units

TRAPPED, FLOWING = "liquid_load_share", "fluid_load_share"
FORMULA = "μ = τ_y · A_dry/(A₀ P) + τ_b · A_wet/(A₀ P)"  # docs/trapped_liquid.md
_DENSITY = "lubricant_density_g_per_m2"
BEFORE = " before oil carries load"  # after the name of a map of the contact that the solids make alone


def shares(rows, key):
    """The shares of the load in states or rows of a table with oil that converged."""
    sure = [row for row in rows if row.get("converged", True) and row.get(_DENSITY, 0) > 0]
    return [float(row[key]) for row in sure if math.isfinite(row.get(key, math.nan))]


def span(found):
    """'2.9 % to 20 % of the load', or 'part of the load' where no share is known."""
    return f"{units.span(found, areas.share)} of the load" if found else "part of the load"


def is_trapped(rows):
    return any(TRAPPED in row for row in rows)


def is_flowing(rows):
    return any(FLOWING in row for row in rows)


def carries(rows):
    """True where oil carries load, in pockets or as it flows."""
    return is_trapped(rows) or is_flowing(rows)


def of_solids(facts):
    """What stands after the name of a map of the contact, which the solids make alone: BEFORE where oil carries load."""
    return BEFORE if carries([facts]) else ""


def of_trapped(rows):
    """The formula of friction with trapped oil, and what it is of."""
    return (
        f"{FORMULA}, where A_dry and A_wet are the dry and the wet part of the contact that the solids keep while the oil in closed "
        f"pockets carries {span(shares(rows, TRAPPED))}"
    )


def note(rows):
    """What a table of frictions needs beside it; "" where oil carries no load."""
    if is_trapped(rows):
        return f"Friction with oil: {of_trapped(rows)}. The contact in this table and the dry friction are those without oil."
    if is_flowing(rows):
        return f"Friction without a speed beside it is that of oil at rest. While the oil flows, it carries {span(shares(rows, FLOWING))}."
    return ""
