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
LARGE = 32 * MIB  # bytes of files from which two copies share the work

_FOREIGN_LINK = "a link to a file that is not in its store"
_VALUES_ELSEWHERE = "values kept in other files"
_TOO_LARGE = "a data set that claims more than the file holds"
_DAMAGED = 10  # exit codes of the copy
_REJECTIONS = {11: _FOREIGN_LINK, 12: _VALUES_ELSEWHERE, 13: _TOO_LARGE}


class _Rejection(Exception):
    pass


_found = {}  # path: what problem() says of it
_begun = {}  # path: the _Trial of a file that is being tried


def begin(path):
    """Starts to try the file in the background until problem() is asked for."""
    if path in _found or path in _begun:
        return
    refusal = _refusal(path)
    if refusal:
        _found[path] = refusal
    else:
        _begun[path] = _Trial([path])


def problem(path):
    """Why the file is not to be read; "" if copies of this process have read all of it."""
    begin(path)
    if path in _begun:
        _found[path] = _begun.pop(path).ending()
    return _found[path]


def try_together(paths):
    """Tries many files at once. Where that does not end well, problem() tries each by itself."""
    sound = [path for path in dict.fromkeys(paths) if path not in _found and not _refusal(path)]
    if len(sound) > 1 and not _Trial(sound).ending():
        _found.update(dict.fromkeys(sound, ""))


def forget():
    """Files are tried again."""
    while _begun:
        _begun.popitem()[1].ending()
    _found.clear()


def _refusal(path):
    """What can be said without the HDF5 library."""
    try:
        if not stat.S_ISREG(os.stat(path).st_mode):
            return "a folder, device or pipe"
        return "bytes that are not those that were written" if seal.is_broken(path) else ""
    except OSError as error:
        return error.strerror.lower()


class _Trial:
    """Copies of this process that read these files, each its share."""

    def __init__(self, paths):
        self._failure, self._children = "", []
        n_copies = _number_of_copies(paths)
        try:
            for number in range(n_copies):
                self._children.append(_copy(paths, _Share(number, n_copies)))
        except OSError as error:
            self._failure = f"no process to try it in ({error.strerror.lower()})"

    def ending(self):
        """What became of them."""
        endings = [_ending(child) for child in self._children]
        return next(filter(None, [self._failure, *endings]), "")


class _Share:
    """The data sets that one copy reads: the next is for the one that has the fewest bytes so far."""

    def __init__(self, number, n_copies):
        self._number, self._bytes = number, [0] * n_copies

    def takes(self, dataset):
        chosen = self._bytes.index(min(self._bytes))
        self._bytes[chosen] += dataset.nbytes if dataset.size else 0
        return chosen == self._number


def _number_of_copies(paths):
    return 2 if sum(map(os.path.getsize, paths)) >= LARGE and len(os.sched_getaffinity(0)) > 1 else 1


def _copy(paths, share):
    """The id of a copy of this process that reads its share of these files and ends."""
    child = os.fork()
    if child == 0:
        _try_and_exit(paths, share)
    return child


def _ending(child):
    _, ending = os.waitpid(child, 0)
    code = os.waitstatus_to_exitcode(ending)
    return "" if code == 0 else _REJECTIONS.get(code, "a damaged file")


def _try_and_exit(paths, share):
    code = _DAMAGED
    try:
        _limit(sum(os.path.getsize(path) for path in paths))
        for path in paths:
            _try(path, share)
        code = 0
    except _Rejection as rejection:
        code = next(code for code, text in _REJECTIONS.items() if text == str(rejection))
    finally:
        os._exit(code)


def _try(path, share):
    try:
        file = h5py.File(path, "r")
    except OSError:
        return  # what is wrong is said where it is opened
    with file:
        _read_all(file, share)


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


def _read_all(file, share):
    _look_at(file, share)
    file.visititems(lambda name, node: _look_at(node, share))


def _look_at(node, share):
    _without_errors(lambda: list(node.attrs.items()))
    if isinstance(node, h5py.Group):
        for name in node:
            _check_link(node, name)
    elif isinstance(node, h5py.Dataset):
        _check_values(node)
        if share.takes(node):
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
