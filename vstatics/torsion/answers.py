"""What the commands of `vstatics torsion` answer about the gears of a case."""

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
    """The modes of gears."""

    case: str
    gears: Sequence[GearModes]


@document("vstatics-reduction")
class ReductionAnswer(NamedTuple):
    """Inertias and compliances of gears on one link."""

    case: str
    to: str
    gears: Sequence[GearReduction]


@document("vstatics-response")
class ResponseAnswer(NamedTuple):
    """Forced vibration of gears, by a torque on a link."""

    case: str
    at: str
    gears: Sequence[GearResponse]


@document("vstatics-random-vibration")
class RandomAnswer(NamedTuple):
    """Random vibration of gears, by a torque on a link or by its motion."""

    case: str
    at: str
    by: Excitation
    gears: Sequence[GearRandom]


@document("vstatics-simplification")
class SimplificationAnswer(NamedTuple):
    """The steps to a simpler scheme of a gear."""

    case: str
    gear: str
    rule: SimplificationRule
    steps: Sequence[SimplificationStep]
    warnings: Sequence[str]


@document("vstatics-identification")
class IdentificationAnswer(NamedTuple):
    """What follows from the frequency of a mode that was measured."""

    case: str
    gear: str
    mode: int
    measured: float
    """[rad/s]"""
    made: Flat[Identified]
    decrement: Sometimes[float] = None
    """Measured, too."""
    mean_line: Sometimes[Sequence[float]] = None
    """At the inner extremes of a record, in its unit."""
    amplitudes: Sometimes[Sequence[float]] = None
    """Likewise."""


@document("vstatics-damping")
class DampingAnswer(NamedTuple):
    """Dampings from decrements, by a mode of a gear."""

    case: str
    gear: str
    mode: int
    made: Flat[Damped]
