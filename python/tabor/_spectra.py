"""Power spectra of surfaces."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import _tabor
from ._arguments import Axes, typed, wrong
from ._maps import Array
from ._optional import needs
from ._records import Shown, Warning, said
from ._tabor import format_si


def _draw(ax: Axes, q: Array, density: Array, unit: str, style: dict[str, Any]) -> Any:
    """A density over wavevectors with logarithmic axes."""
    ax = ax or needs("matplotlib.pyplot", "plot()").gca()
    ax.loglog(q, density, **style)
    ax.xaxis.set_minor_locator(needs("matplotlib.ticker", "plot()").LogLocator(subs=(2, 5)))  # more labels overlap
    ax.set_xlabel("q [rad/m]")
    ax.set_ylabel(f"density [{unit}]")
    return ax


def _wavevectors(q: Array) -> str:
    return f"{q.size} wavevectors, " + (f"{q[0]:.4g} to {q[-1]:.4g} rad/m" if q.size else "none")


@dataclass(frozen=True, eq=False, repr=False)
class Spectrum(Shown):
    """A power spectral density over wavevectors q = 2 pi / wavelength."""

    q: Array  #: [rad/m], rising
    density: Array  #: in ``unit``
    unit: str  #: "m^3" or "m^4"
    hurst: float  #: fitted exponent; NaN where there is none
    hurst_standard_error: float  #: of it, between surfaces of one random kind

    @typed
    def plot(self, ax: Axes = None, **style: Any) -> Any:
        """Draws it with logarithmic axes; needs matplotlib. Returns the axes."""
        return _draw(ax, self.q, self.density, self.unit, style)

    def to_xarray(self) -> Any:
        """The density as a DataArray over q [rad/m], the fit of its exponent as attributes; needs xarray."""
        xarray = needs("xarray", "to_xarray()")
        return xarray.DataArray(self.density, {"q": ("q", self.q, {"units": "rad/m"})}, ("q",), "density", self._attributes())

    def _attributes(self) -> dict[str, Any]:
        fit = {"hurst": self.hurst, "hurst_standard_error": self.hurst_standard_error}
        return {"units": self.unit, **{key: float(value) for key, value in fit.items() if np.isfinite(value)}}

    def _lines(self) -> list[tuple[str, str]]:
        fit = f"{self.hurst:.3g} +- {self.hurst_standard_error:.2g}" if np.isfinite(self.hurst) else "no fit"
        return [("q", _wavevectors(self.q)), ("density", f"in {self.unit}"), ("Hurst", fit)]


@dataclass(frozen=True, eq=False, repr=False)
class Spectra(Shown):
    """Spectra along x, along y and averaged over rings."""

    x: Spectrum
    y: Spectrum
    radial: Spectrum
    convention: str  #: of the densities: "jacobs", "persson" or "gwyddion"
    window: str  #: the taper that was used
    warnings: tuple[Warning, ...]  #: reasons to doubt the exponents
    trusted: tuple[float, float]  #: shortest and longest wavelength to rely on [m], rules of thumb (docs/filters_and_spectra.md)

    @typed
    def plot(self, ax: Axes = None, **style: Any) -> Any:
        """Draws the radial one; needs matplotlib. Returns the axes."""
        return self.radial.plot(ax, **style)

    def to_xarray(self) -> Any:
        """A Dataset with ``density_x`` over ``q_x``, ``density_y`` over ``q_y`` and ``density_radial`` over ``q_radial``;
        needs xarray."""
        xarray = needs("xarray", "to_xarray()")
        named = {"density_x": ("q_x", self.x), "density_y": ("q_y", self.y), "density_radial": ("q_radial", self.radial)}
        return xarray.Dataset({name: (dim, one.density, one._attributes()) for name, (dim, one) in named.items()},
                              {dim: (dim, one.q, {"units": "rad/m"}) for dim, one in named.values()},
                              {"convention": self.convention, "window": self.window, "trusted_wavelengths_m": list(self.trusted), **said(self.warnings, ())})

    def _lines(self) -> list[tuple[str, str]]:
        lines = [(name, ", ".join(text for _, text in one._lines()[:2]) + f", Hurst {one._lines()[2][1]}")
                 for name, one in (("x", self.x), ("y", self.y), ("radial", self.radial))]
        shortest, longest = (format_si(one, "m") for one in self.trusted)
        reliable = f"wavelengths from {shortest} to {longest}" if self.trusted[0] < self.trusted[1] else "no wavelength"
        return [*lines, ("convention", self.convention), ("window", self.window), ("trusted", reliable), *(("warning", one.text) for one in self.warnings)]


@dataclass(frozen=True, eq=False, repr=False)
class MeanSpectrum(Shown):
    """Mean of several power spectra at each wavevector that all of them reach."""

    q: Array  #: [rad/m], rising
    density: Array  #: arithmetic mean, in ``unit``
    standard_deviation: Array  #: between the spectra, in ``unit``; NaN for a single one
    standard_error: Array  #: of the mean, in ``unit``; NaN for a single one
    unit: str  #: "m^3" or "m^4"
    n: int  #: spectra

    @typed
    def plot(self, ax: Axes = None, **style: Any) -> Any:
        """Draws the mean with logarithmic axes; needs matplotlib. Returns the axes."""
        return _draw(ax, self.q, self.density, self.unit, style)

    def to_xarray(self) -> Any:
        """Mean, deviation and standard error as a Dataset over q [rad/m]; needs xarray."""
        xarray = needs("xarray", "to_xarray()")
        names = ("density", "standard_deviation", "standard_error")
        return xarray.Dataset({name: ("q", getattr(self, name), {"units": self.unit}) for name in names},
                              {"q": ("q", self.q, {"units": "rad/m"})}, {"n": self.n})

    def _lines(self) -> list[tuple[str, str]]:
        return [("q", _wavevectors(self.q)), ("density", f"in {self.unit}"), ("spectra", str(self.n))]


@dataclass(frozen=True, eq=False, repr=False)
class MeanSpectra(Shown):
    """Means of spectra along x, along y and averaged over rings."""

    x: MeanSpectrum | None  #: None for profiles along y
    y: MeanSpectrum | None  #: None for profiles along x
    radial: MeanSpectrum | None  #: None for profiles
    convention: str  #: of the densities
    warnings: tuple[Warning, ...]  #: of all spectra, each once

    def _lines(self) -> list[tuple[str, str]]:
        axes = (("x", self.x), ("y", self.y), ("radial", self.radial))
        lines = [(name, ", ".join(text for _, text in one._lines()[:2])) for name, one in axes if one is not None]
        n = max((one.n for _, one in axes if one is not None), default=0)
        return [*lines, ("convention", self.convention), ("spectra", str(n)), *(("warning", one.text) for one in self.warnings)]


def _mean(spectra: list[Spectrum]) -> MeanSpectrum | None:
    if not any(one.q.size for one in spectra):
        return None
    rows = [(one.q.tolist(), one.density.tolist(), one.unit) for one in spectra]
    q, density, deviation, error, unit = _tabor.mean_spectrum(rows)
    return MeanSpectrum(np.array(q), np.array(density), np.array(deviation), np.array(error), unit, len(spectra))


@typed
def mean_spectra(spectra: Iterable[Any]) -> MeanSpectra:
    """Means of the power spectra of a group of scans, as ``tabor psd --group`` prints them.

    The mean is arithmetic: a density is a mean square per wavevector, so the mean of the densities belongs to the mean of
    the squared rms heights. Spectra with different wavevectors are interpolated (docs/filters_and_spectra.md).

    Parameters
    ----------
    spectra : of each scan, as ``Surface.psd`` returns them.

    Returns
    -------
    MeanSpectra
        Means along x, along y and radial, each with the deviation between the spectra at each wavevector.

    Raises
    ------
    ValueError
        For no spectra, different conventions or units, and no common range of wavevectors.

    Examples
    --------
    >>> import tabor as tb
    >>> rough = [tb.generate("edt", pixels=64, seed=seed) for seed in (1, 2, 3)]
    >>> mean = tb.mean_spectra(surface.psd() for surface in rough).radial
    >>> mean.n, mean.unit
    (3, 'm^4')
    """
    expected = "a list of Spectra, as Surface.psd() returns them"
    if not isinstance(spectra, Iterable):
        raise wrong("spectra", spectra, expected)
    given = list(spectra)
    if not all(isinstance(one, Spectra) for one in given):
        raise wrong("spectra", given, expected)
    if not given:
        raise ValueError(f"spectra: got none; expected {expected}")
    conventions = sorted({one.convention for one in given})
    if len(conventions) > 1:
        raise ValueError(f"spectra: got the conventions {' and '.join(conventions)}; expected one")
    warnings = tuple(dict.fromkeys(warning for one in given for warning in one.warnings))
    return MeanSpectra(_mean([one.x for one in given]), _mean([one.y for one in given]), _mean([one.radial for one in given]),
                       conventions[0], warnings)
