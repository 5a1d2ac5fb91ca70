# The same surface, with a saturation pressure
# Tamaas has `KatoSaturated` for this. The surface is that of the tutorial above. Cap, load and
# tolerance are chosen here and come from no tutorial.

# --- surface: that of rough

# --- Tamaas
import tamaas as tm

model = tm.Model(tm.model_type.basic_2d, [1.0, 1.0],
                 heights.shape)
model.E, model.nu = 1.0, 0.0
solver = tm.KatoSaturated(model, heights, 1e-6, 0.2)
solver.max_iter = 10000
solver.solve(0.05)
pressures = [model.traction.copy()]
gaps = [model["gap"].copy()]

# --- tabor
import tabor as tb

surface = tb.Surface(heights, pixel=1 / 128, periodic=True)
solid = tb.Solid(youngs_modulus=1, poissons_ratio=0,
                 saturation_pressure=0.2)
contact = tb.contact(surface, 0.05, solid)
pressures, gaps = [contact.pressure], [contact.gap]
