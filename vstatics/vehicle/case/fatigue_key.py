"""Declaration of the key `fatigue` of a case, with checks."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from vstatics.core.errors import quoted, spoken
from vstatics.core.model.carried import CaseKey
from vstatics.core.model.fields import TransmissionFields
from vstatics.core.model.shape import NUMBER, TEXT, ByKey, ByName, KeyShape, Leaf
from vstatics.core.model.torsional_keys import ABOVE_0
from vstatics.vehicle.case.fatigue import Fatigue, TorqueStrength
from vstatics.vehicle.case.fatigue_checks import doubts_of_fatigue, of_fatigue

_OF_STRESS = ("diameter", "section_modulus", "endurance", "asymmetry")
_OF_TORQUE = ("torque", "contacts", "flanks", "torque_of", "on")


def _strength(**values: Any) -> Fatigue | TorqueStrength:
    kind, others = (TorqueStrength, _OF_STRESS) if "torque" in values else (Fatigue, _OF_TORQUE)
    return kind(**{name: value for name, value in values.items() if name not in others})


def _strength_fault(**values: Any) -> str:
    """Return a contradiction between keys for stress and for torque, or an empty text."""
    of_torque = "torque" in values
    wrong = [name for name in (_OF_STRESS if of_torque else _OF_TORQUE) if name in values]
    wrong = [name for name in wrong if name != "flanks" or values[name] != "together"]
    if not wrong:
        return ""
    names, given = spoken(map(quoted, wrong)), "torque" if of_torque else "endurance"
    return f"read {names} with `{given}`, expected a strength by either `torque` or `endurance`"


def _record(case: TransmissionFields) -> dict[str, Fatigue | TorqueStrength]:
    strengths: dict[str, Fatigue | TorqueStrength] = {**Fatigue.of(case), **TorqueStrength.of(case)}
    return {name: strengths[name] for name in case.fatigue}


FATIGUE = ByKey(
    "Fatigue",
    "The fatigue strength under torque: with `endurance` of a component, for `vstatics damage`; "
    "with `torque` of a member of a gear set, for `vstatics summary --duty`.",
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
            unless="torque",
            limits=ABOVE_0,
            examples=("100 MPa",),
        ),
        KeyShape(
            "torque",
            Leaf("si_torque"),
            "Torque on a member that is endured for `cycles`, in N*m, instead of `endurance`.",
            limits=ABOVE_0,
            examples=("900 N*m",),
        ),
        KeyShape(
            "exponent",
            NUMBER,
            "Exponent m of the S-N curve: stress^m * cycles, or torque^m * contacts, is constant.",
            required=True,
            limits=ABOVE_0,
            examples=(3,),
        ),
        KeyShape(
            "cycles",
            NUMBER,
            "Number of cycles, or of contacts, to failure at the endurance limit.",
            required=True,
            limits=ABOVE_0,
            examples=(4e6,),
        ),
        KeyShape(
            "asymmetry",
            NUMBER,
            "Share of the magnitude of the mean stress that is added to the amplitude.",
            limits={"minimum": 0},
            examples=(0.1,),
        ),
        KeyShape(
            "threshold",
            NUMBER,
            "Stress or torque, relative to the endurance limit, below which a cycle does no "
            "damage; by default 0.6 of a stress, 0 of a torque.",
            limits={"minimum": 0},
        ),
        KeyShape(
            "contacts",
            NUMBER,
            "Contacts of a tooth in each turn of a member; by default the `planets` of the gear "
            "set for its sun and ring, otherwise 1.",
            limits=ABOVE_0,
            examples=(3,),
        ),
        KeyShape(
            "flanks",
            Leaf("choice", ("together", "apart")),
            "`apart`: torques of the two signs load different flanks, of which the worse counts, "
            "as for pitting. `together`: they add up, as for bending.",
            default="together",
        ),
        KeyShape(
            "torque_of",
            TEXT,
            "Member whose torque counts, for a planet, which has no torque of its own.",
            examples=("P1.sun",),
        ),
        KeyShape(
            "on",
            TEXT,
            "Member that has the strength, whose name is then free, for several strengths of a "
            "member.",
            examples=("P1.sun",),
        ),
        KeyShape(
            "sum", NUMBER, "Sum of damages at which the component fails.", default=1, limits=ABOVE_0
        ),
    ),
    _strength,
    _strength_fault,
)
KEY = CaseKey(
    KeyShape(
        "fatigue",
        ByName("device", FATIGUE),
        "Fatigue strengths, each under the name of a spring or another component, or of a member "
        "such as `P1.sun`; with `on`, under any name.",
    ),
    Mapping[str, Fatigue | TorqueStrength],
    _record,
    of_fatigue,
    doubts_of_fatigue,
    names_members=True,
)
