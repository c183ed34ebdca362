"""Classes that declare the shape of a document, such as a case: its keys and their values.

The reader, the writer and the JSON Schema of YAML and JSON documents are all derived from the same
declaration. `model.keys` and `elements.keys` declare a case.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, Literal, NamedTuple, Self, TypeAlias

from vstatics.core.model.empty import EMPTY

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
    "load_per_torque",
    "straight_stiffness",
    "straight_compliance",
    "straight_damping",
]
"""Quantity that is stored in SI units and can be written in any unit of the quantity."""
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
    "load_per_torque": "N/(N*m)",
    "straight_stiffness": "N/m",
    "straight_compliance": "m/N",
    "straight_damping": "N*s/m",
}
"""Unit of a number that the user writes without a unit, by quantity."""
STRAIGHT: Mapping[Measure, Measure] = {
    "stiffness": "straight_stiffness",
    "compliance": "straight_compliance",
    "damping": "straight_damping",
    "si_torque": "force",
    "angle": "length",
    "si_speed": "velocity",
}
"""Quantity of motion along a line that corresponds to a quantity of rotation."""

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
        "slip",
        "drag",
        "efficiency",
        "link",
        "element",
        "converter",
        "flag",
        "choice",
    ]
)
UNITS: Mapping[str, str] = {"speed": "rpm", "torque": "N*m", "power": "kW"}
"""Units of absolute speeds, torques and powers that are written without a unit."""

Limits: TypeAlias = Mapping[str, Any]
"""Limits of a number as keywords of JSON Schema. The program checks numbers separately."""


class Leaf(NamedTuple):
    """Declaration of a single value."""

    kind: LeafKind
    choices: tuple[str, ...] = ()
    infinite: bool = False
    """True if a number can be `.inf`."""
    straight: bool = False
    """True if the value can also be in the unit for motion along a line, such as N/m."""


class InUnit(float):
    """Number in SI units that stores the quantity of the unit with which it was written."""

    measure: Measure | None
    """Quantity of the written unit; None if the number was written without a unit."""

    def __new__(cls, value: float, measure: Measure | None) -> Self:
        """Create a number that stores the quantity of the unit."""
        number = super().__new__(cls, value)
        number.measure = measure
        return number


class Links(NamedTuple):
    """Declaration of links: the number of links, or a list of names."""


class Ends(NamedTuple):
    """Declaration of the first and second link of a shift element."""

    least: int = 2
    """Smallest number of links; if 1, the second link defaults to the housing."""


class Numbers(NamedTuple):
    """Declaration of a mapping from links, shift elements or other parts to values."""

    by: Literal["link", "shift element", "mechanism", "spring", "elastic component"]
    item: Shape
    limits: Limits = EMPTY


class Shares(NamedTuple):
    """Declaration of a mapping from gear names to shares of any sum. The names are not checked."""


class KeyShape(NamedTuple):
    """Declaration of a key and the shape of its value. The model has an attribute of this name.

    `default` is set if only documents have the default, not the class of the model.
    """

    name: str
    shape: Shape
    description: str
    required: bool = False
    default: Any = None
    limits: Limits = EMPTY
    examples: tuple[Any, ...] = ()
    unless: str = ""
    """Name of another key. A document that has this other key can omit the declared key."""

    def leaves_out(self, value: Any) -> bool:
        """Return whether a value is the default, so that a document can omit the key.

        >>> KeyShape("drag", NUMBER, "Drag.", default=0).leaves_out(0.0)
        True
        """
        return bool(value == self.default or not (value or isinstance(value, (float, int))))


class ByKey(NamedTuple):
    """Declaration of a mapping with fixed keys."""

    title: str
    description: str
    keys: tuple[KeyShape, ...]
    make: Callable[..., Any] = dict
    """Function that creates the part of the model from the values as keyword arguments."""
    fault: Callable[..., str] = lambda **_: ""
    """Function that returns a message about contradictory values; empty for valid values."""

    @property
    def required(self) -> list[str]:
        """Names of the required keys."""
        return [key.name for key in self.keys if key.required and not key.unless]


class Either(NamedTuple):
    """Declaration of a mapping that can be shortened to the value of a single key."""

    short: Ends | ListOf | Leaf
    key: str
    record: ByKey
    written: bool = False
    """True if the writer uses the short form when no other key has a value."""


class ByName(NamedTuple):
    """Declaration of an ordered mapping from names to items."""

    kind: str
    item: Shape


class ListOf(NamedTuple):
    """Declaration of a list of items of equal shape."""

    item: Shape
    kind: str = ""
    """Name of the items in messages."""
    unique: bool = True
    """True if repeated items are errors, for items with a `kind`."""


class Pair(NamedTuple):
    """Declaration of a list of two names."""

    kind: str


class RowOf(NamedTuple):
    """Declaration of a list of values in a fixed order."""

    items: tuple[Shape, ...]
    kind: str
    """Names of the values in messages, such as ``slip, coefficient``."""
    optional: tuple[Shape, ...] = ()
    """Shapes of optional further values."""
    more: Shape | None = None
    """Shape of any number of further values at the end."""

    def shapes(self, count: int) -> tuple[Shape, ...]:
        """Return the shapes of a list of `count` values, or fewer if the list must be shorter."""
        known = (*self.items, *self.optional)
        return known[:count] if self.more is None else (*known, *[self.more] * count)[:count]


class ByPoints(NamedTuple):
    """Declaration of a curve: a constant number, a list of points, or a mapping.

    A point is a row of two numbers, such as slip and coefficient of friction.
    """

    row: RowOf
    mapping: ByKey

    @property
    def scalar(self) -> Shape:
        """Shape of the constant number, equal to the shape of the second number of a point."""
        return self.row.items[1]


class Parsed(NamedTuple):
    """Declaration of a single value that a function parses from text."""

    expected: str
    parse: Callable[[str], Any]
    """Parser of the text.

    It raises ValueError (with the expectation) or ReadError (with a column).
    """
    stand_in: Any
    unit: str = ""
    """Unit of a number written without a unit; empty if the unit depends on other keys."""


class ByForm(NamedTuple):
    """Declaration of a value that is a single value, list or mapping, each with its own shape."""

    expected: str
    scalar: Leaf | Parsed | None
    listing: ListOf
    mapping: ByKey | None = None


class OneOrMany(NamedTuple):
    """Declaration of an item or a list of items; a list of points is a single item."""

    item: ByForm


class ByLaw(NamedTuple):
    """Declaration of a number or a law; a law is a text, a list of points or a mapping."""

    scalar: Leaf | None
    """Shape of a number or formula; None if the law must be a mapping."""
    mapping: ByKey | ByKind
    row: RowOf | None = None
    """Shape of a point in a list of points."""
    values: Literal["", "efficiency", "loss"] = ""
    """Quantity of the map in a file; empty if the file contains points."""


class Balances(NamedTuple):
    """Declaration of a mapping from links to numbers, with a key (`power`) for battery power."""

    links: Numbers
    power: str


class ByKind(NamedTuple):
    """Declaration of a mapping whose keys depend on the value of a single key, such as `kind`.

    The deciding value can also be a list of words, such as `[speed, torque]`.
    """

    records: Mapping[str, ByKey]
    key: str = "kind"

    @property
    def keys(self) -> list[KeyShape]:
        """All keys, for any value of the deciding key."""
        return [key for record in self.records.values() for key in record.keys]


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
