"""Reading HDF5 as tabor writes it: text as str, numbers as Python numbers, broken links as None."""

import os
from pathlib import Path

# A finished result never changes under its name, so a lock protects nothing and fails on
# read-only file systems.
os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")

import h5py
import numpy as np

from tabor.report import guard
from tabor.report.errors import InputError, readable

CHUNK_CACHE = 1 << 20  # bytes of each map that is read: whole chunks are read once
ROWS_AT_ONCE = 64  # at least, of a map that is read piece by piece


def file_of(result):
    """The path of a result's file; that of a study may be given by its folder."""
    path = Path(result)
    return path / "results.h5" if path.is_dir() else path


def begin(result):
    """Starts to try the file of a result, which open_file() waits for."""
    path = file_of(result)
    if path.suffix != ".csv":
        guard.begin(str(path))


def open_file(path):
    """Opens for reading; raises InputError in one line if it is no tabor result."""
    rejection = guard.problem(str(path))
    if rejection == "no such file or directory":
        raise InputError(f"{path}: no such file; give the folder or the .h5 file that tabor wrote")
    if rejection:
        raise InputError(f"{path}: got {rejection}; expected a result of tabor; compute it again")
    if not _begins_as_hdf5(path):
        raise _no_result(path)
    try:
        file = h5py.File(path, "r", rdcc_nbytes=CHUNK_CACHE)
    except OSError as error:
        reason = str(error).splitlines()[0]
        raise InputError(f"{path}: cannot be read as HDF5 ({reason})") from None
    if text(file.attrs.get("format", "")) != "tabor":
        file.close()
        raise _no_result(path)
    return file


def _begins_as_hdf5(path):
    with open(path, "rb") as file:
        return file.read(8) == b"\x89HDF\r\n\x1a\n"


def _no_result(path):
    name = Path(path).name
    of_it = (
        "of parameters, 'tabor params SCAN ... -o params.csv' makes one"
        if name.endswith(".json")
        else f"of a scan, 'tabor friction {name} ... -o result.h5' makes one"
    )
    return InputError(f"{path}: got a file that is no result of tabor; expected the folder of a 'tabor sweep' or a file written with -o; {of_it}")


def text(value):
    if isinstance(value, bytes):
        return value.decode("utf-8", "backslashreplace")
    return readable(value)


def plain(value):
    """One attribute as str, int, float, bool or list of those."""
    if isinstance(value, h5py.Empty):
        return None
    if isinstance(value, (bytes, str)):
        return text(value)
    if isinstance(value, np.ndarray):
        return [plain(item) for item in value.ravel()] if value.ndim else plain(value[()])
    return value.item() if isinstance(value, np.generic) else value


def attributes(node):
    return {name: plain(value) for name, value in node.attrs.items()}


def text_list(value):
    """Strings of an attribute that may be absent, one string, or an array of strings."""
    if value is None or value == "":
        return []
    return [text(item) for item in value] if isinstance(value, list) else [text(value)]


def child(group, name):
    """The member `name`, or None if it is absent or its external link leads to nothing that can be read."""
    try:
        link = group.get(name, getlink=True)
        if isinstance(link, h5py.ExternalLink):
            if guard.problem(_linked_file(group, link)):
                return None
        return group[name]
    except (KeyError, OSError):
        return None


def linked_files(group):
    """The files that external links in the group lead to."""
    links = (group.get(name, getlink=True) for name in group)
    return [_linked_file(group, link) for link in links if isinstance(link, h5py.ExternalLink)]


def _linked_file(group, link):
    return str(Path(group.file.filename).parent / link.filename)


def link_target(group, name):
    """The file an external link names, for the message about a missing one."""
    link = group.get(name, getlink=True)
    return getattr(link, "filename", name)


def columns(group):
    """A folder of 1-D datasets as {name: array}; text columns become object arrays of str."""
    return {name: _column(dataset) for name, dataset in group.items()}


def _column(dataset):
    values = np.atleast_1d(dataset[()])
    if values.dtype.kind in "OSU":
        return np.array([text(value) for value in values], dtype=object)
    return values


def thinned(dataset, step):
    """Every step-th row and column of a map; of a large one the rest is never in memory at once."""
    if step == 1:
        return dataset[()]
    found = np.empty([-(-length // step) for length in dataset.shape], dtype=dataset.dtype)
    at_once = _rows_at_once(dataset)
    for start in range(0, len(dataset), at_once):
        rows = dataset[start : start + at_once][-start % step :: step, ::step]
        first = -(-start // step)
        found[first : first + len(rows)] = rows
    return found


def _rows_at_once(dataset):
    """Whole chunks of the file: each is unpacked once."""
    rows = dataset.chunks[0] if dataset.chunks else 1
    return rows * -(-ROWS_AT_ONCE // rows)
