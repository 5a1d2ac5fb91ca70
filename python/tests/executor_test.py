"""Executors compute the same bytes as tabor sweep, and lose nothing but what a worker had in hand."""

import concurrent.futures
import multiprocessing
import os
import pathlib
import signal
import subprocess
import sys
import threading
import time

import pytest

import tabor as tb
from study_test import folder, study_of  # noqa: F401

TABLES = ("results.csv", "averages.csv", "density_curves.csv")


def processes(n=2):
    return concurrent.futures.ProcessPoolExecutor(n, mp_context=multiprocessing.get_context("spawn"))


def bytes_in(results):
    """Of the tables and the store, without the locks; of contacts and films, which keep seconds and memory, the names."""
    files = [pathlib.Path(results, name) for name in TABLES if pathlib.Path(results, name).exists()]
    files += [one for one in pathlib.Path(results, "store").iterdir() if one.suffix in (".h5", ".json")]
    return {one.name: b"" if one.name.startswith(("contact-", "film-")) else one.read_bytes() for one in files}


@pytest.fixture(scope="module")
def swept(program, folder, tmp_path_factory):  # noqa: F811
    """The results of the command line."""
    results = tmp_path_factory.mktemp("swept")
    study_of(folder)._write(results / "study.toml")
    subprocess.run([program, "sweep", results / "study.toml", "-o", results, "--quiet"], check=True, capture_output=True)
    return bytes_in(results)


@pytest.mark.parametrize("store", ["shared", "return"])
def test_processes_give_the_bytes_of_the_command_line(swept, folder, tmp_path_factory, store):  # noqa: F811
    results = tmp_path_factory.mktemp("processes")
    with processes() as executor:
        found = study_of(folder).run(results, executor=executor, store=store)
        assert found.n_contacts == 4 and not found.failures
        assert bytes_in(results) == swept
        assert study_of(folder).run(results, executor=executor, store=store).n_contacts == 0


def test_threads_do_too(swept, folder, tmp_path_factory):  # noqa: F811
    results = tmp_path_factory.mktemp("threads")
    shares = []
    with concurrent.futures.ThreadPoolExecutor(2) as executor:
        study_of(folder).run(results, executor=executor, threads=2,
                             progress=lambda stage, share, _: shares.append(share) if "parts" in stage else None)
    assert bytes_in(results) == swept
    assert shares == [0.25, 0.5, 0.75, 1]


def test_what_is_stored_is_not_computed_again(folder, tmp_path_factory):  # noqa: F811
    results = tmp_path_factory.mktemp("some")
    study_of(folder, pressure="2 MPa").run(results)
    with concurrent.futures.ThreadPoolExecutor(1) as executor:
        assert study_of(folder).run(results, executor=executor).n_contacts == 2


def test_a_damaged_file_is_computed_again_and_named(swept, folder, tmp_path_factory):  # noqa: F811
    results = tmp_path_factory.mktemp("damaged")
    study_of(folder).run(results)
    damaged = next(pathlib.Path(results, "store").glob("contact-*.h5"))
    damaged.write_bytes(damaged.read_bytes()[:-9])
    with concurrent.futures.ThreadPoolExecutor(1) as executor:
        found = study_of(folder).run(results, executor=executor)
    assert found.n_contacts == 1 and any(damaged.name in one for one in found.warnings)
    assert bytes_in(results) == swept


def test_failures_are_those_of_a_run_without_workers(folder, tmp_path_factory):  # noqa: F811
    changes = {"treatment": ["level=plane", "crop=0,0,500,500"]}
    expected = study_of(folder, **changes).run(tmp_path_factory.mktemp("plain"))
    with concurrent.futures.ThreadPoolExecutor(1) as executor:
        for store in ("shared", "return"):
            found = study_of(folder, **changes).run(tmp_path_factory.mktemp(store), executor=executor, store=store)
            assert found.failures == expected.failures and len(found.failures) == 2
            assert bytes_in(found.folder)["results.csv"] == bytes_in(expected.folder)["results.csv"]


def kill_a_worker(executor, results):
    """As soon as there is a row."""
    while not list(pathlib.Path(results).glob("store/case-*.json")):
        time.sleep(0.01)
    os.kill(next(iter(executor._processes)), signal.SIGKILL)


def test_a_killed_worker_loses_its_task_alone(folder, tmp_path_factory):  # noqa: F811
    results, whole = tmp_path_factory.mktemp("killed"), tmp_path_factory.mktemp("whole")
    study = study_of(folder, pressure=[1e6 * (i + 1) for i in range(20)])
    with processes() as executor:
        killer = threading.Thread(target=kill_a_worker, args=(executor, results))
        killer.start()
        with pytest.raises(concurrent.futures.process.BrokenProcessPool):
            study.run(results, executor=executor)
        killer.join()
    deadline = time.monotonic() + 20
    while time.monotonic() < deadline:  # what the killed worker had started may hold the store a moment longer
        try:
            tb._tabor.missing_parts(study._study, results, False, None)
            break
        except ValueError as busy:
            assert "another sweep" in str(busy)
            time.sleep(0.1)
    n_kept = len(list(pathlib.Path(results).glob("store/contact-*.h5")))
    with processes() as executor:
        assert study.run(results, executor=executor).n_contacts == 40 - n_kept < 40
    study.run(whole)
    assert bytes_in(results) == bytes_in(whole)


def test_what_is_no_store_is_refused(folder, tmp_path):  # noqa: F811
    with pytest.raises(ValueError, match="store: got 'none'"):
        study_of(folder).run(tmp_path, store="none")


@pytest.mark.parametrize("store", ["shared", "return"])
def test_a_cluster_of_dask_gives_the_bytes_of_the_command_line(swept, folder, tmp_path_factory, store):  # noqa: F811
    distributed = pytest.importorskip("distributed")
    results = tmp_path_factory.mktemp("dask")
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, \
            distributed.Client(cluster) as client:
        study_of(folder).run(results, executor=client.get_executor(), store=store)
    assert bytes_in(results) == swept


MPI_PROGRAM = """
import sys, tabor as tb
from mpi4py.futures import MPIPoolExecutor
if __name__ == "__main__":
    with MPIPoolExecutor() as executor:
        tb.Study.read(sys.argv[1]).run(sys.argv[2], executor=executor)
"""


def test_two_ranks_of_mpi_give_the_bytes_of_the_command_line(swept, folder, tmp_path_factory):  # noqa: F811
    pytest.importorskip("mpi4py")
    launcher = pathlib.Path(sys.executable).parent / "mpiexec"
    if not launcher.exists():
        pytest.skip("no mpiexec beside Python")
    results = tmp_path_factory.mktemp("mpi")
    study_of(folder)._write(results / "study.toml")
    (results / "program.py").write_text(MPI_PROGRAM)
    subprocess.run([launcher, "-n", "2", sys.executable, "-m", "mpi4py.futures", results / "program.py",
                    results / "study.toml", results], check=True, timeout=120,
                   env={**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                        "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe"})
    assert bytes_in(results) == swept
