# A cone that yields, loaded and unloaded
# ContactMechanics' notebook `plastic_simulation_cone`, in mm, N and MPa. Each load acts on the
# surface that the previous one has deformed.

# --- surface: NumPy
import numpy as np

side = 0.005
x = np.arange(128) * side / 128 - side / 2
heights = -0.05 * np.hypot(x[:, None], x)
forces = np.array([0.001, 0.005, 0.01, 0.02, 0.01, 0.005, 0.001])

# --- ContactMechanics
import numpy as np
from ContactMechanics import FreeFFTElasticHalfSpace
from ContactMechanics.Factory import make_plastic_system
from SurfaceTopography import PlasticTopography, Topography

substrate = FreeFFTElasticHalfSpace(
    (128, 128), 230000, (side, side))
surface = PlasticTopography(
    Topography(heights, (side, side)), hardness=6000)
system = make_plastic_system(substrate=substrate,
                             surface=surface)
start = np.zeros(substrate.nb_domain_grid_pts)
start[:128, :128] = np.maximum(heights + 2e-5, 0)
pressures, gaps = [], []
for force in forces:
    found = system.minimize_proxy(
        external_force=force, initial_displacements=start,
        pentol=1e-10)
    assert found.success
    start = system.disp
    pressures.append(1e6 * system.force / system.area_per_pt)
    left = system.surface.heights() + found.offset
    gaps.append(1e-3 * (start[:128, :128] - left))

# --- tabor
import tabor as tb

surface = tb.Surface(1e-3 * heights, pixel=f"{side / 128} mm")
solid = tb.Solid(youngs_modulus="230 GPa", poissons_ratio=0,
                 saturation_pressure="6 GPa")
contacts = tb.contact(surface, 1e6 * forces / side**2, solid,
                      boundary="free", load_path=True)
pressures = [one.pressure for one in contacts]
gaps = [one.gap for one in contacts]
