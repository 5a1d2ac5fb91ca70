"""The package is there at once: it loads nothing that few need, and no module of its own takes long."""

import subprocess
import sys

#: Packages that only some functions need.
OPTIONAL = ("matplotlib", "pandas", "xarray", "h5py", "pint", "scipy", "bokeh", "tqdm", "IPython", "asyncio", "multiprocessing", "tornado")
SECONDS = 0.5
CODE = """
import sys, time
import numpy
start = time.process_time()
import tabor
print(time.process_time() - start)
print(*sys.modules)
"""


def test_it_is_imported_in_half_a_second_of_the_processor_and_loads_no_optional_package():
    runs = [subprocess.run([sys.executable, "-c", CODE], check=True, capture_output=True, text=True).stdout.splitlines() for _ in range(3)]
    assert min(float(run[0]) for run in runs) < SECONDS
    assert not {name.partition(".")[0] for name in runs[0][1].split()} & set(OPTIONAL)
