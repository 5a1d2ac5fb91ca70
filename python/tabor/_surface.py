"""Surfaces: read, made of an array, treated, measured."""

from __future__ import annotations

import base64
import os
import struct
import sys
import threading
import zlib
from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import Any, NamedTuple, Unpack

import numpy as np
import numpy.typing as npt

from . import _tabor
from ._arguments import Axes, Path, texts, typed, wrong
from ._foreign import Carried, Foreign, carried, foreign, spacing
from ._optional import needs
from ._progress import Progress, watching
from ._records import Warning, said, table_html, warnings_of
from ._setting_types import ReadSettings, TreatmentSteps
from ._settings import READ, complete, filled, takes
from ._values import Value, in_si, is_labelled, is_quantity, optional_si, si, si_list

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
    hurst_standard_error: float  #: of it, between surfaces of one random kind

    @typed
    def plot(self, ax: Axes = None, **style: Any) -> Any:
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

    @typed
    def plot(self, ax: Axes = None) -> Any:
        """Draws the radial one; needs matplotlib. Returns the axes."""
        return self.radial.plot(ax)


def pixel_sides(pixel: Any) -> tuple[float, float]:
    """Sides of a pixel along x and y [m], of one value or two."""
    lengths, _ = si_list(pixel, "length", "pixel")
    if len(lengths) > 2:
        raise ValueError(f"pixel: got {len(lengths)} lengths; expected one, or two for x and y")
    for length in lengths:
        if not 0 < length < np.inf:
            raise ValueError(f"pixel: got {length:g} m; expected a length above zero")
    return lengths[0], lengths[-1]


def _in_metres(z: Any, unit: str | None) -> Any:
    """Heights in metres, by their own unit or the one that is given; ValueError where these contradict each other."""
    z, own, name, is_si = Carried(z.height, 1.0, "m", True) if isinstance(z, Surface) else carried(z)
    given = None if unit is None else _tabor.parse_si(f"1 {unit}", "length", "unit")
    if given is not None and own is not None and not abs(given - own) <= 1e-9 * given:
        raise ValueError(f"unit: got {unit!r} for heights that say they are in {name!r}; leave it out")
    factor = 1.0 if is_si else own if own is not None else given
    heights = _heights(z)
    return heights if factor is None or factor == 1.0 else heights * factor


def _require_spacing(z: Any, pixel: tuple[float, float]) -> None:
    """ValueError where an array of xarray has other coordinates."""
    for axis, side in zip("xy", pixel) if is_labelled(z) else ():
        own = spacing(z, axis)
        if own is not None and abs(own - side) > 1e-6 * side:
            raise ValueError(f"pixel: got {side:g} m along {axis} for an array whose coordinates are {own:g} m apart; "
                             "leave it out")


def _is_masked(z: Any) -> bool:
    """Asked without loading numpy.ma, which takes a while and locks that a copy of the process may find taken."""
    masked = getattr(sys.modules.get("numpy.ma"), "MaskedArray", None)
    return masked is not None and isinstance(z, masked)


def _heights(z: Any) -> Array:
    if _is_masked(z):
        if z.dtype.kind not in "fiu":
            raise TypeError(f"heights: got an array of {z.dtype}; expected real numbers")
        z = np.ma.filled(z.astype(np.float64), np.nan)
    try:
        heights = np.asarray(z)
    except Exception as error:
        raise TypeError(f"heights: got {type(z).__name__} that is no array; expected real numbers") from error
    if heights.dtype.kind not in "fiu":
        raise TypeError(f"heights: got an array of {heights.dtype}; expected real numbers")
    if heights.ndim != 2 or heights.size == 0:
        raise ValueError(f"heights: got shape {heights.shape}; expected (ny, nx), row 0 on top")
    heights = np.ascontiguousarray(heights, dtype=np.float64)
    if np.isinf(heights).any():
        raise ValueError("heights: got an infinite height; expected numbers, NaN where there is none")
    return heights


_looking = threading.Lock()  #: one thread at a time looks at heights that were handed over


def _renew_lock() -> None:
    """In a copy of the process, whose other threads are gone and will not unlock it."""
    global _looking
    _looking = threading.Lock()


os.register_at_fork(after_in_child=_renew_lock)


