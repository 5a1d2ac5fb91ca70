"""A ball that falls on a lubricated flat: Reynolds' equation, elastic rings and the ball's motion, step by step.

Shares nothing with tabor but the equations: central differences on rings, complete elliptic integrals by the
arithmetic-geometric mean, constant time steps (second-order backward differences for the film, the trapezoidal rule for
the ball), one dense Newton system a step, p >= 0 by projection. The cases are rows of the table of R. Larsson and
E. Hoglund, Journal of Tribology 116 (1994) 770, whose groups all follow from R = 10 mm, E' = 230 GPa, eta0 = 0.1 Pa s.
`limit` is Richardson's limit of second order of both grids."""

import numpy as np

RADIUS, MODULUS, VISCOSITY = 0.01, 230e9, 0.1
ROWS = {  # layer, speed, mass, material: the groups H00, V0 1e12, M 1e-13, G
    "1": (0.005, 1.30, 7.475, 3500),
    "3": (0.005, 8.70, 7.475, 3500),
    "5": (0.005, 43.5, 7.475, 3500),
    "7": (0.005, 8.70, 1.49, 3500),
    "9": (0.005, 8.70, 0.75, 3500),
    "9, M = 0.7475e13": (0.005, 8.70, 0.7475, 3500),
    "11": (0.005, 8.70, 7.475, 4600),
    "16": (0.00125, 8.70, 7.475, 3500),
}
GRIDS = ((120, 240), (180, 360))  # nodes along the radius; time steps in the dry contact time


def elliptic(m):
    """Complete elliptic integrals K and E of the parameter m < 1."""
    a, b, total, power = np.ones_like(m), np.sqrt(1 - m), m / 2, 0.5
    for _ in range(40):
        c = (a - b) / 2
        a, b = (a + b) / 2, np.sqrt(a * b)
        power *= 2
        total = total + power * c**2
    k = np.pi / (2 * a)
    return k, k * (1 - total)


def disc(r, c):
    """Deflection times pi E' / 8 at radius r under unit pressure on a disc of radius c."""
    inside = r <= c
    ratio = np.where(inside, r / c, c / np.where(inside, 1, r)) ** 2
    k, e = elliptic(np.minimum(ratio, 1 - 1e-14))
    return np.where(inside, c * e, r * (e - (1 - ratio) * k))


def ring_kernel(nodes, step):
    """Deflection at r_i of unit pressure on the ring around r_j."""
    r, edge = np.arange(nodes + 1)[:, None] * step, (np.arange(nodes)[None, :] + 0.5) * step
    discs = disc(r, edge)
    return 8 / (np.pi * MODULUS) * np.diff(np.concatenate([np.zeros((nodes + 1, 1)), discs], axis=1), axis=1)


def laws(pressure, alpha):
    """Relative density and ln(eta / eta0), and their derivatives by the pressure."""
    scale = np.log(VISCOSITY) + 9.67
    z = alpha / (5.1e-9 * scale)
    rho, rho_slope = 1 + 0.6e-9 * pressure / (1 + 1.7e-9 * pressure), 0.6e-9 / (1 + 1.7e-9 * pressure) ** 2
    grown = (1 + 5.1e-9 * pressure) ** (z - 1)
    return rho, rho_slope, scale * (grown * (1 + 5.1e-9 * pressure) - 1), scale * z * 5.1e-9 * grown


def rigid_stage(layer, speed, mass):
    """Gap, speed and time when Hertz' deflection under the film's force reaches a hundredth of the gap."""
    gap = layer * np.exp(np.linspace(-1e-6, -7, 200001))
    x = gap / layer
    velocity = -speed - 6 * np.pi * VISCOSITY * RADIUS**2 / mass * (np.log(x) - 2 * (x - 1) + (x**2 - 1) / 2)
    force = -6 * np.pi * VISCOSITY * velocity * RADIUS**2 / gap * (1 - x) ** 2
    deflection = (1.5 * np.maximum(0, force) / (MODULUS * np.sqrt(RADIUS))) ** (2 / 3)
    at = np.argmax(deflection > 0.01 * gap)
    time = (np.diff(gap[: at + 1]) * 2 / (velocity[1 : at + 1] + velocity[:at])).sum()
    return gap[at], velocity[at], time


