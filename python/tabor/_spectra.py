"""Power spectra of surfaces."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ._arguments import Axes, typed
from ._maps import Array
from ._optional import needs
from ._records import Shown, Warning, said
from ._tabor import format_si


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
        ax = ax or needs("matplotlib.pyplot", "plot()").gca()
        ax.loglog(self.q, self.density, **style)
        ax.set_xlabel("q [rad/m]")
        ax.set_ylabel(f"density [{self.unit}]")
        return ax

    def to_xarray(self) -> Any:
        """The density as a DataArray over q [rad/m], the fit of its exponent as attributes; needs xarray."""
        xarray = needs("xarray", "to_xarray()")
        return xarray.DataArray(self.density, {"q": ("q", self.q, {"units": "rad/m"})}, ("q",), "density", self._attributes())

    def _attributes(self) -> dict[str, Any]:
        fit = {"hurst": self.hurst, "hurst_standard_error": self.hurst_standard_error}
        return {"units": self.unit, **{key: float(value) for key, value in fit.items() if np.isfinite(value)}}

    def _lines(self) -> list[tuple[str, str]]:
        ends = f"{self.q[0]:.4g} to {self.q[-1]:.4g} rad/m" if self.q.size else "none"
        fit = f"{self.hurst:.3g} +- {self.hurst_standard_error:.2g}" if np.isfinite(self.hurst) else "no fit"
        return [("q", f"{self.q.size} wavevectors, {ends}"), ("density", f"in {self.unit}"), ("Hurst", fit)]


@dataclass(frozen=True, eq=False, repr=False)
class Spectra(Shown):
    """Spectra along x, along y and averaged over rings."""

    x: Spectrum
    y: Spectrum
    radial: Spectrum
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
                              {"window": self.window, "trusted_wavelengths_m": list(self.trusted), **said(self.warnings, ())})

    def _lines(self) -> list[tuple[str, str]]:
        lines = [(name, ", ".join(text for _, text in one._lines()[:2]) + f", Hurst {one._lines()[2][1]}")
                 for name, one in (("x", self.x), ("y", self.y), ("radial", self.radial))]
        shortest, longest = (format_si(one, "m") for one in self.trusted)
        reliable = f"wavelengths from {shortest} to {longest}" if self.trusted[0] < self.trusted[1] else "no wavelength"
        return [*lines, ("window", self.window), ("trusted", reliable), *(("warning", one.text) for one in self.warnings)]
