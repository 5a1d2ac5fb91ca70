"""Surfaces: read, made of an array, treated, measured."""

from __future__ import annotations

import base64
import os
import struct
import zlib
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _tabor
from ._foreign import foreign
from ._optional import needs
from ._progress import Progress, watching
from ._records import Warning, table_html, warnings_of
from ._values import Value, optional_si, si

Array = npt.NDArray[np.float64]
_STEPS = {name: (argument, text) for name, argument, text in _tabor.treatment_steps()}


class Parameter(NamedTuple):
    """A roughness parameter with everything that is needed to compare it with another program's."""

    symbol: str
    value: float  #: SI; NaN where it does not exist
    unit: str
    definition: str
    note: str
    set: str


class Parameters(tuple[Parameter, ...]):
    """Parameters in their order, also by symbol: ``parameters["Sq"].value``."""

    def __getitem__(self, key: Any) -> Any:
        if not isinstance(key, str):
            return super().__getitem__(key)
        for one in self:
            if one.symbol == key:
                return one
        raise KeyError(key)

    def __repr__(self) -> str:
        return "\n".join(f"{one.symbol:<8} {one.value:<14.6g} {one.unit:<6} {one.definition}" for one in self)

    def _repr_html_(self) -> str:
        return table_html("Parameters", [(one.symbol, f"{one.value:.6g} {one.unit}   {one.definition}")
                                         for one in self])


class Spectrum(NamedTuple):
    """A power spectral density over wavevectors q = 2 pi / wavelength."""

    q: Array  #: [rad/m], rising
    density: Array  #: in ``unit``
    unit: str  #: "m^3" or "m^4"
    hurst: float  #: fitted exponent; NaN where there is none
    hurst_standard_error: float  #: of it, from the scatter about the line

    def plot(self, ax: Any = None, **style: Any) -> Any:
        """Draws it with logarithmic axes; needs matplotlib. Returns the axes."""
        ax = ax or needs("matplotlib.pyplot", "plot()").gca()
        ax.loglog(self.q, self.density, **style)
        ax.set_xlabel("q [rad/m]")
        ax.set_ylabel(f"density [{self.unit}]")
        return ax


class Spectra(NamedTuple):
    """Spectra along x, along y and averaged over rings."""

    x: Spectrum
    y: Spectrum
    radial: Spectrum
    window: str  #: the taper that was used
    warnings: tuple[Warning, ...]  #: reasons to doubt the exponents

    def plot(self, ax: Any = None) -> Any:
        """Draws the radial one; needs matplotlib. Returns the axes."""
        return self.radial.plot(ax)


def _pixels(pixel: Any) -> tuple[float, float]:
    sides = list(pixel) if isinstance(pixel, (tuple, list)) else [pixel, pixel]
    if len(sides) != 2:
        raise ValueError(f"pixel: got {len(sides)} lengths; expected one, or two for x and y")
    lengths = [si(side, "length", "pixel") for side in sides]
    for length in lengths:
        if not 0 < length < np.inf:
            raise ValueError(f"pixel: got {length:g} m; expected a length above zero")
    return lengths[0], lengths[1]


def _heights(z: Any) -> Array:
    if isinstance(z, np.ma.MaskedArray):
        z = np.ma.filled(z.astype(np.float64), np.nan)
    heights = np.asarray(z)
    if heights.dtype.kind not in "fiu":
        raise TypeError(f"heights: got an array of {heights.dtype}; expected real numbers")
    if heights.ndim != 2 or heights.size == 0:
        raise ValueError(f"heights: got shape {heights.shape}; expected (ny, nx), row 0 on top")
    heights = np.ascontiguousarray(heights, dtype=np.float64)
    if np.isinf(heights).any():
        raise ValueError("heights: got an infinite height; expected numbers, NaN where there is none")
    return heights


