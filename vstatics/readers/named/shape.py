"""The shape of a case in YAML and JSON, declared once.

The reader checks documents against it, the JSON Schema is made from it. Keys are
the attributes of the model's classes, in the order in which they are read: what
others refer to comes first.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal, TypeAlias

from vstatics.model.parts import ELEMENT_KINDS

LeafKind = Literal[
    "text",
    "number",
    "count",
    "speed",
    "torque",
    "relative_speed",
    "relative_torque",
    "link",
    "element",
    "flag",
    "choice",
]


@dataclass(frozen=True, slots=True)
class Leaf:
    """A single value."""

    kind: LeafKind
    choices: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Links:
    """The number of links, or their names in order."""


@dataclass(frozen=True, slots=True)
class Ends:
    """The links of a shift element, first and second."""

    least: int = 2
    """With 1 the second may be missing, which is the housing."""


@dataclass(frozen=True, slots=True)
class Engaged:
    """Names of shift elements."""


@dataclass(frozen=True, slots=True)
class ByLink:
    """Links with a number for each."""

    limits: Mapping[str, Any] = field(default_factory=dict)
    """As those of a `Key`, for each number."""
    item: Leaf = Leaf("number")


@dataclass(frozen=True, slots=True)
class ByElement:
    """Names of shift elements with a number for each."""

    limits: Mapping[str, Any] = field(default_factory=dict)
    item: Leaf = Leaf("number")


@dataclass(frozen=True, slots=True)
class Key:
    """A key of a record: its attribute in the model, and what stands behind it.

    `default` is for keys whose default the document fixes; `limits` are words of
    JSON Schema for numbers, which the model checks in its own words.
    """

    name: str
    shape: Shape
    description: str
    required: bool = False
    default: Any = None
    limits: Mapping[str, Any] = field(default_factory=dict)
    examples: tuple[Any, ...] = ()


@dataclass(frozen=True, slots=True)
class Record:
    """A mapping of known keys."""

    title: str
    description: str
    keys: tuple[Key, ...]

    @property
    def required(self) -> list[str]:
        """Names of the keys that must be there."""
        return [key.name for key in self.keys if key.required]


@dataclass(frozen=True, slots=True)
class Either:
    """A list of links, or a record with the key `links`: a shift element."""

    links: Ends
    record: Record


@dataclass(frozen=True, slots=True)
class Named:
    """Items of one kind in order, each under its name."""

    kind: str
    item: Shape


@dataclass(frozen=True, slots=True)
class ListOf:
    """Items of one shape in order."""

    item: Shape


@dataclass(frozen=True, slots=True)
class Pair:
    """Two names."""

    kind: str


@dataclass(frozen=True, slots=True)
class ByKind:
    """A mapping whose other keys depend on its `kind`."""

    records: Mapping[str, Record]


Shape: TypeAlias = (
    Leaf
    | Links
    | Ends
    | Engaged
    | ByLink
    | ByElement
    | Record
    | Either
    | Named
    | ListOf
    | Pair
    | ByKind
)

TEXT, NUMBER, LINK, FLAG = Leaf("text"), Leaf("number"), Leaf("link"), Leaf("flag")
COUNT, SPEED, TORQUE = Leaf("count"), Leaf("relative_speed"), Leaf("relative_torque")

ELEMENT = Record(
    "Shift element",
    "A clutch, brake, dog clutch or freewheel.",
    (
        Key(
            "kind",
            Leaf("choice", ELEMENT_KINDS),
            "What it is; with two links a clutch, with the housing a brake when not given. A "
            "freewheel keeps its first link from turning backward against the second, and is "
            "never engaged.",
        ),
        Key(
            "links",
            Ends(least=1),
            "First and second link; one link alone is held against the housing.",
            required=True,
            examples=(["carrier", "housing"],),
        ),
        Key(
            "drag",
            TORQUE,
            "Torque with which it drags when open, relative to the input torque.",
            default=0,
            limits={"minimum": 0},
            examples=(0.002,),
        ),
        Key(
            "capacity",
            TORQUE,
            "Torque that it can carry, relative to the input torque of the case, or with a unit; "
            "for the margins of `vstatics summary`.",
            limits={"exclusiveMinimum": 0},
            examples=("600 N*m",),
        ),
    ),
)

MECHANISM = Record(
    "Mechanism",
    "A three-link device of constant structure: planetary set, gear pair, shaft, support.",
    (
        Key("first", LINK, "First link; the sun of a planetary set.", required=True),
        Key("second", LINK, "Second link; the ring of a planetary set.", required=True),
        Key("third", LINK, "Third link; the carrier of a planetary set.", default=0),
        Key(
            "ratio",
            NUMBER,
            "Internal ratio (w_first - w_third)/(w_second - w_third).",
            required=True,
            limits={"not": {"const": 0}},
            examples=(-2.461, "-96/39"),
        ),
        Key(
            "efficiency",
            NUMBER,
            "Efficiency with the third link held, above 0 and up to 1.",
            default=1,
            limits={"exclusiveMinimum": 0, "maximum": 1},
            examples=(0.97,),
        ),
        Key(
            "back_efficiency",
            NUMBER,
            "Efficiency where power flows from the second link to the first, if it is another "
            "one; 0 is self-locking.",
            limits={"minimum": 0, "maximum": 1},
            examples=(0.7,),
        ),
        Key(
            "planet_ratio",
            NUMBER,
            "Ratio first link to planet, third link held; known by itself for a plain set.",
            limits={"not": {"const": 0}},
        ),
    ),
)

LOAD = Record(
    "Load",
    "Speed and torque at the input link, for a second set of tables in rpm, N*m and kW.",
    (
        Key("speed", Leaf("speed"), "Speed of the input.", examples=("2100 rpm",)),
        Key("torque", Leaf("torque"), "Torque of the input.", examples=("1200 N*m",)),
    ),
)

GEAR = Record(
    "Gear",
    "A shift state: what is engaged, and what is given besides.",
    (
        Key("engaged", Engaged(), "Names of the engaged shift elements.", examples=(["T1", "F2"],)),
        Key(
            "speeds",
            ByLink(item=SPEED),
            "Further given link speeds, relative to the input speed, or with a unit.",
        ),
        Key(
            "torques",
            ByLink(item=TORQUE),
            "Further external torques, relative to the input torque, or with a unit.",
        ),
        Key(
            "drag",
            ByLink({"minimum": 0}, TORQUE),
            "Drag of bearings and oil on links, against their rotation, relative to the input "
            "torque.",
        ),
        Key(
            "open_drag",
            ByElement({"minimum": 0}, TORQUE),
            "Drag of shift elements in this gear when they are open, in place of their own.",
        ),
        Key("input", LINK, "This gear's own input link."),
        Key("output", LINK, "This gear's own output link."),
        Key("load", LOAD, "This gear's own load."),
    ),
)

CASE = Record(
    "Transmission",
    "A vehicle transmission by its kinematic scheme.",
    (
        Key("name", TEXT, "Name of the transmission, on one line."),
        Key("description", TEXT, "What the transmission is, as long as you like."),
        Key("source", TEXT, "Where its data come from."),
        Key(
            "links",
            Links(),
            "Main links without the housing: their number, or their names in order.",
            required=True,
            examples=(6, ["sun", "ring", "carrier"]),
        ),
        Key("input", LINK, "Input link.", default=1),
        Key("output", LINK, "Output link; the last one when not given."),
        Key(
            "idle",
            Leaf("choice", ("exact", "published")),
            "Sign of idle mechanisms: 0 (exact), or as in the published tables.",
            default="exact",
        ),
        Key("load", LOAD, "Load of all gears that give none themselves."),
        Key(
            "drag",
            ByLink({"minimum": 0}, TORQUE),
            "Drag of bearings and oil on links, in all gears that give none of that link.",
        ),
        Key("coast", FLAG, "Power enters at the output (engine braking).", default=False),
        Key(
            "shift_elements",
            Named("shift element", Either(Ends(), ELEMENT)),
            "Clutches, brakes and freewheels in order: name and [first link, second link], or a "
            "mapping with `links`.",
        ),
        Key(
            "mechanisms",
            Named("mechanism", MECHANISM),
            "Mechanisms in order, each under its name.",
            required=True,
        ),
        Key("gears", Named("gear", GEAR), "Gears in order, each under its name.", required=True),
    ),
)
