"""Two scans put together: what wear took away, or two faces in contact."""

from __future__ import annotations

import json
import pathlib
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Literal, NamedTuple

from . import _tabor
from ._arguments import Axes, Path, typed
from ._doubts import tell
from ._guesses import Values
from ._maps import Window
from ._progress import Progress, watching
from ._records import Shown, Warning, plain_attributes, said
from ._surface import Surface
from ._values import Value, si_list


Mode = Literal["wear", "difference", "composite"]
Match = Literal["plane", "offset", "none"]
#: Numbers of the search for the shift, beside the shift.
_OF_SEARCH = ("uncertainty_x_m", "uncertainty_y_m", "overlap", "distinction", "runner_up", "iterations")


class Volume(NamedTuple):
    """A volume with one standard deviation, and the area it was summed over."""

    volume: float  #: [m^3]
    uncertainty: float  #: [m^3]
    area: float  #: [m^2]

    def _text(self) -> str:
        name, cube = ("mm^3", 1e-9) if abs(self.volume) >= 1e-12 else ("µm^3", 1e-18)
        return f"{self.volume / cube:.4g} {name} (± {self.uncertainty / cube:.2g})"


class Combination(Shown):
    """What ``combine`` made of two scans. It does not change."""

    surface: Surface  #: the map, on the pixels of the first scan, cut to the overlap
    mode: Mode  #: "wear", "difference" or "composite"
    warnings: tuple[str, ...]  #: reasons to doubt them
    references: tuple[str, ...]  #: what to cite

    def __init__(self, surface: Surface, mode: Mode, values: Mapping[str, Any], warnings: Sequence[str]) -> None:
        methods = surface.metadata.get("methods", "")
        self.__dict__.update(surface=surface, mode=mode, _values=dict(values), warnings=tuple(warnings),
                             references=(methods,) if methods else ())

    @property
    def values(self) -> Mapping[str, Any]:
        """Numbers by the names of ``tabor combine --json``, whose endings are the units."""
        return Values(self.__dict__["_values"], "Combination")

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError("a Combination does not change")

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)

    @property
    def shift(self) -> tuple[float, float]:
        """What is at (x, y) in the first scan is at (x + shift, y + shift) in the second [m]."""
        return float(self.values["shift_x_m"]), float(self.values["shift_y_m"])

    def _volume(self, name: str) -> Volume | None:
        wear = self.values.get("wear")
        return wear and Volume(*(wear[name][key] for key in ("volume_m3", "uncertainty_m3", "area_m2")))

    @property
    def worn(self) -> Volume | None:
        """Where material is gone; None unless the mode is "wear"."""
        return self._volume("worn")

    @property
    def piled_up(self) -> Volume | None:
        """Where there is more than before, as a positive volume; None unless the mode is "wear"."""
        return self._volume("piled_up")

    @property
    def net(self) -> Volume | None:
        """Worn less piled up over the whole overlap, without a threshold; None unless the mode is "wear"."""
        return self._volume("net")

    @typed
    def plot(self, ax: Axes = None, *, window: Window = None, cmap: str | None = None) -> Any:
        """Draws the map as ``Surface.plot`` does; needs matplotlib. Returns the axes."""
        return self.surface.plot(ax, window=window, cmap=cmap)

    @typed
    def save(self, file: Path) -> None:
        """Writes the file of ``tabor combine -o``, which ends with .h5. Raises ValueError for another ending, OSError where it
        cannot be written."""
        path = pathlib.Path(file)
        if path.suffix not in (".h5", ".hdf5"):
            raise ValueError(f"{path}: expected a name that ends with .h5 or .hdf5; surface.save writes the map as a scan file")
        _tabor.save_combination(path, self.surface._topography, self.mode, json.dumps(dict(self.values)), list(self.warnings),
                                list(self.references))

    def to_xarray(self) -> Any:
        """The map as a DataArray with coordinates x and y [m], numbers and warnings as its attributes, to be written as
        NetCDF; needs xarray."""
        found = self.surface.to_xarray()
        found.attrs.update(plain_attributes(self.values), **said(self.warnings, self.references))
        return found

    def _lines(self) -> list[tuple[str, str]]:
        along = [_tabor.format_si(one, "m") for one in self.shift]
        lines = [("shift", f"{along[0]} along x, {along[1]} along y"),
                 ("overlap", f"{self.values['nx']} x {self.values['ny']} pixels"),
                 ("Sq", _tabor.format_si(self.values["rms_height_m"], "m"))]
        for name in ("worn", "piled_up", "net") if self.worn else ():
            volume = self._volume(name)
            if volume:
                lines.append((name.replace("_", " "), volume._text()))
        return lines + [("warning", text) for text in self.warnings]


