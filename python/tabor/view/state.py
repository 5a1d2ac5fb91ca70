"""What a workbench shows: a scan, its treatment, and how it is pressed, oiled and rubbed.

A state is a plain value that does not change. ``texts`` writes it as a command line, as Python and as a study file;
``answers`` computes its numbers with the functions of the package.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any, Generic, TypeVar

from .. import _tabor
from .._contact import Solid
from .recipes import recipe
from .settings import Given, arguments

KNOWN_STEPS = {name: (argument, text) for name, argument, text in _tabor.treatment_steps()}
FILTERS = ("lowpass", "highpass")  #: steps that a spectrum shows
#: Symbols of the numbers that are shown of a surface.
PARAMETERS = ("Sa", "Sq", "Sz", "Ssk", "Spk", "Svk", "Sdq")
_Kept = TypeVar("_Kept")


@dataclass(frozen=True)
class Step:
    """One step of a treatment chain, switched on or off."""

    text: str  #: as ``Surface.treat`` takes it: "level=plane"
    is_on: bool = True

    @property
    def name(self) -> str:
        """Of the step: "level"."""
        return self.text.partition("=")[0]

    @property
    def argument(self) -> str:
        """Behind the name: "plane"; "" if there is none."""
        return self.text.partition("=")[2]


@dataclass(frozen=True)
class State:
    """Everything that the numbers of one scan depend on. Values are texts with their unit, as all three languages take
    them, so that none of them rounds."""

    scan: str  #: name of the file; "" for a surface in memory
    reading: tuple[tuple[str, str], ...] = ()  #: how the file is read: (("pixel", "0.67 um"), ("unit", "um"))
    steps: tuple[Step, ...] = ()
    material: str = "aluminium-6016"  #: "" where the settings alone say what the surface is of
    shear_strength: str = ""  #: of dry contact; "" for that of the material
    pressure: str = "7 MPa"  #: mean pressure, load over nominal area
    density: str = "0.9 g/m^2"  #: areal density of the oil; "0 g/m^2" is dry
    tool: str = ""  #: rough tool in place of the flat, "ground:Sa=0.1um"; "" for a flat
    trapped: bool = False  #: oil in closed pockets carries load
    settings: Given = ()  #: others, as the command or the file that opened the scan has them: (("seed", "7"),)

    @property
    def treatment(self) -> tuple[str, ...]:
        """The steps that are switched on, in their order."""
        return tuple(step.text for step in self.steps if step.is_on)

    @property
    def filters(self) -> tuple[str, ...]:
        """The filters among the treatment."""
        return tuple(step for step in self.treatment if step.partition("=")[0] in FILTERS)

    @property
    def unfiltered(self) -> State:
        """The state without its filters."""
        return replace(self, steps=tuple(step for step in self.steps if step.name not in FILTERS))

    @property
    def solid(self) -> Solid:
        """What the surface is of."""
        return Solid(self.material or None, **arguments(self.settings, "solid"))

    @property
    def contact_arguments(self) -> dict[str, Any]:
        """What else ``contact`` is given."""
        return {**arguments(self.settings, "contact"), **({"tool": self.tool} if self.tool else {})}

    @property
    def friction_arguments(self) -> dict[str, Any]:
        """What else ``friction`` is given."""
        return {**arguments(self.settings, "friction"), **({"shear_strength": self.shear_strength} if self.shear_strength else {})}

    @property
    def has_friction(self) -> bool:
        """True where a shear strength is given or known of the material."""
        return bool(self.shear_strength) or self.solid.shear_strength is not None

    def adding(self, *texts: str) -> State:
        """The state with steps at the end of its chain."""
        return replace(self, steps=self.steps + tuple(map(Step, texts)))

    def without(self, place: int) -> State:
        """The state without the step at this place, counted from 0."""
        return replace(self, steps=self.steps[:place] + self.steps[place + 1:])

    def with_step(self, place: int, step: Step) -> State:
        """The state with another step at this place."""
        return replace(self, steps=self.steps[:place] + (step,) + self.steps[place + 1:])

    def switching(self, place: int, is_on: bool) -> State:
        """The state with the step at this place switched on or off."""
        return self.with_step(place, replace(self.steps[place], is_on=is_on))

    def moving(self, place: int, by: int) -> State:
        """The state with the step at this place moved down the chain, or up for negative numbers, as far as it goes."""
        steps = list(self.steps)
        step = steps.pop(place)
        steps.insert(min(max(place + by, 0), len(steps)), step)
        return replace(self, steps=tuple(steps))

    def following(self, name: str) -> State:
        """The state with the chain of a recipe. Raises ValueError for an unknown name."""
        return replace(self, steps=tuple(map(Step, recipe(name).steps)))


@dataclass
class History(Generic[_Kept]):
    """What was shown before, and what was undone."""

    now: _Kept
    _before: list[_Kept] = field(default_factory=list)
    _after: list[_Kept] = field(default_factory=list)

    def take(self, value: _Kept) -> None:
        """Makes this what is shown; what was undone is forgotten."""
        if value != self.now:
            self._before.append(self.now)
            self._after.clear()
            self.now = value

    def undo(self) -> _Kept:
        """Goes back by one change, if there is one."""
        if self._before:
            self._after.append(self.now)
            self.now = self._before.pop()
        return self.now

    def redo(self) -> _Kept:
        """Does again what was undone last."""
        if self._after:
            self._before.append(self.now)
            self.now = self._after.pop()
        return self.now

    @property
    def can_undo(self) -> bool:
        """True where there is a change to go back by."""
        return bool(self._before)

    @property
    def can_redo(self) -> bool:
        """True where something was undone."""
        return bool(self._after)
