"""Files that the page offers: written into a temporary folder, and handed out by their names alone."""

from __future__ import annotations

import html
import pathlib
import re
import shutil
import tempfile
from collections.abc import Callable
from typing import Any

from tornado.web import RequestHandler

from .._generate import formats
from .._report import report
from .._save import save
from .answers import Answer

_TYPES = {".html": "text/html; charset=utf-8", ".js": "text/javascript; charset=utf-8"}  # a browser shows these; it saves all others
_CHUNK = 1 << 20  #: bytes


class Folder:
    """The temporary folder of one server."""

    def __init__(self) -> None:
        self._path = pathlib.Path(tempfile.mkdtemp(prefix="tabor-view-"))
        self._files: dict[str, pathlib.Path] = {}
        self._n_written = 0

    def write(self, name: str, make: Callable[[pathlib.Path], None]) -> str:
        """Lets a function write a file; its name in the folder, which no other has."""
        self._n_written += 1
        place = self._path / f"{self._n_written}"
        place.mkdir()
        make(place / name)
        self._files[f"{place.name}/{name}"] = place / name
        return f"{place.name}/{name}"

    def offer(self, file: pathlib.Path) -> str:
        """Hands out a file that lies elsewhere and stays there; its name in the folder."""
        self._files[file.name] = file
        return file.name

    def drop(self, name: str) -> None:
        """Removes a file that is no longer shown."""
        file = self._files.pop(name, None)
        if file is not None and file.is_relative_to(self._path):
            shutil.rmtree(file.parent, ignore_errors=True)

    def file(self, name: str) -> pathlib.Path | None:
        """What was written under this name; None for any other name, whatever it points to."""
        return self._files.get(name)

    def close(self) -> None:
        """Removes the folder."""
        shutil.rmtree(self._path, ignore_errors=True)


def scan_extensions() -> list[str]:
    """Extensions of the scan files that can be written; the first keeps everything."""
    every = [extension for one in formats() if one.writes for extension in one.extensions]
    return sorted(set(every), key=lambda one: (one != ".h5", one))


def write_answer(folder: Folder, kind: str, answer: Answer, extension: str = ".h5") -> str:
    """Writes "scan", "result" or "report" of an answer; its name in the folder. The extension is that of a scan. Raises
    ValueError where there is nothing to write, OSError and ImportError as ``tabor.save`` and ``tabor.report`` do."""
    makers = {"scan": (extension, _write_scan), "result": (".h5", _write_result), "report": (".html", _write_report)}
    suffix, make = makers[kind]
    return folder.write(f"{stem_of(answer.state.scan)}_{kind}{suffix}", lambda file: make(answer, file))


def _write_scan(answer: Answer, file: pathlib.Path) -> None:
    if answer.surface is None:
        raise ValueError("The treatment fails: there is no surface to write")
    answer.surface.save(file)


def _solved(answer: Answer) -> Any:
    found = answer.friction or answer.contact
    if found is None or answer.is_preview:
        raise ValueError("The full answer is not there yet")
    return found


def _write_result(answer: Answer, file: pathlib.Path) -> None:
    save(file, _solved(answer))


def _write_report(answer: Answer, file: pathlib.Path) -> None:
    page = report(_solved(answer), file.parent / "report").page
    if page is None:
        raise ValueError("No page was written")
    page.rename(file)


def stem_of(scan: str) -> str:
    """The name of a scan without what no file name should have."""
    return re.sub(r"[^\w.-]+", "_", pathlib.Path(scan or "surface").stem)[:60] or "surface"


def link_html(address: str, name: str) -> str:
    """A link to a file that was written."""
    return f"<a href='{html.escape(address)}' target='_blank' rel='noopener'>{html.escape(pathlib.PurePath(name).name)}</a>"


class Hand(RequestHandler):
    """Hands out a file of the folder."""

    def initialize(self, folder: Folder) -> None:
        """Of which server."""
        self._folder = folder

    async def get(self, name: str) -> None:
        """The file of this name, or 403."""
        file = self._folder.file(name)
        if file is None:
            self.set_status(403)
            return
        self.set_header("Content-Type", _TYPES.get(file.suffix, "application/octet-stream"))
        if file.suffix not in _TYPES:
            self.set_header("Content-Disposition", f'attachment; filename="{file.name}"')
        with open(file, "rb") as stream:
            while block := stream.read(_CHUNK):
                self.write(block)
                await self.flush()

    def data_received(self, chunk: bytes) -> Any:
        """Nothing is taken."""
