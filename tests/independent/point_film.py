"""Film of a circular point contact: Reynolds' equation, the elastic half-space and the load as one dense Newton system.

Shares nothing with tabor but the equations: differences of second order on half of the symmetric domain, Love's deflection of
squares as a full matrix, implicit Euler towards the steady film, p >= 0 by projection, everything in units of Hertz'
contact (Venner & Lubrecht 2000, chapter 6). The largest pressure is left out: no such grid resolves its spike. The case is M = 20, L = 10 (alpha = 2.2e-8 1/Pa, Roelands with z = 0.6) between
-4.5 and 1.5 half axes. `limit` is Richardson's limit of second order of the two finest grids."""

import numpy as np
import scipy.sparse

M, L, ALPHA, Z, ROELANDS_PRESSURE = 20.0, 10.0, 2.2e-8, 0.6, 5.1e-9
INLET, OUTLET, HALF_WIDTH = 4.5, 1.5, 3.0
NODES = (33, 57, 81)
MAX_PRESSURE = L / np.pi * (1.5 * M) ** (1 / 3) / ALPHA  # of Hertz [Pa]
WEDGE = (128 * np.pi**3 / (3 * M**4)) ** (1 / 3)


def density(pressure, compressible):
    """Relative density of Dowson and Higginson and its derivative by the pressure over that of Hertz."""
    if not compressible:
        return np.ones_like(pressure), np.zeros_like(pressure)
    pascal = MAX_PRESSURE * pressure
    return 1 + 0.6e-9 * pascal / (1 + 1.7e-9 * pascal), 0.6e-9 * MAX_PRESSURE / (1 + 1.7e-9 * pascal) ** 2


def log_viscosity(pressure):
    """ln(eta / eta0) of Roelands and its derivative by the pressure over that of Hertz."""
    scale, pascal = ALPHA / (ROELANDS_PRESSURE * Z), MAX_PRESSURE * pressure
    slope = scale * ROELANDS_PRESSURE * Z * (1 + ROELANDS_PRESSURE * pascal) ** (Z - 1) * MAX_PRESSURE
    return scale * ((1 + ROELANDS_PRESSURE * pascal) ** Z - 1), slope


def love_kernel(nodes, half, step):
    """Deflection (2 / pi^2) int P / |r - r'| dA' of squares and their mirror images, rows and columns (y, x) from the axis."""
    def corner(x, y):
        return x * np.arcsinh(y / np.abs(x)) + y * np.arcsinh(x / np.abs(y))
    x = np.arange(-nodes + 1, nodes)[:, None] * step
    y = np.arange(-2 * half + 2, 2 * half - 1)[None, :] * step
    side = step / 2
    square = corner(x + side, y + side) - corner(x - side, y + side) - corner(x + side, y - side) + corner(x - side, y - side)
    i, j = np.arange(nodes), np.arange(half)
    across = i[:, None] - i[None, :] + nodes - 1
    direct = square[across[None, :, None, :], (j[:, None] - j[None, :] + 2 * half - 2)[:, None, :, None]]
    mirrored = square[across[None, :, None, :], (j[:, None] + j[None, :] + 2 * half - 2)[:, None, :, None]]
    mirrored[:, :, 0, :] = 0  # the axis is its own image
    return 2 / np.pi**2 * (direct + mirrored).reshape(half * nodes, half * nodes)


def solve(nodes, compressible, start=None):
    """Films in a^2 / R, central pressure over that of Hertz; and what a finer grid starts from."""
    half = (nodes + 1) // 2
    x, y = np.linspace(-INLET, OUTLET, nodes), np.linspace(0, HALF_WIDTH, half)
    step = x[1] - x[0]
    kernel = love_kernel(nodes, half, step)
    bowl = ((x[None, :] ** 2 + y[:, None] ** 2) / 2).ravel()
    pressure = start(x, y).ravel() if start else np.sqrt(np.maximum(0, 1 - 2 * bowl))
    central = 0.45 if start else 1.0
    offset = central - (bowl + kernel @ pressure)[np.argmin(bowl)]
    pressure, height = settle((half, nodes, step, compressible), pressure, offset, bowl, kernel, 1.0 if start else 0.01)
    height, pressure = height.reshape(half, nodes), pressure.reshape(half, nodes)
    film = {"central_film": np.interp(0, x, height[0]), "min_film": height.min(), "central_pressure": np.interp(0, x, pressure[0])}
    return film, lambda xs, ys: between(xs, ys, x, y, pressure)


def between(xs, ys, x, y, values):
    """Values at (y, x) at other coordinates, by straight lines."""
    along = np.array([np.interp(xs, x, row) for row in values])
    return np.array([np.interp(ys, y, column) for column in along.T]).T


