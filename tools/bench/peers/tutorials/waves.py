# Nine loads on waves
# The waves of ContactMechanics' notebook `Hardwall_Simulation`, in mm, N and MPa, loaded step by
# step.

# --- surface: NumPy
import numpy as np

side = 2 * np.pi
x = np.arange(64) * side / 64
heights = 0.1 * np.sin(x[:, None]) * np.sin(2 * x)

# --- ContactMechanics
import numpy as np
from ContactMechanics import PeriodicFFTElasticHalfSpace
from ContactMechanics.Factory import make_system
from SurfaceTopography import Topography

modulus = 230000 / (2 * (1 - 0.3**2))
substrate = PeriodicFFTElasticHalfSpace(
    (64, 64), modulus, (side, side))
surface = Topography(heights, (side, side), periodic=True)
system = make_system(substrate=substrate, surface=surface)
pressures, gaps, start = [], [], None
for force in np.linspace(0, 100000, 10)[1:]:
    found = system.minimize_proxy(
        external_force=force, initial_displacements=start,
        forcetol=1e-4, maxiter=100000)
    assert found.success
    start = system.disp
    pressures.append(1e6 * system.force / system.area_per_pt)
    gaps.append(1e-3 * (system.disp - heights - found.offset))

# --- tabor
import numpy as np
import tabor as tb

surface = tb.Surface(1e-3 * heights, pixel=f"{side / 64} mm",
                     periodic=True)
solid = tb.Solid(
    youngs_modulus="230 GPa", poissons_ratio=0.3,
    counter_youngs_modulus="230 GPa", counter_poissons_ratio=0.3)
forces = np.linspace(0, 100000, 10)[1:]
contacts = tb.contact(surface, 1e6 * forces / side**2, solid)
pressures = [one.pressure for one in contacts]
gaps = [one.gap for one in contacts]
