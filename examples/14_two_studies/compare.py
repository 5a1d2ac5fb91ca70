"""Holds what Costagliola et al. 2021 say in words against the averages of the two studies."""

import csv
import sys


def friction(path, group, column):
    """{(pressure in MPa, density in g/m^2): mean} of one group."""
    with open(path, newline="", encoding="utf-8") as file:
        return {(round(1e-6 * float(row["mean_pressure_Pa"])), float(row["lubricant_density_g_per_m2"])):
                float(row[column]) for row in csv.DictReader(file) if row["group"] == group}


lubricated, dry = sys.argv[1:]
facts = []
for reading in ("conserving", "literal"):
    wet = friction(lubricated, reading, "friction_lubricated_mean")
    fall = 1 - wet[15, 0.45] / wet[2, 0.45]
    facts.append((f"{reading}: lubricated friction falls from 2 to 15 MPa by {100 * fall:.0f} %", fall >= 0.1))
literal = friction(lubricated, "literal", "friction_lubricated_mean")
lower = [1 - literal[pressure, 0.9] / literal[pressure, 0.45] for pressure in (2, 5, 7, 10, 15)]
facts.append((f"literal: 0.9 g/m^2 lies below 0.45 g/m^2 by {100 * min(lower):.2g} to {100 * max(lower):.2g} %",
              0 < min(lower) and max(lower) < 0.05))
for density in (0.45, 0.9):
    after = friction(dry, f"after {density} g/m²", "friction_dry_mean")
    rise = [after[pressure, density] for pressure in (2, 5, 7, 10, 15)]
    facts.append((f"after sliding with {density} g/m^2: dry friction rises from {rise[0]:.3f} to {max(rise):.3f}",
                  rise[0] < rise[1] < rise[2] and rise[-1] > rise[0]))
for text, holds in facts:
    print(("holds  " if holds else "FAILS  ") + text)
sys.exit(0 if all(holds for _, holds in facts) else "not as the paper says")
