"""Torque converters between two links."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from vstatics.core.model.parts import HOUSING, Mechanism, with_floats


class Converter(NamedTuple):
    """A torque converter between two links.

    The torques of the pump P and the turbine T are ``M_P = lambda w_P |w_P|`` and ``M_T = K M_P``.
    K and lambda are functions of the speed ratio ``i = w_T/w_P``.

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
    """Speed ratio i [-] in ascending order, torque ratio K [-] and lambda [N*m*s^2]."""

    @property
    def links(self) -> tuple[int, int]:
        """Pump and turbine."""
        return self.pump, self.turbine

    def completed(self) -> Converter:
        """Return the converter with all numbers as floats."""
        return self._replace(points=with_floats(self.points))

    def at_ratio(self, ratio: float) -> Mechanism:
        """Return the converter as a mechanism with a given speed ratio."""
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
    """Return the torque converters of a document, which maps names to mappings of values."""
    return tuple(
        Converter(name, pump, turbine, record["points"]).completed()
        for name, record in given.items()
        for pump, turbine in [record["links"]]
    )
