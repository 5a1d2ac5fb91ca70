"""Writing: every file under a temporary name that is renamed when complete."""

import csv
import io
import os
import tempfile
from functools import partial
from pathlib import Path

from tabor.report.errors import OutputError

LARGEST_IN_PAGE = 300_000  # bytes of a table in a page; larger ones come with --figures


def make_folder(path):
    try:
        Path(path).mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"{path}: cannot be made ({error.strerror})") from None


def write(path, content):
    """Writes bytes or text; raises OutputError in one line."""
    path = Path(path)
    data = content.encode("utf-8", "backslashreplace") if isinstance(content, str) else content
    temporary = None
    try:
        with tempfile.NamedTemporaryFile(dir=path.parent, prefix=f".{path.name}.", delete=False) as file:
            temporary = file.name
            file.write(data)
        os.chmod(temporary, 0o666 & ~_umask())
        os.replace(temporary, path)
    except OSError as error:
        if temporary and os.path.exists(temporary):
            os.unlink(temporary)
        raise OutputError(f"{path}: cannot be written ({error.strerror})") from None


def table_text(columns):
    """CSV of {name: sequence}; numbers with 17 digits so that nothing is lost."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(_harmless(name) for name in columns)
    writer.writerows([_cell(value) for value in row] for row in zip(*columns.values()))
    return stream.getvalue()


def map_table(corner, x, y, values):
    """The same as matrix_text(), made when it is called for where it is too large for a page."""
    make = partial(matrix_text, corner, x, y, values)
    return make if 2 * values.size > LARGEST_IN_PAGE else make()


def matrix_text(corner, x, y, values, digits=6):
    """CSV of a map: first row x, first column y, both in the unit that `corner` names."""
    lines = [",".join([corner] + [f"{value:.6g}" for value in x])]
    for position, row in zip(y, values):
        lines.append(",".join([f"{position:.6g}"] + [f"{value:.{digits}g}" for value in row.tolist()]))
    return "\n".join(lines) + "\n"


def _cell(value):
    if isinstance(value, bool) or hasattr(value, "dtype") and value.dtype == bool:
        return int(value)
    if isinstance(value, float) or hasattr(value, "dtype") and value.dtype.kind == "f":
        return f"{float(value):.17g}"
    return _harmless(value) if isinstance(value, str) else value


def _harmless(text):
    """Text that no spreadsheet computes: an apostrophe says that it is text (as src/tabor/io/text/csv.cpp)."""
    return "'" + text if text.lstrip("'")[:1] in tuple("=+-@\t\r\n") and not _is_number(text) else text


def _is_number(text):
    try:
        float(text)
    except ValueError:
        return False
    return True


def _umask():
    mask = os.umask(0)
    os.umask(mask)
    return mask
