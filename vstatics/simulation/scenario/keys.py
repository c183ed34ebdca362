"""Keys of a scenario in YAML and JSON, see `model.shape`; `given` has the types of their values."""

from __future__ import annotations

from typing import Any

from vstatics.core.model.keys import ENGAGED, ROLLING
from vstatics.core.model.shape import (
    FLAG,
    NUMBER,
    TEXT,
    ByForm,
    ByKey,
    ByName,
    Either,
    KeyShape,
    Leaf,
    ListOf,
    Measure,
    Numbers,
    OneOrMany,
    Parsed,
    RowOf,
    Shape,
)
from vstatics.core.model.torsional_keys import CONVERTER
from vstatics.simulation.scenario.distribution import Distribution
from vstatics.simulation.scenario.formula import OF_MOTION, OF_TORQUES, Vocabulary
from vstatics.simulation.scenario.given import (
    ABSCISSA,
    ANY_MEASURE,
    CAPACITY,
    SI_NUMBER,
    SPEED,
    SPEED_UNIT,
    TORQUE_UNIT,
    TWIST,
    GivenControl,
    GivenLaw,
    GivenSteps,
    GivenTable,
    condition,
    curve,
    exactly_one,
)
from vstatics.simulation.scenario.laws import Road, WheelRadius

_TIME, _TORQUE = Leaf("time"), Leaf("si_torque", straight=True)
_DOG_STATE = Leaf("choice", ("open", "closed"))
_NOT_BELOW_0 = {"minimum": 0}
_ABOVE_0 = {"exclusiveMinimum": 0}


def _points(x: Shape, y: Shape, names: str, what: str = "points") -> ListOf:
    """Return the shape of a list of pairs, such as points; a pair can be repeated."""
    return ListOf(RowOf((x, y), names), what, unique=False)


_CAPACITY_POINTS = _points(_TIME, CAPACITY, "time, capacity")
_TORQUE_POINTS = _points(_TIME, _TORQUE, "time, torque")


def _control(curve: Parsed) -> ByForm:
    return ByForm(
        "a capacity, a formula, points [[time, capacity], ...] or a mapping",
        curve,
        _CAPACITY_POINTS,
        ByKey(
            "Control",
            "Torque capacity of a shift element over time, or times at which a dog clutch closes "
            "and opens.",
            (
                KeyShape(
                    "points",
                    _CAPACITY_POINTS,
                    "Points [time in s, value] in the order of time, interpolated linearly and "
                    "held constant outside; if a time repeats, the later value holds from there.",
                ),
                KeyShape("formula", curve, "A number or a formula of t."),
                KeyShape(
                    "scale",
                    NUMBER,
                    "Factor of the points or the formula.",
                    default=1,
                    limits=_NOT_BELOW_0,
                ),
                KeyShape(
                    "dog",
                    _points(_TIME, _DOG_STATE, "time, state", "times"),
                    "Times from which the dog clutch is closed or open. Before the first time, it "
                    "is open, or closed if the start engages it and the first state is `open`.",
                    examples=([[1.5, "closed"]],),
                ),
            ),
            GivenControl,
            exactly_one("points", "formula", "dog"),
        ),
    )


_RADIUS = Either(
    Leaf("length"),
    "free",
    ByKey(
        "Rolling radius",
        "The radius falls with the torque that the road takes at a steady speed.",
        (
            KeyShape(
                "free",
                Leaf("length"),
                "Radius without torque, in m.",
                required=True,
                limits=_ABOVE_0,
            ),
            KeyShape(
                "by_torque", NUMBER, "Decrease of the radius per torque, in m/(N*m).", default=0
            ),
        ),
        WheelRadius,
    ),
)
ROAD = ByKey(
    "Road",
    "Resistance of a road to a vehicle, on a link that rotates like its wheels; g is 9.81 m/s^2, "
    "the density of air 1.2 kg/m^3.",
    (
        KeyShape(
            "mass", Leaf("mass"), "Mass of the vehicle, in kg.", required=True, limits=_ABOVE_0
        ),
        KeyShape(
            "radius",
            _RADIUS,
            "Radius of the wheels, in m, or a mapping with a radius that falls with torque.",
            required=True,
        ),
        KeyShape(
            "rolling",
            ROLLING,
            "Coefficient of rolling resistance; or points over the speed of the vehicle.",
            default=0,
        ),
        KeyShape(
            "drag_area", Leaf("area"), "Drag coefficient times frontal area, in m^2.", default=0
        ),
        KeyShape("slope", NUMBER, "Sine of the angle of ascent.", default=0),
    ),
    Road,
)


