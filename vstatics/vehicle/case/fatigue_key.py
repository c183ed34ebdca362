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
    "The fatigue strength of a component under torque, for `vstatics damage`.",
    (
        KeyShape(
            "diameter",
            Leaf("length"),
            "Diameter of a round shaft, in m; its section modulus is pi d^3/16.",
            limits=ABOVE_0,
            examples=("42 mm",),
        ),
        KeyShape(
            "section_modulus",
            Leaf("section_modulus"),
            "Torque divided by the largest stress, in m^3, instead of the diameter.",
            limits=ABOVE_0,
            examples=("4 cm^3",),
        ),
        KeyShape(
            "endurance",
            Leaf("stress"),
            "Endurance limit, the stress amplitude at `cycles`, in Pa.",
            required=True,
            limits=ABOVE_0,
            examples=("100 MPa",),
        ),
        KeyShape(
            "exponent",
            NUMBER,
            "Exponent m of the S-N curve: stress^m * cycles is constant.",
            required=True,
            limits=ABOVE_0,
            examples=(3,),
        ),
        KeyShape(
            "cycles",
            NUMBER,
            "Number of cycles to failure at the endurance limit.",
            required=True,
            limits=ABOVE_0,
            examples=(4e6,),
        ),
        KeyShape(
            "asymmetry",
            NUMBER,
            "Share of the magnitude of the mean stress that is added to the amplitude.",
            default=0,
            limits={"minimum": 0},
            examples=(0.1,),
        ),
        KeyShape(
            "threshold",
            NUMBER,
            "Stress, relative to the endurance limit, below which a cycle does no damage.",
            default=0.6,
            limits={"minimum": 0},
        ),
        KeyShape(
            "sum", NUMBER, "Sum of damages at which the component fails.", default=1, limits=ABOVE_0
        ),
    ),
    Fatigue,
)
KEY = CaseKey(
    KeyShape(
        "fatigue",
        ByName("device", FATIGUE),
        "Fatigue strengths, each under the name of a spring or another component.",
    ),
    Mapping[str, Fatigue],
    Fatigue.of,
    of_fatigue,
    doubts_of_fatigue,
)
