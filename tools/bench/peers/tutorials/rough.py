# Ten loads on a rough surface
# The surface of "Random rough surfaces" in Tamaas' documentation, with the rms slope given there.
# Loads and tolerance are those of "Solving contact".

# --- surface: Tamaas
import tamaas as tm

spectrum = tm.Isopowerlaw2D()
spectrum.q0, spectrum.q1, spectrum.q2 = 4, 4, 32
spectrum.hurst = 0.8
generator = tm.SurfaceGeneratorFilter2D([128, 128])
generator.spectrum = spectrum
generator.random_seed = 0
heights = generator.buildSurface() * (0.25 / spectrum.rmsSlopes())

# --- Tamaas
import numpy as np
import tamaas as tm
from tamaas.utils import load_path

model = tm.Model(tm.model_type.basic_2d, [1.0, 1.0],
                 heights.shape)
model.E, model.nu = 1.0, 0.0
solver = tm.PolonskyKeerRey(model, heights, 1e-12)
pressures, gaps = [], []
for state in load_path(solver, np.linspace(0.01, 0.1, 10)):
    pressures.append(state.traction.copy())
    gaps.append(state["gap"].copy())

# --- tabor
import numpy as np
import tabor as tb

surface = tb.Surface(heights, pixel=1 / 128, periodic=True)
solid = tb.Solid(youngs_modulus=1, poissons_ratio=0)
loads = np.linspace(0.01, 0.1, 10)
contacts = tb.contact(surface, loads, solid)
pressures = [one.pressure for one in contacts]
gaps = [one.gap for one in contacts]
