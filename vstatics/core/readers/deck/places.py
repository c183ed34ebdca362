"""Places of problems: which field of a deck contains a value of the model."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from vstatics.core.errors import Path, Problem
from vstatics.core.readers.deck.numbers import Spot
from vstatics.core.readers.deck.table import FIELDS
from vstatics.core.readers.reading import Source

LISTS = {(field.part, field.member): key for key, field in FIELDS.items()}
"""Name of the deck's list for each kind of part and attribute of the model."""
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
IN_DECK = {"`planet_ratio`": "`UAQ`", "`kind: neutral`": "`--allow W414`"}
"""Keys of YAML in remedies, and what users of decks write instead."""
KINDS = {"link_names": "J", "shift_elements": "F", "mechanisms": "D", "gears": "P"}


class Places:
    """Places of the values of a deck, by labels such as ``NZF(1,2)``."""

    def __init__(self, source: Source) -> None:
        self.source = source
        self.named: list[tuple[Iterable[str], Callable[[], Iterable[Spot]]]] = []
        """Labels of values, with a function that returns their places."""
        self.planet: dict[int, int] = {}
        """Position in the deck's list NNM of each non-standard mechanism, by mechanism number."""
        self.given: dict[tuple[str, int, int], int] = {}
        """Positions of prescribed speeds in the deck's list NWZ, and of torques in NMZ.

        The keys are ``("speeds", gear, link)`` and ``("torques", gear, link)``.
        """
        self._spots: dict[str, Spot] = {}

    @property
    def spots(self) -> dict[str, Spot]:
        """Place of each value, by label such as ``NZF(1,2)``."""
        for names, places in self.named:
            self._spots.update(zip(names, places(), strict=True))
        self.named.clear()
        return self._spots

    def locate(self, problem: Problem) -> Problem:
        """Return a problem of the model with the place and label of the value in the deck."""
        if problem.place is not None or not problem.path:
            return problem
        spots = self.spots
        for label in (*self._labels(problem), "KJG"):
            if label in spots:
                place = self.source.place(*spots[label])
                message = problem.message
                for key, word in IN_DECK.items():
                    message = message.replace(key, word)
                if (part := problem.path[0]) not in WHOLE:
                    message += f"; a deck cannot contain `{part}`: convert the deck to YAML"
                return problem._replace(message=f"{label}: {message}", place=place)
        return problem

    def _labels(self, problem: Problem) -> list[str]:
        """Return the labels of the values that can cause a problem, most likely first."""
        part, *below = problem.path
        number = below[0] if below and isinstance(below[0], int) else 0
        inner = tuple(below[1:])
        labels = self._labels_of_part(str(part), number, inner) if number else []
        if len(problem.path) == 2 and "name" in problem.message:
            labels.insert(0, f"NAME {KINDS.get(str(part), '')}{number}")
        if problem.severity == "warning" and part == "mechanisms" and not inner:
            labels.insert(0, f"IAB({number})")
        if part == "output":
            return ["IOUT", "INP"]
        return [*labels, WHOLE.get(str(part), "KJG")]

    def _labels_of_part(self, part: str, number: int, inner: Path) -> list[str]:
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
        ports = [f"IOUT({number})", f"INP({number})"]
        if member in ("input", "output"):
            return ports[::-1] if member == "input" else ports
        engaged = [f"NFRI({item},{number})", f"KFRI({number})"]
        return engaged if member else [*ports, *engaged]


def label_in(key: str, number: int) -> str:
    """Return the label of a value in a list.

    >>> label_in("NZF(I,1)", 3), label_in("IAB", 3)
    ('NZF(3,1)', 'IAB(3)')
    """
    name, _, second = key.rstrip(")").partition("(I")
    return f"{name}({number}{second})"
