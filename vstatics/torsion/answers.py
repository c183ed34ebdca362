"""JSON documents of the commands `vstatics torsion ...` about the gears of a case."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from vstatics.core.tables.answer import Flat, Sometimes, document
from vstatics.torsion.forced.harmonic_torques import GearResponse
from vstatics.torsion.random.random_vibration import Excitation, GearRandom
from vstatics.torsion.reduction.reduced_values import GearReduction
from vstatics.torsion.reduction.simplification import SimplificationRule, SimplificationStep
from vstatics.torsion.vibration.gear_modes import GearModes
from vstatics.torsion.vibration.measured import Damped, Identified


@document("vstatics-modes")
class ModesAnswer(NamedTuple):
    """Natural modes of gears."""

    case: str
    gears: Sequence[GearModes]


@document("vstatics-reduction")
class ReductionAnswer(NamedTuple):
    """Inertias and compliances of all gears, reduced to a link."""

    case: str
    to: str
    gears: Sequence[GearReduction]


@document("vstatics-response")
class ResponseAnswer(NamedTuple):
    """Forced vibration of all gears under a torque on a link."""

    case: str
    at: str
    gears: Sequence[GearResponse]


@document("vstatics-random-vibration")
class RandomAnswer(NamedTuple):
    """Random vibration of all gears under a random torque on a link, or random motion of a link."""

    case: str
    at: str
    by: Excitation
    gears: Sequence[GearRandom]


@document("vstatics-simplification")
class SimplificationAnswer(NamedTuple):
    """Steps of the simplification of the scheme of a gear."""

    case: str
    gear: str
    rule: SimplificationRule
    steps: Sequence[SimplificationStep]
    warnings: Sequence[str]


@document("vstatics-identification")
class IdentificationAnswer(NamedTuple):
    """Compliances that agree with the measured frequency of a mode."""

    case: str
    gear: str
    mode: int
    measured: float
    """Measured natural frequency. [rad/s]"""
    made: Flat[Identified]
    decrement: Sometimes[float] = None
    """Measured logarithmic decrement. [-]"""
    mean_line: Sometimes[Sequence[float]] = None
    """Mean line of a record at the inner extremes. [unit of the record]"""
    amplitudes: Sometimes[Sequence[float]] = None
    """Distances of the inner extremes of a record from the mean line. [unit of the record]"""


@document("vstatics-damping")
class DampingAnswer(NamedTuple):
    """Dampings of components, calculated from their decrements in a mode of a gear."""

    case: str
    gear: str
    mode: int
    made: Flat[Damped]
