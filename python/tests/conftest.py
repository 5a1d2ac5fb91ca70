"""What the tests share: a small surface of waves, a scan of the tree, and the program built beside the package."""

import os
import pathlib
import signal

import numpy as np
import pytest

import tabor as tb

signal.signal(signal.SIGINT, signal.default_int_handler)  # in the background Python ignores Ctrl-C, which some tests send
ROOT = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def scan_file():
    return ROOT / "surfaces" / "edt_before.x3p"


@pytest.fixture(scope="session")
def levelled(scan_file):
    return tb.read(scan_file).level("plane").crop("0,0,128,128")


@pytest.fixture(scope="session")
def program():
    """The command line program of the same build; its numbers are compared bit for bit."""
    path = os.environ.get("TABOR_PROGRAM")
    if not path:
        pytest.skip("TABOR_PROGRAM is not set: nothing to compare with")
    return path


def heights(n=32, seed=1):
    return 1e-6 * np.random.default_rng(seed).standard_normal((n, n))


@pytest.fixture(scope="session")
def rough():
    return tb.Surface(heights(), pixel=1e-6, periodic=True)


@pytest.fixture(scope="session")
def steel():
    return tb.Solid(youngs_modulus="210 GPa", poissons_ratio=0.3, shear_strength="300 MPa",
                    saturation_pressure="2 GPa")
