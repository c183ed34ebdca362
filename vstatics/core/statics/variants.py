"""Variants of a case: each gear by its plans, into arrays made for all of them."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from dataclasses import fields
from functools import lru_cache, partial
from operator import attrgetter
from typing import Any, Literal, NamedTuple, get_args

import numpy as np

from vstatics.core.annexes import KEYS
from vstatics.core.model.parts import OfLoad
from vstatics.core.model.springs import Spring
from vstatics.core.model.transmission import Gear, Mechanism, ShiftElement, Transmission
from vstatics.core.numerics import memory
from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.memory import Form
from vstatics.core.numerics.plans import Function, Inputs, Plans, prepared
from vstatics.core.numerics.signed import Condition
from vstatics.core.numerics.tape import Residual
from vstatics.core.numerics.traced import Number
from vstatics.core.statics import matrix
from vstatics.core.statics.efficiency import Efficiency
from vstatics.core.statics.freewheels import find_state
from vstatics.core.statics.result_arrays import ARRAYS, row_counts
from vstatics.core.statics.state import flat, guard_power, values_of

REMEMBERED = 256
"""Gears whose plans are kept for calls to come."""
HOLDING = frozenset({"holding_torques", "lossy_holding_torques"})

_plans: dict[Hashable, Plans] = {}
_lock = threading.Lock()


OfMechanism = Literal["ratio", "efficiency", "back_efficiency"]
OfGear = Literal["speeds", "torques", "drag", "open_drag", "speed_ratios"]


class GearNumber(NamedTuple):
    """A number that varies in one gear."""

    quantity: OfMechanism | OfGear
    owner: int
    """The index of a mechanism; the number of a link, or of a shift element."""


GearNumbers = Mapping[GearNumber, Floats]
"""Of shape (variants,), speeds and torques relative to those of the input [-]. Where a plain
number stands for the gear, it must have one there."""


def solve_variants(
    case: Transmission,
    ratios: Floats | None,
    efficiencies: Floats | None,
    variants: int,
    by_gear: Sequence[GearNumbers] = (),
) -> dict[str, Any]:
    """The arrays of `Results`, with the variants as first axis.

    Parameters
    ----------
    ratios, efficiencies : ndarray, shape (variants, mechanisms), optional
        The case's own where not given. [-]
    variants : int
        Their number.
    by_gear : sequence of mapping
        What varies in each gear alone, nothing in any where not given.
    """
    fixed, inputs = _inputs(case, ratios, efficiencies, variants)
    counts = row_counts(case)
    held = any(gear.speeds for gear in case.gears)
    block = memory.block(_forms(tuple(counts.items()), len(case.gears), variants, held=held))
    names = tuple(block.forms)
    structure = (*_structure(case), tuple(fixed), names)
    for number, (given, rows) in enumerate(zip(case.gears, block.gears, strict=True)):
        gear = case.with_all_drag(given)
        if variants:
            own = _own(by_gear[number]) if by_gear else NOTHING_OWN
            rest = own.left_out_of(gear) if by_gear else gear
            key = (*structure, *own.key, *_conditions(case, rest))
            numbers = prepared(np.vstack([inputs.values, *own.rows])) if own.rows else inputs
            function = partial(_function, case, gear, fixed, names, own)
            _remembered(key, function).run(numbers, rows)
    tables = memory.shown(block)
    found = {}
    for name, width in counts.items():
        table = tables.get(name)
        if table is None:
            found[name] = _nothing(ARRAYS[name].dtype, (variants, len(case.gears), width or 0))
        else:
            found[name] = table[:, 0].T if width is None else table.transpose(2, 0, 1)
    return found


def _inputs(
    case: Transmission, ratios: Floats | None, efficiencies: Floats | None, variants: int
) -> tuple[list[float | None], Inputs]:
    """What is fixed, None for what varies; and the numbers that vary.

    A single case has nothing fixed, so that its plans suit others of its structure.
    """
    mechanisms = case.mechanisms
    # every gear has a ratio of its own where a mechanism has none, NaN
    own = [0.0 if math.isnan(one.ratio) else one.ratio for one in mechanisms]
    own += [one.efficiency for one in mechanisms]
    given = _columns(ratios, len(mechanisms)) + _columns(efficiencies, len(mechanisms))
    fixed: list[float | None] = []
    varied = []
    for number, column in zip(own, given, strict=True):
        if variants > 1 and (
            column is None or bool((column[:9] == number).all() and (column == number).all())
        ):
            fixed.append(number)
        else:
            fixed.append(None)
            varied.append([number] if column is None else column)
    values = np.empty((len(varied), variants))
    for row, column in zip(values, varied, strict=True):
        row[:] = column
    return fixed, prepared(values)


class _GearsOwn(NamedTuple):
    """The numbers of one gear: inputs of its plans, and what is the same in all variants."""

    places: tuple[GearNumber, ...] = ()
    rows: Sequence[Floats] = ()
    constants: tuple[tuple[GearNumber, float], ...] = ()

    @property
    def key(self) -> tuple[Hashable, ...]:
        """What plans are known by."""
        return (self.places, self.constants) if self.places or self.constants else ()

    def left_out_of(self, gear: Gear) -> Gear:
        """The gear without the numbers that stand here."""
        given = {*self.places, *(place for place, _ in self.constants)}
        for quantity in {place.quantity for place in given} - {*OF_MECHANISMS}:
            others = getattr(gear, quantity).items()
            kept: Any = {owner: v for owner, v in others if (quantity, owner) not in given}
            gear = gear._replace(**{quantity: kept})
        return gear

    def put(self, gear: Gear, ratios: list[Any], efficiencies: list[Any], numbers: Any) -> Gear:
        """The gear with these numbers; those of mechanisms are put in their places."""
        maps: dict[str, Any] = {}
        given = dict([*self.constants, *zip(self.places, numbers, strict=True)])
        for (quantity, owner), number in given.items():
            if quantity == "ratio":
                ratios[owner] = number
            elif quantity == "efficiency":
                efficiencies[owner] = number
            elif quantity != "back_efficiency":
                own = maps.setdefault(quantity, dict(getattr(gear, quantity)))
                own[owner] = OfLoad(number, 1.0) if isinstance(number, float) else number
        for (quantity, owner), number in given.items():
            if quantity == "back_efficiency":
                efficiencies[owner] = Efficiency(efficiencies[owner], number)
        return gear._replace(**maps) if maps else gear


OF_MECHANISMS: tuple[OfMechanism, ...] = get_args(OfMechanism)
OF_GEAR: tuple[OfGear, ...] = get_args(OfGear)
NOTHING_OWN = _GearsOwn()


def _own(columns: GearNumbers) -> _GearsOwn:
    """What varies of the numbers of a gear, and what does not."""
    places, rows, constants = [], [], []
    for place, column in columns.items():
        if column.size > 1 and bool((column == column[0]).all()):
            constants.append((place, float(column[0])))
        else:
            places.append(place)
            rows.append(column)
    return _GearsOwn(tuple(places), rows, tuple(constants))


def _columns(given: Floats | None, mechanisms: int) -> list[Any]:
    """The numbers of each mechanism, None where none are given."""
    return [None] * mechanisms if given is None else list(given.T)


@lru_cache(maxsize=REMEMBERED)
def _forms(
    counts: tuple[tuple[str, int | None], ...], gears: int, variants: int, *, held: bool
) -> dict[str, Form]:
    """The tables for the arrays of `Results`, those of the largest type first.

    Arrays without rows need no memory, nor do holding torques where no speed is given
    (`held`).
    """
    forms = {
        name: Form((gears, 1 if width is None else width, variants), ARRAYS[name].dtype)
        for name, width in counts
        if width != 0 and (held or name not in HOLDING)
    }
    return dict(sorted(forms.items(), key=lambda item: -np.dtype(item[1].kind).itemsize))


@lru_cache(maxsize=REMEMBERED)
def _nothing(kind: type, shape: tuple[int, ...]) -> Any:
    """An array that says nothing, to read; it takes no memory."""
    return np.broadcast_to(kind(np.nan), shape)


WITHOUT_EFFECT: dict[type, frozenset[str]] = {
    Transmission: frozenset(
        {
            *("name", "description", "source", "link_names", "load", "allow", "hushed"),
            *("drawing", "_lowered", "inertias", "masses", "cylinders", *KEYS),
        }
    ),
    ShiftElement: frozenset({"name", "capacity", "stiffness", "damping", "static", "friction"}),
    Mechanism: frozenset({"name", "stiffness", "damping", "is_set"}),
    Spring: frozenset(
        {"name", "stiffness", "compliance", "damping", "limit", "points", "friction", "strut"}
    ),
    Gear: frozenset({"name", "load", "balance"}),
}
"""Fields that no result depends on; a drawing acts through its devices, a load by its sign."""


def _kept(part: type, fields: Iterable[str], *left_out: str) -> Callable[[Any], tuple[Any, ...]]:
    without = WITHOUT_EFFECT[part].union(left_out)
    return attrgetter(*(name for name in fields if name not in without))


_OF_CASE = _kept(
    Transmission,
    (field.name for field in fields(Transmission)),
    *("shift_elements", "mechanisms", "springs", "gears", "drag"),
)
_OF_ELEMENT = _kept(ShiftElement, ShiftElement._fields, "drag")
"""Drag acts through the gears, see `Transmission.with_all_drag`."""
_OF_MECHANISM = _kept(Mechanism, Mechanism._fields, "ratio", "efficiency")
"""The numbers that are left out may vary: a plan takes them as its inputs."""
_OF_SPRING = _kept(Spring, Spring._fields)
_OF_GEAR = _kept(Gear, Gear._fields)


def _structure(case: Transmission) -> tuple[Hashable, ...]:
    """All that the gears of a case have in common, without the numbers that may vary.

    Made from all fields but a few, so that a new one is never forgotten: plans of another
    case would give its numbers without a sound.
    """
    elements = tuple(map(_OF_ELEMENT, case.shift_elements))
    mechanisms = tuple(map(_OF_MECHANISM, case.mechanisms))
    springs = tuple(map(_OF_SPRING, case.springs))
    drawn = () if case.drawing is None else tuple(case.drawing.devices)
    return (*_OF_CASE(case), case.own_links, elements, mechanisms, springs, drawn)


def _conditions(case: Transmission, gear: Gear) -> tuple[Hashable, ...]:
    """What a gear has of its own."""
    own = (tuple(v.items()) if isinstance(v, dict) else v for v in _OF_GEAR(gear))
    turned = case.input_turns(gear) == "backward"
    ends = case.gear_input(gear), case.gear_output(gear)
    return (*own, *ends, turned, case.coasts(gear), *_loads(case, gear))


def _loads(case: Transmission, gear: Gear) -> tuple[Hashable, ...]:
    """Which given torques act where the input has none; nothing where it has one."""
    if case.input_torque(gear):
        return ()
    by_part = gear.torques, gear.drag, gear.open_drag
    given = [torque for torques in by_part for torque in torques.values()]
    return (0.0, *(matrix.given_torque(case, gear, torque) for torque in given))


def _remembered(key: Hashable, function: Callable[[], Function]) -> Plans:
    """The plans of a gear; gears that differ only in numbers that vary have the same."""
    with _lock:
        plans = _plans.pop(key, None) or Plans(function())
        _plans[key] = plans  # the latest stand last
        while len(_plans) > REMEMBERED:
            del _plans[next(iter(_plans))]
    return plans


def _function(
    case: Transmission,
    gear: Gear,
    fixed: Sequence[float | None],
    names: Sequence[str],
    own: _GearsOwn,
) -> Function:
    """The calculation of a gear from the numbers that vary."""
    count = len(case.mechanisms)

    def calculate(numbers: Sequence[Number]) -> list[Number | Residual | Condition]:
        varied = iter(numbers)
        given: list[Any] = [next(varied) if number is None else number for number in fixed]
        ratios, efficiencies = given[:count], given[count:]
        changed = own.put(gear, ratios, efficiencies, varied)
        state = find_state(case, changed, ratios, efficiencies)
        values = values_of(state)
        guard_power(state)
        return flat(values, names)

    return calculate
