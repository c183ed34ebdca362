"""A formula of the time, and of the speed and angle of a link."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple


class Formula(NamedTuple):
    """A formula of t [s], and of speed [rad/s] and angle [rad] of the link itself."""

    text: str

    @property
    def variables(self) -> frozenset[str]:
        """Which of t, speed and angle it has."""
        raise NotImplementedError

    @property
    def function(self) -> Callable[[float, float, float], float]:
        """Its value by t, speed and angle."""
        raise NotImplementedError
