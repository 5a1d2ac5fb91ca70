"""Surfaces: made of an array, treated, measured."""

from __future__ import annotations

import base64
import os
import threading
from collections.abc import Callable, Iterable, Mapping
from typing import Any, Literal, Self

import numpy as np

from . import _tabor
from ._arguments import Axes, Path, texts, typed, wrong
from ._doubts import tell
from ._foreign import Carried, Foreign, foreign
from ._heights import Array, checked, in_metres, pixel_sides, require_spacing
from ._maps import Map, Window, map_to_xarray, plot_map, thumbnail
from ._on_grid import OnGrid
from ._operators import Operators, part_of
from ._parameters import Parameter, Parameters, selected
from ._progress import Progress, watching
from ._records import Shown, Warning, said, table_html, warnings_of
from ._section import Section, point_of, section_of
from ._setting_types import TreatmentSteps
from ._spectra import Spectra, Spectrum
from ._state import attributes_of, state_of
from ._steps import add_steps
from ._values import Value, optional_si

#: Conventions of power spectra (docs/filters_and_spectra.md).
Convention = Literal["jacobs", "persson", "gwyddion"]
Taper = Literal["none", "hann"]

_looking = threading.Lock()  #: one thread at a time looks at heights that were handed over


def _renew_lock() -> None:
    """In a copy of the process, whose other threads are gone and will not unlock it."""
    global _looking
    _looking = threading.Lock()


os.register_at_fork(after_in_child=_renew_lock)


