# A paraboloid alone on a half-space
# The non-periodic contact of "Solving contact", applied to the paraboloid of Hertz.

# --- surface: NumPy
import numpy as np

x = (np.arange(128) + 0.5) / 128 - 0.5
heights = -0.5 * (x[:, None] ** 2 + x**2)

# --- Tamaas
import tamaas as tm

model = tm.Model(tm.model_type.basic_2d, [1.0, 1.0],
                 heights.shape)
model.E, model.nu = 1.0, 0.0
tm.ModelFactory.registerNonPeriodic(model, "dcfft")
solver = tm.PolonskyKeerRey(model, heights, 1e-12)
solver.setIntegralOperator("dcfft")
solver.solve(0.01)
pressures = [model.traction.copy()]
gaps = [model["gap"].copy()]

# --- tabor
import tabor as tb

surface = tb.Surface(heights, pixel=1 / 128)
solid = tb.Solid(youngs_modulus=1, poissons_ratio=0)
contact = tb.contact(surface, 0.01, solid, boundary="free")
pressures, gaps = [contact.pressure], [contact.gap]
