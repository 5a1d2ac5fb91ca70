"""What a long computation tells while it runs."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from typing import Any, Union

from . import _tabor
from ._arguments import Count, typed

#: True for a bar of tqdm (plain lines without tqdm); or what is called up to fifty times a second with
#: (stage, done share 0..1, certificate), where NaN is unknown.
Progress = Union[bool, None, Callable[[str, float, float], Any]]
#: What the extension module calls, if anything.
Told = Union[Callable[[str, float, float], Any], None]


@typed
def set_threads(n: Count) -> None:
    """Limits the threads of computations. Results do not depend on it.

    Parameters
    ----------
    n : number of threads; 0, as many as there are processors.

    Raises
    ------
    TypeError, ValueError
        For what is no whole number of zero or more.

    Examples
    --------
    >>> import tabor as tb
    >>> tb.set_threads(2)
    >>> tb.set_threads(0)
    """
    _tabor.set_threads(n)


def watching(progress: Progress) -> AbstractContextManager[Told]:
    """What the extension module tells; a bar is closed at the end."""
    if progress is True:
        return _Bar()
    if progress is False or progress is None:
        return nullcontext(None)
    if not callable(progress):
        raise TypeError(f"progress: got {type(progress).__name__}; expected True, False or a callable")
    return nullcontext(progress)


class _Bar(AbstractContextManager[Told]):
    """A bar of tqdm, or one line per stage where tqdm is not installed."""

    def __init__(self) -> None:
        self._stage = ""
        self._bar: Any = None
        try:
            from tqdm.auto import tqdm
        except ImportError:
            return
        self._bar = tqdm(total=1.0, bar_format="{desc} {percentage:3.0f}%|{bar}| {elapsed}{postfix}")

    def __call__(self, stage: str, fraction: float, certificate: float) -> None:
        if self._bar is None:
            if stage != self._stage:
                print(stage, flush=True)
            self._stage = stage
            return
        self._bar.set_description_str(stage, refresh=False)
        if fraction == fraction:
            self._bar.n = min(1.0, max(0.0, fraction))
        if certificate == certificate:
            self._bar.set_postfix_str(f"certificate {certificate:.1e}", refresh=False)
        self._bar.refresh()

    def __exit__(self, *error: object) -> None:
        if self._bar is not None:
            self._bar.close()