def _law(curve: Parsed) -> ByForm:
    return ByForm(
        "a torque, a formula, points [[time, torque], ...] or a mapping",
        curve,
        _TORQUE_POINTS,
        ByKey(
            "Torque",
            "A law of an external torque.",
            (
                KeyShape(
                    "over",
                    Leaf("choice", ("time", "speed", "angle")),
                    "First number of the points: the time in s, the speed in rad/s or the angle "
                    "in rad of the link itself.",
                ),
                KeyShape(
                    "points",
                    _points(ABSCISSA, _TORQUE, "abscissa, torque"),
                    "Points in ascending order, interpolated linearly and held constant outside.",
                    examples=([[80, 900], [200, 1100], [260, 0]],),
                ),
                KeyShape("formula", curve, "A number or a formula of t, speed and angle."),
                KeyShape(
                    "resistance",
                    _TORQUE,
                    "Dry friction, in N*m: it acts against the speed, and at rest it holds up to "
                    "this torque.",
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
    "The speeds at t = 0: by a gear and the speed of its input, or by speeds and engaged "
    "shift elements that determine all others.",
    (
        KeyShape("gear", TEXT, "Name of a gear.", examples=("1",)),
        KeyShape("speed", SPEED, "Speed of the input in that gear, in rad/s; 0 when not given."),
        KeyShape(
            "speeds",
            Numbers("link", SPEED),
            "Speeds of links, in rad/s.",
            examples=({"in": 60, "out": 0},),
        ),
        KeyShape(
            "engaged", ENGAGED, "Shift elements that do not slip at t = 0.", examples=(["FH"],)
        ),
        KeyShape("settled", FLAG, "Springs are loaded as they are at rest.", default=False),
        KeyShape(
            "twists",
            Numbers("elastic component", TWIST),
            "Twists of springs, in rad, or in m if they are straight; 0 when not given, unless "
            "others determine it.",
            examples=({"shaft": 0.02},),
        ),
        KeyShape(
            "angles",
            Numbers("link", TWIST),
            "Angles of links, in rad, or in m if they move straight; springs between links with "
            "given angles are twisted.",
            examples=({"crank": "90 deg"},),
        ),
    ),
)

SHIFT = ByKey(
    "Shift",
    "A shift to another gear.",
    (
        KeyShape(
            "at", _TIME, "Time at which the shift begins, in s.", required=True, limits=_NOT_BELOW_0
        ),
        KeyShape("to", TEXT, "Name of the gear.", required=True),
        KeyShape("overlap", _TIME, "Duration of the shift, in s.", default=0, limits=_NOT_BELOW_0),
    ),
)

SAMPLES = ByKey(
    "Distribution",
    "Distribution from which a number is drawn.",
    (
        KeyShape(
            "normal",
            RowOf((SI_NUMBER, SI_NUMBER), "mean, standard deviation"),
            "Normal: mean and standard deviation.",
        ),
        KeyShape(
            "lognormal",
            RowOf((NUMBER, NUMBER), "mean, standard deviation"),
            "Lognormal: mean and standard deviation of the logarithm.",
        ),
        KeyShape(
            "uniform",
            RowOf((SI_NUMBER, SI_NUMBER), "least, largest"),
            "Uniform between two numbers.",
        ),
        KeyShape("min", SI_NUMBER, "Least number; smaller numbers are replaced by it."),
        KeyShape("max", SI_NUMBER, "Largest number; larger numbers are replaced by it."),
    ),
    Distribution,
    exactly_one("normal", "lognormal", "uniform"),
)

TABLE = ByForm(
    "points [[x, value], ...], or a mapping with `file`, or with `columns` and `rows`",
    SI_NUMBER,
    _points(SI_NUMBER, SI_NUMBER, "x, value"),
    ByKey(
        "Table",
        "Values that formulas call by the name of the table, interpolated linearly and held "
        "constant outside.",
        (
            KeyShape(
                "file",
                TEXT,
                "CSV file, relative to the scenario, with a head such as `speed [rpm],0.2,0.5,1`: "
                "the name of the first variable, then the second variable of each other column.",
                examples=("engine.csv",),
            ),
            KeyShape(
                "columns",
                ListOf(SI_NUMBER, "numbers", unique=False),
                "The second variable of each column, ascending.",
                examples=([0.2, 0.5, 1],),
            ),
            KeyShape(
                "rows",
                ListOf(ListOf(SI_NUMBER, "numbers", unique=False), "rows", unique=False),
                "The first variable, ascending, then the value of each column.",
                examples=([[100, 20, 50, 90], [300, 25, 60, 110]],),
            ),
        ),
        GivenTable,
        exactly_one("file", "rows"),
    ),
)


def named_numbers() -> tuple[KeyShape, ...]:
    """Return the keys of named numbers and tables, which are read before any formula."""
    return (
        KeyShape(
            "numbers",
            ByName("number", SI_NUMBER),
            "Numbers by the names that formulas have for them.",
            examples=({"t_k": 0.46},),
        ),
        KeyShape("tables", ByName("table", TABLE), "Tables that formulas call by their names."),
    )


def _sequence(when: Parsed, value: Parsed) -> ByForm:
    step = ByKey(
        "Step",
        "Actions that follow when a condition becomes true.",
        (
            KeyShape("when", when, "Condition; without a condition, the step is due at once."),
            KeyShape(
                "within", _TIME, "Time within which it must become true, in s.", limits=_ABOVE_0
            ),
            KeyShape(
                "wait", _TIME, "Delay after it becomes true, in s.", default=0, limits=_NOT_BELOW_0
            ),
            KeyShape("set", ByName("number", value), "Numbers and states that are set."),
            KeyShape(
                "shift",
                ByKey(
                    "SequenceShift",
                    "A shift to another gear.",
                    tuple(key for key in SHIFT.keys if key.name != "at"),
                ),
                "A shift that begins then.",
            ),
            KeyShape(
                "dog",
                Numbers("shift element", _DOG_STATE),
                "Dog clutches that open or close.",
            ),
        ),
        fault=lambda **values: (
            ""
            if any(map(values.get, ("set", "shift", "dog")))
            else "read a step with nothing to do, expected `set`, `shift` or `dog`"
        ),
    )
    steps = ListOf(step, "steps", unique=False)
    return ByForm(
        "a list of steps, or a mapping with `steps`",
        None,
        steps,
        ByKey(
            "Sequence",
            "Steps that are done one after the other.",
            (
                KeyShape("steps", steps, "The steps.", required=True),
                KeyShape("repeat", FLAG, "Begin again after the last step.", default=False),
            ),
            GivenSteps,
        ),
    )


_GENERAL_KEYS = (
    KeyShape("name", TEXT, "Name of the scenario, on one line."),
    KeyShape("description", TEXT, "Description of the scenario, of any length."),
    KeyShape("source", TEXT, "Source of the data."),
    KeyShape("case", TEXT, "File of the case, relative to this one.", examples=("box.yaml",)),
    KeyShape(
        "duration",
        _TIME,
        "Duration of the simulation, in s.",
        required=True,
        limits=_ABOVE_0,
        examples=(6,),
    ),
    KeyShape(
        "start", START, "The speeds at t = 0; not needed where `speeds` determine all of them."
    ),
)
"""Keys of description, case, duration and start."""

_SHIFT_KEYS = (
    KeyShape(
        "converters",
        ByName("converter", CONVERTER),
        "Torque converters by their names, which replace the converters of the case.",
    ),
    KeyShape(
        "shifts",
        ListOf(SHIFT, "shifts", unique=False),
        "Shifts by names of gears, in their order; of several at one time the last holds.",
    ),
)
"""Keys of shifts, and of converters that replace converters of the case."""

_EVALUATION_KEYS = (
    KeyShape(
        "targets",
        Numbers("link", ByForm("a speed, or a list of speeds", SPEED, ListOf(SPEED))),
        "Speeds of links in rad/s, or in km/h on a road: when they are reached.",
        examples=({"vehicle": [8.3, 27.8]},),
    ),
    KeyShape(
        "static",
        ByKey(
            "Static",
            "Gear and input torque of a calculation of statics with losses. The largest torques of "
            "the run divided by the torques of statics are dynamic factors.",
            (
                KeyShape("gear", TEXT, "Name of a gear.", required=True, examples=("1",)),
                KeyShape("torque", _TORQUE, "Input torque, in N*m.", required=True),
            ),
        ),
        "Gear and input torque of statics, for dynamic factors.",
        examples=({"gear": "1", "torque": 150},),
    ),
    KeyShape(
        "samples",
        ByName("number", SAMPLES),
        "Distributions of numbers of this scenario or its case, by their paths.",
    ),
)
"""Keys of target speeds and of samples."""


def scenario_shape(words: Vocabulary) -> ByKey:
    """Return the keys of a scenario whose formulas use the names of a vocabulary."""
    return ByKey(
        "Scenario",
        "Events and controls of a case over time; numbers without a unit are in SI units.",
        (
            *_GENERAL_KEYS,
            *_keys_over_time(words),
            *_SHIFT_KEYS,
            *_control_keys(words),
            *_EVALUATION_KEYS,
        ),
    )


def _keys_over_time(words: Vocabulary) -> tuple[KeyShape, ...]:
    moving = words.only(*OF_MOTION)
    capacity = curve(
        "a capacity, or a formula of t", ["si_torque", "pressure"], moving, unit=TORQUE_UNIT
    )
    torque = curve(
        "a torque, or a formula of t, speed and angle",
        ["si_torque", "force"],
        moving,
        ["t", "speed", "angle"],
        TORQUE_UNIT,
    )
    limit = curve("a torque, or a formula of t", ["si_torque", "force"], moving, unit=TORQUE_UNIT)
    return (
        KeyShape(
            "controls",
            Numbers("shift element", _control(capacity)),
            "Kinetic capacity of shift elements over time in N*m, or pressure in Pa where they "
            "have `friction`; a shift element without a control or shift stays as at the start.",
        ),
        KeyShape(
            "torques",
            Numbers("link", OneOrMany(_law(torque))),
            "External torques on links in N*m: a law, or several. Positive torques act forward.",
        ),
        *_motion_keys(words),
        KeyShape(
            "limits",
            Numbers(
                "spring",
                ByForm(
                    "a torque, a formula, or points [[time, torque], ...]", limit, _TORQUE_POINTS
                ),
            ),
            "Torque limits of springs, over time or by a formula, in N*m; by default the `limit` "
            "of the case.",
            examples=({"tyre": [[0, 3000], [2, 1800]]},),
        ),
    )


def _motion_keys(words: Vocabulary) -> tuple[KeyShape, ...]:
    timed = words.only()._replace(values=())
    speed = curve("a speed, or a formula of t", ["si_speed", "velocity"], timed, unit=SPEED_UNIT)
    ratio = curve("a speed ratio, or a formula of t", ["angle"], timed)
    return (
        KeyShape(
            "speeds",
            Numbers(
                "link",
                ByForm(
                    "a speed, a formula of t, or points [[time, speed], ...]",
                    speed,
                    _points(_TIME, SPEED, "time, speed"),
                ),
            ),
            "Speeds of links that are given over time, in rad/s; their "
            "torques are in the column of torques.",
            examples=({"dyno": [[0, "500 rpm"], [10, "400 rpm"]]},),
        ),
        KeyShape(
            "speed_ratios",
            Numbers(
                "mechanism",
                ByForm(
                    "a speed ratio, a formula of t, or points [[time, ratio], ...]",
                    ratio,
                    _points(_TIME, NUMBER, "time, ratio"),
                ),
            ),
            "Speed ratios of variators over time, w_second/w_first, any sign, 0 included.",
            examples=({"hydro": [[0, 0.2], [2, -0.2]]},),
        ),
    )


def _control_keys(words: Vocabulary) -> tuple[KeyShape, ...]:
    value = curve("a number, or a formula", ANY_MEASURE, words.only(*OF_MOTION, *OF_TORQUES))
    state = ByKey(
        "State",
        "A number that changes by itself.",
        (
            KeyShape("rate", value, "Rate of change, by a formula.", required=True),
            KeyShape("start", SI_NUMBER, "Value at t = 0.", default=0),
            KeyShape("min", SI_NUMBER, "Least value."),
            KeyShape("max", SI_NUMBER, "Largest value."),
        ),
    )
    return (
        *named_numbers(),
        KeyShape(
            "states",
            ByName("state", state),
            "Numbers that change by themselves, dx/dt = rate, by their names.",
            examples=({"p": {"rate": "(command - p)/0.06"}},),
        ),
        KeyShape(
            "set",
            ByName("number", SI_NUMBER),
            "Initial values of numbers that sequences change.",
            examples=({"command": 0},),
        ),
        KeyShape(
            "sequences",
            ByName("sequence", _sequence(condition(words), value)),
            "Steps that are done one after the other, each when its condition becomes true.",
        ),
    )


SCENARIO = scenario_shape(Vocabulary())
MEASURES: tuple[Measure, ...] = (
    *("time", "si_torque", "si_speed", "mass", "length", "area", "velocity", "pump_factor"),
)
"""Measures that numbers of a scenario can have."""


def json_schema() -> dict[str, Any]:
    """Return the JSON schema of a scenario."""
    from vstatics.core.readers.named.schema import document_schema

    return document_schema(SCENARIO, MEASURES)
