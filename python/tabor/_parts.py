"""Parts of a study on the workers of an executor."""

from __future__ import annotations

import json
import os
import pathlib
import tempfile
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, Future, as_completed
from typing import Any, NamedTuple

from . import _tabor

_nan = float("nan")


class Done(NamedTuple):
    """What a worker did."""

    n_contacts: int
    files: dict[str, bytes]  #: of the store, where workers do not share it


def compute(text: str, file: str, folder: str, retry: bool, threads: int) -> Done:
    """Computes a part, whose text stands as if in ``file``, into the store of the folder."""
    _tabor.set_threads(threads)  # workers may be threads of one process: run() puts back what was before
    n_contacts, _ = _tabor.run_part(_tabor.parse_study(text, file), folder, retry)
    return Done(n_contacts, {})


def compute_and_return(text: str, file: str, scan: tuple[str, bytes], threads: int) -> Done:
    """Computes a part of a scan that comes with it, and returns what belongs into the store. Failures are
    left to whoever has the scan itself."""
    with tempfile.TemporaryDirectory() as root:
        path = pathlib.Path(root, *pathlib.Path(scan[0]).parts[1:])
        path.parent.mkdir(parents=True)
        path.write_bytes(scan[1])
        there = pathlib.Path(root, *pathlib.Path(file).parts[1:])
        there.parent.mkdir(parents=True, exist_ok=True)
        n_contacts = compute(text, str(there), os.path.join(root, "results"), False, threads).n_contacts
        store = pathlib.Path(root, "results", "store")
        return Done(n_contacts, {one.name: one.read_bytes() for one in _results_in(store)})


def _results_in(store: pathlib.Path) -> Iterator[pathlib.Path]:
    for one in store.iterdir():
        failed = one.name.startswith("case-") and json.loads(one.read_bytes())["error"]
        if one.suffix in (".h5", ".json") and not failed:
            yield one


def _submit(executor: Executor, text: str, file: str, folder: str, retry: bool, threads: int,
            returns: bool) -> Future[Done]:
    if not returns:
        return executor.submit(compute, text, file, folder, retry, threads)
    scan = os.path.normpath(_tabor.parse_study(text, file).files[0])
    return executor.submit(compute_and_return, text, file, (scan, pathlib.Path(scan).read_bytes()), threads)


def run(executor: Executor, texts: list[str], file: str, folder: str, *, retry: bool, threads: int, returns: bool,
        told: Callable[[str, float, float], Any] | None) -> int:
    """Computes the parts; returns how many contacts were computed. Whatever a worker raises is raised when
    all others are done; Ctrl-C leaves out those that have not begun."""
    futures: list[Future[Done]] = []
    n_threads = _tabor.threads()
    error: BaseException | None = None
    n_contacts = 0
    try:
        for text in texts:
            futures.append(_submit(executor, text, file, folder, retry, threads, returns))
        for i, future in enumerate(as_completed(futures)):
            try:
                n_contacts += _keep(future.result(), folder)
            except Exception as raised:
                error = error or raised
            if told is not None:
                told("parts of the study", (i + 1) / len(futures), _nan)
    except BaseException:
        for future in futures:
            future.cancel()
        raise
    finally:
        _tabor.set_threads(n_threads)
    if error is not None:
        raise error
    return n_contacts


def _keep(done: Done, folder: str) -> int:
    for name, data in done.files.items():
        _tabor.write_file(os.path.join(folder, "store", name), data)
    return done.n_contacts
