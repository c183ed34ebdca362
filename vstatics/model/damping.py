"""The damping of an elastic device."""

from __future__ import annotations

from typing import NamedTuple


class Damping(NamedTuple):
    """What resists the rate of a twist.

    Parameters
    ----------
    viscous : float
        Torque by rate of twist. [N*m*s/rad]
    loss_factor : float
        Of the material: at any frequency the damping torque is this part of the elastic one,
        so that a mode of this device alone has half of it as its damping ratio. [-]
    """

    viscous: float = 0.0
    loss_factor: float = 0.0

    def __bool__(self) -> bool:
        """Whether it resists anything."""
        return self.viscous != 0 or self.loss_factor != 0


NO_DAMPING = Damping()


def damping(given: Damping | float) -> Damping:
    """A damping that may be a number, which is viscous.

    >>> damping(3)
    Damping(viscous=3.0, loss_factor=0.0)
    """
    return Damping(*map(float, given)) if isinstance(given, Damping) else Damping(float(given))


def damping_of(
    viscous: float = 0.0, ratio: float | None = None, loss_factor: float = 0.0
) -> Damping:
    """The damping that one of the three gives; a damping ratio is half of a loss factor.

    >>> damping_of(ratio=0.02)
    Damping(viscous=0.0, loss_factor=0.04)
    """
    return Damping(viscous, loss_factor if ratio is None else 2 * ratio)


def damping_fault(
    viscous: float = 0.0, ratio: float | None = None, loss_factor: float = 0.0
) -> str:
    """Why these do not tell a damping.

    >>> damping_fault(ratio=0.02, loss_factor=0.1)
    'read several of `viscous`, `ratio` and `loss_factor`, expected one of them'
    """
    if ratio is not None and ratio < 0:
        return f"read a ratio of {ratio:g}, expected one of 0 or more"
    if bool(viscous) + (ratio is not None) + bool(loss_factor) < 2:
        return ""
    return "read several of `viscous`, `ratio` and `loss_factor`, expected one of them"
