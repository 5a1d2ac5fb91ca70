"""The server of a workbench: on this machine alone, behind a token, until the last page closes."""

from __future__ import annotations

import asyncio
import logging
import os
import threading
import webbrowser
from collections.abc import Sequence
from typing import Any

from bokeh.application import Application
from bokeh.application.handlers import FunctionHandler
from bokeh.server.server import BaseServer
from bokeh.server.util import bind_sockets
from tornado.httpserver import HTTPServer
from tornado.ioloop import IOLoop

from .guard import ADDRESS, Guarded, new_token
from .opening import Opened
from .page import fill
from .written import Folder, Hand

_LOOK = 500  #: how often is looked whether a page is open [ms]
_PATIENCE = 8  #: so many looks without a page, as while one is loaded again, end the server


def can_show() -> bool:
    """True where a browser can be expected to open a window."""
    if not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY") or os.name == "nt" or os.uname().sysname == "Darwin"):
        return False
    try:
        webbrowser.get()
    except webbrowser.Error:
        return False
    return True


class View:
    """A workbench that is served. It runs on a thread of its own, which ends when the last page closes."""

    url: str  #: address with the token

    def __init__(self, opened: Sequence[Opened], port: int = 0, keep: bool = False) -> None:
        self._opened, self._keep = list(opened), keep
        self._is_ready, self._has_ended = threading.Event(), threading.Event()
        self._port = port
        self._seen, self._looks = False, 0
        self._failure: BaseException | None = None
        self._thread = threading.Thread(target=self._run, name="tabor view server")
        self._thread.start()
        self._is_ready.wait()
        if self._failure is not None:
            raise self._failure

    def __repr__(self) -> str:
        return f"View at {self.url}" if self.is_open else "View, closed"

    @property
    def is_open(self) -> bool:
        """True until the last page closes."""
        return not self._has_ended.is_set()

    def wait(self, seconds: float | None = None) -> bool:
        """Waits until the last page closes, at most so long; True if it did."""
        return self._has_ended.wait(seconds)  # a join that Ctrl-C interrupts takes the thread for ended

    def close(self) -> None:
        """Ends the server."""
        if self.is_open:
            self._loop.add_callback(self._loop.stop)
            self._has_ended.wait()

    def show(self) -> None:
        """Opens the page in a browser."""
        webbrowser.open(self.url)

    def _run(self) -> None:
        logging.getLogger("bokeh").setLevel(logging.ERROR)
        logging.getLogger("tornado").setLevel(logging.ERROR)
        asyncio.set_event_loop(asyncio.new_event_loop())
        folder = Folder()
        try:
            server = self._start(folder)
        except BaseException as failure:
            self._failure = failure
            folder.close()
            self._has_ended.set()
            return
        finally:
            self._is_ready.set()
        try:
            self._loop.start()
        finally:
            server.stop()
            server.unlisten()
            folder.close()
            self._has_ended.set()

    def _start(self, folder: Folder) -> Any:
        sockets, port = bind_sockets(ADDRESS, self._port)
        token = new_token()
        self.url = f"http://{ADDRESS}:{port}/{token}/"
        application = Application(FunctionHandler(lambda document: fill(document, self._opened, folder, f"/{token}")))
        guarded = Guarded(application, token, port, extra_patterns=[(r"/file/(.+)", Hand, {"folder": folder})],
                          check_unused_sessions_milliseconds=_LOOK, unused_session_lifetime_milliseconds=2 * _LOOK)
        self._loop = IOLoop.current()
        http = HTTPServer(guarded)
        http.add_sockets(sockets)
        server = BaseServer(self._loop, guarded, http)
        server.start()
        if not self._keep:
            self._look_later(server)
        return server

    def _look_later(self, server: Any) -> None:
        self._loop.call_later(_LOOK / 1e3, self._look, server)

    def _look(self, server: Any) -> None:
        """Ends the server once a page was open and none has been for a while."""
        is_open = any(session.connection_count > 0 for session in server.get_sessions())
        self._seen = self._seen or is_open
        self._looks = 0 if is_open else self._looks + 1
        if self._seen and self._looks >= _PATIENCE:
            self._loop.stop()
        else:
            self._look_later(server)
