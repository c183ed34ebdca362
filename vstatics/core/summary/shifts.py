"""Transitions between gears: shift elements that change, and their slip power."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.statics.physical import gear_scales
from vstatics.core.statics.results import Results
from vstatics.core.summary.design_table import ranges
from vstatics.core.tables.answer import json_keys

WORDS = ("none", "single", "double", "triple")


@json_keys(
    *("start", "end", "skipped", "released", "engaged", "changes", "slip_power", "slip_power_kW"),
    kind="word",
)
class Transition(NamedTuple):
    """Upshift between two gears. For the downshift, exchange `released` and `engaged`."""

    start: str
    end: str
    skipped: str
    """Gear between start and end that the shift skips; else empty."""
    released: Sequence[str]
    engaged: Sequence[str]
    slip_power: Mapping[str, float]
    """Torque after the shift times slip before the shift, for each oncoming shift element, relative
    to the input power. Elements in `released` are oncoming in the downshift. [-]
    """
    slip_power_kW: Mapping[str, float]  # noqa: N815
    """Slip power at the operating point before the shift; NaN without a load. [kW]"""

    @property
    def changes(self) -> int:
        """Number of elements in `released` or in `engaged`, whichever is more."""
        return max(len(self.released), len(self.engaged))

    @property
    def word(self) -> str:
        """Number of changes in words: `single` for a replaced shift element, `double` for two, etc.

        >>> Transition("1", "2", "", ["A", "B"], ["C"], {}, {}).word
        'double'
        """
        return WORDS[self.changes] if self.changes < len(WORDS) else f"{self.changes} at once"


def transitions(results: Results) -> list[Transition]:
    """Return the shifts between neighbouring gears of a case, then the shifts that skip a gear.

    Freewheels that hold count as engaged.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(1, 2, "C"), ShiftElement(2, 0, "B")],
    ...                     [Mechanism(1, 2, 3, -2.5)], [Gear([2]), Gear([1])])
    >>> [transition] = transitions(solve(case))
    >>> transition.released, transition.engaged, transition.word
    (['B'], ['C'], 'single')
    """
    comparable = ranges(results)
    return [
        transition
        for distance in (1, 2)
        for indices in comparable
        for transition in _over(results, indices, distance)
    ]


def _over(results: Results, indices: Sequence[int], distance: int) -> Iterator[Transition]:
    """Yield the shifts from each gear of a range to the gear `distance` positions later."""
    case = results.case
    names = [element.name for element in case.shift_elements]
    for place, start in enumerate(indices[:-distance]):
        end = indices[place + distance]
        before, after = results.holds[start].tolist(), results.holds[end].tolist()
        states = list(zip(names, before, after, strict=True))
        yield Transition(
            case.gears[start].name,
            case.gears[end].name,
            case.gears[indices[place + 1]].name if distance == 2 else "",
            [name for name, was, holds in states if was and not holds],
            [name for name, was, holds in states if holds and not was],
            *_slip_powers(results, start, end),
        )


def _slip_powers(
    results: Results, start: int, end: int
) -> tuple[dict[str, float], dict[str, float]]:
    """Return the slip powers of oncoming elements, relative to the input power [-] and in kW."""
    case = results.case
    count = len(case.shift_elements)
    torques = np.abs(results.in_own_unit("lossy_torques")[:, :count])
    slips, units = np.abs(results.slip_speeds), [scale["kW"] for scale in gear_scales(case)]
    relative, loaded = {}, {}
    for place, element in enumerate(case.shift_elements):
        was, holds = results.holds[start, place], results.holds[end, place]
        if was != holds and element.kind != "dog_clutch":  # dog clutches do not slip
            after, before = (end, start) if holds else (start, end)
            power = float(torques[after, place] * slips[before, place])
            has_torque = case.input_torque(case.gears[after]) != 0
            relative[element.name] = power if has_torque else math.nan
            loaded[element.name] = power * units[before]
    return relative, loaded
