"""From the parts of a model to the fields of a deck that give them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field

from vstatics.errors import Path, Problem
from vstatics.readers.deck.values import Spot
from vstatics.readers.reading import Source

MEMBERS = {"first": "1", "second": "2", "third": "3"}
MECHANISM = {"ratio": "IAB", "efficiency": "ETAI"}
WHOLE = {
    "links": "KJG",
    "link_names": "KJG",
    "shift_elements": "KL",
    "mechanisms": "KG",
    "gears": "NP",
    "input": "INP",
    "output": "IOUT",
    "idle": "IDLE",
    "coast": "COAST",
    "name": "NAME T",
}
KINDS = {"link_names": "J", "shift_elements": "F", "mechanisms": "D", "gears": "P"}


@dataclass
class Places:
    """Where the values of a deck stand, by names such as ``NZF(1,2)``."""

    source: Source
    named: list[tuple[Iterable[str], Callable[[], Iterable[Spot]]]] = field(default_factory=list)
    """Names of values, and what gives their places; put together when one is asked for."""
    planet: dict[int, int] = field(default_factory=dict)
    """Position in NNM of each mechanism that is there."""
    given: dict[tuple[str, int, int], int] = field(default_factory=dict)
    """Position of a link in NWZ or NMZ, by ``("speeds", gear, link)``."""
    _spots: dict[str, Spot] = field(default_factory=dict)

    @property
    def spots(self) -> dict[str, Spot]:
        """The place of each value that was read."""
        for names, places in self.named:
            self._spots.update(zip(names, places(), strict=True))
        self.named.clear()
        return self._spots

    def locate(self, problem: Problem) -> Problem:
        """Give a problem of the model its place, and put the name of the field before it."""
        if problem.place is not None or not problem.path:
            return problem
        spots = self.spots
        for label in (*self._labels(problem), "KJG"):
            if label in spots:
                place = self.source.place(*spots[label])
                return problem._replace(message=f"{label}: {problem.message}", place=place)
        return problem

    def _labels(self, problem: Problem) -> list[str]:
        """The fields that a problem may be about, the likeliest first."""
        part, *rest = problem.path
        number = rest[0] if rest and isinstance(rest[0], int) else 0
        inner = tuple(rest[1:])
        labels = LABELS[str(part)](self, number, inner) if part in LABELS and number else []
        if len(problem.path) == 2 and "name" in problem.message:
            labels.insert(0, f"NAME {KINDS.get(str(part), '')}{number}")
        if problem.severity == "warning" and part == "mechanisms" and not inner:
            labels.insert(0, f"IAB({number})")
        if part == "output":
            return ["IOUT", "INP"]
        return [*labels, WHOLE.get(str(part), "KJG")]

    def element(self, number: int, inner: Path) -> list[str]:
        """Fields of a shift element."""
        member = MEMBERS.get(str(inner[0]), "1") if inner else "1"
        return [f"NZF({number},{member})"]

    def mechanism(self, number: int, inner: Path) -> list[str]:
        """Fields of a mechanism."""
        part = str(inner[0]) if inner else "first"
        if part in MECHANISM:
            return [f"{MECHANISM[part]}({number})"]
        if part == "planet_ratio":
            return [f"UAQ({self.planet.get(number, 0)})", f"IAB({number})"]
        return [f"NZD({number},{MEMBERS.get(part, '1')})"]

    def gear(self, number: int, inner: Path) -> list[str]:
        """Fields of a gear."""
        part, item = str(inner[0]) if inner else "", inner[1] if len(inner) > 1 else 1
        own = [f"IOUT({number})", f"INP({number})"]
        engaged = [f"NFRI({item},{number})", f"KFRI({number})"]
        if part in ("speeds", "torques"):
            name, count = ("NWZ", "KWZ") if part == "speeds" else ("NMZ", "KMZ")
            position = self.given.get((part, number, int(item)), 0)
            return [f"{name}({position},{number})", f"{count}({number})"]
        if part in ("input", "output"):
            return own[::-1] if part == "input" else own
        return engaged if part else [*own, *engaged]


LABELS: Mapping[str, Callable[[Places, int, Path], list[str]]] = {
    "shift_elements": Places.element,
    "mechanisms": Places.mechanism,
    "gears": Places.gear,
}
