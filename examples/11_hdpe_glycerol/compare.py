#!/usr/bin/env python3
"""Friction coefficients of a sweep over viscosity beside the experiment. usage: compare.py JSON"""

import json
import math
import sys

# Akchurin's thesis, Table 4: pin on disc, HDPE on steel; viscosity in mPa s, friction.
MEASURED = {"water": (0.9135, 0.055), "95 % glycerol": (363.8, 0.031), "glycerol": (987.0, 0.036)}


def viscosity(result):
    """mPa s of one case of the sweep."""
    return float(result["set"]["lubricant.viscosity"].split()[0])


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        results = json.load(file)["results"]
    print(f"{'viscosity [mPa s]':>17}  {'film [nm]':>9}  {'friction':>8}  measured")
    for result in results:
        near = [
            f"{friction} ({name})"
            for name, (value, friction) in MEASURED.items()
            if abs(math.log(value / viscosity(result))) < 0.35
        ]
        print(
            f"{viscosity(result):17.4g}  {result['min_film_m'] * 1e9:9.3g}"
            f"  {result['friction_coefficient']:8.2g}  {', '.join(near)}"
        )


if __name__ == "__main__":
    main()
