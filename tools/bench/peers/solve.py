"""Solves one contact problem with one peer, in a process of its own.

    python solve.py REQUEST.json

The request names the tool, its option, its tolerance and the problem; the pressure field [Pa] goes
to the .npy file it names and one JSON object to standard output. Only the solve call is timed: not
the import of the tool, not the reading of the heights, not the construction of its objects.
"""

from __future__ import annotations

import contextlib
import json
import resource
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np


@dataclass
class Problem:
    height: np.ndarray  # [m], asperities up, n x n
    pixel: float  # [m]
    effective_modulus: float  # E* [Pa]
    mean_pressure: float  # [Pa]
    saturation_pressure: float  # [Pa], inf: elastic

    @property
    def side(self) -> float:
        return self.height.shape[0] * self.pixel

    @property
    def is_saturated(self) -> bool:
        return bool(np.isfinite(self.saturation_pressure))


# A prepared solve: called once, timed; returns the pressure [Pa] and how the tool ended.
Solve = Callable[[], tuple[np.ndarray, dict]]


def tamaas(problem: Problem, option: str, tolerance: float, threads: int) -> Solve:
    """Rey, Anciaux & Molinari's solver, on the pressure or the gap; saturated: Kato's."""
    import tamaas as tm

    tm.set_log_level(tm.LogLevel.error)
    tm.initialize(threads)
    # Kato's step has a fixed size that suits lengths over the side and pressures over E*.
    n, scale = problem.height.shape[0], problem.effective_modulus
    model = tm.ModelFactory.createModel(tm.model_type.basic_2d, [1.0, 1.0], [n, n])
    model.E, model.nu = 1.0, 0.0
    height = problem.height / problem.side
    if problem.is_saturated:
        solver = tm.KatoSaturated(model, height, tolerance, problem.saturation_pressure / scale)
    else:
        primal = getattr(tm.PolonskyKeerRey, option)
        solver = tm.PolonskyKeerRey(model, height, tolerance, primal, tm.PolonskyKeerRey.pressure)
    solver.max_iter = 100_000

    def solve() -> tuple[np.ndarray, dict]:
        error = solver.solve(problem.mean_pressure / scale)
        return np.array(model.traction) * scale, {"own_error": float(error)}

    return solve


def contact_mechanics(problem: Problem, option: str, tolerance: float, threads: int) -> Solve:
    """Polonsky & Keer with restarts (the default) or Bugnicourt's gradients without restart."""
    del threads  # its transforms run on one thread
    from ContactMechanics import PeriodicFFTElasticHalfSpace
    from ContactMechanics.PlasticSystemSpecialisations import PlasticNonSmoothContactSystem
    from ContactMechanics.Systems import NonSmoothContactSystem
    from SurfaceTopography import PlasticTopography, Topography

    shape, side = problem.height.shape, problem.side
    half_space = PeriodicFFTElasticHalfSpace(shape, problem.effective_modulus, (side, side))
    surface = Topography(problem.height, (side, side), periodic=True)
    pixel_area = problem.pixel**2
    gap_tolerance = tolerance * float(problem.height.std())
    if problem.is_saturated:
        surface = PlasticTopography(surface, problem.saturation_pressure)
        system = PlasticNonSmoothContactSystem(half_space, surface)
    else:
        system = NonSmoothContactSystem(half_space, surface)
    if option == "without restart":
        return _without_restart(system, problem, gap_tolerance)
    settings = {"pentol": gap_tolerance, "forcetol": tolerance * problem.mean_pressure * pixel_area}
    if problem.is_saturated:
        settings |= _saturated_settings(problem)

    def solve() -> tuple[np.ndarray, dict]:
        result = system.minimize_proxy(
            external_force=problem.mean_pressure * side**2, maxiter=100_000, **settings
        )
        ended = {"iterations": int(result.nit), "converged": bool(result.success)}
        return np.array(result.jac) / pixel_area, ended

    return solve


def _saturated_settings(problem: Problem) -> dict:
    """From its own start the saturated solve does not find the load: it gets the bearing area.

    Capping loses part of the load in every iteration, so that only a loose load error is reached.
    """
    highest = np.argsort(problem.height, axis=None)[::-1]
    n_capped = int(problem.height.size * problem.mean_pressure / problem.saturation_pressure)
    forces = np.zeros(problem.height.size)  # negative is compression
    forces[highest[:n_capped]] = -problem.saturation_pressure * problem.pixel**2
    return {
        "initial_forces": forces.reshape(problem.height.shape),
        "forcetol": 1e-3 * problem.saturation_pressure * problem.pixel**2,
        "thermotol": 1e-3,
    }


