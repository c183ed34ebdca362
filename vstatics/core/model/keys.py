"""Declarations of the keys of a case in YAML and JSON; see `model.shape`.

Each key has the name of an attribute of the model. Keys are read in the declared order, so links
come before the parts that refer to them.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from vstatics.core.errors import quoted, spoken
from vstatics.core.model.carried import CaseKey
from vstatics.core.model.fields import MOST_CYLINDERS
from vstatics.core.model.parts import (
    DIRECTIONS,
    ELEMENT_KINDS,
    GEAR_KINDS,
    MECHANISM_KINDS,
    CoefficientTable,
    Friction,
    Gear,
    ShiftElement,
    load_fault,
    load_of,
    mechanism_fault,
    mechanism_of,
)
from vstatics.core.model.shape import (
    COUNT,
    FLAG,
    LINK,
    NUMBER,
    SPEED,
    TEXT,
    TORQUE,
    Balances,
    ByKey,
    ByKind,
    ByLaw,
    ByName,
    ByPoints,
    Either,
    Ends,
    KeyShape,
    Leaf,
    LeafKind,
    Links,
    ListOf,
    Numbers,
    RowOf,
)
from vstatics.core.model.torsional_keys import ABOVE_0, CONVERTER, ELASTIC, SPRING

COEFFICIENTS = ByKey(
    "Coefficients",
    "Coefficients of friction over slip and temperature, interpolated linearly and held constant "
    "outside.",
    (
        KeyShape(
            "columns",
            ListOf(NUMBER, "temperatures", unique=False),
            "Temperatures in degrees Celsius in ascending order.",
            required=True,
            examples=([20, 120],),
        ),
        KeyShape(
            "rows",
            ListOf(ListOf(NUMBER, "numbers", unique=False), "rows", unique=False),
            "Slip in rad/s in ascending order, then the coefficient at each temperature.",
            required=True,
            examples=([[0, 0.13, 0.11], [20, 0.11, 0.10]],),
        ),
    ),
    CoefficientTable,
)

FRICTION = ByKey(
    "Friction",
    "Friction pack of a shift element, whose controls are then pressures, and its heating.",
    (
        KeyShape(
            "radius",
            Leaf("length"),
            "Mean radius of friction, in m.",
            required=True,
            unless="heat_capacity",
            limits=ABOVE_0,
            examples=(0.1,),
        ),
        KeyShape(
            "area",
            Leaf("area"),
            "Area on which the pressure acts, in m^2.",
            required=True,
            unless="heat_capacity",
            limits=ABOVE_0,
            examples=("60 cm^2",),
        ),
        KeyShape(
            "surfaces",
            COUNT,
            "Pairs of friction surfaces.",
            required=True,
            unless="heat_capacity",
            examples=(8,),
        ),
        KeyShape(
            "coefficient",
            ByPoints(RowOf((Leaf("si_speed"), NUMBER), "slip, coefficient"), COEFFICIENTS),
            "Coefficient of friction: a number, points [slip in rad/s, coefficient] in ascending "
            "order, interpolated linearly, or a mapping with coefficients at several temperatures.",
            required=True,
            unless="heat_capacity",
            examples=(0.12, [[0, 0.12], [10, 0.1]]),
        ),
        KeyShape(
            "heat_capacity",
            Leaf("heat_capacity"),
            "Heat capacity of the parts that friction warms, in J/K; a scenario then calculates "
            "their temperature.",
            limits=ABOVE_0,
            examples=(900,),
        ),
        KeyShape(
            "cooling",
            Leaf("cooling"),
            "Heat transfer to the surroundings, in W/K.",
            default=0,
            limits={"minimum": 0},
        ),
        KeyShape(
            "ambient",
            NUMBER,
            "Temperature of the surroundings and at the start, in degrees Celsius.",
            default=0,
        ),
    ),
    Friction,
)

DRAG = ByLaw(
    Leaf("drag"),
    ByKey(
        "Points",
        "Points in a file, in columns `speed [unit],torque [unit]`.",
        (
            KeyShape(
                "file",
                TEXT,
                "Name of a CSV file, relative to the case.",
                required=True,
                examples=("drag.csv",),
            ),
        ),
    ),
    RowOf((Leaf("si_speed"), Leaf("si_torque")), "speed, torque"),
)
"""Declaration of a drag torque: relative to the input torque [-], or a law over speed."""


def _law(over: Any, points: Any) -> Any:
    from vstatics.core.model.laws import PointLaw  # costs start-up time

    return PointLaw(points, over)


def _map(columns: Any = (), rows: Any = (), unit: Any = "", **others: Any) -> Any:
    """Return a map, or the unchanged values if `file` names a file with the map."""
    from vstatics.core.model.laws import MapLaw  # costs start-up time

    return others if "file" in others else MapLaw(columns, rows, unit)


def _map_fault(file: str | None = None, **others: object) -> str:
    """Return a message if both a file and the document contain a map, else an empty text."""
    beside = [quoted(name) for name in ("columns", "rows", "unit") if name in others]
    if file is None or not beside:
        return ""
    return f"read `file` and {spoken(beside)}, expected `file` alone: the file has them"


def _map_keys(values: str, head: str, of: str, *others: KeyShape) -> ByKey:
    """Return the declaration of a map over speed and torque.

    Parameters
    ----------
    values : str
        Name of the values in messages, such as ``efficiency``.
    head : str
        Heading of the column of values in a file.
    of : str
        Description of the key `over`: which speed and torque are meant.
    *others : KeyShape
        Further keys.
    """
    return ByKey(
        f"Map of {values} over speed and torque",
        "Values at the points of a grid, interpolated linearly in both directions and held "
        "constant outside.",
        (
            KeyShape("over", ListOf(Leaf("choice", ("speed", "torque"))), of, required=True),
            KeyShape(
                "columns",
                ListOf(Leaf("si_torque"), "torques", unique=False),
                "Torques in ascending order, in N*m.",
                required=True,
                unless="file",
                examples=([10, 60, 200],),
            ),
            KeyShape(
                "rows",
                ListOf(
                    RowOf((Leaf("si_speed"), NUMBER), f"speed, {values}, ...", more=NUMBER),
                    "rows",
                    unique=False,
                ),
                "Rows in ascending order of speed: the speed in rad/s, then the value at each "
                "torque.",
                required=True,
                unless="file",
                examples=([[50, 0.90, 0.95, 0.96], [400, 0.93, 0.97, 0.98]],),
            ),
            KeyShape(
                "file",
                TEXT,
                "Name of a CSV file, relative to the case, with the columns `speed [unit]`, "
                f"`torque [unit]` and `{head}`: a full grid, with rows in any order.",
                examples=("map.csv",),
            ),
            *others,
        ),
        _map,
        _map_fault,
    )


MAP = "[speed, torque]"
"""Value of the key `over` for a map whose rows begin with a speed."""


def _map_alone(values: str, head: str, of: str, *others: KeyShape) -> ByKind:
    """Return the declaration of a law that must be a map; see `_map_keys` for the parameters."""
    return ByKind({MAP: _map_keys(values, head, of, *others)}, "over")


def _efficiency_over(over: str, measure: LeafKind, of: str) -> ByKey:
    return ByKey(
        f"Efficiency over {over}",
        "Points, interpolated linearly and held constant outside.",
        (
            KeyShape("over", Leaf("choice", ("speed", "torque")), of, required=True),
            KeyShape(
                "points",
                ListOf(RowOf((Leaf(measure), NUMBER), f"{over}, efficiency")),
                "Points in ascending order.",
                required=True,
                examples=([[0, 0.9], [150, 0.975]],),
            ),
        ),
        _law,
    )


EFFICIENCY = ByLaw(
    Leaf("efficiency"),
    ByKind(
        {
            MAP: _map_keys(
                "efficiency",
                "efficiency",
                "Magnitudes of the speed of the first link relative to the third, in rad/s, and of "
                "the torque on the first link, in N*m.",
            ),
            "speed": _efficiency_over(
                "speed",
                "si_speed",
                "Magnitude of the speed of the first link relative to the third, in rad/s.",
            ),
            "torque": _efficiency_over(
                "torque", "si_torque", "Magnitude of the torque on the first link, in N*m."
            ),
        },
        "over",
    ),
    values="efficiency",
)
"""Declaration of an efficiency [-]: a number, or a law over speed [rad/s] and torque [N*m]."""

MACHINE_EFFICIENCY = ByLaw(
    Leaf("efficiency"),
    _map_alone(
        "efficiency",
        "efficiency",
        "Magnitude of the speed of the machine, in rad/s, and its torque in N*m, below 0 against "
        "the speed; without torques below 0 both directions count alike.",
    ),
    values="efficiency",
)
"""Key of the efficiency of an electric machine: a number, a map or a formula. [-]"""

GEAR_LOSS = ByLaw(
    None,
    _map_alone(
        "loss",
        "loss [W]",
        "Magnitudes of the speed of the input in rad/s, and of its torque in N*m.",
        KeyShape("unit", Leaf("choice", ("W", "kW", "N*m")), "Unit of the losses; by default W."),
    ),
    values="loss",
)
"""Declaration of a loss measured for a whole gear, over input speed [rad/s] and torque [N*m]."""

ROLLING = Either(
    NUMBER,
    "points",
    ByKey(
        "Rolling resistance over speed",
        "Points, interpolated linearly and held constant outside.",
        (
            KeyShape("over", Leaf("choice", ("speed",)), "Speed of the vehicle.", required=True),
            KeyShape(
                "points",
                ListOf(RowOf((Leaf("velocity"), NUMBER), "speed, coefficient"), unique=False),
                "Points [speed in m/s, from 0 on, coefficient].",
                required=True,
                examples=([[0, 0.01], [30, 0.016]],),
            ),
        ),
        lambda points, over="speed": points if over else (),
    ),
)
"""Declaration of a coefficient of rolling resistance [-]: a number, or points over speed [m/s]."""

ELEMENT = ByKey(
    "Shift element",
    "A clutch, brake, dog clutch or freewheel.",
    (
        KeyShape(
            "kind",
            Leaf("choice", ELEMENT_KINDS),
            "Kind of the shift element; by default a clutch between two links, and a brake between "
            "a link and the housing. A freewheel keeps its first link from turning backward "
            "against the second, and is never engaged.",
        ),
        KeyShape(
            "links",
            Ends(),
            "First and second link.",
            required=True,
            examples=(["carrier", "housing"],),
        ),
        KeyShape(
            "drag",
            DRAG,
            "Drag torque when disengaged, relative to the input torque, or a formula of "
            "w = |slip| in rad/s, or points [rad/s, N*m].",
            default=0,
            limits={"minimum": 0},
            examples=(0.002,),
        ),
        KeyShape(
            "capacity",
            TORQUE,
            "Torque capacity, relative to the input torque of the case, or with a unit, for the "
            "margins of `vstatics summary`.",
            limits=ABOVE_0,
            examples=("600 N*m",),
        ),
        KeyShape(
            "static",
            NUMBER,
            "Static-to-dynamic friction ratio, for scenarios.",
            default=1,
            limits={"minimum": 1},
            examples=(1.2,),
        ),
        KeyShape(
            "friction",
            FRICTION,
            "Friction pack; in a scenario, controls are then pressures.",
        ),
        *ELASTIC,
    ),
    lambda links, **others: ShiftElement(*links, **others),
)

MECHANISM = ByKey(
    "Mechanism",
    "Mechanism with three links: planetary gear set, gear pair, shaft or support.",
    (
        KeyShape("first", LINK, "First link; the sun of a planetary set.", required=True),
        KeyShape("second", LINK, "Second link; the ring of a planetary set.", required=True),
        KeyShape(
            "third",
            LINK,
            "Third link; the carrier of a planetary set. `housing` means that it is always held; "
            "without a third link, the mechanism is a gear pair.",
        ),
        KeyShape(
            "ratio",
            NUMBER,
            "Basic ratio (w_first - w_third)/(w_second - w_third); a variator or converter has a "
            "speed ratio instead.",
            required=True,
            unless="kind",
            limits={"not": {"const": 0}},
            examples=(-2.461, "-96/39"),
        ),
        KeyShape(
            "kind",
            Leaf("choice", MECHANISM_KINDS),
            "A variator, or a hydrodynamic converter, between two links.",
        ),
        KeyShape(
            "speed_ratio",
            NUMBER,
            "Speed ratio w_second/w_first of a variator or converter, unless a gear gives it.",
            examples=(0.4,),
        ),
        KeyShape(
            "points",
            ListOf(
                RowOf((NUMBER, NUMBER), "speed ratio, torque ratio", (Leaf("pump_factor"),)),
            ),
            "Points [speed ratio, torque ratio M_second/M_first] of a converter in ascending "
            "order, interpolated linearly. With a third number, lambda in N*m*s^2, vibration and "
            "scenarios treat it like an entry of `converters`.",
            examples=([[0, 2.4], [0.8, 1]],),
        ),
        KeyShape(
            "efficiency",
            EFFICIENCY,
            "Efficiency with the third link held, above 0 and up to 1; or points over speed or "
            "torque, a map over both, or a formula of w in rad/s and T in N*m.",
            default=1,
            limits={"exclusiveMinimum": 0, "maximum": 1},
            examples=(0.97,),
        ),
        KeyShape(
            "back_efficiency",
            EFFICIENCY,
            "Efficiency if power flows from the second link to the first; by default `efficiency`. "
            "With 0 the mechanism is self-locking.",
            limits={"minimum": 0, "maximum": 1},
            examples=(0.7,),
        ),
        KeyShape(
            "planet_ratio",
            NUMBER,
            "Ratio of first link to planet with the third link held; by default the ratio of a "
            "simple planetary set.",
            limits={"not": {"const": 0}},
        ),
        *ELASTIC,
    ),
    mechanism_of,
    mechanism_fault,
)

LOAD = ByKey(
    "Load",
    "Two of speed, torque and power at the input link, for a second set of tables in rpm, N*m "
    "and kW.",
    (
        KeyShape("speed", Leaf("speed"), "Speed of the input.", examples=("2100 rpm",)),
        KeyShape("torque", Leaf("torque"), "Torque of the input.", examples=("1200 N*m",)),
        KeyShape(
            "power",
            Leaf("power"),
            "Power at the input, which together with speed or torque gives the other of the two.",
            examples=("120 kW",),
        ),
    ),
    load_of,
    load_fault,
)

COAST = KeyShape(
    "coast",
    FLAG,
    "True if power enters at the output (engine braking): the input torque then acts against the "
    "input speed, otherwise along it. By default the sign of the input power decides.",
)
ENGAGED = ListOf(Leaf("element"), "shift elements")
"""Declaration of the key with the shift elements that a gear engages."""

GEAR = ByKey(
    "Gear",
    "Engaged shift elements of a gear, and further given values.",
    (
        KeyShape(
            "engaged",
            ENGAGED,
            "Names of the engaged shift elements.",
            examples=(["T1", "F2"],),
        ),
        KeyShape(
            "speeds",
            Numbers("link", SPEED),
            "Further given speeds of links, relative to the input speed, with a unit, or as a "
            "multiple of the speed of another link.",
            examples=({"generator": 1.2}, {"FR": "1.05*FL"}),
        ),
        KeyShape(
            "torques",
            Numbers("link", TORQUE),
            "Further external torques, relative to the input torque, or with a unit.",
        ),
        KeyShape(
            "drag",
            Numbers("link", DRAG, {"minimum": 0}),
            "Drag of bearings and oil on links, against their rotation, relative to the input "
            "torque; or a formula of w = |speed| in rad/s, or points [rad/s, N*m].",
        ),
        KeyShape(
            "open_drag",
            Numbers("shift element", DRAG, {"minimum": 0}),
            "Drag of disengaged shift elements in this gear, instead of their `drag`.",
        ),
        KeyShape(
            "speed_ratios",
            Numbers("mechanism", NUMBER),
            "Speed ratios of variators and converters in this gear.",
            examples=({"hydro": -0.2},),
        ),
        KeyShape(
            "slip",
            Numbers("shift element", Leaf("slip")),
            "Slip, speed of the first link minus speed of the second, of clutches and brakes that "
            "slip under torque, relative to the input speed, or with a unit.",
            examples=({"C1": "300 rpm"},),
        ),
        KeyShape(
            "open",
            ListOf(Leaf("converter"), "converters"),
            "Converters that transmit nothing in this gear, such as drained fluid couplings.",
            examples=(["TC"],),
        ),
        KeyShape(
            "loss",
            GEAR_LOSS,
            "Loss of the gear, measured as a whole, which brakes the input link beside all other "
            "losses.",
            examples=({"over": ["speed", "torque"], "file": "gear1.csv"},),
        ),
        KeyShape("input", LINK, "Input link of this gear."),
        KeyShape(
            "input_turns",
            Leaf("choice", DIRECTIONS),
            "Direction in which the input turns, for freewheels, if no operating point gives it.",
        ),
        KeyShape("output", LINK, "Output link of this gear."),
        KeyShape("load", LOAD, "Operating point of this gear."),
        COAST,
        KeyShape(
            "balance",
            Balances(
                Numbers("link", MACHINE_EFFICIENCY, {"exclusiveMinimum": 0, "maximum": 1}),
                "battery",
            ),
            "Efficiencies of machines on links, each a number, a map over speed and torque, or a "
            "formula of w in rad/s and T in N*m; and the power that charges the `battery`. The "
            "torque of the only link without a given speed or torque follows.",
            examples=({"MG1": 0.92, "MG2": 0.9, "battery": "-2 kW"},),
        ),
        KeyShape(
            "kind",
            Leaf("choice", GEAR_KINDS),
            "`neutral`: the gear is neutral on purpose and gets no warning. `point`: it is an "
            "operating point. Both have no step ratio and are not part of the spread.",
            default="gear",
        ),
    ),
    Gear,
)

CASE = ByKey(
    "Transmission",
    "A vehicle transmission, described by its stick diagram.",
    (
        KeyShape("name", TEXT, "Name of the transmission, on one line."),
        KeyShape("description", TEXT, "Description of the transmission, of any length."),
        KeyShape("source", TEXT, "Source of the data."),
        KeyShape(
            "links",
            Links(),
            "Main links without the housing: their number, or their names in order.",
            required=True,
            examples=(6, ["sun", "ring", "carrier"]),
        ),
        KeyShape("input", LINK, "Input link.", default=1),
        KeyShape("output", LINK, "Output link; by default the last link."),
        KeyShape(
            "outputs",
            ListOf(LINK, "links"),
            "All output links, if there are several. The first is `output`; each other link needs "
            "a given speed or torque in every gear.",
            examples=(["FL", "FR", "RL", "RR"],),
        ),
        KeyShape(
            "idle",
            Leaf("choice", ("exact", "published")),
            "Sign of the power of unloaded mechanisms: 0 (exact), or +1 or -1 as in the listing of "
            "Visual-Statics (published).",
            default="exact",
        ),
        KeyShape("load", LOAD, "Operating point of all gears that do not give their own."),
        KeyShape(
            "drag",
            Numbers("link", DRAG, {"minimum": 0}),
            "Drag of bearings and oil on links, unless a gear gives the drag of the link.",
        ),
        COAST,
        KeyShape(
            "shift_elements",
            ByName("shift element", Either(Ends(), "links", ELEMENT, written=True)),
            "Clutches, brakes and freewheels in order: name and [first link, second link], or a "
            "mapping with `links`.",
        ),
        KeyShape(
            "mechanisms",
            ByName("mechanism", MECHANISM),
            "Mechanisms in order, each under its name.",
            required=True,
        ),
        KeyShape(
            "inertias",
            Numbers("link", Leaf("inertia"), {"minimum": 0}),
            "Moments of inertia of links, in kg*m^2; 0 for links that are not listed.",
            examples=({"engine": 0.15},),
        ),
        KeyShape(
            "masses",
            Numbers("link", Leaf("mass"), {"minimum": 0}),
            "Masses of links that move straight, in kg; their displacements are in m, and springs "
            "between them in N/m.",
            examples=({"body": "1140 kg"},),
        ),
        KeyShape(
            "springs",
            ByName("spring", SPRING),
            "Elastic components in order, each under its name. A case with springs or inertias "
            "needs no mechanisms, links or gears.",
        ),
        KeyShape(
            "converters",
            ByName("converter", CONVERTER),
            "Torque converters by their names, for vibration, and for scenarios without their own.",
        ),
        KeyShape(
            "gears",
            ByName("gear", Either(ENGAGED, "engaged", GEAR)),
            "Gears in order, each under its name: a list of engaged shift elements, or a mapping. "
            "A case without shift elements can omit them: it has a single gear.",
            examples=({"low": ["C1", "B1"]},),
        ),
        KeyShape(
            "cylinders",
            COUNT,
            "Number of cylinders of the four-stroke engine at the input, for pictures of "
            "vibration; half of them fire in each revolution.",
            limits={"minimum": 1, "maximum": MOST_CYLINDERS},
            examples=(4,),
        ),
        KeyShape(
            "allow",
            ListOf(Leaf("text"), "messages"),
            "Ids of warnings and notes that are not printed.",
            examples=(["W201"],),
        ),
    ),
)


def with_carried(case: ByKey, keys: Iterable[CaseKey]) -> ByKey:
    """Return the declaration of a case with the keys of annexes added before the key `allow`."""
    *others, allow = case.keys
    return case._replace(keys=(*others, *(key.shape for key in keys), allow))


def with_masses(case: ByKey) -> ByKey:
    """Return the declaration of a case with springs or inertias, where mechanisms are optional."""
    free = {"mechanisms", "links"}
    keys = (key._replace(required=key.required and key.name not in free) for key in case.keys)
    return case._replace(keys=tuple(keys))
