"""What a record of torques does to devices, by their fatigue strength: the linear sum of damages.

Source: I. S. Tsitovich, V. B. Algin, Vehicle dynamics (1981), chapter 4.6; numbers of equations
are those of the book.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np

from vstatics.core.arguments import refusing
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats, as_floats
from vstatics.core.tables.answer import document
from vstatics.vehicle.case.fatigue import Fatigue
from vstatics.vehicle.damage.rainflow import LoadCycle, rainflow

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


class HasDamage(Protocol):
    """Run that damages devices."""

    @property
    def damage(self) -> Mapping[str, object]:
        """Damage by names of devices."""


class DeviceDamage(NamedTuple):
    """What a record of torques does to a device."""

    damage: float
    """A part of that of which it fails, which is `sum` of its fatigue strength. [-]"""
    repeats: float | None
    """How often it bears the record; None: for ever. [-]"""
    largest_stress: float
    """Of all cycles, as it counts for damage. [Pa]"""
    cycles: Sequence[LoadCycle]
    """Ranges and means in N*m."""

    @classmethod
    def of(cls, motion: HasDamage) -> dict[str, DeviceDamage]:
        """Return the damage in a run by the names of devices."""
        return {name: one for name, one in motion.damage.items() if isinstance(one, cls)}


Damages = Mapping[str, DeviceDamage]
"""Damage by names of devices."""


@document("vstatics-damage")
class DamageAnswer(NamedTuple):
    """What a record does to the devices of a case that have a fatigue strength."""

    case: str
    damage: Mapping[str, DeviceDamage]


def device_damage(fatigue: Fatigue, torques: Floats) -> DeviceDamage:
    """The damage of a record of torques [N*m], by (4.33), (4.34) and (4.38).

    A cycle has the stress amplitude + asymmetry |mean|. From threshold times endurance on it
    costs (stress/endurance)^exponent/cycles. Where a torque is open, or numbers are so large that
    there is no damage, it is NaN.

    Examples
    --------
    A quarter of 4e6 half cycles at the endurance:

    >>> shaft = Fatigue(100e6, 3, 4e6, section_modulus=4e-6)
    >>> device_damage(shaft, np.array([400.0, -400.0])).damage
    1.25e-07
    """
    if not np.isfinite(torques).all():
        return DeviceDamage(math.nan, None, math.nan, [])
    counted = rainflow(torques)
    parts = np.array([one.amplitude + fatigue.asymmetry * abs(one.mean) for one in counted])
    stresses = parts / fatigue.modulus
    ratios = stresses / fatigue.endurance
    counts = np.array([one.counted for one in counted]) * (ratios >= fatigue.threshold)
    with np.errstate(all="ignore"):
        damage = float(counts @ ratios**fatigue.exponent) / fatigue.cycles
    if not math.isfinite(damage):
        damage = math.nan
    repeats = fatigue.sum / damage if damage > 0 else None
    return DeviceDamage(damage, repeats, float(stresses.max(initial=0.0)), counted)


@refusing()
def damages(case: Transmission, torques: Mapping[str, ArrayLike]) -> dict[str, DeviceDamage]:
    """What records of torques do to the devices of a case.

    Parameters
    ----------
    case : Transmission
        With `fatigue` of devices.
    torques : mapping of str to array_like, shape (instants,)
        The record of each device by its name. [N*m]

    Returns
    -------
    dict of str to DeviceDamage
        Of each device that has both: damage [-], cycles [N*m], largest stress [Pa].

    Raises
    ------
    CaseError
        If a record is none of numbers.
    ValueError
        If it is no series of them.

    Examples
    --------
    Cycles of 300, 500 and 800 N*m, half of each counted; 400 N*m are 100 MPa:

    >>> from vstatics import Spring
    >>> strength = Fatigue(100e6, 3, 4e6, section_modulus=4e-6)
    >>> shaft = Spring({1: 1, 2: -1}, stiffness=9000.0, name="shaft")
    >>> case = Transmission(2, [], [], [], springs=[shaft], fatigue={"shaft": strength})
    >>> made = damages(case, {"shaft": [0.0, 500.0, -300.0, 0.0]})["shaft"]
    >>> round(made.largest_stress / 1e6), [one.range for one in made.cycles]
    (100, [300.0, 500.0, 800.0])
    """
    return {
        name: device_damage(fatigue, as_floats(name, torques[name]))
        for name, fatigue in Fatigue.of(case).items()
        if name in torques
    }
