"""Torque converters between two links."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from vstatics.core.model.parts import HOUSING, Mechanism


class Converter(NamedTuple):
    """A torque converter between two links.

    ``M_P = lambda w_P |w_P|``, ``M_T = K M_P``, by the points i = w_T/w_P, K, lambda.

    Examples
    --------
    >>> points = ((0.0, 2.2, 0.003), (0.85, 1.0, 0.002))
    >>> Converter("TC", pump=1, turbine=2, points=points).links
    (1, 2)
    """

    name: str
    pump: int
    turbine: int
    points: tuple[tuple[float, ...], ...]
    """i [-], K [-], lambda [N*m*s^2]; i ascends."""

    @property
    def links(self) -> tuple[int, int]:
        """Pump and turbine."""
        return self.pump, self.turbine

    def completed(self) -> Converter:
        """The same with floats."""
        return self._replace(points=tuple(tuple(map(float, point)) for point in self.points))

    def at_ratio(self, ratio: float) -> Mechanism:
        """The mechanism that it is at a speed ratio."""
        return Mechanism(
            self.pump,
            self.turbine,
            HOUSING,
            ratio,
            name=self.name,
            kind="converter",
            points=self.points,
        )


def converters_of(given: Mapping[str, Any]) -> tuple[Converter, ...]:
    """The converters of a document, by their names."""
    return tuple(
        Converter(name, pump, turbine, one["points"]).completed()
        for name, one in given.items()
        for pump, turbine in [one["links"]]
    )
