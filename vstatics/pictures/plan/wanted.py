"""Case built from wanted ratios only, for a kinematic plan before gear sets are chosen.

The link that is at rest in the gear of ratio u is the carrier of a mechanism with basic ratio u
between input and output. Its speed is ``(u x - 1)/(u - 1)`` at the output speed x.
"""

from __future__ import annotations

from collections.abc import Sequence

from vstatics.core.model.transmission import HOUSING, Gear, Mechanism, ShiftElement, Transmission
from vstatics.pictures.drawing.style import Style

LARGEST_RATIO = 1e6
"""Largest accepted ratio, or inverse of a ratio; larger values are probably typing errors. [-]"""


def case_of_ratios(ratios: Sequence[float], style: Style | None = None) -> Transmission:
    """Build a case with a link and a brake for each ratio, and a clutch for the ratio 1.

    Parameters
    ----------
    ratios : sequence of float
        Ratios of the gears, input speed per output speed. [-]
    style : Style, optional
        Style that determines the language of the names.

    Raises
    ------
    ValueError
        If a ratio is 0, too large or small, or given twice.

    Examples
    --------
    >>> from vstatics.core.statics.solve import solve
    >>> case = case_of_ratios([2.6, 1, -4])
    >>> case.link_names, solve(case).ratio.round(9).tolist()
    (('input', 'output', '2.6', '-4'), [2.6, 1.0, -4.0])
    """
    say = (style or Style()).text
    names = [f"{ratio:.12g}" for ratio in ratios]
    for name in names:
        if not 1 / LARGEST_RATIO <= abs(float(name)) <= LARGEST_RATIO:
            raise ValueError(f"read {name}, expected a ratio from 1e-6 to 1e6 in size")
        if names.count(name) > 1:
            raise ValueError(f"read {name} again, expected each ratio once")
    rays = [name for name in names if name != "1"]
    numbers = {name: number for number, name in enumerate(rays, 3)}
    return Transmission(
        2 + len(rays),
        [
            ShiftElement(numbers[name], HOUSING, f"T{name}")
            if name in numbers
            else ShiftElement(1, 2, "F")
            for name in names
        ],
        [Mechanism(1, 2, number, float(name)) for name, number in numbers.items()],
        [Gear([number], name=name) for number, name in enumerate(names, 1)],
        output=2,
        name=say("Ratios {names}", names=", ".join(names)),
        link_names=[say("input"), say("output"), *rays],
    )
