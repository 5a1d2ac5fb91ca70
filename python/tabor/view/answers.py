"""Numbers and maps of a state, by the functions of the package; what was computed once is kept."""

from __future__ import annotations

import time
from collections import OrderedDict
from collections.abc import Callable, Hashable
from dataclasses import dataclass, field, replace
from typing import Any, TypeVar

from .. import _tabor
from .._contact import Contact, contact
from .._friction import Film, Friction, friction, rain
from .._progress import Told
from .._records import Warning
from .._spectra import Spectra
from .._parameters import Parameters
from .._surface import Surface
from .previews import Pace
from .settings import arguments
from .state import PARAMETERS, State

_MOST_KEPT = 12  #: results of one stage
_Result = TypeVar("_Result")


@dataclass(frozen=True)
class Filtering:
    """Spectra of a surface: treated, and without its filters where it has some."""

    treated: Spectra
    unfiltered: Spectra | None


@dataclass(frozen=True)
class Answer:
    """What is known of a state. A part is None until it is computed, or where ``failures`` says why it cannot be."""

    state: State
    surface: Surface | None = None  #: treated
    pressed: Surface | None = None  #: that was pressed: the treated one, or a coarser one
    parameters: Parameters | None = None
    tilt: tuple[float, float] | None = None  #: slopes of the mean plane along x and y
    spectra: Filtering | None = None
    contact: Contact | None = None
    film: Film | None = None
    friction: Friction | None = None
    failures: dict[str, str] = field(default_factory=dict)  #: by "treatment", "spectrum", "contact", "oil", "friction"
    is_preview: bool = False  #: contact, oil and friction are those of ``pressed``, which has larger pixels
    seconds: float = 0.0  #: that contact, oil and friction took

    @property
    def is_whole(self) -> bool:
        """True where contact, oil and friction are those of the state, and nothing is missing but what failed."""
        return not self.is_preview and (self.contact is not None or "contact" in self.failures)

    @property
    def warnings(self) -> dict[str, tuple[Warning, ...]]:
        """By what they concern: "scan", "contact", "oil", "friction"; each is said once."""
        found: dict[str, tuple[Warning, ...]] = {}
        said: set[Warning] = set()
        parts = {"scan": self.surface, "contact": self.contact, "oil": self.film, "friction": self.friction}
        for name, part in parts.items():
            given: tuple[Warning, ...] = () if part is None else part.warnings
            found[name] = tuple(one for one in given if one not in said)
            said.update(given)
        return found


def numbers(answer: Answer) -> dict[str, Any]:
    """All numbers by name: symbols of roughness parameters, and the keys of ``--json``."""
    found: dict[str, Any] = {one.symbol: one.value for one in (answer.parameters or {}).values()}
    for part in (answer.contact, answer.film, answer.friction):
        found.update({} if part is None else part.values)
    return found


class Kept:
    """Results of the stages by what they depend on; the oldest are forgotten."""

    def __init__(self, most: int = _MOST_KEPT) -> None:
        self._most = most
        self._found: dict[str, OrderedDict[Hashable, Any]] = {}

    def has(self, stage: str, key: Hashable) -> bool:
        """True where the result is at hand."""
        return key in self._found.get(stage, ())

    def get(self, stage: str, key: Hashable, make: Callable[[], _Result]) -> _Result:
        """The result, computed if it is not at hand."""
        kept = self._found.setdefault(stage, OrderedDict())
        if key not in kept:
            kept[key] = make()
            while len(kept) > self._most:
                kept.popitem(last=False)
        kept.move_to_end(key)
        found: _Result = kept[key]
        return found


