"""Files of others are tried before they are read: the HDF5 library crashes over damaged ones, or never returns."""

import os
import resource
import signal
import stat
from pathlib import Path, PurePosixPath

import h5py

from tabor.report import seal

MIB = 1 << 20
LARGEST_RATIO = 1100  # deflate shrinks at most 1032 : 1

_FOREIGN_LINK = "a link to a file that is not in its store"
_VALUES_ELSEWHERE = "values kept in other files"
_TOO_LARGE = "a data set that claims more than the file holds"
_DAMAGED = 10  # exit codes of the copy
_REJECTIONS = {11: _FOREIGN_LINK, 12: _VALUES_ELSEWHERE, 13: _TOO_LARGE}


class _Rejection(Exception):
    pass


_found = {}  # path: what problem() says of it


def problem(path):
    """Why the file is not to be read; "" if a copy of this process has read all of it."""
    if path not in _found:
        _found[path] = _refusal(path) or _ending([path])
    return _found[path]


def try_together(paths):
    """Tries many files in one copy of this process. Where it does not end well, problem() tries each in one of its own."""
    sound = [path for path in dict.fromkeys(paths) if path not in _found and not _refusal(path)]
    if len(sound) > 1 and not _ending(sound):
        _found.update(dict.fromkeys(sound, ""))


def forget():
    """Files are tried again."""
    _found.clear()


def _refusal(path):
    """What can be said without the HDF5 library."""
    try:
        if not stat.S_ISREG(os.stat(path).st_mode):
            return "a folder, device or pipe"
        return "bytes that are not those that were written" if seal.is_broken(path) else ""
    except OSError as error:
        return error.strerror.lower()


def _ending(paths):
    """What became of a copy of this process that read these files."""
    try:
        child = os.fork()
    except OSError as error:
        return f"no process to try it in ({error.strerror.lower()})"
    if child == 0:
        _try_and_exit(paths)
    _, ending = os.waitpid(child, 0)
    code = os.waitstatus_to_exitcode(ending)
    return "" if code == 0 else _REJECTIONS.get(code, "a damaged file")


def _try_and_exit(paths):
    code = _DAMAGED
    try:
        _limit(sum(os.path.getsize(path) for path in paths))
        for path in paths:
            _try(path)
        code = 0
    except _Rejection as rejection:
        code = next(code for code, text in _REJECTIONS.items() if text == str(rejection))
    finally:
        os._exit(code)


def _try(path):
    try:
        file = h5py.File(path, "r")
    except OSError:
        return  # what is wrong is said where it is opened
    with file:
        _read_all(file)


def _limit(size):
    """Processor time, time and memory for a file of so many bytes, most of them packed."""
    seconds = 5 + size // (5 * MIB)
    memory = _address_space() + 512 * MIB + 64 * size
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))
    resource.setrlimit(resource.RLIMIT_AS, (memory, resource.getrlimit(resource.RLIMIT_AS)[1]))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    signal.signal(signal.SIGALRM, signal.SIG_DFL)
    signal.setitimer(signal.ITIMER_REAL, 10 * seconds)


def _address_space():
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[0]) * resource.getpagesize()


def _read_all(file):
    _look_at(file)
    file.visititems(lambda name, node: _look_at(node))


def _look_at(node):
    _without_errors(lambda: list(node.attrs.items()))
    if isinstance(node, h5py.Group):
        for name in node:
            _check_link(node, name)
    elif isinstance(node, h5py.Dataset):
        _check_values(node)
        _without_errors(lambda: _read(node))


def _check_link(group, name):
    link = group.get(name, getlink=True)
    if isinstance(link, h5py.ExternalLink):
        target = PurePosixPath(link.filename)
        is_store = target.parent == PurePosixPath("store") and target.suffix == ".h5"
        if not is_store or not group.name.startswith("/scans/") or _is_no_file(group, link):
            raise _Rejection(_FOREIGN_LINK)


def _is_no_file(group, link):
    """A pipe or device, which the library would wait for; one that is absent is only missing."""
    path = Path(group.file.filename).parent / link.filename
    return path.exists() and not path.is_file()


def _check_values(dataset):
    created = dataset.id.get_create_plist()
    if created.get_layout() == h5py.h5d.VIRTUAL or created.get_external_count() > 0:
        raise _Rejection(_VALUES_ELSEWHERE)
    if dataset.size and dataset.nbytes > max(MIB, LARGEST_RATIO * dataset.id.get_storage_size()):
        raise _Rejection(_TOO_LARGE)


def _read(dataset):
    """All of it, piece by piece."""
    if not dataset.shape or dataset.nbytes < MIB:
        return dataset[()]
    step = max(1, 8 * MIB * len(dataset) // dataset.nbytes)
    for start in range(0, len(dataset), step):
        dataset[start : start + step]


def _without_errors(action):
    """An error is no crash: what comes of it is said where the value is used."""
    try:
        action()
    except MemoryError:
        raise
    except Exception:
        pass