class Surface(Shown, OnGrid, Operators, TreatmentSteps):
    """A height map that does not change; treatments return new ones.

    Parameters
    ----------
    z : array_like, shape (ny, nx)
        Heights [m], row 0 on top, asperities up, NaN or masked where there is none; or a Surface, which is taken
        with its grid, history and edges. C-ordered float64
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
        For another shape, no pixel, infinite heights, an array without any height; where ``unit`` or ``pixel`` contradicts what the heights
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
                 periodic: bool = False, name: str | None = None) -> None:
        if isinstance(z, Surface) and pixel is None and unit in (None, "m") and not periodic:
            same = z if name is None else z._named(name)
            self.__dict__.update(_heights=same._heights, _is_looked_at=same._is_looked_at, _sha256=same._sha256)
            return
        if pixel is None:
            other = Foreign(z.height, z.pixel, "m", z.periodic) if isinstance(z, Surface) else foreign(z)
            if other is None:
                raise TypeError('Surface: give the side of a pixel, pixel="0.67 um"')
            if unit is not None and _tabor.parse_si(f"1 {unit}", "length", "unit") != \
                    _tabor.parse_si(f"1 {other.unit}", "length", "unit"):
                raise ValueError(f"unit: got {unit!r} for heights that say they are in {other.unit!r}; leave it out")
            z, pixel, unit, periodic = *other[:3], periodic or other.periodic
        dx, dy = pixel_sides(pixel)
        require_spacing(z, (dx, dy))
        heights = in_metres(Carried(z.height, 1.0, "m", True) if isinstance(z, Surface) else z, unit)
        made = _tabor.make_surface(heights, dx, dy, periodic, "array" if name is None else name)
        self.__dict__.update(_heights=made, _is_looked_at=False, _sha256="")

    @classmethod
    @typed
    def from_array(cls, z: Any, pixel: Value | tuple[Value, Value], *, unit: str | None = None, periodic: bool = False,
                   name: str | None = None) -> Self:
        """A surface of an array of heights; the arguments are those of ``Surface``.

        Examples
        --------
        >>> import numpy as np, tabor as tb
        >>> tb.Surface.from_array(np.zeros((4, 8)), "1 um").lengths
        (8e-06, 4e-06)
        """
        return cls(z, pixel=pixel, unit=unit, periodic=periodic, name=name)

    @classmethod
    @typed
    def from_xarray(cls, array: Any) -> Self:
        """A surface of an array of xarray, shape (ny, nx) or (nx, ny), with coordinates x and y and units. One that
        ``to_xarray`` made comes back with its history, edges, source and warnings.

        Raises
        ------
        TypeError
            For anything but a DataArray.
        ValueError
            Without coordinates and units, and where the coordinates are not evenly spaced.
        """
        if not all(hasattr(array, name) for name in ("dims", "coords", "transpose", "attrs", "values")):
            raise wrong("array", array, "a DataArray of xarray with coordinates x and y and units")
        plain = cls(array)
        state = state_of(array.attrs, plain._heights.__getstate__()[1])
        if state is None:
            return plain
        whole = _tabor.Topography.__new__(_tabor.Topography)
        whole.__setstate__((plain.height, state))
        return cls._of(whole)

    @classmethod
    def _of(cls, topography: _tabor.Topography, sha256: str = "") -> Self:
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

    def _named(self, name: str) -> Surface:
        return Surface._of(_tabor.from_source(self._topography, name), self._sha256)

    def _derived(self, heights: Array, note: str, second: Any = None) -> Self:
        """With other heights on the same grid; ``second`` is the surface that took part."""
        kept = _tabor.with_heights(self._topography, checked(heights), note, None if second is None else second._topography)
        return type(self)._of(kept)

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

    __iter__ = None  # a surface is no list of rows: surface.height is

    def __getitem__(self, index: Any) -> Surface:
        """``surface[10:200, 5:100]`` is the part with the rows 10 to 199 and the columns 5 to 99, as ``crop`` makes it:
        on the same pixels, with its history. Raises ValueError for a step and for a part without pixels, TypeError for
        anything but slices."""
        x0, y0, nx, ny = part_of(index, self.shape)
        if (ny, nx) == self.shape:
            return self
        return self.treat(f"crop={x0},{y0},{nx},{ny}")

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
    def name(self) -> str:
        """Name of its file without folders, or the one it was given."""
        is_file = self.format not in ("array", "generated")
        return os.path.basename(self.source) if is_file else self.source

    @property
    def format(self) -> str:
        """Format of its file, as in ``tabor formats``; "array" if it is from none."""
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
    def apply(self, function: Callable[[Array], Any], note: str | None = None) -> Surface:
        """A surface with the heights that a function makes of these, on the same grid; it keeps edges and history.

        Parameters
        ----------
        function : takes heights [m], shape (ny, nx), NaN where there is none, and returns as many.
        note : what the history says [the name of the function].

        Raises
        ------
        TypeError
            For what is no function, and for what it returns if that is no array of real numbers.
        ValueError
            Where it returns another shape or infinite heights.

        Examples
        --------
        >>> import numpy as np, tabor as tb
        >>> rough = tb.generate("edt", pixels=64, seed=1)
        >>> rough.apply(lambda z: np.clip(z, -1e-6, 1e-6), "clip to 1 um").history[-1]
        'clip to 1 um'
        """
        if not callable(function):
            raise wrong("function", function, "a function of an array of heights")
        made = checked(function(self.height.copy()), "heights that the function returns")
        if made.shape != self.shape:
            raise ValueError(f"heights that the function returns: got shape {made.shape}; expected {self.shape}")
        return self._derived(made, note or str(getattr(function, "__name__", "apply")))

    @typed
    def section(self, p: Iterable[Value], q: Iterable[Value]) -> Section:
        """Heights along the line from p to q, linear between pixel centres.

        Parameters
        ----------
        p, q : points (x, y) [m] from the upper left corner, ("10 um", "5 um").

        Raises
        ------
        ValueError
            For points that are not on the surface, and for one point twice.

        Examples
        --------
        >>> import tabor as tb
        >>> rough = tb.generate("edt", pixels=64, pixel="1 um", seed=1)
        >>> rough.section(("0 um", "32 um"), ("64 um", "32 um")).height.shape
        (65,)
        """
        start, end = (point_of(one, name, self.lengths) for name, one in (("p", p), ("q", q)))
        return section_of(self.height, self.pixel, start, end)

    @typed
    def parameters(self, symbols: Iterable[str] | None = None, *more: str, progress: Progress = None) -> Parameters:
        """Roughness parameters of the surface as it is (ISO 25178-2 and others, docs/parameters.md), all
        or those named: ``parameters("Sa", "Sq")``. Level before.

        Parameters
        ----------
        symbols, more : "Sa", one by one or as a list; a set stands for all of its parameters: "height", "spatial",
            "hybrid", ...

        Raises
        ------
        ValueError
            For an unknown symbol, with the nearest.
        """
        with watching(progress) as told:
            every = Parameters((Parameter(*row) for row in _tabor.parameters(self._topography, told)), source=self.source,
                               history=self.history, warnings=self.warnings)
        tell(self.warnings)
        return every if symbols is None else selected(every, [*texts(symbols, "symbols"), *texts(more, "symbols")])

    @typed
    def psd(self, convention: Convention = "jacobs", window: Taper | None = None, *, fit_min: Value | None = None,
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
        doubts = warnings_of(found["warnings"])
        tell(doubts)
        x, y, radial = (Spectrum(np.array(q), np.array(density), *rest)
                        for q, density, *rest in (found[axis] for axis in ("x", "y", "radial")))
        return Spectra(x, y, radial, found["convention"], found["window"], doubts, found["trusted"])

    @typed
    def save(self, file: Path) -> None:
        """Writes a scan file by its extension (docs/formats.md). Raises ValueError for an extension that
        no format has, OSError where it cannot be written."""
        _tabor.write(self._topography, os.fspath(file))

    def to_xarray(self) -> Any:
        """The heights as a DataArray with coordinates x and y [m] and, as attributes, what ``from_xarray`` needs to make
        the same surface again: history, edges, source, warnings. Its file of NetCDF keeps them; needs xarray."""
        facts = attributes_of(self._topography.__getstate__()[1])
        return map_to_xarray(self, self.height, "height", "m", {**facts, **said(self.warnings, ())})

    @typed
    def plot(self, ax: Axes = None, *, window: Window = None, cmap: str | None = None) -> Any:
        """Draws the heights in µm; needs matplotlib. Returns the axes.

        Parameters
        ----------
        ax : axes of matplotlib [the current ones].
        window : part that is shown: x0, y0, width and height [m] from the upper left corner [all].
        cmap : name of a colour map of matplotlib [that of its settings].
        """
        return plot_map(self, Map(self.height, "m", "height"), ax, window, cmap)

    def _lines(self) -> list[tuple[str, str]]:
        ny, nx = self.shape
        dx, dy = (_tabor.format_si(side, "m") for side in self.pixel)
        lines = [("source", f"{self.source} ({self.format})"),
                 ("size", f"{nx} x {ny} pixels of {dx if dx == dy else dx + ' x ' + dy}"),
                 ("heights", f"in m, {self.n_holes or 'no'} hole{'' if self.n_holes == 1 else 's'}")]
        lines += [("step", step) for step in self.history]
        return lines + [("warning", warning.text) for warning in self.warnings]

    def _repr_html_(self) -> str:
        return table_html("Surface", self._lines(), base64.b64encode(thumbnail(self.height)).decode())


add_steps(Surface)
