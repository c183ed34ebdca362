"""The keys of a scenario in YAML and JSON, declared once; see `model.shape`.

What is read of them is in `scenario_given`.
"""

from __future__ import annotations

from vstatics.model.keys import ENGAGED
from vstatics.model.shape import (
    FLAG,
    NUMBER,
    TEXT,
    ByForm,
    ByKey,
    ByName,
    Ends,
    KeyShape,
    Leaf,
    ListOf,
    Numbers,
    OneOrMany,
    RowOf,
)
from vstatics.simulation.scenario.distribution import Distribution
from vstatics.simulation.scenario.given import (
    ABSCISSA,
    ANYTHING,
    CAPACITY,
    CAPACITY_CURVE,
    SPEED,
    TORQUE_CURVE,
    GivenControl,
    GivenLaw,
    exactly_one,
)
from vstatics.simulation.scenario.laws import Road

_TIME, _TORQUE = Leaf("time"), Leaf("si_torque")
_NOT_BELOW_0 = {"minimum": 0}
_ABOVE_0 = {"exclusiveMinimum": 0}
_POINTS_OVER_TIME = "points [time in s, value] in their order: straight between, constant outside; "
_POINTS_OVER_TIME += "where a time repeats the later value holds from there"


_CAPACITY_POINTS = ListOf(RowOf((_TIME, CAPACITY), "time, capacity"), "points", unique=False)
_TORQUE_POINTS = ListOf(RowOf((_TIME, _TORQUE), "time, torque"), "points", unique=False)

CONTROL = ByForm(
    "a capacity, a formula, points [[time, capacity], ...] or a mapping",
    CAPACITY_CURVE,
    _CAPACITY_POINTS,
    ByKey(
        "Control",
        "What a shift element can carry over time; or a dog clutch, which joins at once or opens.",
        (
            KeyShape(
                "points",
                _CAPACITY_POINTS,
                f"{_POINTS_OVER_TIME[0].upper()}{_POINTS_OVER_TIME[1:]}.",
            ),
            KeyShape("formula", CAPACITY_CURVE, "A number or a formula of t."),
            KeyShape("scale", NUMBER, "By which it is multiplied.", default=1, limits=_NOT_BELOW_0),
            KeyShape(
                "dog",
                ListOf(
                    RowOf((_TIME, Leaf("choice", ("open", "closed"))), "time, state"),
                    "times",
                    unique=False,
                ),
                "Times from which it is closed or open; open before.",
                examples=([[1.5, "closed"]],),
            ),
        ),
        GivenControl,
        exactly_one("points", "formula", "dog"),
    ),
)

ROAD = ByKey(
    "Road",
    "What a road does to a vehicle, on a link that turns as its wheels; g is 9.81 m/s^2, the "
    "density of air 1.2 kg/m^3.",
    (
        KeyShape("mass", Leaf("mass"), "Of the vehicle, in kg.", required=True, limits=_ABOVE_0),
        KeyShape("radius", Leaf("length"), "Of the wheels, in m.", required=True, limits=_ABOVE_0),
        KeyShape("rolling", NUMBER, "Coefficient of rolling resistance.", default=0),
        KeyShape(
            "drag_area", Leaf("area"), "Frontal area by coefficient of air drag, in m^2.", default=0
        ),
        KeyShape("slope", NUMBER, "Sine of the angle of ascent.", default=0),
    ),
    Road,
)

LAW = ByForm(
    "a torque, a formula, points [[time, torque], ...] or a mapping",
    TORQUE_CURVE,
    _TORQUE_POINTS,
    ByKey(
        "Torque",
        "A law of an outside torque.",
        (
            KeyShape(
                "over",
                Leaf("choice", ("time", "speed", "angle")),
                "What stands first in points: the time in s, the speed in rad/s or the angle in "
                "rad of the link itself.",
            ),
            KeyShape(
                "points",
                ListOf(RowOf((ABSCISSA, _TORQUE), "abscissa, torque"), "points", unique=False),
                "Points in their order, straight between, constant outside.",
                examples=([[80, 900], [200, 1100], [260, 0]],),
            ),
            KeyShape("formula", TORQUE_CURVE, "A number or a formula of t, speed and angle."),
            KeyShape(
                "resistance",
                _TORQUE,
                "Dry friction: against the speed, and at rest it holds up to this torque, in N*m.",
                limits=_NOT_BELOW_0,
            ),
            KeyShape("road", ROAD, "Rolling resistance, air drag and slope."),
        ),
        GivenLaw,
        exactly_one("points", "formula", "resistance", "road", with_points=["over"]),
    ),
)

