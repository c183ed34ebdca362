"""The words in which the shape of a document is declared: a key, and what may stand behind it.

One declaration serves all who know the keys of YAML and JSON: the reader walks along it,
the writer goes it the other way, the JSON Schema is made from it. `model.keys` and
`elements.keys` declare a case.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any, Literal, NamedTuple, Self, TypeAlias

Measure = Literal[
    "inertia",
    "stiffness",
    "compliance",
    "damping",
    "mass",
    "length",
    "si_torque",
    "si_speed",
    "area",
    "section_modulus",
    "stress",
    "pressure",
    "time",
    "angle",
    "velocity",
    "pump_factor",
    "heat_capacity",
    "cooling",
    "force",
    "straight_stiffness",
    "straight_compliance",
    "straight_damping",
]
"""What is given in SI, with its unit or without."""
UNIT_OF: Mapping[Measure, str] = {
    "inertia": "kg*m^2",
    "stiffness": "N*m/rad",
    "compliance": "rad/(N*m)",
    "damping": "N*m*s/rad",
    "mass": "kg",
    "length": "m",
    "si_torque": "N*m",
    "si_speed": "rad/s",
    "area": "m^2",
    "section_modulus": "m^3",
    "stress": "Pa",
    "pressure": "Pa",
    "time": "s",
    "angle": "rad",
    "velocity": "m/s",
    "pump_factor": "N*m*s^2",
    "heat_capacity": "J/K",
    "cooling": "W/K",
    "force": "N",
    "straight_stiffness": "N/m",
    "straight_compliance": "m/N",
    "straight_damping": "N*s/m",
}
"""What bare numbers are in."""
STRAIGHT: Mapping[Measure, Measure] = {
    "stiffness": "straight_stiffness",
    "compliance": "straight_compliance",
    "damping": "straight_damping",
    "si_torque": "force",
    "angle": "length",
    "si_speed": "velocity",
}
"""What stands, where something moves straight, for a measure of what turns."""

LeafKind = (
    Measure
    | Literal[
        "text",
        "number",
        "count",
        "share",
        "speed",
        "torque",
        "power",
        "relative_speed",
        "relative_torque",
        "drag",
        "link",
        "element",
        "flag",
        "choice",
    ]
)
UNITS: Mapping[str, str] = {"speed": "rpm", "torque": "N*m", "power": "kW"}
"""Units of speeds, torques and powers that are not relative."""

Limits: TypeAlias = Mapping[str, Any]
"""Words of JSON Schema for numbers, which the model checks in its own words."""
NO_LIMITS: Limits = MappingProxyType({})


class Leaf(NamedTuple):
    """A single value."""

    kind: LeafKind
    choices: tuple[str, ...] = ()
    infinite: bool = False
    """Whether a number may be `.inf`."""
    straight: bool = False
    """Whether its measure may also be that of what moves straight."""


class InUnit(float):
    """A number in SI that knows what its unit measures."""

    measure: Measure | None
    """None: it is bare."""

    def __new__(cls, value: float, measure: Measure | None) -> Self:
        """Keep what it measures."""
        made = super().__new__(cls, value)
        made.measure = measure
        return made


class Links(NamedTuple):
    """The number of links, or their names in order."""


class Ends(NamedTuple):
    """The links of a shift element, first and second."""

    least: int = 2
    """With 1 the second may be missing, which is the housing."""


class Numbers(NamedTuple):
    """Links or shift elements with a number for each, or with what else it has in its place."""

    by: Literal["link", "shift element", "mechanism", "spring", "elastic device"]
    item: Shape
    limits: Limits = NO_LIMITS


class Shares(NamedTuple):
    """Names of gears, of whatever case, with a share for each."""


class KeyShape(NamedTuple):
    """A key: the attribute that it is in the model, if it is one, and what stands behind it.

    `default` is for keys whose default the document fixes.
    """

    name: str
    shape: Shape
    description: str
    required: bool = False
    default: Any = None
    limits: Limits = NO_LIMITS
    examples: tuple[Any, ...] = ()
    unless: str = ""
    """Another key beside which this one need not be there."""

    def leaves_out(self, value: Any) -> bool:
        """Whether a value says what a document says that has not the key.

        >>> KeyShape("drag", NUMBER, "Drag.", default=0).leaves_out(0.0)
        True
        """
        return bool(value == self.default or not (value or isinstance(value, (float, int))))


class ByKey(NamedTuple):
    """A mapping of known keys."""

    title: str
    description: str
    keys: tuple[KeyShape, ...]
    make: Callable[..., Any] = dict
    """What the reader makes of the values, given by their keys: a part of the model."""
    fault: Callable[..., str] = lambda **_: ""
    """What values that are each right are not right together: what was read, what was expected."""

    @property
    def required(self) -> list[str]:
        """Names of the keys that must be there."""
        return [key.name for key in self.keys if key.required and not key.unless]


class Either(NamedTuple):
    """A record, or in its place a list or a number, which is one of its keys and says all."""

    short: Ends | ListOf | Leaf
    key: str
    record: ByKey
    written: bool = False
    """Whether it is written as a list where that says all."""


class ByName(NamedTuple):
    """Items of one kind in order, each under its name."""

    kind: str
    item: Shape


class ListOf(NamedTuple):
    """Items of one shape in order."""

    item: Shape
    kind: str = ""
    """What messages call the items."""
    unique: bool = True
    """Whether each, where it is of a kind, is the only one of its name."""


class Pair(NamedTuple):
    """Two names."""

    kind: str


class RowOf(NamedTuple):
    """Values in a fixed order, in a list."""

    items: tuple[Shape, ...]
    kind: str
    """What messages call them: ``slip, coefficient``."""
    optional: tuple[Shape, ...] = ()
    """What may stand behind them."""


class ByPoints(NamedTuple):
    """A number, or points in order of which it is the constant one: rows of two; or a mapping."""

    row: RowOf
    mapping: ByKey


class Parsed(NamedTuple):
    """A single value that a room reads itself."""

    expected: str
    parse: Callable[[str], Any]
    """Text -> value; it raises ValueError with what was expected, or ReadError with the column."""
    stand_in: Any
    unit: str = ""
    """What bare numbers are in, where that is always the same."""


class ByForm(NamedTuple):
    """A single value, a list or a mapping, each with a shape of its own."""

    expected: str
    scalar: Leaf | Parsed
    listing: ListOf
    mapping: ByKey | None = None


class OneOrMany(NamedTuple):
    """One item, or several in a list; a list of lists of single values is one."""

    item: ByForm


class ByLaw(NamedTuple):
    """A number, or a law: in a text, in points, or in a mapping."""

    scalar: Leaf
    mapping: ByKey | ByKind
    row: RowOf | None = None
    """Of points that stand alone."""


class Balances(NamedTuple):
    """Numbers of links, and a power under a word of its own."""

    links: Numbers
    power: str


class ByKind(NamedTuple):
    """A mapping whose other keys depend on one of them."""

    records: Mapping[str, ByKey]
    key: str = "kind"


Shape: TypeAlias = (
    Leaf
    | Links
    | Ends
    | Numbers
    | Shares
    | ByKey
    | Either
    | ByName
    | ListOf
    | Pair
    | RowOf
    | Parsed
    | ByForm
    | OneOrMany
    | ByPoints
    | ByLaw
    | Balances
    | ByKind
)

TEXT, NUMBER, LINK, FLAG = Leaf("text"), Leaf("number"), Leaf("link"), Leaf("flag")
COUNT, SPEED, TORQUE = Leaf("count"), Leaf("relative_speed"), Leaf("relative_torque")
