"""Compares a contact of a 1 mm sphere with Hertz (1882); ends with an error if they differ."""

import json
import math
import sys

with open(sys.argv[1], encoding="utf-8") as file:
    result = json.load(file)
state = result["states"][0]
radius = 1e-3
side = 256e-6
modulus = result["effective_modulus_Pa"]
force = state["mean_pressure_Pa"] * side**2
contact_radius = (3 * force * radius / (4 * modulus)) ** (1 / 3)

cases = [  # quantity, tabor, Hertz, allowed relative difference
    ("contact radius [um]", 1e6 * math.sqrt(state["contact_area_fraction"] * side**2 / math.pi),
     1e6 * contact_radius, 5e-3),
    ("peak pressure [MPa]", 1e-6 * state["max_pressure_Pa"],
     1e-6 * 2 * modulus * contact_radius / (math.pi * radius), 2e-3),
]
good = state["converged"]
print(f"{'quantity':22} {'tabor':>10} {'Hertz':>10} {'difference':>11}")
for name, found, expected, allowed in cases:
    difference = found / expected - 1
    good = good and abs(difference) <= allowed
    print(f"{name:22} {found:10.4f} {expected:10.4f} {100 * difference:+10.3f} %")
sys.exit(0 if good else "the numbers do not agree")
