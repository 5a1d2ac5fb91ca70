"""Maps as small texts for a page: pictures of full resolution, and coarse arrays of the numbers themselves."""

import base64
import io
import zlib

import numpy as np
from PIL import Image

from tabor_report.still import uri

HOLE_CODE = 65535  # of a coarse array: no value
STEPS = HOLE_CODE - 1
LARGEST_SIDE = 8192  # pixels of a picture; a larger map is thinned

# A contact picture is two layers: where film is, in the colours of contact, and on it what hides all that is no contact.
WET_COLOURS = ((232, 134, 46), (0, 0, 0))  # dry, wet
VEILS = (255, 0, 110)  # opacity of white over: no contact, saturated contact, contact below saturation
BELOW_SATURATION = (240, 176, 116), (90, 90, 90)  # the two colours under that veil


def thinning(shape):
    """Every how many pixels of a map a picture has one."""
    return max(1, -(-max(shape) // LARGEST_SIDE))


def coloured(values, limits, colours, ground, quality):
    """A data: URI of a WebP picture of a map; values that are NaN have the colour `ground`.

    values: (ny, nx); limits: the values of the first and last of the 255 colours; colours: uint8 (256, 3), of which
    the first is not used.
    """
    step = thinning(values.shape)
    table = np.array(colours, dtype=np.uint8)
    table[0] = ground
    return _webp(table[_steps(values[::step, ::step], *limits)], quality)


def contact_layer(state, is_saturating):
    """A data: URI of a PNG that hides what does not touch; state: 0 none, 1 contact, 2 saturated.

    Where nothing saturates, all contact is drawn in full.
    """
    veils = VEILS if is_saturating else (VEILS[0], VEILS[1], VEILS[1])
    picture = _palette(state, ((255, 255, 255),) * 3)
    return _png(picture, 2, transparency=bytes([veils[0], veils[2], veils[1]]))


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


def sampled(length, most):
    """The places, at most `most` and evenly spread, at which a side of `length` pixels is sampled."""
    count = min(length, most)
    return ((np.arange(count) + 0.5) * length / count).astype(int)


def coarse(values, most):
    """{"rows", "columns", "low", "step", "data"}: samples of a map as 16-bit steps.

    A value is low + step * code; the codes are packed as differences along a row, high bytes before low ones, deflated.
    The largest error is half a step.
    """
    picked = np.asarray(values[np.ix_(sampled(values.shape[0], most), sampled(values.shape[1], most))], dtype=float)
    finite = picked[np.isfinite(picked)]
    low, high = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 0.0)
    step = (high - low) / STEPS or 1.0
    codes = np.where(np.isfinite(picked), np.rint((np.nan_to_num(picked) - low) / step), HOLE_CODE).astype(np.uint16)
    return {"rows": picked.shape[0], "columns": picked.shape[1], "low": low, "step": step, "data": _packed(codes)}


def _packed(codes):
    differences = np.diff(codes, axis=1, prepend=np.uint16(0))
    planes = np.concatenate([(differences >> 8).astype(np.uint8).ravel(), differences.astype(np.uint8).ravel()])
    return base64.b64encode(zlib.compress(planes.tobytes(), 6)).decode("ascii")


def _steps(values, low, high):
    """uint8 of 1 to 255 for values between the limits, 0 for holes."""
    scaled = (values - np.float32(low)) * np.float32(254 / ((high - low) or 1))
    holes = ~np.isfinite(scaled)
    scaled[holes] = -1
    return (np.clip(scaled, np.where(holes, -1, 0), 254) + 1).astype(np.uint8)


def _webp(picture, quality):
    stream = io.BytesIO()
    Image.fromarray(picture, "RGB").save(stream, "WEBP", quality=quality, method=2)
    return uri("image/webp", stream.getvalue())