class Surface(TreatmentSteps):
    """A height map that does not change; treatments return new ones.

    Parameters
    ----------
    z : array_like, shape (ny, nx)
        Heights [m], row 0 on top, asperities up, NaN or masked where there is none. C-ordered float64
        is copied once, anything else is converted first. A quantity of pint, astropy or unyt, or an array of
        xarray with the attribute ``units``, is taken in its own unit. Without ``pixel``: a surface of
        SurfaceTopography, surfalize or gwyfile, or an array of xarray with coordinates x and y and units.
    pixel : value or (value, value)
        Side of a pixel [m], or those along x and y.
    unit : str, optional
        Unit of the heights if it is not metres: "um". Heights that carry their unit need none.
    periodic : bool
        The map tiles without a seam.
    name : str
        What messages call it.

    Raises
    ------
    ValueError
        For another shape, no pixel, infinite heights; where ``unit`` or ``pixel`` contradicts what the heights
        say themselves.
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

    _heights: _tabor.Topography  #: perhaps without edges and warnings
    _is_looked_at: bool  #: its edges and warnings are known
    _sha256: str  #: of the file it was read from, "" if there is none

    @typed
    def __init__(self, z: Any, *, pixel: Value | tuple[Value, Value] | None = None, unit: str | None = None,
                 periodic: bool = False, name: str = "array") -> None:
        if pixel is None:
            other = Foreign(z.height, z.pixel, "m", z.periodic) if isinstance(z, Surface) else foreign(z)
            if other is None:
                raise TypeError('Surface: give the side of a pixel, pixel="0.67 um"')
            if unit is not None and _tabor.parse_si(f"1 {unit}", "length", "unit") != \
                    _tabor.parse_si(f"1 {other.unit}", "length", "unit"):
                raise ValueError(f"unit: got {unit!r} for heights that say they are in {other.unit!r}; leave it out")
            z, pixel, unit, periodic = *other[:3], periodic or other.periodic
        dx, dy = pixel_sides(pixel)
        _require_spacing(z, (dx, dy))
        heights = _in_metres(z, unit)
        self.__dict__.update(_heights=_tabor.make_surface(heights, dx, dy, periodic, name), _is_looked_at=False, _sha256="")

    @classmethod
    def _of(cls, topography: _tabor.Topography, sha256: str = "") -> Surface:
        surface = cls.__new__(cls)
        surface.__dict__.update(_heights=topography, _is_looked_at=True, _sha256=sha256)
        return surface

    @property
    def _topography(self) -> _tabor.Topography:
        """With edges and warnings, which take longer to find than heights to copy: found when first asked for."""
        if not self._is_looked_at:
            with _looking:
                if not self._is_looked_at:
                    _tabor.look_at(self._heights)
                    self.__dict__["_is_looked_at"] = True
        return self._heights

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError("a Surface does not change")

    def __getstate__(self) -> dict[str, Any]:
        return {"_topography": self._topography, "_sha256": self._sha256}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(_heights=state["_topography"], _is_looked_at=True, _sha256=state["_sha256"])

    @property
    def height(self) -> Array:
        """Heights [m], shape (ny, nx), a read-only view; NaN is a hole."""
        return self._heights.height

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
        return self._heights.lx, self._heights.ly

    @property
    def pixel(self) -> tuple[float, float]:
        """Sides of a pixel along x and y [m]."""
        ny, nx = self.shape
        return self._heights.lx / nx, self._heights.ly / ny

    @property
    def periodic(self) -> bool:
        """It repeats: it was made or said to, or its opposite edges match."""
        return self._topography.periodic

    @property
    def n_holes(self) -> int:
        """Pixels without a height."""
        return self._heights.n_holes

    @property
    def source(self) -> str:
        """File or name it came from."""
        return self._heights.source

    @property
    def format(self) -> str:
        """Of its file, as in ``tabor formats``; "array" if it is from none."""
        return self._heights.format

    @property
    def metadata(self) -> Mapping[str, str]:
        """What else the file says."""
        return self._heights.metadata

    @property
    def history(self) -> tuple[str, ...]:
        """Treatment steps so far, with their numbers."""
        return tuple(self._heights.history)

    @property
    def warnings(self) -> tuple[Warning, ...]:
        """Reasons to doubt what is computed with it."""
        return warnings_of(self._topography.warnings)

    def treat(self, *steps: str, progress: Progress = None) -> Surface:
        """Applies steps in the order given, as a study file writes them: ``treat("level=plane",
        "fill=harmonic")``. Raises ValueError that names the nearest step."""
        steps = tuple(step for given in steps for step in texts(given, "steps"))
        with watching(progress) as told:
            return Surface._of(_tabor.apply(self._topography, list(steps), told), self._sha256)

    @typed
    def parameters(self, symbols: Iterable[str] | None = None, *, progress: Progress = None) -> Parameters:
        """Roughness parameters of the surface as it is (ISO 25178-2 and others, docs/parameters.md), all
        or those named. Level before. Raises ValueError for an unknown symbol."""
        with watching(progress) as told:
            every = Parameters(Parameter(*row) for row in _tabor.parameters(self._topography, told))
        if symbols is None:
            return every
        wanted = texts(symbols, "symbols")
        known = {one.symbol: one for one in every}
        for symbol in wanted:
            if symbol not in known:
                raise ValueError(f"symbols: got {symbol!r}; expected some of {', '.join(known)}")
        return Parameters(known[symbol] for symbol in wanted)

    @typed
    def psd(self, convention: str = "jacobs", window: str | None = None, *, fit_min: Value | None = None,
            fit_max: Value | None = None, progress: Progress = None) -> Spectra:
        """Power spectra along x, along y and radial (docs/filters_and_spectra.md).

        Parameters
        ----------
        convention : "jacobs", "persson" or "gwyddion".
        window : "none" or "hann" ["none" where opposite edges match, else "hann"].
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

    @typed
    def write(self, file: Path) -> None:
        """Writes a scan file by its extension (docs/formats.md). Raises ValueError for an extension that
        no format has, OSError where it cannot be written."""
        _tabor.write(self._topography, os.fspath(file))

    def to_xarray(self) -> Any:
        """The heights as a DataArray with coordinates x and y [m], warnings as its attribute, to be written as
        NetCDF; needs xarray."""
        return map_to_xarray(self, self.height, "height", "m", {"source": self.source, **said(self.warnings, ())})

    @typed
    def plot(self, ax: Axes = None) -> Any:
        """Draws the heights; needs matplotlib. Returns the axes."""
        return plot_map(self, self.height, "height [m]", ax)

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


