"""Prints what was carved beside what was measured. usage: compare.py TRUTH.json WEAR.json"""

import json
import sys

with open(sys.argv[1], encoding="utf-8") as file:
    truth = json.load(file)
with open(sys.argv[2], encoding="utf-8") as file:
    result = json.load(file)
wear = result["wear"]
match = result["registration"]
rows = [("shift along x [nm]", 1e9, truth["shift_x_m"], match["shift_x_m"], match["uncertainty_x_m"]),
        ("shift along y [nm]", 1e9, truth["shift_y_m"], match["shift_y_m"], match["uncertainty_y_m"])]
for name, key, carved in [("worn [um^3]", "worn", truth["worn_m3"]), ("piled up [um^3]", "piled_up", 0),
                          ("net [um^3]", "net", truth["worn_m3"])]:
    rows.append((name, 1e18, carved, wear[key]["volume_m3"], wear[key]["uncertainty_m3"]))
print(f"{'quantity':20}{'carved':>10}{'measured':>10}{'+-':>7}")
for name, factor, *values in rows:
    carved, measured, deviation = (factor * value for value in values)
    print(f"{name:20}{carved:10.1f}{measured:10.1f}{deviation:7.1f}")
error = wear["worn"]["volume_m3"] / truth["worn_m3"] - 1
if abs(error) > 0.01:
    sys.exit(f"the worn volume is off by {100 * error:.2f} %")