def _without_restart(system, problem: Problem, gap_tolerance: float) -> Solve:
    from NuMPI.Optimization import CCGWithoutRestart

    n_pixels, pixel_area = problem.height.size, problem.pixel**2
    start = np.full(n_pixels, problem.mean_pressure * pixel_area)

    def solve() -> tuple[np.ndarray, dict]:
        result = CCGWithoutRestart.constrained_conjugate_gradients(
            system.dual_objective(0.0, gradient=True),
            system.dual_hessian_product,
            x0=start,
            mean_val=problem.mean_pressure * pixel_area,
            gtol=gap_tolerance,
            maxiter=20_000,
        )
        ended = {"iterations": int(result.nit), "converged": bool(result.success)}
        return result.x.reshape(problem.height.shape) / pixel_area, ended

    return solve


def slippy(problem: Problem, option: str, tolerance: float, threads: int) -> Solve:
    """Polonsky & Keer, Rey (elastic), or slippy's double iteration (saturated)."""
    import slippy as package

    package.CORES = threads
    import slippy.contact as contact
    import slippy.surface as surface

    # The mean mode is dropped as everywhere else; the double iteration needs it to be positive.
    zero_frequency = None if option == "double" else 0.0
    rough = surface.Surface(profile=problem.height, grid_spacing=problem.pixel)
    flat = surface.FlatSurface(shift=(0, 0))
    rough.material = contact.Elastic(
        "rough", {"E": problem.effective_modulus, "v": 0.0},
        max_load=problem.saturation_pressure, zero_frequency_value=zero_frequency,
    )
    flat.material = contact.rigid
    model = contact.ContactModel("peers", rough, flat)
    step = contact.StaticStep(
        "press", normal_load=problem.mean_pressure * problem.side**2, adhesion=False,
        periodic_axes=(True, True), method=option,
        tolerance=tolerance, tolerance_outer=tolerance, max_it=100_000, max_it_outer=200,
    )
    model.add_step(step)

    def solve() -> tuple[np.ndarray, dict]:
        state = model.solve(skip_data_check=True)
        return np.array(state["loads_z"]), {"converged": bool(state.get("converged", True))}

    return solve


def aspher(problem: Problem, option: str, tolerance: float, threads: int) -> Solve:
    """Nested grids with the |q| preconditioner, in double or first in single precision."""
    del threads  # OMP_NUM_THREADS
    import aspher as package

    n = problem.height.shape[0]
    scale = problem.effective_modulus  # pressures over E*, lengths over the side
    gap = ((problem.height.max() - problem.height) / problem.side).ravel()
    precision, engine = option.split(", ")

    def solve() -> tuple[np.ndarray, dict]:
        result = package.solve_nested(
            grid_size=n, gap=gap, p_nominal=problem.mean_pressure / scale, backend="periodic",
            tol=tolerance, precision=precision, precond_engine=engine, light_result=True,
        )
        ended = {
            "iterations": int(result.iterations),
            "converged": bool(result.converged),
            "own_error": float(result.fw_error),
        }
        return np.array(result.pressure).reshape(n, n) * scale, ended

    return solve


TOOLS: dict[str, Callable[[Problem, str, float, int], Solve]] = {
    "Tamaas": tamaas,
    "ContactMechanics": contact_mechanics,
    "slippy": slippy,
    "ASPHER": aspher,
}


def resident_bytes() -> int:
    with open("/proc/self/statm", encoding="ascii") as statm:
        return int(statm.read().split()[1]) * resource.getpagesize()


def peak_bytes() -> int:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024


def measure(solve: Solve) -> tuple[np.ndarray, dict]:
    before, processor, wall = resident_bytes(), time.process_time(), time.perf_counter()
    pressure, ended = solve()
    ended["seconds"] = time.perf_counter() - wall
    ended["processor_seconds"] = time.process_time() - processor
    ended["before_bytes"], ended["peak_bytes"] = before, peak_bytes()
    return pressure, ended


def main() -> None:
    with open(sys.argv[1], encoding="utf-8") as file:
        request = json.load(file)
    problem = Problem(
        np.load(request["heights"]), request["pixel"], request["effective_modulus"],
        request["mean_pressure"], float(request["saturation_pressure"]),
    )
    with contextlib.redirect_stdout(sys.stderr):  # tools talk; standard output is the answer
        prepare = TOOLS[request["tool"]]
        solve = prepare(problem, request["option"], request["tolerance"], request["threads"])
        pressure, ended = measure(solve)
    np.save(request["pressure"], np.ascontiguousarray(pressure, dtype=np.float64))
    print(json.dumps(ended))


if __name__ == "__main__":
    main()
