"""Fatigue damage of components by a record of torques, by linear accumulation.

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
    """Results that contain the fatigue damage of components, such as a run."""

    @property
    def damage(self) -> Mapping[str, object]:
        """Damage by component name."""


class DeviceDamage(NamedTuple):
    """Fatigue damage of a component by a record of torques."""

    damage: float
    """Damage; the component fails at `sum` of the fatigue strength. [-]"""
    repeats: float | None
    """Number of repetitions of the record to failure; None for an unlimited number. [-]"""
    largest_stress: float
    """Largest equivalent stress amplitude of all cycles. [Pa]"""
    cycles: Sequence[LoadCycle]
    """Torque cycles of the record, with ranges and means in N*m."""

    @classmethod
    def of(cls, motion: HasDamage) -> dict[str, DeviceDamage]:
        """Return the damage in a run by component name."""
        return {name: damage for name, damage in motion.damage.items() if isinstance(damage, cls)}


Damages = Mapping[str, DeviceDamage]
"""Damage by component name."""


@document("vstatics-damage")
class DamageAnswer(NamedTuple):
    """Damage of the components of a case by a record of torques."""

    case: str
    damage: Mapping[str, DeviceDamage]


def device_damage(fatigue: Fatigue, torques: Floats) -> DeviceDamage:
    """Return the damage of a record of torques [N*m], by (4.33), (4.34) and (4.38).

    The stress of a cycle is amplitude + asymmetry |mean|. If it reaches threshold * endurance, the
    cycle causes the damage (stress/endurance)^exponent/cycles; smaller stresses cause none. The
    damage is NaN if a torque is indeterminate or if the damage overflows.

    Examples
    --------
    Half a cycle at the endurance, of 4e6 cycles:

    >>> shaft = Fatigue(100e6, 3, 4e6, section_modulus=4e-6)
    >>> device_damage(shaft, np.array([400.0, -400.0])).damage
    1.25e-07
    """
    if not np.isfinite(torques).all():
        return DeviceDamage(math.nan, None, math.nan, [])
    counted = rainflow(torques)
    amplitudes = np.array(
        [cycle.amplitude + fatigue.asymmetry * abs(cycle.mean) for cycle in counted]
    )
    stresses = amplitudes / fatigue.modulus
    ratios = stresses / fatigue.endurance
    counts = np.array([cycle.counted for cycle in counted]) * (ratios >= fatigue.threshold)
    with np.errstate(all="ignore"):
        damage = float(counts @ ratios**fatigue.exponent) / fatigue.cycles
    if not math.isfinite(damage):
        damage = math.nan
    repeats = fatigue.sum / damage if damage > 0 else None
    return DeviceDamage(damage, repeats, float(stresses.max(initial=0.0)), counted)


@refusing()
def damages(case: Transmission, torques: Mapping[str, ArrayLike]) -> dict[str, DeviceDamage]:
    """Calculate the fatigue damage of the components of a case by records of torques.

    Parameters
    ----------
    case : Transmission
        Case with `fatigue` of components.
    torques : mapping of str to array_like, shape (instants,)
        Record of each component by name. [N*m]

    Returns
    -------
    dict of str to DeviceDamage
        Damage [-], cycles [N*m] and largest stress [Pa] of each component with a fatigue strength
        and a record.

    Raises
    ------
    CaseError
        If a record contains something other than numbers.
    ValueError
        If a record is not one-dimensional.

    Examples
    --------
    Half a cycle each with ranges of 300, 500 and 800 N*m; 400 N*m correspond to 100 MPa:

    >>> from vstatics import Spring
    >>> strength = Fatigue(100e6, 3, 4e6, section_modulus=4e-6)
    >>> shaft = Spring({1: 1, 2: -1}, stiffness=9000.0, name="shaft")
    >>> case = Transmission(2, [], [], [], springs=[shaft], fatigue={"shaft": strength})
    >>> damage = damages(case, {"shaft": [0.0, 500.0, -300.0, 0.0]})["shaft"]
    >>> round(damage.largest_stress / 1e6), [cycle.range for cycle in damage.cycles]
    (100, [300.0, 500.0, 800.0])
    """
    return {
        name: device_damage(fatigue, as_floats(name, torques[name]))
        for name, fatigue in Fatigue.of(case).items()
        if name in torques
    }
