"""Film of a line contact: Reynolds' equation, the elastic half-plane and the load as one dense Newton system.

Shares nothing with tabor but the equations: central differences on cells of uniform pressure, the log kernel as a full
matrix, p >= 0 by projection, everything in units of Hertz' contact. The case is Table 6 of M. Akchurin's thesis
(HDPE on steel in glycerol-water) and readings of it. Two grids each; `limit` is their Richardson limit of second order."""

import numpy as np

TABLE_6 = {"radius": 2.5e-3, "modulus": 1.05e9 / (1 - 0.35**2), "load": 5000.0, "speed": 7.9e-3, "viscosity": 0.3638,
           "alpha": 5.9e-9, "compressible": False}
READINGS = {
    "Table 6": {},
    "constant viscosity": {"alpha": 0.0},
    "compressible": {"compressible": True},
    "half the modulus": {"modulus": TABLE_6["modulus"] / 2},
    "twice the modulus": {"modulus": TABLE_6["modulus"] * 2},
    "twice the load": {"load": 10000.0},
    "half the speed": {"speed": 3.95e-3},
    "half the speed, a ball of 2.381 mm": {"speed": 3.95e-3, "radius": 2.381e-3, "load": 5 / (0.4 * 2.381e-3)},
    "0.168 Pa s": {"viscosity": 0.168},
    "0.987 Pa s": {"viscosity": 0.987},
}
NODES = (400, 800)
INLET, OUTLET = 5.0, 2.0  # half widths of the contact


def density(pressure, compressible):
    """Relative density and its derivative: (5.9e8 + 1.34 p) / (5.9e8 + p), or 1."""
    if not compressible:
        return np.ones_like(pressure), np.zeros_like(pressure)
    return (5.9e8 + 1.34 * pressure) / (5.9e8 + pressure), 0.34 * 5.9e8 / (5.9e8 + pressure) ** 2


def log_kernel(nodes, step):
    """Deflection at node i of uniform pressure on cell j, H = ... - (1/pi) int P ln|X - X'| dX'."""
    edge = (np.arange(nodes)[:, None] - np.arange(nodes)[None, :])[..., None] * step + np.array([-0.5, 0.5]) * step
    antiderivative = edge * (np.log(np.abs(edge)) - 1)
    return -(antiderivative[..., 1] - antiderivative[..., 0]) / np.pi


def solve(case, nodes):
    """Smallest and central film [nm], largest pressure [MPa], friction of pure shear [1]."""
    half_width = np.sqrt(4 * case["load"] * case["radius"] / (np.pi * case["modulus"]))
    hertz = 2 * case["load"] / (np.pi * half_width)
    wedge = 12 * case["viscosity"] * case["speed"] * case["radius"] ** 2 / (half_width**3 * hertz)
    x = np.linspace(-INLET, OUTLET, nodes)
    step = x[1] - x[0]
    kernel = log_kernel(nodes, step)
    pressure = np.sqrt(np.maximum(0, 1 - x**2))
    # From ten times the film of the elastic isoviscous formula of Moes, 2.05 M^(-1/5) and a quarter more in the centre.
    speed = case["viscosity"] * case["speed"] / (2 * case["modulus"] * case["radius"])
    moes = case["load"] / (2 * case["modulus"] * case["radius"]) / np.sqrt(2 * speed)
    film = 26 * moes**-0.2 * np.sqrt(2 * speed) * case["radius"] ** 2 / half_width**2
    offset = film - (x**2 / 2 + kernel @ pressure)[np.argmin(np.abs(x))]
    pressure, height = settle(case, pressure, offset, x, kernel, hertz, wedge)
    unit = half_width**2 / case["radius"]
    sheared = (case["viscosity"] * np.exp(case["alpha"] * hertz * pressure) / (height * unit) * (pressure > 0)).sum()
    friction = sheared * 2 * case["speed"] * step * half_width / case["load"]
    return {"min_film_nm": smallest(height) * unit * 1e9, "central_film_nm": np.interp(0, x, height) * unit * 1e9,
            "max_pressure_mpa": -smallest(-pressure) * hertz * 1e-6, "friction": friction}


