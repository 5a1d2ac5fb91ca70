"""Compares contacts of a 1 mm sphere with Hertz (1882): under a pressure, under a force and at a separation; ends with an error if
they differ."""

import json
import math
import sys

RADIUS = 1e-3
SIDE = 256e-6


def state_of(name):
    with open(name, encoding="utf-8") as file:
        result = json.load(file)
    return result["states"][0], result["effective_modulus_Pa"]


pressed, modulus = state_of(sys.argv[1])
forced, _ = state_of(sys.argv[2])
placed, _ = state_of(sys.argv[3])
contact_radius = (3 * pressed["mean_pressure_Pa"] * SIDE**2 * RADIUS / (4 * modulus)) ** (1 / 3)
approach = -placed["separation_m"]  # the zero of heights is the tip of the sphere

cases = [  # quantity, tabor, Hertz, allowed relative difference
    ("contact radius [um]", 1e6 * math.sqrt(pressed["contact_area_fraction"] * SIDE**2 / math.pi),
     1e6 * contact_radius, 5e-3),
    ("peak pressure [MPa]", 1e-6 * pressed["max_pressure_Pa"],
     1e-6 * 2 * modulus * contact_radius / (math.pi * RADIUS), 2e-3),
    ("approach at 8.52 N [um]", -1e6 * forced["separation_m"],
     1e6 * (3 * 8.52 / (4 * modulus)) ** (2 / 3) / RADIUS ** (1 / 3), 2e-3),
    ("force at 1.6 um [N]", placed["mean_pressure_Pa"] * SIDE**2,
     4 / 3 * modulus * math.sqrt(RADIUS) * approach**1.5, 2e-3),
]
good = all(state["converged"] for state in (pressed, forced, placed))
print(f"{'quantity':24} {'tabor':>10} {'Hertz':>10} {'difference':>11}")
for name, found, expected, allowed in cases:
    difference = found / expected - 1
    good = good and abs(difference) <= allowed
    print(f"{name:24} {found:10.4f} {expected:10.4f} {100 * difference:+10.3f} %")
sys.exit(0 if good else "the numbers do not agree")
