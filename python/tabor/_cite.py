"""What to cite."""

from __future__ import annotations

import os
from typing import Any

from . import _tabor
from ._arguments import path, wrong
from ._errors import require_file
from ._study import Results


def cite(*results: Any) -> str:
    """BibTeX of tabor and of the methods that results rest on, as ``tabor cite`` prints it.

    Parameters
    ----------
    results : contacts, films, frictions, results of studies, or result files; none for all methods there are.

    Returns
    -------
    str
        Entries with an empty line between them.

    Raises
    ------
    ValueError
        For a file that is not there (InputFileNotFound) or that tabor has not written.
    TypeError
        For what is no result.

    Examples
    --------
    >>> import tabor as tb
    >>> "@article{polonsky1999," in tb.cite()
    True
    """
    if not results:
        return _tabor.whole_bibtex()
    keys: list[str] = []
    files: list[str] = []
    for one in results:
        if isinstance(one, Results):
            files.append(os.fspath(one.folder / "results.h5"))
        elif isinstance(one, (str, os.PathLike)):
            require_file(path(one, "results"))
            files.append(os.fspath(one))
        elif hasattr(one, "references"):
            keys += one.references
        else:
            raise wrong("results", one, "results or files of results")
    return _tabor.bibtex(keys, files)
