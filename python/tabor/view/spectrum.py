"""The power spectrum of the surface with and without its filters, and the wavelengths at which it can be trusted."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from bokeh.models import Column, ColumnDataSource, HoverTool, Range1d
from bokeh.models.annotations import BoxAnnotation
from bokeh.models.widgets import Div
from bokeh.plotting import figure

from .._spectra import Spectra, Spectrum
from .._surface import Surface
from .._values import si
from .answers import Answer
from .looks import CURVES, STYLE, failure_html, si_text
from .pictures import add_saving

_WITHOUT = "#999999"
_DECADES = 12  #: that the densities are shown over, at most


def cutoff(step: str, surface: Surface) -> float:
    """The cutoff wavelength of a filter step [m]: of "lowpass=gauss:8um" 8 µm, of "lowpass=hann:512/L" the side over 512."""
    length = step.partition(":")[2]
    if not length.endswith("/L"):
        return si(length, "length", step)
    lx, ly = surface.lengths
    return math.sqrt(lx * ly) / float(length.removesuffix("/L"))


def _points(spectrum: Spectrum | None) -> dict[str, Any]:
    """Wavelengths [µm] and densities [m^4] that a logarithmic figure can show."""
    if spectrum is None:
        return {"wavelength": [], "density": []}
    seen = (spectrum.q > 0) & (spectrum.density > 0)
    return {"wavelength": 2e6 * np.pi / spectrum.q[seen], "density": spectrum.density[seen]}


class SpectrumFigure:
    """The radial spectrum over the wavelength, long waves on the left."""

    def __init__(self, name: str) -> None:
        self._x, self._y = Range1d(start=100, end=1), Range1d(start=1e-30, end=1e-20)
        self.plot: Any = figure(width=565, height=250, x_axis_type="log", y_axis_type="log", x_range=self._x, y_range=self._y,
                                x_axis_label="wavelength [µm]", y_axis_label="spectral density C(q) [m⁴]", tools="box_zoom,wheel_zoom,reset",
                                toolbar_location="right", name="spectrum", visible=False)
        self.plot.toolbar.logo = None
        self.plot.toolbar.active_scroll = None
        self._trusted = BoxAnnotation(fill_color="#2E7D32", fill_alpha=0.08, left=1, right=10, name="trusted")
        self.plot.add_layout(self._trusted)
        self._before = ColumnDataSource({"wavelength": [], "density": []})
        self._after = ColumnDataSource({"wavelength": [], "density": []}, name="spectrum_source")
        self._cutoffs = ColumnDataSource({"wavelength": [], "step": []})
        self.plot.line("wavelength", "density", source=self._before, color=_WITHOUT, line_width=1.5, legend_label="without filters")
        after = self.plot.line("wavelength", "density", source=self._after, color=CURVES["lubricated"], line_width=2, legend_label="treated")
        self.plot.vspan("wavelength", source=self._cutoffs, color=CURVES["dry"], line_dash="dashed", legend_label="cutoff")
        self.plot.add_tools(HoverTool(visible=False, renderers=[after], tooltips=[("wavelength", "@wavelength{0.000} µm"), ("density", "@density{0.00e+0} m⁴")]))
        self.plot.legend.update(location="bottom_left", background_fill_alpha=0.7)
        add_saving(self.plot, f"{name}_spectrum")
        self.note = Div(stylesheets=[STYLE], width=565, name="spectrum_note")
        self.view = Column(children=[self.plot, self.note])

    def show(self, answer: Answer) -> None:
        """Shows the spectra of an answer, or why there are none."""
        found = answer.spectra
        self.plot.visible = found is not None
        if found is None or answer.surface is None:
            self.note.text = failure_html(answer.failures.get("spectrum", ""))
            return
        self._after.data, self._before.data = _points(found.treated.radial), _points(found.unfiltered.radial if found.unfiltered else None)
        steps = list(answer.state.filters)
        self._cutoffs.data = {"wavelength": [1e6 * cutoff(step, answer.surface) for step in steps], "step": steps}
        self._frame(found.unfiltered or found.treated)
        self.note.text = _trust_text(found.treated)

    def _frame(self, spectra: Spectra) -> None:
        """Ranges and the trusted wavelengths; filters do not move them."""
        known = _points(spectra.radial)
        if not len(known["density"]):
            return
        top = float(known["density"].max())
        self._x.update(start=float(known["wavelength"].max()) * 1.1, end=float(known["wavelength"].min()) / 1.1)
        self._y.update(start=max(float(known["density"].min()) / 30, top / 10.0**_DECADES), end=3 * top)
        shortest, longest = spectra.trusted
        self._trusted.update(left=1e6 * longest, right=1e6 * shortest, visible=shortest < longest)


def _trust_text(spectra: Spectra) -> str:
    shortest, longest = spectra.trusted
    hurst = f" Hurst exponent {spectra.radial.hurst:.2f}." if math.isfinite(spectra.radial.hurst) else ""
    if shortest >= longest:
        return f"<p class='note'>No wavelength can be trusted: four pixels are more than a quarter of the side.{hurst}</p>"
    return (f"<p class='note'>Shaded: wavelengths to rely on, {si_text(shortest, 'm')} to {si_text(longest, 'm')} (rule of thumb: four pixels "
            f"to a quarter of the side).{hurst} Window: {spectra.window}.</p>")