def _without(numbers: Mapping[str, Any], before: str) -> dict[str, Any]:
    """Numbers whose names begin so, by the rest of their names."""
    return {key.removeprefix(before): value for key, value in numbers.items() if key.startswith(before)}


def combination_of(surface: Surface, numbers: Mapping[str, Any], warnings: Sequence[str]) -> Combination:
    """The combination of a file, which has the numbers of volumes and of the search beside the others."""
    volumes = {name: _without(numbers, f"{name}_") for name in ("worn", "piled_up", "net") if f"{name}_volume_m3" in numbers}
    of_wear = {key: numbers[key] for key in ("noise_m", "noise_area_m2", "noise_floor_m3", "threshold_m") if key in numbers}
    of_search = {key: numbers[key] for key in _OF_SEARCH if key in numbers}
    shift = {key: numbers[key] for key in ("shift_x_m", "shift_y_m")}
    inside = {"mode", *of_wear, *of_search, *(f"{name}_{key}" for name, values in volumes.items() for key in values)}
    values: dict[str, Any] = {key: value for key, value in numbers.items() if key not in inside}
    values["registration"] = {**shift, **of_search} if of_search else None
    if volumes:
        values["wear"] = {**volumes, **of_wear}
    return Combination(surface, numbers["mode"], values, warnings)


@typed
def combine(first: Surface, second: Surface, mode: Mode = "wear", *, search: bool = True,
            shift: Iterable[Value] | None = None, match: Match = "plane", threshold: float = 4.0,
            progress: Progress = None) -> Combination:
    """Registers two scans and subtracts them, or adds two faces, as ``tabor combine`` does.

    Parameters
    ----------
    first, second : before and after, or the two faces, treated alike and equally oriented: rotation is not
        corrected.
    mode : "wear", first less second with volumes; "difference", the same without; "composite", first plus second
        turned over: the gap between two faces in contact is a constant less this map.
    search : look for the shift between the scans; else they are taken corner on corner.
    shift : (dx, dy) [m], not searched: what is at x in the first is at x + dx in the second.
    match : offset or tilt between the scans that is fitted where nothing changed, and removed: "plane", "offset" or
        "none".
    threshold : a change counts from here on, in standard deviations of the noise.
    progress : see ``tabor.Progress``.

    Returns
    -------
    Combination
        The map on the pixels of the first scan [m], shift [m], volumes [m^3] and warnings.

    Raises
    ------
    ValueError
        Where the scans do not overlap or cannot be matched, and for unknown names.

    Examples
    --------
    >>> import tabor as tb
    >>> before = tb.generate("edt", pixels=128, seed=3)
    >>> worn = before.height.copy()
    >>> worn[40:60, 40:60] -= 1e-6
    >>> found = tb.combine(before, tb.Surface(worn, pixel=before.pixel), shift=(0, 0), match="none")
    >>> round(1e18 * found.worn.volume / (20 * 20 * 0.67**2), 3)
    1.0
    """
    lengths = [] if shift is None else si_list(shift, "length", "shift")[0]
    if len(lengths) not in (0, 2):
        raise ValueError(f"shift: got {len(lengths)} lengths; expected two, along x and y")
    options = _tabor.CombineOptions(mode, match, search, lengths, float(threshold))
    with watching(progress) as told:
        topography, values, doubts = _tabor.combine(first._topography, second._topography, options, told)
    tell(Warning("", text) for text in doubts)
    return Combination(Surface._of(topography), mode, json.loads(values), doubts)
