"""Variants of a case. The arithmetic of each gear is recorded as a plan and applied to arrays."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from dataclasses import fields
from functools import partial
from operator import attrgetter
from typing import Any, Literal, get_args

import numpy as np

from vstatics.core.annexes import KEYS
from vstatics.core.model.parts import OfLoad
from vstatics.core.model.springs import Spring
from vstatics.core.model.transmission import Gear, Mechanism, ShiftElement, Transmission
from vstatics.core.numerics import memory
from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.memory import Form
from vstatics.core.numerics.plans import Plans, prepared
from vstatics.core.numerics.signed import Condition
from vstatics.core.numerics.tape import Residual
from vstatics.core.numerics.traced import Number
from vstatics.core.start import NamedTuple
from vstatics.core.statics import matrix
from vstatics.core.statics.efficiency import Efficiency
from vstatics.core.statics.freewheels import find_state, is_nearly_one
from vstatics.core.statics.result_arrays import ARRAYS, row_counts
from vstatics.core.statics.state import flat, guard_power, values_of

REMEMBERED = 256
"""Number of gears whose plans are stored for later calls."""
HOLDING = frozenset({"holding_torques", "lossy_holding_torques"})
"""Arrays that are NaN unless a gear has a prescribed speed."""
SLIPPING = frozenset({"slip_losses"})
"""Arrays that are 0 unless a shift element has a prescribed slip."""

_plans: dict[Hashable, Plans] = {}
_lock = threading.Lock()


OfMechanism = Literal["ratio", "efficiency", "back_efficiency"]
"""Property of a mechanism that can vary in a gear."""
OfGear = Literal[
    "speeds", "slip", "torques", "drag", "open_drag", "loss_torques", "pump_torques", "speed_ratios"
]
"""Field of `Gear` that is a mapping of numbers that can vary."""


class GearNumber(NamedTuple):
    """Number that varies in a gear."""

    quantity: OfMechanism | OfGear
    owner: int
    """Index of the mechanism, or number of the link or shift element, as in `CaseNumber`."""


GearNumbers = Mapping[GearNumber, Floats]
"""Arrays of shape (variants,); speeds and torques are relative to the input [-].

