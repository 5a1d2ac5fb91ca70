"""Files that the page offers: written into a temporary folder, and handed out by their names alone."""

from __future__ import annotations

import html
import pathlib
import re
import shutil
import tempfile
from typing import Any

from tornado.web import RequestHandler

from .._report import report
from .._save import save
from .answers import Answer

_TYPES = {".html": "text/html; charset=utf-8", ".h5": "application/x-hdf5"}
_CHUNK = 1 << 20  #: bytes


class Folder:
    """The temporary folder of one server."""

    def __init__(self) -> None:
        self._path = pathlib.Path(tempfile.mkdtemp(prefix="tabor-view-"))
        self._files: dict[str, pathlib.Path] = {}

    def write(self, kind: str, answer: Answer) -> str:
        """Writes "scan", "result" or "report" of an answer; its name in the folder. Raises ValueError where there is
        nothing to write, OSError and ImportError as ``tabor.save`` and ``tabor.report`` do."""
        place = self._path / f"{len(self._files) + 1}"
        place.mkdir()
        name = f"{stem_of(answer)}_{kind}.{'html' if kind == 'report' else 'h5'}"
        self._make(kind, answer, place, place / name)
        self._files[f"{place.name}/{name}"] = place / name
        return f"{place.name}/{name}"

    def _make(self, kind: str, answer: Answer, place: pathlib.Path, file: pathlib.Path) -> None:
        if answer.surface is None:
            raise ValueError("The treatment fails: there is no surface to write")
        if kind == "scan":
            answer.surface.save(file)
            return
        found = answer.friction or answer.contact
        if found is None or answer.is_preview:
            raise ValueError("The full answer is not there yet")
        if kind == "result":
            save(file, found)
            return
        page = report(found, place / "report").page
        if page is None:
            raise ValueError("No page was written")
        page.rename(file)

    def file(self, name: str) -> pathlib.Path | None:
        """What was written under this name; None for any other name, whatever it points to."""
        return self._files.get(name)

    def close(self) -> None:
        """Removes the folder."""
        shutil.rmtree(self._path, ignore_errors=True)


def stem_of(answer: Answer) -> str:
    """The name of the scan without what no file name should have."""
    return re.sub(r"[^\w.-]+", "_", pathlib.Path(answer.state.scan or "surface").stem)[:60] or "surface"


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
        self.set_header("Content-Type", _TYPES[file.suffix])
        if file.suffix != ".html":
            self.set_header("Content-Disposition", f'attachment; filename="{file.name}"')
        with open(file, "rb") as stream:
            while block := stream.read(_CHUNK):
                self.write(block)
                await self.flush()

    def data_received(self, chunk: bytes) -> Any:
        """Nothing is taken."""
