"""What the pictures of the documents share: their look, how they are written, the sample sheet, maps and sections."""

import io
import pathlib
import shutil
import tempfile

import numpy as np
from PIL import Image

import tabor as tb
from tabor.report import section, style

ROOT = pathlib.Path(__file__).resolve().parents[2]
IMAGES = ROOT / "docs" / "images"
SHEET = ROOT / "surfaces" / "edt_before.x3p"
MATERIAL = "aluminium-6016"
UM, NM, MPA, PERCENT = 1e6, 1e9, 1e-6, 100
COLOURS = 256  # of a picture, which then takes half of the bytes
LARGEST = 150_000  # bytes of a picture
DPI = 130
HEIGHT_COLOURS, FILM_COLOURS, PRESSURE_COLOURS = "cividis", "Blues", "inferno_r"

MAKERS = {}


def picture(name):
    """Registers a function that returns a figure or an image as the maker of docs/images/NAME.png."""

    def register(function):
        MAKERS[name] = function
        return function

    return register


def make(name):
    style.apply()
    made = MAKERS[name]()
    write(made if isinstance(made, Image.Image) else Image.open(drawn(made)), name)


def drawn(figure):
    stream = io.BytesIO()
    figure.savefig(stream, dpi=DPI)
    style.plt.close(figure)
    return stream


def write(image, name):
    """Writes docs/images/NAME.png with few colours."""
    file = IMAGES / f"{name}.png"
    image.convert("RGB").quantize(COLOURS).save(file, optimize=True)
    size = file.stat().st_size
    print(file.relative_to(ROOT), size // 1000, "kB")
    if size > LARGEST:
        raise ValueError(f"{file.name}: {size} bytes, expected at most {LARGEST}; draw it smaller")


def sheet():
    """The sample sheet, levelled."""
    return tb.read(SHEET).level("plane")


def reported(result, name):
    """The figure NAME.png that `tabor report` draws of a result."""
    folder = pathlib.Path(tempfile.mkdtemp())
    try:
        pictures = {file.stem: file for file in tb.report(result, folder, html=False, figures="png").files if file.suffix == ".png"}
        if name not in pictures:
            raise ValueError(f"{name}: expected one of {', '.join(pictures)}")
        target = Image.open(io.BytesIO(pictures[name].read_bytes()))
    finally:
        shutil.rmtree(folder)
    width = round(style.WIDTH * DPI)
    return target.resize((width, round(target.height * width / target.width)), Image.Resampling.LANCZOS)


def show_map(axes, surface, values, label=None, **keywords):
    """A map in µm with the y axis downwards, with a colour bar where it has a label."""
    left, right, bottom, top = (UM * side for side in surface.extent)
    shown = axes.imshow(values, extent=(left, right, max(bottom, top), min(bottom, top)), interpolation="nearest", **keywords)
    axes.set_xlabel("$x$ (µm)")
    axes.set_ylabel("$y$ (µm)")
    for spine in axes.spines.values():
        spine.set_visible(True)
    if label:
        bar = axes.figure.colorbar(shown, ax=axes, shrink=0.85, pad=0.02)
        bar.set_label(label)
        bar.outline.set_visible(False)
    return shown


def cut(contact, row, columns, film=None):
    """Lines of a section through a contact: solid, liquid level and flat [m]."""
    surface = contact.surface
    return section.cut(row, columns, surface.dx, surface.height, None if film is None else film.thickness, contact.gap)


def draw_section(axes, lines):
    """Draws a section with x in µm and heights in µm."""
    section.draw(axes, lines, UM, "µm", UM, "µm")


def section_legend(axes):
    """Names what a section shows, below its figure."""
    axes.figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=4)


def exaggeration_note(axes):
    """Says how far heights are stretched."""
    factor = section.exaggeration(axes, UM, UM)
    axes.set_title(f"heights drawn {factor:.0f} times as large as lengths", loc="right", fontsize=7.5, color="0.4")


def busiest_row(flags, columns):
    """The row with most True in a range of columns."""
    return int(np.argmax(flags[:, columns[0]:columns[1]].sum(axis=1)))
