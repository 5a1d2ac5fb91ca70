# A sphere alone on a half-space
# The sphere of the same notebook, in mm, N and MPa. The force presses it in by 0.01 mm according to
# Hertz' equation.

# --- surface: ContactMechanics
import numpy as np
from SurfaceTopography import make_sphere

side = 2 * np.pi
modulus = 230000 / (2 * (1 - 0.3**2))
force = 4 / 3 * modulus * 100**0.5 * 0.01**1.5
heights = make_sphere(radius=100, nb_grid_pts=(64, 64),
                      physical_sizes=(side, side)).heights()

# --- ContactMechanics
from ContactMechanics import FreeFFTElasticHalfSpace
from ContactMechanics.Factory import make_system
from SurfaceTopography import Topography

modulus = 230000 / (2 * (1 - 0.3**2))
substrate = FreeFFTElasticHalfSpace(
    (64, 64), modulus, (side, side))
surface = Topography(heights, (side, side))
system = make_system(substrate=substrate, surface=surface)
found = system.minimize_proxy(external_force=force)
assert found.success
pressures = [1e6 * system.force / system.area_per_pt]
pressed = system.disp[:64, :64]
gaps = [1e-3 * (pressed - heights - found.offset)]

# --- tabor
import tabor as tb

surface = tb.Surface(1e-3 * heights, pixel=f"{side / 64} mm")
solid = tb.Solid(
    youngs_modulus="230 GPa", poissons_ratio=0.3,
    counter_youngs_modulus="230 GPa", counter_poissons_ratio=0.3)
contact = tb.contact(surface, 1e6 * force / side**2, solid,
                     boundary="free")
pressures, gaps = [contact.pressure], [contact.gap]