For each key, the gear itself must contain a number.
"""


def solve_variants(
    case: Transmission,
    ratios: Floats | None,
    efficiencies: Floats | None,
    variants: int,
    by_gear: Sequence[GearNumbers] = (),
) -> dict[str, Any]:
    """Return the arrays of `Results`, with the variants as first axis.

    Parameters
    ----------
    ratios, efficiencies : ndarray, shape (variants, mechanisms), optional
        Basic ratios and efficiencies of the mechanisms. Default: the numbers of the case. [-]
    variants : int
        Number of variants.
    by_gear : sequence of mapping
        For each gear, the numbers that vary only in this gear.
    """
    fixed, values = _inputs(case, ratios, efficiencies, variants)
    calls = _calls(case, fixed, values, by_gear)
    if variants == 1:
        alone = _arrays_of_one(case, [(plans, given[:, 0].tolist()) for plans, given in calls])
        return {name: array[np.newaxis] for name, array in alone.items()}
    tables = _tables(calls, case.derived(_widths), values)
    _, places, others = case.derived(_layout)
    arrays = {
        name: np.broadcast_to(array, (variants, *array.shape)) for name, array in others.items()
    }
    for name, (_, place) in places.items():
        arrays[name] = tables[name] if isinstance(place, slice) else tables[name][..., 0]
    return arrays


def solve_one(case: Transmission) -> dict[str, Any]:
    """Return the arrays of `Results` for the numbers of the case itself, without variants."""
    numbers = _numbers(case)
    planets, plans = case.derived(_plans_of_one)
    if planets != _planet_ratios(case):  # cases with other planet ratios share derived values
        _, plans = _plans_of_one(case)
    return _arrays_of_one(case, [(of_gear, numbers) for of_gear in plans])


def _calls(
    case: Transmission,
    fixed: Sequence[float | None],
    values: Floats,
    by_gear: Sequence[GearNumbers] = (),
) -> list[tuple[Plans, Floats]]:
    """Return the plans of each gear, with their inputs."""
    widths = case.derived(_widths)
    structure = (*_case_key(case), tuple(fixed), tuple(widths))
    gear_keys = case.derived(_gear_keys)
    calls = []
    for number, gear in enumerate(case.gears_with_drag):
        key, gear_inputs, numbers = (*structure, *gear_keys[number]), NO_GEAR_INPUTS, values
        if by_gear:
            gear_inputs = _gear_inputs(by_gear[number])
            of_gear = _gear_key(case, gear_inputs.left_out_of(gear))
            key = (*structure, *gear_inputs.key, *of_gear)
        if gear_inputs.rows:
            numbers = np.vstack([values, *gear_inputs.rows])
        create = partial(_plans_of, case, gear, fixed, widths, gear_inputs)
        calls.append((_remembered(key, create), numbers))
    return calls


def _plans_of_one(case: Transmission) -> tuple[list[float | None], list[Plans]]:
    """Return the planet ratios, and the plans of each gear for a single variant with these."""
    calls = _calls(case, *_inputs(case, None, None, 1))
    return _planet_ratios(case), [plans for plans, _ in calls]


def _planet_ratios(case: Transmission) -> list[float | None]:
    return [mechanism.planet_ratio for mechanism in case.mechanisms]


def _widths(case: Transmission) -> dict[str, int]:
    """Return the number of rows of each array of `Results` that needs memory.

    Arrays without rows and arrays of equal values need no memory. The largest data type is first.
    """
    empty = HOLDING if not any(gear.speeds for gear in case.gears) else frozenset()
    empty |= SLIPPING if not any(gear.slip for gear in case.gears) else frozenset()
    counts = row_counts(case).items()
    widths = {name: 1 if n is None else n for name, n in counts if n != 0 and name not in empty}
    return dict(sorted(widths.items(), key=lambda item: -np.dtype(ARRAYS[item[0]].dtype).itemsize))


def _tables(
    calls: Sequence[tuple[Plans, Floats]], widths: Mapping[str, int], values: Floats
) -> dict[str, Any]:
    """Return read-only tables of shape (variants, gears, rows) from the plans of each gear."""
    variants = values.shape[1]
    forms = {
        name: Form((len(calls), width, variants), ARRAYS[name].dtype)
        for name, width in widths.items()
    }
    block, inputs = memory.block(forms), prepared(values)
    for rows, (plans, numbers) in zip(block.gears, calls, strict=True):
        plans.run(inputs if numbers is values else prepared(numbers), rows)
    return {name: table.transpose(2, 0, 1) for name, table in memory.shown(block).items()}


def _arrays_of_one(
    case: Transmission, calls: Iterable[tuple[Plans, Sequence[float]]]
) -> dict[str, Any]:
    """Return the read-only arrays of a single variant."""
    count, places, others = case.derived(_layout)
    numbers = np.array([plans.run_one(given, count) for plans, given in calls], np.float64)
    by_kind: dict[type, Any] = {}
    for kind in {kind for kind, _ in places.values()}:
        by_kind[kind] = numbers.astype(kind)
        by_kind[kind].flags.writeable = False
    return others | {name: by_kind[kind][:, place] for name, (kind, place) in places.items()}


def _layout(
    case: Transmission,
) -> tuple[int, dict[str, tuple[type, int | slice]], dict[str, Floats]]:
    """Return the number of results of a gear, the places of arrays in them, and other arrays.

    The other arrays are read-only and need no memory, because all values are equal (True for
    flags).
    """
    places: dict[str, tuple[type, int | slice]] = {}
    widths, counts = case.derived(_widths), case.derived(row_counts)
    count = 0
    for name, width in widths.items():
        place = count if counts[name] is None else slice(count, count + width)
        places[name] = ARRAYS[name].dtype, place
        count += width
    others: dict[str, Any] = {}
    for name, rows in counts.items():
        if name not in widths:
            value = ARRAYS[name].dtype(0.0 if name in SLIPPING else math.nan)
            others[name] = np.broadcast_to(value, (len(case.gears), rows or 0))
    return count, places, others


def _numbers(case: Transmission) -> list[float]:
    """Return the ratios, then the efficiencies, of the mechanisms."""
    mechanisms = case.mechanisms
    # A ratio is NaN if each gear has its own ratio; 1 is a placeholder, because 0 prevents plans.
    ratios = [1.0 if math.isnan(mechanism.ratio) else mechanism.ratio for mechanism in mechanisms]
    return ratios + [mechanism.efficiency for mechanism in mechanisms]


def _inputs(
    case: Transmission, ratios: Floats | None, efficiencies: Floats | None, variants: int
) -> tuple[list[float | None], Floats]:
    """Return the constant numbers (None for numbers that vary), and the numbers that vary.

    For a single variant all numbers count as varying, so that other cases with the same structure
    can use its plans.
    """
    defaults, mechanisms = _numbers(case), len(case.mechanisms)
    if variants == 1 and ratios is None and efficiencies is None:
        return [None] * len(defaults), np.array(defaults, dtype=np.float64)[:, np.newaxis]
    given = _columns(ratios, mechanisms) + _columns(efficiencies, mechanisms)
    fixed: list[float | None] = []
    varied = []
    for number, column in zip(defaults, given, strict=True):
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
    return fixed, values


class _GearInputs(NamedTuple):
    """Numbers that replace numbers of a gear: inputs of the plan, and constants."""

    places: tuple[GearNumber, ...] = ()
    rows: Sequence[Floats] = ()
    constants: tuple[tuple[GearNumber, float], ...] = ()

    @property
    def key(self) -> tuple[Hashable, ...]:
        """Part of the key under which the plans of a gear are stored."""
        return (self.places, self.constants) if self.places or self.constants else ()

    def left_out_of(self, gear: Gear) -> Gear:
        """Return the gear without the numbers that the inputs and constants replace."""
        given = {*self.places, *(place for place, _ in self.constants)}
        for quantity in {place.quantity for place in given} - {*OF_MECHANISMS}:
            others = getattr(gear, quantity).items()
            remaining: Any = {owner: v for owner, v in others if (quantity, owner) not in given}
            gear = gear._replace(**{quantity: remaining})
        return gear

    def put(self, gear: Gear, ratios: list[Any], efficiencies: list[Any], numbers: Any) -> Gear:
        """Return the gear with other numbers; ratios and efficiencies are changed in place."""
        maps: dict[str, Any] = {}
        given = dict([*self.constants, *zip(self.places, numbers, strict=True)])
        for (quantity, owner), number in given.items():
            if quantity == "ratio":
                ratios[owner] = number
            elif quantity == "efficiency":
                efficiencies[owner] = number
            elif quantity != "back_efficiency":
                numbers_of_gear = maps.setdefault(quantity, dict(getattr(gear, quantity)))
                numbers_of_gear[owner] = (
                    OfLoad(number, 1.0) if isinstance(number, float) else number
                )
        for (quantity, owner), number in given.items():
            if quantity == "back_efficiency":
                efficiencies[owner] = Efficiency(efficiencies[owner], number)
        return gear._replace(**maps) if maps else gear


OF_MECHANISMS: tuple[OfMechanism, ...] = get_args(OfMechanism)
OF_GEAR: tuple[OfGear, ...] = get_args(OfGear)
NO_GEAR_INPUTS = _GearInputs()


def _gear_inputs(columns: GearNumbers) -> _GearInputs:
    """Split the columns of a gear into inputs, and numbers that are 0 or 1 in all variants.

    Other equal numbers are inputs, so that plans serve later calls with other numbers.
    """
    places, rows, constants = [], [], []
    for place, column in columns.items():
        if column.size > 1 and column[0] in (0, 1) and bool((column == column[0]).all()):
            constants.append((place, float(column[0])))
        else:
            places.append(place)
            rows.append(column)
    return _GearInputs(tuple(places), rows, tuple(constants))


def _columns(given: Floats | None, mechanisms: int) -> list[Any]:
    return [None] * mechanisms if given is None else list(given.T)


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
    Gear: frozenset({"name", "load", "balance", "loss"}),
}
"""Fields of a case that affect no result and are therefore not part of the cache key.