class Bench:
    """One scan with all that was computed of it. One thread uses it at a time."""

    def __init__(self, scan: Surface) -> None:
        self.scan = scan  #: as it was read
        self.pace = Pace()
        self._kept = Kept()

    def treated(self, treatment: tuple[str, ...], told: Told = None) -> Surface:
        """The surface after these steps. Raises ValueError that names the step."""
        if not treatment:
            return self.scan

        def apply() -> Surface:
            before = self.treated(treatment[:-1], told)
            with self.pace.of("treatment", before):
                return before.treat(treatment[-1], progress=told)

        return self._kept.get("treatment", treatment, apply)

    def described(self, state: State, told: Told = None) -> Answer:
        """The treated surface with its roughness parameters."""
        answer = self.treated_answer(state, told)
        surface = answer.surface
        if surface is None:
            return answer

        def measure() -> tuple[Parameters, tuple[float, float] | None]:
            with self.pace.of("parameters", surface):
                return surface.parameters(PARAMETERS, progress=told), _tabor.tilt(surface._topography)

        try:
            parameters, tilt = self._kept.get("parameters", state.treatment, measure)
        except ValueError as error:
            return replace(answer, failures={**answer.failures, "treatment": str(error)})
        return replace(answer, parameters=parameters, tilt=tilt)

    def analysed(self, answer: Answer, told: Told = None) -> Answer:
        """The answer with the spectra of its surface, or why there are none."""
        state = answer.state

        def analyse() -> Filtering:
            surface = self.treated(state.treatment, told)
            with self.pace.of("spectrum", surface):
                before = self.treated(state.unfiltered.treatment, told).psd(progress=told) if state.filters else None
                window: Any = before.window if before else None
                return Filtering(surface.psd(window=window, progress=told), before)  # one window for both

        try:
            return replace(answer, spectra=self._kept.get("spectrum", state.treatment, analyse))
        except ValueError as error:
            return replace(answer, spectra=None, failures={**answer.failures, "spectrum": str(error)})

    def treated_answer(self, state: State, told: Told = None) -> Answer:
        """The treated surface alone, or why there is none."""
        try:
            return Answer(state, self.treated(state.treatment, told))
        except ValueError as error:
            return Answer(state, failures={"treatment": str(error)})

    def expected(self, state: State, surface: Surface) -> float:
        """How long contact, oil and friction will take [s], of what is not at hand."""
        parts = [("contact", _contact_key(state)), ("oil", _oil_key(state))] + ([("friction", state)] if state.trapped else [])
        return sum(self.pace.expected(stage, surface) for stage, key in parts
                   if not self._kept.has(stage, (surface.shape, key)))

    def solved(self, answer: Answer, surface: Surface, told: Told = None) -> Answer:
        """The answer with contact, oil and friction of this surface: the treated one, or one with larger pixels."""
        begin = time.monotonic()
        state = answer.state
        found: dict[str, Any] = {"pressed": surface, "is_preview": surface is not answer.surface}
        failures = {key: text for key, text in answer.failures.items() if key == "treatment"}
        stages: tuple[tuple[str, Callable[[], Any]], ...] = (
            ("contact", lambda: self._contact(state, surface, told)),
            ("film", lambda: self._film(state, surface, told)),
            ("friction", lambda: self._friction(state, found, told)),
        )
        for name, compute in stages:
            try:
                found[name] = compute()
            except ValueError as error:
                found[name] = None
                failures["oil" if name == "film" else name] = str(error)
        return replace(answer, **found, failures=failures, seconds=time.monotonic() - begin)

    def _contact(self, state: State, surface: Surface, told: Told) -> Contact:
        def solve() -> Contact:
            with self.pace.of("contact", surface):
                found: Contact = contact(surface, state.pressure, state.solid, check=False, progress=told, **state.contact_arguments)
                return found

        return self._kept.get("contact", (surface.shape, _contact_key(state)), solve)

    def _film(self, state: State, surface: Surface, told: Told) -> Film:
        def fall() -> Film:
            with self.pace.of("oil", surface):
                found: Film = rain(surface, state.density, progress=told, **arguments(state.settings, "film"))
                return found

        return self._kept.get("oil", (surface.shape, _oil_key(state)), fall)

    def _friction(self, state: State, found: dict[str, Any], told: Told) -> Friction | None:
        pressed, film = found["contact"], found["film"]
        if pressed is None or film is None:
            return None
        def rub() -> Friction:
            with self.pace.of("friction", pressed.surface):
                return friction(pressed, film, check=False, trapped=state.trapped, progress=told, **state.friction_arguments)

        return self._kept.get("friction", (pressed.surface.shape, state), rub)


def _contact_key(state: State) -> Hashable:
    return state.treatment, state.pressure, state.material, state.tool, state.settings


def _oil_key(state: State) -> Hashable:
    return state.treatment, state.density, state.settings


def answer_of(scan: Surface, state: State) -> Answer:
    """The whole answer of a state at once."""
    bench = Bench(scan)
    answer = bench.described(state)
    return answer if answer.surface is None else bench.solved(answer, answer.surface)
