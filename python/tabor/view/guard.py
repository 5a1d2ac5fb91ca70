"""Who may ask: a page of this server alone, by the address with the token."""

from __future__ import annotations

import hmac
import secrets
from typing import Any
from urllib.parse import urlsplit

from bokeh.resources import Resources
from bokeh.server.tornado import BokehTornado
from tornado.httputil import HTTPServerRequest
from tornado.web import RequestHandler

ADDRESS = "127.0.0.1"


def new_token() -> str:
    """128 random bits, as they stand in an address."""
    return secrets.token_urlsafe(16).replace("-", "x").replace("_", "y")


def reason_against(path: str, host: str, origin: str | None, is_websocket: bool, token: str, port: int) -> str:
    """Why a request is rejected, "" if it is not. A browser names the host it thinks it talks to, and where the page
    comes from that asks: neither can be chosen by a page of another server."""
    here = f"{ADDRESS}:{port}"
    if not hmac.compare_digest(host.encode(), here.encode()):
        return "another host"
    if origin is None and is_websocket or origin is not None and (urlsplit(origin).netloc, urlsplit(origin).scheme) != (here, "http"):
        return "another origin"
    given, *rest = path.removeprefix("/").split("/")
    if not hmac.compare_digest(given.encode(), token.encode()):
        return "a wrong token"
    return "a path outside" if ".." in rest else ""


class Forbidden(RequestHandler):
    """Answers 403 whatever is asked."""

    def prepare(self) -> None:
        """Ends the request before any method is looked at."""
        self.set_status(403)
        self.set_header("Content-Type", "text/plain; charset=utf-8")
        self.finish("403: this address does not belong to a page of tabor view\n")

    def check_xsrf_cookie(self) -> None:
        """A request that is rejected anyway needs no cookie."""

    def data_received(self, chunk: bytes) -> None:
        """Nothing is taken."""


class Guarded(BokehTornado):
    """The application of Bokeh's server behind the token."""

    def __init__(self, applications: Any, token: str, port: int, **settings: Any) -> None:
        self._token, self._port = token, port
        super().__init__(applications, prefix=token, extra_websocket_origins=[f"{ADDRESS}:{port}"], use_index=False,
                         default_handler_class=Forbidden, **settings)

    def resources(self, absolute_url: str | bool | None = None) -> Resources:
        """From this server, whatever variables of the environment say."""
        return Resources(mode="server", root_url=f"{self.prefix}/", path_versioner=_versioned)

    def find_handler(self, request: HTTPServerRequest, **kwargs: Any) -> Any:
        """Rejects a request before Bokeh sees it."""
        is_websocket = request.headers.get("Upgrade", "").lower() == "websocket"
        if reason_against(request.path, request.host, request.headers.get("Origin"), is_websocket, self._token, self._port):
            return self.get_handler_delegate(request, Forbidden)
        return super().find_handler(request, **kwargs)


def _versioned(path: str) -> str:
    from bokeh.server.views.static_handler import StaticHandler

    return StaticHandler.append_version(path)