def _step_text(value: Any, step: str) -> str:
    """One part of the argument of a step; a quantity is a length."""
    if isinstance(value, str):
        return value
    if is_quantity(value):
        return f"{float(in_si(value, 'length', step))!r} m"
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, float, np.integer, np.floating)):
        raise wrong(step, value, f"its argument, {_STEPS[step][0]}")
    return str(value)


def _add_step(name: str, argument: str, text: str) -> None:
    def with_argument(self: Surface, *values: Any, progress: Progress = None) -> Surface:
        words = ",".join(_step_text(value, name) for value in values)
        return self.treat(f"{name}={words}" if words else name, progress=progress)

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


@takes(READ)
def read(file: Path, *, channel: str | int | None = None, progress: Progress = None, **settings: Unpack[ReadSettings]) -> Surface:
    """Reads a scan file, recognised by its content (docs/formats.md).

    Parameters
    ----------
    file : its name.
    **settings
    progress : see ``tabor.Progress``.

    Raises
    ------
    ValueError
        What is wrong with the file, or which of these it leaves open. A file that does not exist, too.
    """
    options = _tabor.ReadOptions()
    values = complete(READ, {**settings, "channel": None if channel is None else str(channel)})
    pixel = values.pop("pixel")
    if pixel is not None:
        options.pixel_x, options.pixel_y = pixel_sides(pixel)
    filled(options, values)
    with watching(progress) as told:
        return Surface._of(*_tabor.read(os.fspath(file), options, told))


def coordinates(surface: Surface) -> tuple[Array, Array]:
    """Centres of the columns and of the rows [m], from the upper left corner."""
    (ny, nx), (dx, dy) = surface.shape, surface.pixel
    return (np.arange(nx, dtype=np.float64) + 0.5) * dx, (np.arange(ny, dtype=np.float64) + 0.5) * dy


def map_to_xarray(surface: Surface, values: Array, name: str, unit: str,
                  attributes: Mapping[str, Any] = MappingProxyType({})) -> Any:
    """A map as a DataArray."""
    xarray = needs("xarray", "to_xarray()")
    x, y = coordinates(surface)
    found = xarray.DataArray(values, {"y": y, "x": x}, ("y", "x"), name, {"units": unit, **attributes})
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