A drawing affects results only through its devices, and a load only through its sign.
"""


def _kept(part: type, fields: Iterable[str], *left_out: str) -> Callable[[Any], tuple[Any, ...]]:
    without = WITHOUT_EFFECT[part].union(left_out)
    return attrgetter(*(name for name in fields if name not in without))


_OF_CASE = _kept(
    Transmission,
    (field.name for field in fields(Transmission)),
    *("shift_elements", "mechanisms", "springs", "gears", "drag"),
)
_OF_ELEMENT = _kept(ShiftElement, ShiftElement._fields, "drag")
"""Function that returns the fields of a shift element for the cache key of plans.

Drag is omitted, because the gears in the key contain it (`Transmission.gears_with_drag`).
"""
_OF_MECHANISM = _kept(Mechanism, Mechanism._fields, "ratio", "efficiency")
"""Function that returns the fields of a mechanism for the cache key, except inputs of plans."""
_OF_SPRING = _kept(Spring, Spring._fields)
_OF_GEAR = _kept(Gear, Gear._fields)


def _case_key(case: Transmission) -> tuple[Hashable, ...]:
    """Return the cache key that all gears of a case share, without numbers that can vary.

    All fields except `WITHOUT_EFFECT` are included, so that a new field is included automatically.
    With an incomplete key, plans of another case would silently return wrong numbers.
    """
    elements = tuple(map(_OF_ELEMENT, case.shift_elements))
    mechanisms = tuple(map(_OF_MECHANISM, case.mechanisms))
    springs = tuple(map(_OF_SPRING, case.springs))
    drawn = () if case.drawing is None else tuple(case.drawing.devices)
    return (*_OF_CASE(case), case.own_links, elements, mechanisms, springs, drawn)


def _gear_keys(case: Transmission) -> list[tuple[Hashable, ...]]:
    return [_gear_key(case, gear) for gear in case.gears_with_drag]


def _gear_key(case: Transmission, gear: Gear) -> tuple[Hashable, ...]:
    fields_of_gear = (tuple(v.items()) if isinstance(v, dict) else v for v in _OF_GEAR(gear))
    turned = case.input_turns(gear) == "backward"
    ends = case.gear_input(gear), case.gear_output(gear)
    return (*fields_of_gear, *ends, turned, case.coasts(gear), *_torque_key(case, gear))


def _torque_key(case: Transmission, gear: Gear) -> tuple[Hashable, ...]:
    """Return the external torques of a gear if its input torque is 0, else an empty tuple."""
    if case.input_torque(gear):
        return ()
    by_part = gear.torques, gear.drag, gear.open_drag, gear.loss_torques, gear.pump_torques
    given = [torque for torques in by_part for torque in torques.values()]
    return (0.0, *(matrix.given_torque(case, gear, torque) for torque in given))


def _remembered(key: Hashable, create: Callable[[], Plans]) -> Plans:
    """Return the plans of a gear, stored under a key without the numbers that vary."""
    with _lock:
        plans = _plans.pop(key, None) or create()
        _plans[key] = plans  # the most recently used plans are last
        while len(_plans) > REMEMBERED:
            del _plans[next(iter(_plans))]
    return plans


def _plans_of(
    case: Transmission,
    gear: Gear,
    fixed: Sequence[float | None],
    widths: Mapping[str, int],
    gear_inputs: _GearInputs,
) -> Plans:
    count, names = len(case.mechanisms), tuple(widths)

    def calculate(numbers: Sequence[Number]) -> list[Number | Residual | Condition]:
        varied = iter(numbers)
        given: list[Any] = [next(varied) if number is None else number for number in fixed]
        ratios, efficiencies = given[:count], given[count:]
        changed = gear_inputs.put(gear, ratios, efficiencies, varied)
        state = find_state(case, changed, ratios, efficiencies)
        values = values_of(state)
        guard_power(state)
        return flat(values, names)

    if gear_inputs.key or not (set(fixed) <= {None, 1} and _is_without_numbers(case, gear)):
        return Plans(calculate)
    row = sum(widths[name] for name in names[: names.index("exact")])

    def mark_exact(numbers: Sequence[float], results: list[float]) -> None:
        varied = iter(numbers)
        ratios = [next(varied) if number is None else number for number in fixed[:count]]
        results[row] = is_nearly_one(case, ratios)

    return Plans(calculate, mark_exact)


def _is_without_numbers(case: Transmission, gear: Gear) -> bool:
    """Return whether ratios and efficiencies are the only numbers of a gear.

    Calculations with fractions take other numbers as the decimals that were written, but plans
    take them as floats.
    """
    given = gear.speeds, gear.torques, gear.slip, gear.speed_ratios, case.springs
    drag = *gear.drag.values(), *gear.open_drag.values(), *gear.loss_torques.values()
    back = (mechanism.back_efficiency for mechanism in case.mechanisms)
    return not (any(given) or any(drag) or any(back) or case.has_converter)
