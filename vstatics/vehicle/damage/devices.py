"""Fatigue damage of components under a record of torques, by linear accumulation (Miner's rule).

Source: I. S. Tsitovich, V. B. Algin, Vehicle dynamics (1981), chapter 4.6; equation numbers are
from the book.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np

from vstatics.core.arguments import refusing
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats, as_list
from vstatics.core.tables.answer import document
from vstatics.vehicle.case.fatigue import Fatigue
from vstatics.vehicle.damage.rainflow import LoadCycle, rainflow
from vstatics.vehicle.tolerances import SAME_TORQUE_CLASS

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


class HasDamage(Protocol):
    """Results with fatigue damage of components, such as a run."""

    @property
    def damage(self) -> Mapping[str, object]:
        """Damage by component name."""


class DeviceDamage(NamedTuple):
    """Fatigue damage of a component under a record of torques."""

    damage: float
    """Damage; the component fails when it reaches `sum` of its fatigue strength. [-]"""
    repeats: float | None
    """Number of repetitions of the record to failure, None if unlimited. [-]"""
    largest_stress: float
    """Largest equivalent stress amplitude of all cycles. [Pa]"""
    cycles: Sequence[LoadCycle]
    """Torque cycles of the record, with ranges and means in N*m."""

    @classmethod
    def of(cls, motion: HasDamage) -> dict[str, DeviceDamage]:
        """Return the damage in a run, by component name."""
        return {name: damage for name, damage in motion.damage.items() if isinstance(damage, cls)}


Damages = Mapping[str, DeviceDamage]
"""Damage by component name."""


@document("vstatics-damage")
class DamageAnswer(NamedTuple):
    """JSON document with the damage of the components of a case under a record of torques."""

    case: str
    damage: Mapping[str, DeviceDamage]


def device_damage(fatigue: Fatigue, torques: Floats) -> DeviceDamage:
    """Return the fatigue damage that a record of torques [N*m] causes.

    Equations (4.33), (4.34) and (4.38) of Tsitovich and Algin, 1981.

    The equivalent stress of a cycle is (amplitude + asymmetry |mean|)/modulus. If it reaches
    threshold * endurance, the cycle causes the damage (stress/endurance)^exponent/cycles, otherwise
    no damage. The result is NaN if a torque is indeterminate or the damage overflows.

    Examples
    --------
    Half a cycle at the endurance stress, under which the shaft fails after 4e6 cycles:

    >>> shaft = Fatigue(100e6, 3, 4e6, section_modulus=4e-6)
    >>> device_damage(shaft, np.array([400.0, -400.0])).damage
    1.25e-07
    """
    if not np.isfinite(torques).all():
        return DeviceDamage(math.nan, None, math.nan, [])
    with np.errstate(all="ignore"):  # an overflow gives NaN
        counted = rainflow(torques)
        amplitudes = np.array(
            [cycle.amplitude + fatigue.asymmetry * abs(cycle.mean) for cycle in counted]
        )
        stresses = amplitudes / fatigue.modulus
        ratios = stresses / fatigue.endurance
        counts = np.array([cycle.counted for cycle in counted]) * (
            ratios >= fatigue.threshold * (1 - SAME_TORQUE_CLASS)
        )
        damage = float(counts @ ratios**fatigue.exponent) / fatigue.cycles
    if not math.isfinite(damage):
        damage = math.nan
    repeats = fatigue.sum / damage if damage > 0 else None
    return DeviceDamage(damage, repeats, float(stresses.max(initial=0.0)), counted)


@refusing()
def damages(case: Transmission, torques: Mapping[str, ArrayLike]) -> dict[str, DeviceDamage]:
    """Calculate the fatigue damage of the components of a case under records of torques.

    Parameters
    ----------
    case : Transmission
        Case with `fatigue` of components.
    torques : mapping of str to array_like, shape (instants,)
        Records of torques, by name of the component. [N*m]

    Returns
    -------
    dict of str to DeviceDamage
        Damage [-], cycles [N*m] and largest stress [Pa] of each component with a fatigue strength
        and a record.

    Raises
    ------
    CaseError
        If a record is not a list of numbers.

    Examples
    --------
    Half cycles with ranges of 300, 500 and 800 N*m; a torque of 400 N*m causes 100 MPa:

    >>> from vstatics import Spring
    >>> strength = Fatigue(100e6, 3, 4e6, section_modulus=4e-6)
    >>> shaft = Spring({1: 1, 2: -1}, stiffness=9000.0, name="shaft")
    >>> case = Transmission(2, [], [], [], springs=[shaft], fatigue={"shaft": strength})
    >>> damage = damages(case, {"shaft": [0.0, 500.0, -300.0, 0.0]})["shaft"]
    >>> round(damage.largest_stress / 1e6), [cycle.range for cycle in damage.cycles]
    (100, [300.0, 500.0, 800.0])
    """
    return {
        name: device_damage(fatigue, as_list(name, torques[name]))
        for name, fatigue in Fatigue.of(case).items()
        if name in torques
    }
