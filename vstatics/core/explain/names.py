"""Symbols of speeds, torques and ratios in equations."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from typing import NamedTuple

from vstatics.core.model.transmission import Transmission
from vstatics.core.statics.result_arrays import OUTPUT

SIMPLE = re.compile(r"\w+")
"""Pattern of names that need no brackets."""


class Names(NamedTuple):
    """Symbols of a case in equations."""

    speeds: Sequence[str]
    """Symbol of the speed of each link, the housing first."""
    torques: Sequence[str]
    """Symbol of the torque of each device, then of the output torque."""
    holding: Sequence[str]
    """Symbol of the torque that holds a prescribed speed, for each link, housing first."""
    ratios: Sequence[str]
    """Symbol of the basic ratio of each mechanism."""
    efficiencies: Sequence[str]
    """Symbol of the efficiency of each mechanism."""

    def with_losses(self, signs: Sequence[float], efficiencies: Sequence[float]) -> Names:
        """Return the symbols with ``u eta^x`` instead of each u.

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

    def with_torque_ratios(self, converters: Collection[int]) -> Names:
        """Return the symbols with ``K`` instead of ``u`` for converters, by index.

        >>> Names([], [], [], ["u_P", "u_TC"], []).with_torque_ratios([1]).ratios
        ['u_P', 'K_TC']
        """
        ratios = [
            f"K{ratio.removeprefix('u')}" if place in converters else ratio
            for place, ratio in enumerate(self.ratios)
        ]
        return self._replace(ratios=ratios)


def names_of(case: Transmission) -> Names:
    """Return the symbols of a case: ``w_`` link, ``M_`` device, ``u_`` and ``eta_`` mechanism.

    A name that is not a single word is in brackets. The symbol of such a mechanism contains its
    number instead, for short equations.

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
        f"_{mechanism.name}"
        if SIMPLE.fullmatch(mechanism.name) and mechanism.name not in elements
        else str(number)
        for number, mechanism in enumerate(case.mechanisms, 1)
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
    """Return a name as the subscript of a symbol."""
    return f"_{name}" if SIMPLE.fullmatch(name) else f"[{name}]"