class Surface:
    """A height map that does not change; treatments return new ones.

    Parameters
    ----------
    z : array_like, shape (ny, nx)
        Heights [m], row 0 on top, asperities up, NaN or masked where there is none. C-ordered float64
        is copied once, anything else is converted first. Without ``pixel``: a surface of SurfaceTopography,
        surfalize or gwyfile, or an array of xarray with coordinates x and y and units.
    pixel : value or (value, value)
        Side of a pixel [m], or those along x and y.
    unit : str, optional
        Unit of the heights if it is not metres: "um".
    periodic : bool
        The map tiles without a seam.
    name : str
        What messages call it.

    Raises
    ------
    ValueError
        For another shape, no pixel, infinite heights.
    TypeError
        For arrays of anything but real numbers.

    Examples
    --------
    >>> import numpy as np, tabor as tb
    >>> waves = 1e-6 * np.sin(np.linspace(0, 6 * np.pi, 64, endpoint=False))
    >>> surface = tb.Surface(np.tile(waves, (64, 1)), pixel="1 um")
    >>> surface.shape
    (64, 64)
    """

    _topography: _tabor.Topography
    _sha256: str  #: of the file it was read from, "" if there is none

    def __init__(self, z: Any, *, pixel: Value | tuple[Value, Value] | None = None, unit: str = "m",
                 periodic: bool = False, name: str = "array") -> None:
        if pixel is None:
            other = foreign(z)
            if other is None:
                raise TypeError('Surface: give the side of a pixel, pixel="0.67 um"')
            z, pixel, unit, periodic = other
        dx, dy = _pixels(pixel)
        heights = _heights(z)
        if unit != "m":
            heights = heights * _tabor.parse_si(f"1 {unit}", "length", "unit")
        self.__dict__.update(_topography=_tabor.make_surface(heights, dx, dy, periodic, name), _sha256="")

    @classmethod
    def _of(cls, topography: _tabor.Topography, sha256: str = "") -> Surface:
        surface = cls.__new__(cls)
        surface.__dict__.update(_topography=topography, _sha256=sha256)
        return surface

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError("a Surface does not change")

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)

    @property
    def height(self) -> Array:
        """Heights [m], shape (ny, nx), a read-only view; NaN is a hole."""
        return self._topography.height

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Any:
        return np.array(self.height, dtype=dtype) if copy or dtype else self.height

    @property
    def shape(self) -> tuple[int, int]:
        """(ny, nx)"""
        ny, nx = self.height.shape
        return ny, nx

    @property
    def size(self) -> tuple[float, float]:
        """Sides along x and y [m]."""
        return self._topography.lx, self._topography.ly

    @property
    def pixel(self) -> tuple[float, float]:
        """Sides of a pixel along x and y [m]."""
        ny, nx = self.shape
        return self._topography.lx / nx, self._topography.ly / ny

    @property
    def periodic(self) -> bool:
        """It tiles without a seam."""
        return self._topography.periodic

    @property
    def n_holes(self) -> int:
        """Pixels without a height."""
        return self._topography.n_holes

    @property
    def source(self) -> str:
        """File or name it came from."""
        return self._topography.source

    @property
    def format(self) -> str:
        """Of its file, as in ``tabor formats``; "array" if it is from none."""
        return self._topography.format

    @property
    def metadata(self) -> Mapping[str, str]:
        """What else the file says."""
        return self._topography.metadata

    @property
    def history(self) -> tuple[str, ...]:
        """Treatment steps so far, with their numbers."""
        return tuple(self._topography.history)

    @property
    def warnings(self) -> tuple[Warning, ...]:
        """Reasons to doubt what is computed with it."""
        return warnings_of(self._topography.warnings)

    def treat(self, *steps: str, progress: Progress = None) -> Surface:
        """Applies steps in the order given, as a study file writes them: ``treat("level=plane",
        "fill=harmonic")``. Raises ValueError that names the nearest step."""
        with watching(progress) as told:
            return Surface._of(_tabor.apply(self._topography, list(steps), told), self._sha256)

    def parameters(self, symbols: Iterable[str] | None = None, *, progress: Progress = None) -> Parameters:
        """Roughness parameters of the surface as it is (ISO 25178-2 and others, docs/parameters.md), all
        or those named. Level before. Raises ValueError for an unknown symbol."""
        with watching(progress) as told:
            every = Parameters(Parameter(*row) for row in _tabor.parameters(self._topography, told))
        if symbols is None:
            return every
        wanted = [symbols] if isinstance(symbols, str) else list(symbols)
        known = {one.symbol: one for one in every}
        for symbol in wanted:
            if symbol not in known:
                raise ValueError(f"parameters: got {symbol!r}; expected some of {', '.join(known)}")
        return Parameters(known[symbol] for symbol in wanted)

    def psd(self, convention: str = "jacobs", window: str | None = None, *, fit_min: Value | None = None,
            fit_max: Value | None = None, progress: Progress = None) -> Spectra:
        """Power spectra along x, along y and radial (docs/filters_and_spectra.md).

        Parameters
        ----------
        convention : "jacobs", "persson" or "gwyddion".
        window : "none" or "hann" ["none" if periodic, else "hann"].
        fit_min, fit_max : wavevectors 2 pi / wavelength between which the Hurst exponents are fitted [rad/m], "0.1/um"
            [the longest straight range].

        Raises ValueError where there are holes, for unknown words, and for a range that ends before it begins.
        """
        with watching(progress) as told:
            found = _tabor.psd(self._topography, convention, window, optional_si(fit_min, "wavevector", "fit_min"),
                               optional_si(fit_max, "wavevector", "fit_max"), told)
        x, y, radial = (Spectrum(np.array(q), np.array(density), *rest)
                        for q, density, *rest in (found[axis] for axis in ("x", "y", "radial")))
        return Spectra(x, y, radial, found["window"], warnings_of(found["warnings"]))

    def write(self, file: str | os.PathLike[str]) -> None:
        """Writes a scan file by its extension (docs/formats.md). Raises ValueError for an extension that
        no format has, OSError where it cannot be written."""
        _tabor.write(self._topography, os.fspath(file))

    def to_xarray(self) -> Any:
        """The heights as a DataArray with coordinates x and y [m]; needs xarray."""
        return map_to_xarray(self, self.height, "height", "m")

    def plot(self, ax: Any = None) -> Any:
        """Draws the heights; needs matplotlib. Returns the axes."""
        return plot_map(self, self.height, "height [m]", ax)

    if TYPE_CHECKING:  # made below of the table of steps

        def crop(self, *values: Any, progress: Progress = None) -> Surface: ...
        def trim(self, *values: Any, progress: Progress = None) -> Surface: ...
        def despike(self, *values: Any, progress: Progress = None) -> Surface: ...
        def level(self, *values: Any, progress: Progress = None) -> Surface: ...
        def fill(self, *values: Any, progress: Progress = None) -> Surface: ...
        def lowpass(self, *values: Any, progress: Progress = None) -> Surface: ...
        def highpass(self, *values: Any, progress: Progress = None) -> Surface: ...
        def resample(self, *values: Any, progress: Progress = None) -> Surface: ...
        def mirror(self, *, progress: Progress = None) -> Surface: ...
        def flip(self, *values: Any, progress: Progress = None) -> Surface: ...

    def _lines(self) -> list[tuple[str, str]]:
        ny, nx = self.shape
        dx, dy = (_tabor.format_si(side, "m") for side in self.pixel)
        lines = [("source", f"{self.source} ({self.format})"),
                 ("size", f"{nx} x {ny} pixels of {dx if dx == dy else dx + ' x ' + dy}"),
                 ("heights", "in m, all there" if not self.n_holes else f"in m, {self.n_holes} holes")]
        lines += [("step", step) for step in self.history]
        return lines + [("warning", warning.text) for warning in self.warnings]

    def __repr__(self) -> str:
        return "\n".join(["Surface"] + [f"  {heading:<8} {text}" for heading, text in self._lines()])

    def _repr_html_(self) -> str:
        return table_html("Surface", self._lines(), base64.b64encode(thumbnail(self.height)).decode())


