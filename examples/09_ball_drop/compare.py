"""Compares an impact with the numbers of Larsson & Höglund 1995. usage: compare.py impact.json"""

import json
import sys

PAPER = [("impact time [us]", "impact_time_s", 1e6, 241),
         ("time of largest force [us]", "time_max_force_s", 1e6, 145),
         ("smallest film [um]", "min_film_m", 1e6, 2.9),
         ("its time [us]", "time_min_film_s", 1e6, 176),
         ("turning point [us]", "turning_time_s", 1e6, 158),
         ("first pressure peak [us]", "time_primary_center_pressure_s", 1e6, 163),
         ("cavitation begins [us]", "cavitation_time_s", 1e6, 166),
         ("largest deformation [um]", "max_deformation_m", 1e6, 16),
         ("rebound speed [m/s]", "rebound_speed_m_per_s", 1, 0.257),
         ("coefficient of restitution", "restitution", 1, 0.82)]

with open(sys.argv[1], encoding="utf-8") as file:
    result = json.load(file)
print(f"{'quantity':28}{'tabor':>9}{'paper':>9}")
for name, key, factor, paper in PAPER:
    print(f"{name:28}{result[key] * factor:9.3f}{paper:9g}")
