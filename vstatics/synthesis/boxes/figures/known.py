"""Names of found gearboxes that equal a shipped case.

`known.jsonl` lists the shipped gearboxes; `shipped` writes it from the cases.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from typing import Any, NamedTuple

from vstatics.synthesis.boxes.box import FoundBox
from vstatics.synthesis.boxes.chosen_gears import equal_sets
from vstatics.synthesis.boxes.least_form import identity
from vstatics.synthesis.structures.scheme import SetScheme

FAR_DECIMALS = 6
"""Number of decimals in comparisons of distances between ratios, which are fitted numbers."""


class KnownBox(NamedTuple):
    """Gearbox of a shipped case, renumbered as in `least_forms`."""

    name: str
    """Name of the shipped case."""
    left_out: int
    """Number of one-way clutches of the case, which the record of the gearbox lacks."""
    box: FoundBox

    @classmethod
    def of_line(cls, line: str) -> KnownBox:
        """Return the gearbox from a line of JSON, as written by `line`."""
        data = json.loads(line)
        sets, elements, gears = (
            tuple(tuple(entry) for entry in data[key]) for key in ("sets", "elements", "gears")
        )
        box = FoundBox(
            SetScheme(sets),
            data["held"],
            data["input"],
            data["output"],
            elements,
            tuple(data["ratios"]),
            gears,
            0.0,
        )
        return cls(data["name"], data["left_out"], box)

    def line(self) -> str:
        """Return the gearbox as a line of JSON.

        >>> box = FoundBox(SetScheme(((0, 1, 2),)), None, 0, 1, ((2, -1),), (-2.0,), ((0,),), 0.0)
        >>> known = KnownBox("reduction", 0, box)
        >>> KnownBox.of_line(known.line()) == known
        True
        """
        box = self.box
        data = {
            "name": self.name,
            "left_out": self.left_out,
            "sets": box.scheme.sets,
            "held": box.held,
            "input": box.input,
            "output": box.output,
            "elements": box.elements,
            "ratios": box.ratios,
            "gears": box.gears,
        }
        return f"{json.dumps(data)}\n"

    def rank(self, ratios: tuple[float, ...]) -> tuple[float, int, str]:
        """Return a sort key for shipped gearboxes that equal a found gearbox, nearest first."""
        pairs = zip(ratios, self.box.ratios, strict=True)
        far = math.fsum(abs(math.log(ratio / known)) for ratio, known in pairs)
        return round(far, FAR_DECIMALS), self.left_out, self.name


def known_name(box: FoundBox) -> str | None:
    """Return the name of the shipped case that equals a gearbox; of several, the nearest.

    A case is equal if scheme and shift elements agree. In addition, the engaged elements of some
    gear of the case must give the ratio of each gear of the gearbox. The nearest case has the
    nearest ratios of gear sets.

    Parameters
    ----------
    box : FoundBox
        Found gearbox in the form that `least_box` returns.

    Examples
    --------
    >>> from vstatics.core.examples import example
    >>> from vstatics.synthesis.boxes.figures.built import built_box
    >>> from vstatics.synthesis.boxes.least_form import least_box
    >>> known_name(least_box(built_box(example("gm-6t70"))))
    'gm-6t70'
    """
    known = _known().get(identity(box))
    if not known:
        return None
    choices = equal_sets(box)
    same = [
        case for case in known if all(not set(case.box.gears).isdisjoint(sets) for sets in choices)
    ]
    return min((case.rank(box.ratios) for case in same), default=(0.0, 0, None))[-1]


@cache
def _known() -> Mapping[tuple[Any, ...], list[KnownBox]]:
    by_identity: dict[tuple[Any, ...], list[KnownBox]] = {}
    table = files(__package__) / "known.jsonl"
    for line in table.read_text(encoding="utf-8").splitlines():
        known = KnownBox.of_line(line)
        by_identity.setdefault(identity(known.box), []).append(known)
    return by_identity