def _add_step(name: str, argument: str, text: str) -> None:
    def with_argument(self: Surface, *values: Any, progress: Progress = None) -> Surface:
        return self.treat("=".join([name, *filter(None, [",".join(map(str, values))])]), progress=progress)

    def plain(self: Surface, *, progress: Progress = None) -> Surface:
        return self.treat(name, progress=progress)

    method = with_argument if argument else plain
    method.__name__ = name
    method.__qualname__ = f"Surface.{name}"
    method.__doc__ = f"{text[0].upper()}{text[1:]}." + (
        f"\n\nThe argument: {argument}; several may be given one by one." if argument else "")
    setattr(Surface, name, method)


for _name, (_argument, _text) in _STEPS.items():
    _add_step(_name, _argument, _text)


def read(file: str | os.PathLike[str], *, channel: str | int | None = None,
         pixel: Value | tuple[Value, Value] | None = None, unit: str | None = None,
         z_scale: Value | None = None, override_unit: bool = False, progress: Progress = None) -> Surface:
    """Reads a scan file, recognised by its content (docs/formats.md).

    Parameters
    ----------
    channel : name or number of the height channel, where there are several.
    pixel : side of a pixel, where the file has none.
    unit : of the heights, where the file has none.
    z_scale : height of one count of integer images.
    override_unit : ``pixel`` and ``unit`` win over what the file says.

    Raises
    ------
    ValueError
        What is wrong with the file, or which of these it leaves open. A file that does not exist, too.
    """
    options = _tabor.ReadOptions()
    options.channel = None if channel is None else str(channel)
    if pixel is not None:
        options.pixel_x, options.pixel_y = _pixels(pixel)
    options.unit = unit
    options.z_scale = optional_si(z_scale, "length", "z_scale")
    options.override_unit = override_unit
    with watching(progress) as told:
        return Surface._of(*_tabor.read(os.fspath(file), options, told))


