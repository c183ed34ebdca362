"""Torsional vibration of a case: natural modes, reduction, simplification, response.

`system` builds the `TorsionalSystem` of a gear from bodies, elastic components and rigid
components, each with its row of the structural-distribution matrix. `vibration` calculates natural
modes with and without damping, modes of many variants, and parameters from measured modes.
`reduction` reduces a gear to a link, to a scheme of masses and springs, and to simpler schemes.
`forced` calculates the response to periodic torques, `random` the response to random torques, and
`clutch` the torques after a clutch dump. `answers` declares the JSON of commands, `pictures` draws
modes, Campbell diagrams and responses, `report` writes the section of a report, and `cli` contains
the commands `vstatics torsion ...`. The annex needs scipy, an optional dependency.

>>> from vstatics import Spring, Transmission, torsion
>>> shaft = Spring({1: 1, 2: -1}, stiffness=100.0, name="shaft")
>>> case = Transmission(2, [], [], [], springs=[shaft], inertias={1: 2.0, 2: 2.0})
>>> [gear] = torsion.modes(case)
>>> gear.modes[0].omega, gear.modes[0].torques
(10.0, {'shaft': 200.0})

Source: Tsitovich, Algin, Vehicle dynamics, Minsk, 1981 (chapters 1 to 3, appendices 1 to 3).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from vstatics.core.extras import later
from vstatics.torsion.annex import ANNEX

if TYPE_CHECKING:
    from vstatics.torsion.clutch.dumped import DumpTorque, dump
    from vstatics.torsion.clutch.gear_dump import GearDump, gear_dumps
    from vstatics.torsion.clutch.given import Dump
    from vstatics.torsion.forced.harmonic_torques import GearResponse, Harmonic, response
    from vstatics.torsion.random.random_vibration import GearRandom, random_vibration
    from vstatics.torsion.random.spectra import Correlation, SpectrumPoints, White
    from vstatics.torsion.reduction.reduced_scheme import gear_scheme
    from vstatics.torsion.reduction.reduced_values import GearReduction, reduce
    from vstatics.torsion.reduction.scheme import TorsionScheme
    from vstatics.torsion.reduction.simplification import Simplification, simplify
    from vstatics.torsion.vibration.gear_modes import CaseModes, GearModes, Mode, modes
    from vstatics.torsion.vibration.measured import Damped, Identified, damping, identify

__all__ = [
    "CaseModes",
    "Correlation",
    "Damped",
    "Dump",
    "DumpTorque",
    "GearDump",
    "GearModes",
    "GearRandom",
    "GearReduction",
    "GearResponse",
    "Harmonic",
    "Identified",
    "Mode",
    "Simplification",
    "SpectrumPoints",
    "TorsionScheme",
    "White",
    "damping",
    "dump",
    "gear_dumps",
    "gear_scheme",
    "identify",
    "modes",
    "random_vibration",
    "reduce",
    "response",
    "simplify",
]

__getattr__ = later(__name__, ANNEX.own_names)


def __dir__() -> list[str]:
    return __all__
