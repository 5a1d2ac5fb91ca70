"""The pictures of a page that stand still: no larger together than the page allows."""

import base64
import io
import re

from tabor.report import style

QUALITIES = (92, 80, 60, 40)  # of WebP


def fitted(figures, room):
    """(figures, [title of each left out]): maps as WebP of the best quality at which all take at most `room` bytes.

    figures: [page.Shown] with PNG or SVG. Where the worst quality is too large, sections are left out, then maps, the last first;
    never what is not a picture of a state. Without a Pillow that writes WebP all stay as they are.
    """
    if not _writes_webp():
        return figures, []
    for quality in QUALITIES:
        pictures = [_webp(shown.picture, quality) if shown.drawn.is_map else shown.picture for shown in figures]
        if sum(map(_size, pictures)) <= room:
            break
    for shown, picture in zip(figures, pictures):
        shown.picture = picture
    return _those_that_fit(figures, room)


def kind(picture):
    """(MIME type, ending of a name) of a picture made here."""
    if picture.startswith(b"RIFF"):
        return "image/webp", "webp"
    return ("image/png", "png") if picture.startswith(b"\x89PNG") else ("image/svg+xml", "svg")


def uri(kind, data):
    return f"data:{kind};base64,{base64.b64encode(data).decode('ascii')}"


def width_in_inches(picture):
    """Of a PNG made here, whose IHDR chunk holds the width in bytes 16 to 19, or of an SVG, which has it in points."""
    if picture.startswith(b"\x89PNG"):
        return int.from_bytes(picture[16:20], "big") / style.DPI
    return float(re.search(rb'<svg[^>]* width="([0-9.]+)pt"', picture).group(1)) / 72


def _those_that_fit(figures, room):
    sections = [shown for shown in figures if shown.drawn.is_viewed and not shown.drawn.is_map]
    maps = [shown for shown in figures if shown.drawn.is_viewed and shown.drawn.is_map]
    left_out, size = [], sum(_size(shown.picture) for shown in figures)
    for shown in (*reversed(sections), *reversed(maps)):
        if size <= room:
            break
        left_out.insert(0, shown)
        size -= _size(shown.picture)
    return [shown for shown in figures if shown not in left_out], [shown.drawn.title for shown in left_out]


def _size(picture):
    """Bytes in the page."""
    return 4 * len(picture) / 3


def _writes_webp():
    from PIL import features  # Matplotlib brings Pillow

    return features.check("webp")


def _webp(png, quality):
    from PIL import Image

    stream = io.BytesIO()
    Image.open(io.BytesIO(png)).convert("RGB").save(stream, "WEBP", quality=quality, method=2)
    return stream.getvalue()