def settle(case, pressure, offset, x, kernel, hertz, wedge):
    """Pressure and film at rest: one Newton step of implicit Euler per time step, which grows until it is Newton's alone."""
    duration, before = 0.01, None
    for _ in range(400):
        residual, jacobian, height, mass = equations(case, pressure, offset, x, kernel, hertz, wedge, duration, before)
        change = np.linalg.solve(jacobian, -residual)
        after = np.maximum(0, pressure + np.pad(change[:-1], 1))
        thinning = -(change[-1] + kernel @ (after - pressure)) / height
        if thinning.max() > 0.5:
            duration /= 4
            continue
        moved = np.max(np.abs(after - pressure))
        pressure, offset, before = after, offset + change[-1], mass
        duration *= 2 if moved < 0.1 else 0.7 if moved > 0.5 else 1.2
        if moved < 1e-12 and duration > 1e3:
            return pressure, height
    raise RuntimeError("no convergence of the line contact")


def smallest(values):
    """Least value of a parabola through the least node and its neighbours."""
    i = np.argmin(values)
    before, at, after = values[i - 1 : i + 2]
    return at - (after - before) ** 2 / (8 * (before - 2 * at + after))


def equations(case, pressure, offset, x, kernel, hertz, wedge, duration, before):
    """Residual and Jacobian by the inner pressures and the offset, the film and its mass (`before`: a time step ago)."""
    step = x[1] - x[0]
    height = offset + x**2 / 2 + kernel @ pressure
    viscosity = np.exp(case["alpha"] * hertz * pressure)
    rho, rho_slope = density(hertz * pressure, case["compressible"])
    rho_slope *= hertz
    eps = rho * height**3 / (viscosity * wedge)
    between, gradient = (eps[1:] + eps[:-1]) / 2, np.diff(pressure) / step
    flow = -between * gradient + (rho * height)[:-1] / 2 + (rho * height)[1:] / 2
    # Derivatives of eps and rho h at every node by every pressure.
    d_eps = (3 * eps / height)[:, None] * kernel
    d_eps[np.diag_indices_from(d_eps)] += eps * (rho_slope / rho - case["alpha"] * hertz)
    d_mass = rho[:, None] * kernel
    d_mass[np.diag_indices_from(d_mass)] += rho_slope * height
    unity = np.eye(x.size)
    d_flow = (-gradient[:, None] * (d_eps[1:] + d_eps[:-1]) / 2 - between[:, None] * np.diff(unity, axis=0) / step
              + (d_mass[1:] + d_mass[:-1]) / 2)
    by_offset = -gradient * (3 * eps / height)[1:] / 2 - gradient * (3 * eps / height)[:-1] / 2
    by_offset += (rho[1:] + rho[:-1]) / 2
    rate = step / duration
    squeezed = rho * height - (rho * height if before is None else before)
    outflow = np.diff(flow) + rate * squeezed[1:-1]
    d_outflow = (np.diff(d_flow, axis=0) + rate * d_mass[1:-1])[:, 1:-1]
    scale = (between[1:] + between[:-1]) / step  # turns the outflow into a pressure
    torn = (pressure[1:-1] <= 0) & (outflow > 0)
    residual = np.where(torn, pressure[1:-1], outflow / scale)
    jacobian = np.where(torn[:, None], np.eye(x.size - 2), d_outflow / scale[:, None])
    column = np.where(torn, 0, (np.diff(by_offset) + rate * rho[1:-1]) / scale)
    load = pressure.sum() * step - np.pi / 2
    jacobian = np.block([[jacobian, column[:, None]], [np.full((1, x.size - 2), step), np.zeros((1, 1))]])
    return np.append(residual, load), jacobian, height, rho * height


def limit(coarse, fine, ratio):
    """Where values of second order on two grids tend."""
    return {key: fine[key] + (fine[key] - coarse[key]) / (ratio**2 - 1) for key in fine}


def compute():
    table = {}
    for name, change in READINGS.items():
        coarse, fine = (solve(TABLE_6 | change, nodes) for nodes in NODES)
        table[name] = {"fine": fine, "limit": limit(coarse, fine, (NODES[1] - 1) / (NODES[0] - 1))}
    return table
