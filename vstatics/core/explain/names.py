"""How equations call speeds, torques and ratios."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

from vstatics.core.model.transmission import Transmission
from vstatics.core.statics.result_arrays import OUTPUT

SIMPLE = re.compile(r"\w+")


class Names(NamedTuple):
    """The symbols of a case."""

    speeds: Sequence[str]
    """By link, the housing first."""
    torques: Sequence[str]
    """By device, then the output torque."""
    holding: Sequence[str]
    """By link, the housing first: the torque that holds a given speed."""
    ratios: Sequence[str]
    """By mechanism."""
    efficiencies: Sequence[str]
    """By mechanism."""

    def with_losses(self, signs: Sequence[float], efficiencies: Sequence[float]) -> Names:
        """The same with ``u eta^x`` in place of each u.

        >>> Names([], [], [], ["u1", "u2"], ["eta1", "eta2"]).with_losses([1, -1], [0.9, 0.8])[3]
        ['u1 eta1', 'u2/eta2']
        """
        signed = zip(self.ratios, self.efficiencies, signs, efficiencies, strict=True)
        ratios = [
            ratio
            if sign == 0 or number == 1
            else f"{ratio} {eta}"
            if sign > 0
            else f"{ratio}/{eta}"
            for ratio, eta, sign, number in signed
        ]
        return self._replace(ratios=ratios)


def names_of(case: Transmission) -> Names:
    """The symbols of a case: ``w_`` and a link, ``M_`` a device, ``u_``, ``eta_`` a mechanism.

    A name that is more than a word stands in brackets; such a mechanism has its number
    instead, as its name would hide the equation.

    Examples
    --------
    >>> from vstatics.core.model.transmission import Gear, Mechanism, ShiftElement
    >>> case = Transmission(2, [ShiftElement(1, name="B")], [Mechanism(1, 2, 0, -2, name="a b")],
    ...                     [Gear()], link_names=["in", "axle 2"])
    >>> names_of(case)[:2]
    (['0', 'w_in', 'w[axle 2]'], ['M_B', 'M1', 'Mx'])
    """
    elements = [element.name for element in case.shift_elements]
    mechanisms = [
        f"_{one.name}" if SIMPLE.fullmatch(one.name) and one.name not in elements else str(number)
        for number, one in enumerate(case.mechanisms, 1)
    ]
    return Names(
        ["0", *(f"w{subscript(name)}" for name in case.link_names)],
        [
            *(f"M{subscript(name)}" for name in elements),
            *(f"M{name}" for name in mechanisms),
            *(f"M{subscript(spring.name)}" for spring in case.springs),
            OUTPUT,
        ],
        ["0", *(f"T{subscript(name)}" for name in case.link_names)],
        [f"u{name}" for name in mechanisms],
        [f"eta{name}" for name in mechanisms],
    )


def subscript(name: str) -> str:
    """A name behind a letter."""
    return f"_{name}" if SIMPLE.fullmatch(name) else f"[{name}]"
