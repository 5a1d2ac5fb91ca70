"""Maps as small texts for a page: the numbers of one grid of pixels, and pictures of every pixel where the grid has fewer."""

import base64
import io
import math
import zlib

import numpy as np
from PIL import Image

from tabor.report.still import uri

LARGEST_GRID = 1024  # pixels along a side of which all are kept
LARGEST_SIDE = 8192  # pixels of a picture; a larger map is thinned
LARGEST_CODE = 2**26  # of a map's range: sums of a few stay within 32 bits
ROWS_AT_ONCE = 64  # of a map whose values become colours: what is between stays in the caches
DIGITS = 5  # a step is at most 10^-5 of the range of nearly all values

# A contact picture is two layers: where film is, in the colours of contact, and on it what hides all that is no contact.
WET_COLOURS = ((232, 134, 46), (0, 0, 0))  # dry, wet
VEILS = (255, 110, 0)  # opacity of white over: no contact, contact below saturation, saturated contact
ELASTIC_COLOURS = ((240, 176, 116), (90, 90, 90))  # the two colours under that veil
CLASS_COLOURS = ((255, 255, 255), ELASTIC_COLOURS[0], WET_COLOURS[0], ELASTIC_COLOURS[1], WET_COLOURS[1])


class Bits:
    """Marked pixels of a large map, in an eighth of the memory of a mask."""

    def __init__(self, values):
        """Marks where values are above zero."""
        self._shape = values.shape
        self._rows = np.zeros((values.shape[0], -(-values.shape[1] // 8)), dtype=np.uint8)
        self.add(values)

    def add(self, values):
        """Marks also where these are."""
        for rows in _pieces(values):
            self._rows[rows] |= np.packbits(values[rows] > 0, axis=1)

    @property
    def any(self):
        return bool(self._rows.any())

    def mask(self):
        return np.unpackbits(self._rows, axis=1, count=self._shape[1]).view(bool)


def _pieces(values):
    """Slices of a few rows each, of which the temporary arrays are small."""
    return [slice(start, start + ROWS_AT_ONCE) for start in range(0, len(values), ROWS_AT_ONCE)]


def thinning(shape, largest=LARGEST_SIDE):
    """Every how many pixels of a map are kept, so that no side has more than `largest`."""
    return max(1, math.ceil(max(shape) / largest))


def steps_of(values, limits, offset=0.0):
    """uint8 of a map that is thinned: which of 255 colours each value has, from 1; 0 where it is NaN.

    values: (ny, nx); limits: the values, less the offset, of the first and last colour.
    """
    step = thinning(values.shape)
    values = values[::step, ::step]
    steps = np.empty(values.shape, dtype=np.uint8)
    for rows in _pieces(steps):
        steps[rows] = _steps((values[rows] - np.float32(offset)).astype(np.float32, copy=False), *limits)
    return steps


def coloured(steps, colours, ground, quality):
    """A data: URI of a WebP picture of steps_of(); colours: uint8 (256, 3), in place of the first of which is `ground`."""
    table = np.array(colours, dtype=np.uint8)
    table[0] = ground
    picture = Image.fromarray(steps, "P")
    picture.putpalette(table.tobytes())
    return _webp(picture.convert("RGB"), quality)


def contact_layer(state):
    """A data: URI of a PNG that hides what does not touch, and half hides what is elastic; state: 0 none, 1 elastic, 2 saturated."""
    return _png(_palette(state, ((255, 255, 255),) * 3), 2, transparency=bytes(VEILS))


def wet_layer(wet):
    """A data: URI of a PNG of the colours of contact, wet or dry."""
    return _png(_palette(wet, WET_COLOURS), 1)


def _palette(classes, colours):
    step = thinning(classes.shape)
    picture = Image.fromarray(np.ascontiguousarray(classes[::step, ::step], dtype=np.uint8), "P")
    picture.putpalette([part for colour in colours for part in colour])
    return picture


def _png(picture, bits, **keywords):
    stream = io.BytesIO()
    picture.save(stream, "PNG", bits=bits, compress_level=6, **keywords)
    return uri("image/png", stream.getvalue())


def power_of(usual, span=0.0):
    """The exponent of the decimal step in which a map is kept.

    usual: the range of nearly all values, of which the step is at most 10^-DIGITS; span: of all values, at most LARGEST_CODE steps.
    """
    fine = math.floor(math.log10(usual)) - DIGITS if usual > 0 else -300
    coarsest = math.ceil(math.log10(span / LARGEST_CODE)) if span > 0 else fine
    return max(fine, coarsest)


def codes_of(values, power):
    """(int64 (ny, nx): values rounded to whole steps 10^power, the code of holes or None)."""
    known, codes = np.isfinite(values), np.empty(values.shape, dtype=np.int64)
    for rows in _pieces(values):
        part = np.where(known[rows], values[rows], 0).astype(float, copy=False)
        codes[rows] = np.rint(part * 10.0**-power if power <= 0 else part / 10.0**power)
    if known.all():
        return codes, None
    hole = int(codes[known].min() if known.any() else 0) - 1
    codes[~known] = hole
    return codes, hole


def packed(codes, height=None, is_level=False):
    """{"data", "planes", "on_height", "is_level"}: integers without loss, as what a guess from pixels before lacks; viewer.js unpacks them.

    height: codes on which those of a gap or of a film stand: their sum is what is smooth. Of a map the guess goes on with the plane through three
    neighbours, of a film with the level beside or above. What is lacking is folded to 0, -1, 1, -2 ..., and its bytes are stored low ones first,
    a plane each.
    """
    folded = np.empty(codes.shape, dtype=np.uint32)
    for rows in _pieces(codes):
        above = slice(max(0, rows.start - 1), rows.stop)  # a guess needs the row before
        around = codes[above].astype(np.int64, copy=False)
        lacking = around - (_level(around, height[above]) if is_level else _plane(around, None if height is None else height[above]))
        folded[rows] = ((lacking << 1) ^ (lacking >> 63))[rows.start - above.start :]
    planes = max(1, (int(folded.max(initial=0)).bit_length() + 7) // 8)
    # Runs and frequencies are all there is to find; longer matches cost time and bring nothing.
    packer = zlib.compressobj(1, zlib.DEFLATED, 15, 9, zlib.Z_RLE)
    parts = [packer.compress((folded >> np.uint32(8 * plane)).astype(np.uint8).tobytes()) for plane in range(planes)]
    data = base64.b64encode(b"".join([*parts, packer.flush()])).decode("ascii")
    return {"data": data, "planes": planes, "on_height": height is not None, "is_level": is_level}


def _plane(codes, height):
    total = codes if height is None else codes + height
    guess = np.zeros_like(total)
    guess[:, 1:] = total[:, :-1]
    guess[1:, :] += total[:-1, :]
    guess[1:, 1:] -= total[:-1, :-1]
    return guess if height is None else guess - height


def _level(codes, height):
    """The level of the liquid to the left, else of that above; zero where neither is or the ground is higher."""
    guess = np.zeros_like(codes)
    above, beside = codes[:-1], codes[:, :-1]
    guess[1:] = np.where(above > 0, above + height[:-1] - height[1:], 0)
    guess[:, 1:] = np.where(beside > 0, beside + height[:, :-1] - height[:, 1:], guess[:, 1:])
    return np.maximum(guess, 0)


def _steps(values, low, high):
    """uint8 of 1 to 255 for values between the limits, 0 for holes."""
    scaled = (values - np.float32(low)) * np.float32(254 / ((high - low) or 1))
    holes = ~np.isfinite(scaled)
    scaled[holes] = -1
    return (np.clip(scaled, np.where(holes, -1, 0), 254) + 1).astype(np.uint8)


def _webp(picture, quality):
    stream = io.BytesIO()
    picture.save(stream, "WEBP", quality=quality, method=2)
    return uri("image/webp", stream.getvalue())
