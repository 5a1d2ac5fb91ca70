"""Copies of the process and its end: nothing hangs, nothing aborts."""

import contextlib
import os
import signal
import subprocess
import sys
import textwrap

import pytest

import tabor as tb

HEAD = """
import os, sys, threading, time
import numpy as np, numpy.random, tabor as tb
from concurrent.futures import ProcessPoolExecutor
import multiprocessing, warnings
warnings.simplefilter("ignore", tb.Doubt)
def surface(n=128):
    return tb.Surface(1e-6 * np.random.default_rng(1).standard_normal((n, n)), pixel=1e-6, periodic=True)
def area(pressure):
    return tb.contact(surface(), pressure, tb.Solid('aluminium-6016')).area_fraction
"""


def run(program, timeout=120, head=HEAD):
    """What a program prints; it must end by itself, well and without a word of complaint."""
    words = [sys.executable, "-W", "ignore::DeprecationWarning", "-c", head + textwrap.dedent(program)]
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True) as begun:
        try:
            printed, complaints = begun.communicate(timeout=timeout)
        finally:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(begun.pid, signal.SIGKILL)  # with the copies that hang
    assert begun.returncode == 0 and not complaints, (begun.returncode, complaints)
    return printed.split()


FORK = 'multiprocessing.get_context("fork")'


@pytest.mark.parametrize("pool", [f"ProcessPoolExecutor(2, mp_context={FORK})", f"{FORK}.Pool(2)"])
def test_a_forked_pool_works_after_a_contact(pool):
    printed = run(f"""
        tb.set_threads(2)
        before = [area(2e6), area(7e6)]
        with {pool} as pool:
            print(list(pool.map(area, [2e6, 7e6])) == before)
        print(area(2e6) == before[0])
    """)
    assert printed == ["True", "True"]


def test_a_copy_has_one_thread_and_does_all_there_is():
    printed = run("""
        tb.set_threads(2)
        before = area(2e6)
        child = os.fork()
        if child == 0:
            print(tb._tabor.threads(), flush=True)
            tb.set_threads(2)  # asked for, and still safe
            one = surface().level("plane").lowpass("gauss:8um")
            found = tb.contact(one, 2e6, tb.Solid('aluminium-6016'))
            film = tb.rain(one, "0.45 g/m^2")
            friction = tb.friction(found, film, shear_strength=1e8)
            one.psd(), one.parameters(["Sq"]), tb.density_curve(found, shear_strength=1e8)
            os._exit(0 if area(2e6) == before and friction.dry > 0 else 1)
        print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), tb._tabor.threads())
    """)
    assert printed == ["1", "0", "2"]


def test_a_copy_made_in_the_middle_of_a_computation_works():
    printed = run("""
        tb.set_threads(2)
        stop = []
        def work():
            while not stop:
                area(3e6)
        area(2e6)  # loads what NumPy loads when it is needed: a copy made meanwhile would wait for that
        thread = threading.Thread(target=work)
        thread.start()
        codes = []
        for _ in range(5):
            time.sleep(0.02)
            child = os.fork()
            if child == 0:
                os._exit(0 if area(2e6) > 0 else 1)
            codes.append(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
        stop.append(True)
        thread.join()
        print(sum(codes))
    """)
    assert printed == ["0"]


def test_a_copy_of_a_process_that_computed_nothing_may_ask_for_threads():
    printed = run("""
        child = os.fork()
        if child == 0:
            tb.set_threads(2)
            print(tb._tabor.threads(), area(2e6) > 0, flush=True)
            os._exit(0)
        print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
    """)
    assert printed == ["2", "True", "0"]


WORK = {
    "contact": "tb.contact(surface(1024), np.geomspace(1e6, 1e8, 99), tb.Solid('aluminium-6016'), tolerance=1e-12)",
    "rain": "tb.rain(surface(1024), '3 g/m^2', droplet_height=1e-9)",
    "psd": "[surface(2048).psd() for _ in range(999)]",
    "told": "tb.contact(surface(1024), np.geomspace(1e6, 1e8, 99), tb.Solid('aluminium-6016'), tolerance=1e-12, progress=lambda *_: sum(range(9999)))",
    "sweep": "tb.ehl.point(tb.ehl.template('point')).sweep({'motion.speed': np.geomspace(1e-3, 10, 99)})",
    "many": "[area(p) for p in np.linspace(1e6, 9e6, 9999)]",
}


@pytest.mark.parametrize("work", WORK)
@pytest.mark.parametrize("wait", [0.05, 0.4])
def test_a_daemon_thread_inside_a_call_ends_quietly(work, wait):
    printed = run(f"""
        thread = threading.Thread(target=lambda: {WORK[work]}, daemon=True)
        thread.start()
        time.sleep({wait})
        print(thread.is_alive())
    """, timeout=30)
    assert printed == ["True"]


def test_several_daemon_threads_do():
    assert run("""
        for _ in range(4):
            threading.Thread(target=lambda: [area(p) for p in np.linspace(1e6, 9e6, 9999)], daemon=True).start()
        time.sleep(0.3)
        print("end")
    """, timeout=30) == ["end"]


def test_what_runs_at_exit_still_computes():
    assert run("""
        import atexit
        atexit.register(lambda: print(area(2e6) > 0))  # after that of the package, so before it
    """) == ["True"]
    before = "import atexit\natexit.register(lambda: print(area(2e6) > 0))\n"
    assert run("", head=before + HEAD) == ["True"]


def test_nothing_is_said_about_what_is_still_there_at_the_end():
    assert run("""
        import builtins
        builtins.kept = [tb.contact(surface(), 2e6, tb.Solid('aluminium-6016')), tb.rain(surface(), 0)]
        builtins.kept.append(builtins.kept)
        print("end")
    """) == ["end"]


def test_pickles_name_classes_where_users_find_them():
    for name in tb.__all__:
        thing = getattr(tb, name)
        if isinstance(thing, type):
            assert (thing.__module__, thing.__qualname__) == ("tabor", name)
    for name in ("Case", "Key", "Limit", "Solution", "Sweep"):
        assert getattr(tb.ehl, name).__module__ == "tabor.ehl"
