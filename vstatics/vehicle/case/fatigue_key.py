"""Declaration of the key `fatigue` of a case, with checks."""

from __future__ import annotations

from collections.abc import Mapping

from vstatics.core.model.carried import CaseKey
from vstatics.core.model.shape import NUMBER, ByKey, ByName, KeyShape, Leaf
from vstatics.core.model.torsional_keys import ABOVE_0
from vstatics.vehicle.case.fatigue import Fatigue
from vstatics.vehicle.case.fatigue_checks import doubts_of_fatigue, of_fatigue

FATIGUE = ByKey(
    "Fatigue",
    "The fatigue strength of a device under torque, for `vstatics damage`.",
    (
        KeyShape(
            "diameter",
            Leaf("length"),
            "Of a round shaft, in m; its section modulus is pi d^3/16.",
            limits=ABOVE_0,
            examples=("42 mm",),
        ),
        KeyShape(
            "section_modulus",
            Leaf("section_modulus"),
            "In place of the diameter: torque by the largest stress, in m^3.",
            limits=ABOVE_0,
            examples=("4 cm^3",),
        ),
        KeyShape(
            "endurance",
            Leaf("stress"),
            "Amplitude of stress that it bears for `cycles`, in Pa.",
            required=True,
            limits=ABOVE_0,
            examples=("100 MPa",),
        ),
        KeyShape(
            "exponent",
            NUMBER,
            "Stress to this power by the cycles that are borne is constant.",
            required=True,
            limits=ABOVE_0,
            examples=(3,),
        ),
        KeyShape(
            "cycles",
            NUMBER,
            "That it bears at its endurance.",
            required=True,
            limits=ABOVE_0,
            examples=(4e6,),
        ),
        KeyShape(
            "asymmetry",
            NUMBER,
            "This part of the mean stress, whatever its sign, is added to the amplitude.",
            default=0,
            limits={"minimum": 0},
            examples=(0.1,),
        ),
        KeyShape(
            "threshold",
            NUMBER,
            "Stresses below this part of the endurance do no damage.",
            default=0.6,
            limits={"minimum": 0},
        ),
        KeyShape("sum", NUMBER, "Of damages at which it fails.", default=1, limits=ABOVE_0),
    ),
    Fatigue,
)
KEY = CaseKey(
    KeyShape(
        "fatigue",
        ByName("device", FATIGUE),
        "Fatigue strengths, each under the name of a spring or another device.",
    ),
    Mapping[str, Fatigue],
    Fatigue.of,
    of_fatigue,
    doubts_of_fatigue,
)
