"""One thread that computes the newest of what it is asked for: a new task stops the one that runs."""

from __future__ import annotations

import threading
import traceback
from collections.abc import Callable
from typing import Protocol

from .._doubts import tell_none_here


class Stopped(Exception):
    """Raised out of a computation that a new one replaced, or that the stop button ended."""


class Watching(Protocol):
    """What a task is given: it is called while the task runs, and raises Stopped when that is to end."""

    def __call__(self, stage: str, fraction: float, certificate: float, /) -> None: ...


Task = Callable[[Watching], None]
#: Told of (stage, done share 0..1 or NaN); ("", nan) when nothing runs.
Teller = Callable[[str, float], None]
_IDLE = ("", float("nan"))


class Worker:
    """Runs tasks on a thread of its own, the newest alone."""

    def __init__(self, tell: Teller) -> None:
        self._tell = tell
        self._change = threading.Condition()
        self._next: Task | None = None
        self._number = 0  # of the newest task, or of the newest stop
        self._is_running = False
        self._is_closed = False
        self._thread = threading.Thread(target=self._run, name="tabor view", daemon=True)
        self._thread.start()

    def ask(self, task: Task) -> None:
        """Stops what runs, and computes this."""
        with self._change:
            self._next = task
            self._number += 1
            self._change.notify_all()

    def stop(self) -> bool:
        """Stops what runs; True if something did."""
        with self._change:
            had_work = self._is_running or self._next is not None
            self._next = None
            self._number += 1
            return had_work

    def close(self) -> None:
        """Ends the thread as soon as what runs has stopped."""
        self.stop()
        with self._change:
            self._is_closed = True
            self._change.notify_all()

    def wait(self, seconds: float) -> bool:
        """Waits until nothing runs or waits; False if that took longer."""
        with self._change:
            return self._change.wait_for(lambda: self._next is None and not self._is_running, seconds)

    def _run(self) -> None:
        tell_none_here()
        while (taken := self._taken()) is not None:
            task, number = taken
            try:
                task(self._watching(number))
            except Stopped:
                pass
            except Exception:  # a fault of a page must not end the thread, nor be hidden
                traceback.print_exc()
            finally:
                with self._change:
                    self._is_running = False
                    is_idle = self._next is None
                    self._change.notify_all()
            if is_idle:
                self._tell(*_IDLE)

    def _taken(self) -> tuple[Task, int] | None:
        with self._change:
            self._change.wait_for(lambda: self._next is not None or self._is_closed)
            if self._next is None:
                return None
            task, self._next, self._is_running = self._next, None, True
            return task, self._number

    def _watching(self, number: int) -> Watching:
        def told(stage: str, fraction: float, certificate: float, /) -> None:
            if number != self._number:
                raise Stopped
            self._tell(stage, fraction)

        return told
