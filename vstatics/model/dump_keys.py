"""The keys of a clutch that is dumped, in a case."""

from __future__ import annotations

from vstatics.model.clutch_dump import MASSES, NEEDED, dump_of
from vstatics.model.shape import LINK, ByKey, KeyShape, Leaf, Limits, ListOf

_ABOVE_0: Limits = {"exclusiveMinimum": 0}
_OF = {
    "J1": "the engine and the driving parts of the clutch",
    "J2": "the driven disc",
    "J3": "the transmission",
    "J4": "the wheels",
    "J5": "the vehicle",
}

DUMP = ByKey(
    "Clutch dump",
    "What makes up the masses of a clutch that is dumped, for `vstatics torsion dump`.",
    (
        *(
            KeyShape(
                name,
                ListOf(LINK, "links"),
                f"Links of {_OF[name]}; their inertias are reduced and added.",
                required=name in NEEDED,
                limits={"minItems": 1} if name in NEEDED else {},
            )
            for name in MASSES
        ),
        KeyShape(
            "M_C0",
            Leaf("si_torque"),
            "Torque at which the clutch breaks away, on the first link of J2, in N*m.",
            required=True,
            limits=_ABOVE_0,
        ),
        KeyShape(
            "M_phi",
            Leaf("si_torque", infinite=True),
            "Torque at which the tyres lose their grip, that of all wheels on the first link of "
            "J4, in N*m; when not given they don't.",
            limits=_ABOVE_0,
        ),
        KeyShape(
            "omega1",
            Leaf("si_speed"),
            "Speed before of the first link of J1, in rad/s.",
            required=True,
            limits=_ABOVE_0,
        ),
        KeyShape(
            "E",
            Leaf("compliance"),
            "Compliance from J2 to J5 on the link `to`, in rad/(N*m); that of the elastic devices "
            "when not given.",
            limits=_ABOVE_0,
        ),
        KeyShape(
            "to",
            LINK,
            "Link to which all is reduced and on which the torques are told; the first of J2 when "
            "not given.",
        ),
    ),
    dump_of,
)