class Impact:
    """One impact, marched from the end of the rigid stage until the film carries nothing."""

    def __init__(self, layer, speed, mass, material, nodes, steps):
        self.nodes, self.steps = nodes, steps
        self.layer, self.speed = layer * RADIUS, speed * 1e-12 * MODULUS * RADIUS / VISCOSITY
        self.mass = mass * 1e13 * RADIUS * VISCOSITY**2 / MODULUS
        self.alpha = material / MODULUS
        self.gap, self.velocity, self.time = rigid_stage(self.layer, self.speed, self.mass)
        radius = np.sqrt(2 * RADIUS * (self.layer - self.gap))
        self.dr = radius / self.nodes
        self.r = np.arange(self.nodes + 1) * self.dr
        self.kernel = ring_kernel(self.nodes, self.dr)
        edge = (np.arange(self.nodes) + 0.5) * self.dr
        self.area = np.pi * np.diff(np.append(0, edge) ** 2)  # of the rings [m^2]
        self.edge = 2 * np.pi * edge / self.dr  # circumference over distance
        rigid = self.gap + self.r**2 / (2 * RADIUS)
        self.pressure = (3 * VISCOSITY * RADIUS * -self.velocity * (rigid**-2 - self.layer**-2))[:-1]
        self.before = [self.content(self.pressure, self.gap)[0]]  # rho h one and two steps ago
        approach = (15 * self.mass * self.speed**2 / (8 * np.sqrt(RADIUS) * MODULUS)) ** 0.4
        self.step = 2.943 * approach / self.speed / self.steps
        self.last = self.pressure

    def content(self, pressure, gap):
        """rho h [m] and h at the nodes inside the edge; h at the edge as the last of all."""
        film = gap + self.r**2 / (2 * RADIUS) + self.kernel @ pressure
        return laws(pressure, self.alpha)[0] * film[:-1], film

    def balance(self, pressure, gap):
        """What leaves every ring [m^3/s] with what it stores, and the derivatives by pressures and gap."""
        rho, rho_slope, log_eta, eta_slope = laws(pressure, self.alpha)
        mass, film = self.content(pressure, gap)
        rho, log_eta = np.append(rho, 1), np.append(log_eta, 0)
        eps = rho * film**3 * np.exp(-log_eta) / (12 * VISCOSITY)
        law = np.append(rho_slope / rho[:-1] - eta_slope, 0)
        between, drop = (eps[1:] + eps[:-1]) / 2, pressure - np.append(pressure[1:], 0)
        flow = self.edge * between * drop
        d_eps = (3 * eps / film)[:, None] * self.kernel
        d_eps[np.arange(self.nodes), np.arange(self.nodes)] += (eps * law)[:-1]
        d_drop = np.eye(self.nodes) - np.eye(self.nodes, k=1)
        d_flow = self.edge[:, None] * (between[:, None] * d_drop + drop[:, None] * (d_eps[1:] + d_eps[:-1]) / 2)
        by_gap = self.edge * drop * ((3 * eps / film)[1:] + (3 * eps / film)[:-1]) / 2
        if len(self.before) == 1:
            weight, stored = 1, mass - self.before[0]
        else:
            weight, stored = 1.5, 1.5 * mass - 2 * self.before[0] + 0.5 * self.before[1]
        d_mass = rho[:-1, None] * self.kernel[:-1]
        d_mass[np.arange(self.nodes), np.arange(self.nodes)] += rho_slope * film[:-1]
        rate = self.area / self.step
        outflow = np.diff(flow, prepend=0) + rate * stored
        jacobian = np.diff(d_flow, axis=0, prepend=0) + weight * rate[:, None] * d_mass
        scale = self.edge * between + np.append(0, (self.edge * between)[:-1])
        return outflow / scale, jacobian / scale[:, None], (np.diff(by_gap, prepend=0) + weight * rate * rho[:-1]) / scale

    def advance(self):
        """One time step; the film at its end."""
        force = self.area @ self.pressure
        drift = self.gap + self.step * self.velocity + self.step**2 / 4 * force / self.mass
        pull = self.step**2 / 4 / self.mass * self.area
        pressure = np.maximum(0, 2 * self.pressure - self.last)
        gap = drift + pull @ pressure
        for _ in range(50):
            residual, jacobian, column = self.balance(pressure, gap)
            torn = (pressure <= 0) & (residual > 0)
            residual, column = np.where(torn, pressure, residual), np.where(torn, 0, column)
            jacobian = np.where(torn[:, None], np.eye(self.nodes), jacobian)
            # The gap follows from the pressures: gap = drift + pull . pressure.
            change = np.linalg.solve(jacobian + np.outer(column, pull), -residual - column * (drift + pull @ pressure - gap))
            film, ease = self.content(pressure, gap)[1], 1.0
            while True:
                after = np.maximum(0, pressure + ease * change)
                next_gap = drift + pull @ after
                thinnest = (self.content(after, next_gap)[1] / film).min()
                if thinnest > 0.3:
                    break
                ease /= 2
            moved = np.max(np.abs(after - pressure)) / max(after.max(), 1.0)
            pressure, gap = after, next_gap
            if moved < 1e-9:
                break
        else:
            raise RuntimeError("no convergence of a time step")
        self.velocity += self.step / 2 * (force + self.area @ pressure) / self.mass
        self.last, self.pressure, self.gap = self.pressure, pressure, gap
        self.time += self.step
        mass, film = self.content(pressure, gap)
        self.before = [mass, self.before[0]]
        return film

    def run(self):
        history = []
        while not history or history[-1][1] > 1e-4 * max(at[1] for at in history):
            film = self.advance()
            history.append((self.time, self.area @ self.pressure, film.min(), self.pressure[0]))
            if len(history) > 20 * self.steps:
                raise RuntimeError("the impact does not end")
        return self.measures(np.array(history))

    def measures(self, history):
        time, force, film, central = history.T
        time_force, largest = peak(time, force, np.argmax(force))
        time_film, smallest = peak(time, film, np.argmin(film))
        threshold = 1e-4 * largest
        over, under = force[-2] - threshold, threshold - force[-1]
        end = time[-2] + (time[-1] - time[-2]) * over / (over + under)
        peaks = [i for i in range(1, len(central) - 1) if central[i - 1] < central[i] > central[i + 1]]
        found = {"force": largest / (MODULUS * RADIUS**2), "min_film": smallest / RADIUS,
                 "delay": (time_film - time_force) / (end - time_force), "restitution": self.velocity / self.speed}
        if len(peaks) > 1:  # the last one is the spike as the film closes
            found["primary_pressure"] = peak(time, central, peaks[0])[1] / MODULUS
        return found


def peak(time, values, i):
    """Place and height of a parabola's vertex through three points."""
    before, at, after = values[i - 1 : i + 2]
    shift = (before - after) / (2 * (before - 2 * at + after))
    return time[i] + shift * (time[i + 1] - time[i]), at - (before - after) * shift / 4


def compute():
    table = {}
    for name, groups in ROWS.items():
        coarse, fine = (Impact(*groups, nodes, steps).run() for nodes, steps in GRIDS)
        ratio = (GRIDS[1][0] / GRIDS[0][0]) ** 2 - 1
        limit = {key: fine[key] + (fine[key] - coarse[key]) / ratio for key in fine if key in coarse}
        table[name] = {"fine": fine, "limit": limit}
    return table