def settle(grid, pressure, offset, bowl, kernel, duration):
    """Pressure and film at rest: one Newton step of implicit Euler per time step, which grows until it is Newton's alone."""
    half, nodes, _, _ = grid
    inner = np.zeros((half, nodes), bool)
    inner[:-1, 1:-1] = True
    inner = np.flatnonzero(inner)
    before = None
    for _ in range(200):
        residual, jacobian, height, mass = equations(grid, pressure, offset, bowl, kernel, inner, duration, before)
        change = np.linalg.solve(jacobian, -residual)
        after = pressure.copy()
        after[inner] = np.maximum(0, pressure[inner] + change[:-1])
        if np.max(-(change[-1] + kernel @ (after - pressure)) / height) > 0.6:
            duration /= 4
            continue
        moved = np.max(np.abs(after - pressure))
        pressure, offset, before = after, offset + change[-1], mass
        duration *= 2 if moved < 0.1 else 1.2
        if moved < 1e-10:
            return pressure, height
    raise RuntimeError("no convergence of the point contact")


def equations(grid, pressure, offset, bowl, kernel, inner, duration, before):
    """Residual and Jacobian by the inner pressures and the offset, the film and its mass (`before`: a time step ago)."""
    half, nodes, step, compressible = grid
    height = offset + bowl + kernel @ pressure
    rho, rho_slope = density(pressure, compressible)
    log_eta, eta_slope = log_viscosity(pressure)
    eps = rho * height**3 * np.exp(-log_eta) / WEDGE
    mass = rho * height
    rate = step**2 / duration
    squeezed = rate * (mass - (mass if before is None else before))[inner]
    # Backward differences of second order, of first order beside the inlet: central ones let the film waver.
    first = inner % nodes == 1
    upwind = [(inner, np.where(first, 1, 1.5)), (inner - 1, np.where(first, -1, -2)),
              (inner - np.where(first, 1, 2), np.where(first, 0, 0.5))]
    outflow, total = squeezed + sum(step * weight * mass[node] for node, weight in upwind), np.zeros(inner.size)
    jacobian, column = np.zeros((inner.size, pressure.size)), np.zeros(inner.size)
    rows, films = np.arange(inner.size), []

    def depends(node, by_height, by_pressure):
        """The outflow's derivatives by film and pressure at a node."""
        nonlocal column
        films.append((by_height, (rows, node)))
        jacobian[rows, node] += by_pressure
        column += by_height

    for node, weight in [(inner, rate / step), *upwind]:
        depends(node, step * weight * rho[node], step * weight * (rho_slope * height)[node])
    below = np.where(inner < nodes, inner + nodes, inner - nodes)  # the axis mirrors the row beside it
    for neighbour in (inner + 1, inner - 1, inner + nodes, below):
        between, drop = (eps[inner] + eps[neighbour]) / 2, pressure[inner] - pressure[neighbour]
        outflow += between * drop
        total += between
        for node, sign in ((inner, 1), (neighbour, -1)):
            by_law = drop / 2 * (eps * (rho_slope / rho - eta_slope))[node]
            depends(node, drop * 1.5 * (eps / height)[node], by_law + sign * between)
    jacobian += sum(scipy.sparse.csr_array(film, shape=jacobian.shape) for film in films) @ kernel
    torn = (pressure[inner] <= 0) & (outflow > 0)
    jacobian = jacobian[:, inner]
    jacobian[torn] = np.eye(inner.size)[torn]
    jacobian[~torn] /= total[~torn, None]
    residual, column = np.where(torn, pressure[inner], outflow / total), np.where(torn, 0, column / total)
    share = np.where(inner < nodes, 1, 2) * step**2  # of the load: rows beside the axis count twice
    load = (share * pressure[inner]).sum() - 2 * np.pi / 3
    jacobian = np.block([[jacobian, column[:, None]], [share[None, :], np.zeros((1, 1))]])
    return np.append(residual, load), jacobian, height, mass


def compute():
    table = {}
    for name, compressible in (("compressible", True), ("incompressible", False)):
        films, start = [], None
        for nodes in NODES:
            film, start = solve(nodes, compressible, start)
            films.append(film)
        ratio = ((NODES[-1] - 1) / (NODES[-2] - 1)) ** 2 - 1
        limit = {key: films[-1][key] + (films[-1][key] - films[-2][key]) / ratio for key in films[-1]}
        table[name] = {f"{nodes} nodes": film for nodes, film in zip(NODES, films)} | {"limit": limit}
    return table
