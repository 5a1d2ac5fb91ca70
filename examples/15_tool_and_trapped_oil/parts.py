#!/usr/bin/env python3
"""Prints the friction of several models side by side. usage: parts.py CSV..."""

import csv
import pathlib
import sys


def main():
    tables = {pathlib.Path(file).stem.replace("_", " + "): list(csv.DictReader(open(file, encoding="utf-8"))) for file in sys.argv[1:]}
    print("pressure  " + "  ".join(f"{name:>15}" for name in tables) + "      oil carries")
    for rows in zip(*tables.values()):
        cells = []
        for row in rows:
            spread = f" ± {float(row['friction_lubricated_std']):.3f}" if row.get("friction_lubricated_std") else ""
            cells.append(f"{float(row['friction_lubricated']):.4f}{spread}")
        carried = 100 * float(rows[-1]["liquid_load_share"])
        print(f"{float(rows[0]['mean_pressure_Pa']) / 1e6:>5g} MPa  " + "  ".join(f"{cell:>15}" for cell in cells) + f"      {carried:>9.1f} %")


if __name__ == "__main__":
    main()
