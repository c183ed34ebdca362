"""From the parts of a model to the fields of a deck that give them."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from vstatics.core.errors import Path, Problem
from vstatics.core.readers.deck.table import FIELDS
from vstatics.core.readers.deck.values import Spot
from vstatics.core.readers.reading import Source

LISTS = {(field.part, field.member): key for key, field in FIELDS.items()}
"""Lists by what their values are in the model."""
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


class Places:
    """Where the values of a deck stand, by names such as ``NZF(1,2)``."""

    def __init__(self, source: Source) -> None:
        self.source = source
        self.named: list[tuple[Iterable[str], Callable[[], Iterable[Spot]]]] = []
        """Names of values, and what gives their places; put together when one is asked for."""
        self.planet: dict[int, int] = {}
        """Position in NNM of each mechanism that is there."""
        self.given: dict[tuple[str, int, int], int] = {}
        """Position of a link in NWZ or NMZ, by ``("speeds", gear, link)``."""
        self._spots: dict[str, Spot] = {}

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
        labels = self._labels_of_part(str(part), number, inner) if number else []
        if len(problem.path) == 2 and "name" in problem.message:
            labels.insert(0, f"NAME {KINDS.get(str(part), '')}{number}")
        if problem.severity == "warning" and part == "mechanisms" and not inner:
            labels.insert(0, f"IAB({number})")
        if part == "output":
            return ["IOUT", "INP"]
        return [*labels, WHOLE.get(str(part), "KJG")]

    def _labels_of_part(self, part: str, number: int, inner: Path) -> list[str]:
        """The fields of a shift element, a mechanism or a gear."""
        member, item = str(inner[0]) if inner else "", inner[1] if len(inner) > 1 else 1
        if part == "mechanisms" and member == "planet_ratio":
            return [f"UAQ({self.planet.get(number, 0)})", f"IAB({number})"]
        if part in ("shift_elements", "mechanisms"):
            return [label_in(LISTS.get((part, member), LISTS[part, "first"]), number)]
        if part != "gears":
            return []
        if member in ("speeds", "torques"):
            name, count = ("NWZ", "KWZ") if member == "speeds" else ("NMZ", "KMZ")
            position = self.given.get((member, number, int(item)), 0)
            return [f"{name}({position},{number})", f"{count}({number})"]
        own = [f"IOUT({number})", f"INP({number})"]
        if member in ("input", "output"):
            return own[::-1] if member == "input" else own
        engaged = [f"NFRI({item},{number})", f"KFRI({number})"]
        return engaged if member else [*own, *engaged]


def label_in(key: str, number: int) -> str:
    """The name of a value of a list.

    >>> label_in("NZF(I,1)", 3), label_in("IAB", 3)
    ('NZF(3,1)', 'IAB(3)')
    """
    name, _, second = key.rstrip(")").partition("(I")
    return f"{name}({number}{second})"