START = ByKey(
    "Start",
    "The speeds at t = 0: by a gear and the speed of its input, or by speeds and engaged elements "
    "that determine all others.",
    (
        KeyShape("gear", TEXT, "Name of a gear.", examples=("1",)),
        KeyShape("speed", SPEED, "Of the input in that gear, in rad/s; 0 when not given."),
        KeyShape(
            "speeds",
            Numbers("link", SPEED),
            "Of links, in rad/s.",
            examples=({"in": 60, "out": 0},),
        ),
        KeyShape(
            "engaged", ENGAGED, "Shift elements that do not slip at t = 0.", examples=(["FH"],)
        ),
        KeyShape("settled", FLAG, "Springs are loaded as they are at rest.", default=False),
    ),
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

SHIFT = ByKey(
    "Shift",
    "A shift to another gear.",
    (
        KeyShape("at", _TIME, "When it begins, in s.", required=True, limits=_NOT_BELOW_0),
        KeyShape("to", TEXT, "Name of the gear.", required=True),
        KeyShape("overlap", _TIME, "Time that it takes, in s.", default=0, limits=_NOT_BELOW_0),
    ),
)

SAMPLES = ByKey(
    "Distribution",
    "From which a number is drawn.",
    (
        KeyShape(
            "normal",
            RowOf((ANYTHING, ANYTHING), "mean, standard deviation"),
            "Normal: mean and standard deviation.",
        ),
        KeyShape(
            "lognormal",
            RowOf((NUMBER, NUMBER), "mean, standard deviation"),
            "Lognormal: mean and standard deviation of the logarithm.",
        ),
        KeyShape(
            "uniform", RowOf((ANYTHING, ANYTHING), "least, largest"), "Uniform between two numbers."
        ),
        KeyShape("min", ANYTHING, "Numbers below are this one."),
        KeyShape("max", ANYTHING, "Numbers above are this one."),
    ),
    Distribution,
    exactly_one("normal", "lognormal", "uniform"),
)

SCENARIO = ByKey(
    "Scenario",
    "What happens to a case over time; bare numbers are in SI.",
    (
        KeyShape("name", TEXT, "Name of the scenario, on one line."),
        KeyShape("description", TEXT, "What happens, as long as you like."),
        KeyShape("source", TEXT, "Where its data come from."),
        KeyShape("case", TEXT, "File of the case, relative to this one.", examples=("box.yaml",)),
        KeyShape("duration", _TIME, "In s.", required=True, limits=_ABOVE_0, examples=(6,)),
        KeyShape("start", START, "The speeds at t = 0.", required=True),
        KeyShape(
            "controls",
            Numbers("shift element", CONTROL),
            "Kinetic capacity of shift elements over time in N*m, or pressure in Pa where they "
            "have `friction`; what has none, and no shift moves, stays as the start has it.",
        ),
        KeyShape(
            "torques",
            Numbers("link", OneOrMany(LAW)),
            "Outside torques on links in N*m, positive like the input's; a law, or several.",
        ),
        KeyShape("converters", ByName("converter", CONVERTER), "Torque converters by their names."),
        KeyShape(
            "shifts",
            ListOf(SHIFT, "shifts", unique=False),
            "Shifts by names of gears, in their order; of several at one time the last holds.",
        ),
        KeyShape(
            "targets",
            Numbers("link", ByForm("a speed, or a list of speeds", SPEED, ListOf(SPEED))),
            "Speeds of links in rad/s, or in km/h on a road: when they are reached.",
            examples=({"vehicle": [8.3, 27.8]},),
        ),
        KeyShape(
            "samples",
            ByName("number", SAMPLES),
            "Distributions of numbers of this scenario or its case, by their paths.",
        ),
    ),
)
