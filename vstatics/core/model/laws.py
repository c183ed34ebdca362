"""Laws given by points, and the checks of laws and battery balances in a case."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any, Literal, Self

import numpy as np

from vstatics.core.errors import Path, Problem
from vstatics.core.model.fields import TransmissionFields
from vstatics.core.model.parts import Gear, Law

MOST_LAW_POINTS = 10_000
"""Largest number of points in a law."""


class PointLaw(Law):
    """Law interpolated linearly between points and held constant outside.

    Parameters
    ----------
    points : sequence of pairs
        Speeds [rad/s] or torques [N*m] of 0 or more in ascending order, with the value at each.
    over : {"speed", "torque"}
        Quantity on which the value depends.

    Examples
    --------
    >>> law = PointLaw([(0, 2.0), (300, 3.5)])
    >>> law.at(150.0), law.at(np.array([0, 1000])).tolist(), float(law)
    (2.75, [2.0, 3.5], 2.0)
    """

    def __new__(
        cls, points: Sequence[Sequence[float]], over: Literal["speed", "torque"] = "speed"
    ) -> Self:
        """Store the points, which are checked with the case."""
        law = super().__new__(cls, points[0][1] if points else 1.0)
        law.points = tuple((float(x), float(y)) for x, y in points)
        law.over = over
        return law

    def __getnewargs__(self) -> tuple[Any, ...]:
        """Return the arguments of the constructor, for pickling."""
        return self.points, self.over

    def at(self, size: Any) -> Any:
        """Return the value at a speed or torque, or an array of values at an array of speeds."""
        x, y = zip(*self.points, strict=True)
        values = np.interp(size, x, y)
        return values if isinstance(size, np.ndarray) else float(values)

    def is_outside(self, size: Any) -> Any:
        """Return whether a speed or torque, or each of an array, is outside the points."""
        return (size < self.points[0][0]) | (size > self.points[-1][0])


def of_points(law: Law, path: Path, *, low: float, high: float, what: str) -> Iterator[Problem]:
    """Check that points ascend from 0 on, with values from `low` to `high`."""
    if len(law.points) > MOST_LAW_POINTS:
        yield Problem(
            "E266", f"read {len(law.points)} points, expected {MOST_LAW_POINTS} at most", path
        )
        return
    if not law.points:
        yield Problem("E266", "read no points, expected at least one", path)
    least = -math.inf
    for number, (x, y) in enumerate(law.points, 1):
        if not 0 <= x < math.inf:
            message = f"read {x:g}, expected a {law.over} of 0 or more: magnitudes count"
            yield Problem("E266", message, (*path, number, 1))
        elif x <= least:
            message = f"read {x:g}, expected a {law.over} above {least:g}: points must ascend"
            yield Problem("E266", message, (*path, number, 1))
        if not low <= y <= high or not math.isfinite(y):
            yield Problem("E266", f"read {y:g}, expected {what}", (*path, number, 2))
        least = max(least, x)


def of_balances(case: TransmissionFields) -> Iterator[Problem]:
    """Check battery balances: links, efficiencies, and a link whose torque is to be calculated."""
    for number, gear in enumerate(case.gears, 1):
        if gear.balance is None:
            continue
        path: Path = ("gears", number, "balance")
        for link, efficiency in gear.balance.efficiencies:
            if not (hasattr(link, "__index__") and 0 < link <= case.own_links):
                expected = f"a link number from 1 to {case.own_links}"
                yield Problem("E269", f"read {link!r}, expected {expected}", path)
                return
            if not 0 < efficiency <= 1:
                what = f"read {efficiency:g}, expected an efficiency above 0 and up to 1"
                yield Problem("E269", what, (*path, link))
        if not math.isfinite(gear.balance.battery):
            message = f"read {gear.balance.battery:g}, expected a finite power"
            yield Problem("E269", message, (*path, "battery"))
        ends = gear.input or case.input, gear.output or case.main_output
        if not gear.open_links(ends):
            expected = "expected at least one such link, neither input nor output"
            yield Problem("E269", f"read no link without speed and torque, {expected}", path)


def without_loads(case: TransmissionFields) -> Iterator[Problem]:
    """Yield laws in gears whose operating point lacks speed or torque, which statics needs.

    Simulation does not need them.
    """
    places: list[Path] = [
        ("mechanisms", number, name)
        for number, part in enumerate(case.mechanisms, 1)
        for name in ("efficiency", "back_efficiency")
        if isinstance(getattr(part, name), Law)
    ]
    elements = enumerate(case.shift_elements, 1)
    places += [("shift_elements", n, "drag") for n, part in elements if isinstance(part.drag, Law)]
    places += [("drag", link) for link, drag in case.drag.items() if isinstance(drag, Law)]
    for number, gear in enumerate(case.gears, 1):
        load = case.gear_load(gear)
        if load.speed is not None and load.torque is not None:
            continue
        of_balance: list[Path] = [("gears", number, "balance")] if gear.balance else []
        for path in (*places, *_of_gear(gear, number), *of_balance):
            what = "speed" if load.speed is None else "torque"
            message = (
                "it depends on speed and torque, but the operating point of gear "
                f"{gear.name or number} has no {what}"
            )
            yield Problem("E267", f"{message}: expected a `load` with both", path)
        return


def _of_gear(gear: Gear, number: int) -> list[Path]:
    return [
        ("gears", number, name, owner)
        for name in ("drag", "open_drag")
        for owner, torque in getattr(gear, name).items()
        if isinstance(torque, Law)
    ]