def generate(kind: str, *, pixels: int | tuple[int, int] = 512, pixel: Value | tuple[Value, Value] = 0.67e-6,
             seed: int = 1, stage: str = "before", periodic: bool = True, random_amplitudes: bool = False,
             **numbers: Value) -> Surface:
    """Makes a surface; the same arguments give the same bits, on any number of threads.

    Parameters
    ----------
    kind : "self-affine", "edt", "ground", "sinusoid", "sphere" or "bump".
    pixels : number of pixels along x and y, or one for both.
    pixel : side of a pixel [m], or those along x and y.
    seed : of random numbers.
    stage : edt: "before" or "after" sliding.
    periodic : edt: a tile, or a cut-out.
    random_amplitudes : self-affine: Gaussian amplitudes, not random phases only.

    Raises
    ------
    ValueError
        For an unknown kind, and for numbers that do not belong to it, are missing or out of range.

    Examples
    --------
    >>> import tabor as tb
    >>> tb.generate("sinusoid", pixels=64, pixel="1 um", amplitude="1 um", wavelength_x="16 um").periodic
    True

    Further numbers, with the kinds that take them and [their usual values]:

    """
    request = _tabor.GenerateRequest()
    nx, ny = (pixels, pixels) if isinstance(pixels, int) else pixels
    request.set_grid(nx, ny, *_pixels(pixel))
    request.kind, request.periodic, request.random_amplitudes = kind, periodic, random_amplitudes
    request.set_stage(stage)
    if seed < 0:
        raise ValueError(f"seed: got {seed}; expected zero or more")
    request.seed = seed
    request.numbers = {name: si(value, _NUMBERS.get(name, "none"), name) for name, value in numbers.items()}
    return Surface._of(_tabor.generate(request))


_NUMBERS = {name: dimension for name, dimension, _ in _tabor.recipe_numbers()}
generate.__doc__ = (generate.__doc__ or "").rstrip() + "\n\n" + "\n".join(
    f"    {name} : {text}" for name, _, text in _tabor.recipe_numbers()) + "\n"


class Format(NamedTuple):
    """A format of scan files."""

    name: str
    description: str
    extensions: tuple[str, ...]
    reads: bool
    writes: bool
    via_gwyddion: bool  #: only where Gwyddion is installed


def formats() -> tuple[Format, ...]:
    """The formats that ``read`` and ``Surface.write`` know, as ``tabor formats`` lists them."""
    return tuple(Format(name, text, tuple(extensions), *can) for name, text, extensions, *can in _tabor.formats())


def coordinates(surface: Surface) -> tuple[Array, Array]:
    """Centres of the columns and of the rows [m], from the upper left corner."""
    (ny, nx), (dx, dy) = surface.shape, surface.pixel
    return (np.arange(nx, dtype=np.float64) + 0.5) * dx, (np.arange(ny, dtype=np.float64) + 0.5) * dy


def map_to_xarray(surface: Surface, values: Array, name: str, unit: str) -> Any:
    """A map as a DataArray."""
    xarray = needs("xarray", "to_xarray()")
    x, y = coordinates(surface)
    found = xarray.DataArray(values, {"y": y, "x": x}, ("y", "x"), name, {"units": unit})
    found.x.attrs["units"] = found.y.attrs["units"] = "m"
    return found


def plot_map(surface: Surface, values: Array, label: str, ax: Any) -> Any:
    """A map as a picture with its scale."""
    ax = ax or needs("matplotlib.pyplot", "plot()").gca()
    lx, ly = surface.size
    image = ax.imshow(values, extent=(0, lx * 1e6, ly * 1e6, 0))
    ax.set_xlabel("x [um]")
    ax.set_ylabel("y [um]")
    ax.figure.colorbar(image, ax=ax, label=label)
    return ax


def thumbnail(values: Array, side: int = 128) -> bytes:
    """A grey PNG of at most side x side pixels, from the 1st to the 99th percentile; holes are black."""
    step = max(1, -(-max(values.shape) // side))
    small = values[::step, ::step]
    known = small[np.isfinite(small)]
    low, high = np.percentile(known, [1, 99]) if known.size else (0.0, 1.0)
    share = np.clip((small - low) / (high - low if high > low else 1.0), 0, 1)
    grey = np.where(np.isfinite(share), 32 + 223 * np.nan_to_num(share), 0).astype(np.uint8)
    rows = b"".join(b"\0" + row.tobytes() for row in grey)
    head = struct.pack(">IIBBBBB", grey.shape[1], grey.shape[0], 8, 0, 0, 0, 0)
    chunks = [(b"IHDR", head), (b"IDAT", zlib.compress(rows)), (b"IEND", b"")]
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        for kind, data in chunks)
