"""Shows kappa = A/A0 E* slope / P, which elastic theories put between 1.6 and 2.5 at light load."""

import json
import sys

with open(sys.argv[1], encoding="utf-8") as file:
    result = json.load(file)
slope = 0.1  # of the generated surface, by spectral derivative
good = True
print(f"{'P [MPa]':>8} {'P/(E* slope)':>13} {'contact [%]':>12} {'kappa':>7}")
for state in result["states"]:
    load = state["mean_pressure_Pa"] / (result["effective_modulus_Pa"] * slope)
    kappa = state["contact_area_fraction"] / load
    # Persson: sqrt(8/pi) = 1.60; Bush, Gibson and Thomas: sqrt(2 pi) = 2.51.
    good = good and state["converged"] and (load > 0.1 or 1.6 < kappa < 2.51)
    print(f"{1e-6 * state['mean_pressure_Pa']:8.0f} {load:13.4f} "
          f"{100 * state['contact_area_fraction']:12.3f} {kappa:7.3f}")
sys.exit(0 if good else "kappa left the range of the theories")
