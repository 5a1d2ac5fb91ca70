"""Compares elastic and saturated contact; no contact below 240 MPa can be smaller than P/240 MPa."""

import json
import sys

results = []
for name in sys.argv[1:]:
    with open(name, encoding="utf-8") as file:
        results.append(json.load(file))
elastic, saturated = results
limit = saturated["saturation_pressure_Pa"]
good = True
print(f"{'P [MPa]':>8} {'elastic [%]':>12} {'saturated [%]':>14} {'P/p_sat [%]':>12} {'capped share':>13}")
for soft, capped in zip(elastic["states"], saturated["states"]):
    bound = capped["mean_pressure_Pa"] / limit
    area = capped["contact_area_fraction"]
    good = good and soft["converged"] and capped["converged"]
    good = good and area >= bound > 0 and area > soft["contact_area_fraction"]
    print(f"{1e-6 * capped['mean_pressure_Pa']:8.0f} {100 * soft['contact_area_fraction']:12.3f} "
          f"{100 * area:14.3f} {100 * bound:12.3f} {capped['saturated_area_fraction'] / area:13.3f}")
sys.exit(0 if good else "a bound does not hold")
