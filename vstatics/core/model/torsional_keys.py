"""Keys of springs and converters, and of the stiffness of shift elements and mechanisms."""

from __future__ import annotations

from vstatics.core.model.parts import damping_fault, damping_of
from vstatics.core.model.shape import (
    NUMBER,
    TEXT,
    ByKey,
    Either,
    Ends,
    KeyShape,
    Leaf,
    Limits,
    ListOf,
    Numbers,
    RowOf,
)
from vstatics.core.model.springs import limit_fault, limit_of, spring_fault, spring_of
from vstatics.core.model.struts import Strut

DAMPING = Either(
    Leaf("damping", straight=True),
    "viscous",
    ByKey(
        "Damping",
        "Viscous damping, or material damping, which is a share of the elastic torque.",
        (
            KeyShape(
                "viscous",
                Leaf("damping", straight=True),
                "Torque by rate of twist, in N*m*s/rad.",
                default=0,
                limits={"minimum": 0},
            ),
            KeyShape(
                "ratio",
                NUMBER,
                "Damping ratio of a mode in which nothing else is twisted, half the loss factor.",
                limits={"minimum": 0},
                examples=(0.02,),
            ),
            KeyShape(
                "loss_factor",
                NUMBER,
                "Damping torque as a part of the elastic one, at any frequency.",
                default=0,
                limits={"minimum": 0},
            ),
        ),
        damping_of,
        damping_fault,
    ),
    written=True,
)
"""Declaration of a damping, viscous or relative to the elastic torque."""
ABOVE_0: Limits = {"exclusiveMinimum": 0}
_DAMPING = KeyShape("damping", DAMPING, "Damping in parallel with the stiffness, in N*m*s/rad.")

ELASTIC = (
    KeyShape(
        "stiffness",
        Leaf("stiffness"),
        "Stiffness for vibration, in N*m/rad: torque on the first link divided by the twist of the "
        "component; rigid when not given.",
        limits=ABOVE_0,
        examples=(9e4,),
    ),
    _DAMPING,
)
"""Keys of components that are elastic in vibration and simulation, but rigid in statics."""

LIMIT = Either(
    Leaf("si_torque", straight=True),
    "base",
    ByKey(
        "Limit",
        "A limit that depends on the torque of another spring, as grip depends on wheel load.",
        (
            KeyShape(
                "base",
                Leaf("si_torque", straight=True),
                "Limit while the other spring has no torque, in N*m.",
                required=True,
                limits={"minimum": 0},
            ),
            KeyShape("of", TEXT, "The other spring."),
            KeyShape(
                "times",
                NUMBER,
                "Factor of the magnitude of its torque, which is added to the base.",
            ),
        ),
        limit_of,
        limit_fault,
    ),
    written=True,
)

STRUT = ByKey(
    "Strut",
    "Gas above a piston, and below it if there is a counter chamber: p V^exponent is constant.",
    (
        KeyShape(
            "pressure",
            Leaf("pressure"),
            "Pressure of the gas at rest, in Pa.",
            required=True,
            limits=ABOVE_0,
            examples=("38 at",),
        ),
        KeyShape(
            "area", Leaf("area"), "Area of the piston, in m^2.", required=True, limits=ABOVE_0
        ),
        KeyShape(
            "length",
            Leaf("length"),
            "Volume of the gas at rest divided by `area`, in m.",
            required=True,
            limits=ABOVE_0,
            examples=("11 cm",),
        ),
        KeyShape("exponent", NUMBER, "Polytropic exponent.", required=True, limits=ABOVE_0),
        KeyShape(
            "counter_pressure",
            Leaf("pressure"),
            "Pressure in the counter chamber at rest, in Pa.",
            default=0,
            limits={"minimum": 0},
        ),
        KeyShape(
            "counter_area",
            Leaf("area"),
            "Area of the piston towards the counter chamber, in m^2.",
            default=0,
            limits={"minimum": 0},
        ),
        KeyShape(
            "counter_length",
            Leaf("length"),
            "Volume of the counter chamber at rest divided by `counter_area`, in m.",
            limits=ABOVE_0,
        ),
        KeyShape(
            "at",
            Leaf("length"),
            "Extension from rest at which the slope of the strut is the stiffness of modes, in m.",
            default=0,
        ),
    ),
    Strut,
)

SPRING = ByKey(
    "Spring",
    "An elastic component: torque against twist.",
    (
        KeyShape(
            "links",
            Ends(least=1),
            "Links of a shaft, whose twist is the angle of the first link less the angle of the "
            "second; a single link is joined to the housing.",
            examples=(["engine", "disc"],),
        ),
        KeyShape(
            "twist",
            Numbers("link", NUMBER),
            "Coefficients of any sum of angles, instead of `links`.",
            examples=({"pinion": 1, "wheel": -1, "casing": -1},),
        ),
        KeyShape(
            "stiffness",
            Leaf("stiffness", straight=True),
            "Stiffness in N*m/rad, or in N/m if the twist names a link of `masses`.",
            limits=ABOVE_0,
        ),
        KeyShape(
            "compliance",
            Leaf("compliance", straight=True),
            "Compliance in rad/(N*m), instead of `stiffness`.",
            limits=ABOVE_0,
            examples=(84e-5,),
        ),
        KeyShape(
            "damping",
            DAMPING,
            "Damping in parallel with the stiffness, in N*m*s/rad; if the points have a play, it "
            "acts in contact only, and spring and damper together never pull.",
        ),
        KeyShape(
            "limit",
            LIMIT,
            "Largest torque in a scenario, in N*m; beyond it the spring slips, like a tyre.",
            examples=("3000 N*m", {"base": 2400, "of": "suspension", "times": 0.24}),
        ),
        KeyShape(
            "points",
            ListOf(
                RowOf(
                    (Leaf("angle", straight=True), Leaf("si_torque", straight=True)),
                    "twist, torque",
                ),
                "points",
            ),
            "Twists in rad, which rise, and torques in N*m, which do not fall, instead of a "
            "stiffness. Points from [0, 0] on hold in both directions, and with a twist below 0 "
            "as they are written. Beyond them the last slope holds.",
            examples=([[0, 0], [0.02, 0], [0.1, 160]],),
        ),
        KeyShape(
            "friction",
            Leaf("si_torque", straight=True),
            "Dry friction in parallel, in N*m, in a scenario and in `torsion response`.",
            default=0,
            limits={"minimum": 0},
            examples=("14 N*m",),
        ),
        KeyShape("strut", STRUT, "Strut of a straight spring, instead of a stiffness."),
    ),
    spring_of,
    spring_fault,
)

CONVERTER = ByKey(
    "Converter",
    "A torque converter: -M on the pump, +K*M on the turbine, M = lambda*w_P*|w_P|, by "
    "i = w_T/w_P.",
    (
        KeyShape(
            "links", Ends(), "Pump and turbine.", required=True, examples=(["engine", "turbine"],)
        ),
        KeyShape(
            "points",
            ListOf(
                RowOf((NUMBER, NUMBER, Leaf("pump_factor")), "i, K, lambda"), "points", unique=False
            ),
            "Speed ratio i, torque ratio K, lambda in N*m*s^2; i ascends.",
            required=True,
            examples=([[0, 2.4, 3.1e-3], [0.8, 1.0, 2.2e-3], [1, 1, 0]],),
        ),
    ),
)
