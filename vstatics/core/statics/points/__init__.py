"""Results at many points, which are variants of a case with other numbers in SI units.

`paths` finds the numbers that a path names. `parts` creates a new case for points with other tooth
numbers, for example. `relative` groups points by the signs of loads, and divides numbers by the
input speed or torque. `laws` calculates drag torques, efficiencies and losses of gears
(`gear_loss`) that depend on speed and torque. `roots` searches for an unknown number of each gear.
`balance` uses this search for the torque that balances `machines` with a battery, `converters` for
the speed ratio at which the pump takes the torque of its gear. `unsolved` reports gears without
such a solution.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from vstatics.core.errors import not_allowed
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.statics import diagnosis
from vstatics.core.statics.efficiency import Efficiency
from vstatics.core.statics.points.balance import (
    NO_BALANCE,
    TWO_BALANCES,
    balanced,
    unknown_torque,
    without_balances,
)
from vstatics.core.statics.points.converters import (
    NO_RATIO,
    NO_TORQUE,
    unknown_ratio,
    with_found_ratios,
    with_varied_slips,
    without_sought,
)
from vstatics.core.statics.points.laws import Followed, follow_laws
from vstatics.core.statics.points.parts import cases_of_points, joined
from vstatics.core.statics.points.paths import CaseNumber, Columns, columns_of, numbers_of, together
from vstatics.core.statics.points.relative import solve_points, with_numbers
from vstatics.core.statics.points.unsolved import unsolved_messages
from vstatics.core.statics.result_arrays import ARRAYS, OperatingPoints
from vstatics.core.statics.results import Results

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


CONSEQUENCES = frozenset({"W418", "W420", "W423", "W424", "W438"})
"""Ids of messages about missing torques, omitted if W426, W427, W431 or W433 states the cause."""


def solve_varied(case: Transmission, vary: Mapping[str, ArrayLike]) -> Results:
    """Calculate every gear of a case at many points; see `vstatics.solve`."""
    vary = dict(vary)  # accept a table of pandas, too
    arrays, variants = together(vary)
    known = case.part_numbers() if vary.keys() - case.derived(numbers_of).keys() else {}
    parts = {path: arrays.pop(path) for path in vary if path in known}
    columns = columns_of(case, arrays, known)
    with np.errstate(all="ignore"):
        if not parts:
            return _at_points(case, columns, variants)
        cases = [*cases_of_points(case, parts)]
        results = [_at_points(part.case, part.columns(columns), part.chosen.size) for part in cases]
    return joined(case, [part.chosen for part in cases], results)


def _at_points(case: Transmission, columns: Columns, variants: int) -> Results:
    slipping = with_varied_slips(case, columns)
    if not slipping.depends:
        return solve_points(case, columns, variants)
    answer = _followed(slipping, columns, variants)
    points = answer.results.points
    assert points is not None  # noqa: S101 - for mypy
    return answer.results._replace(
        case=case,
        points=points._replace(open=answer.open, outside={**points.outside, **answer.outside}),
    )


def _followed(case: Transmission, columns: Columns, variants: int) -> Followed:
    case, sought = without_sought(case, columns)
    if sought:
        follow = partial(_followed, case)
        return with_found_ratios(case, sought, columns, variants, follow)
    if not any(gear.balance for gear in case.gears):
        return follow_laws(case, columns, variants)
    plain, balances = without_balances(case)
    return balanced(plain, balances, columns, variants, partial(follow_laws, plain))


def solve_laws(
    case: Transmission, axes: tuple[int, ...], ratios: Floats | None, efficiencies: Floats | None
) -> Results:
    """Calculate a case with laws, or variants of ratios and efficiencies.

    Both arrays have the shape (variants, mechanisms). A mechanism is not varied if its numbers
    equal the numbers of the case. Its efficiency can then follow a law.
    """
    columns: dict[CaseNumber, Floats] = {}
    for owner, mechanism in enumerate(case.mechanisms):
        for quantity, given in (("ratio", ratios), ("efficiency", efficiencies)):
            fixed = float(getattr(mechanism, quantity))
            if given is None or np.allclose(given[:, owner], fixed, 0, 0, equal_nan=True):
                continue
            for index in range(len(case.gears)):
                columns[CaseNumber(index, quantity, owner)] = given[:, owner]  # type: ignore[arg-type] # one of the two
    with np.errstate(all="ignore"):
        if not axes:
            return _single(case, _followed(case, columns, 1))

        def shaped(array: Any) -> Any:
            return array.reshape(*axes, *array.shape[1:])

        results = _at_points(case, columns, int(np.prod(axes)))
        arrays: Any = {name: shaped(results.in_own_unit(name)) for name in ARRAYS}
        return results._replace(**arrays, points=_with_arrays(results.points, shaped))


def _with_arrays(points: Any, changed: Callable[[Any], Any]) -> OperatingPoints:
    """Return the operating points with a function applied to every array."""
    gears = [
        gear._replace(torques={link: changed(torque) for link, torque in gear.torques.items()})
        for gear in points.gears
    ]
    scales = {unit: changed(scale) for unit, scale in points.scales.items()}
    outside = {name: changed(where) for name, where in points.outside.items()}
    loaded, is_open = changed(points.loaded), changed(points.open)
    return points._replace(scales=scales, loaded=loaded, gears=gears, open=is_open, outside=outside)  # type: ignore[no-any-return] # a named tuple


def _single(case: Transmission, answer: Followed) -> Results:
    """Return the results of a single point, with messages and without an axis of points."""
    results, points = answer.results, answer.results.points
    assert points is not None  # noqa: S101 - for mypy
    settled = with_numbers(results.case, answer.columns)
    others = {gear: ratios[0][np.isfinite(ratios[0])] for gear, ratios in answer.others.items()}
    points = points._replace(open=answer.open, outside=answer.outside)
    points = _with_arrays(points, lambda array: array[0])._replace(
        gears=[*map(_settled, case.gears, settled.gears, answer.open[0].tolist())],
        efficiencies=[_efficiencies(settled, answer.columns, n) for n in range(len(case.gears))],
        other_ratios={gear: ratios.tolist() for gear, ratios in others.items()},
    )
    arrays = {name: results.in_own_unit(name)[0] for name in ARRAYS}
    at_point = results._replace(case=settled, points=points, **arrays)
    states = zip(case.gears, answer.open[0].tolist(), strict=True)
    unknown = [gear.name for gear, state in states if state not in (0, NO_TORQUE)]
    said = [
        message
        for message in diagnosis.messages(at_point, case)
        if not (message.gear in unknown and message.id in CONSEQUENCES)
    ]
    said += not_allowed(unsolved_messages(case, points, answer), case.untold)
    return at_point._replace(case=case, messages=tuple(said))


def _settled(gear: Gear, settled: Gear, state: int) -> Gear:
    """Return a solved gear, with NaN for a torque or speed ratio that has no unique solution."""
    if state in (NO_RATIO, NO_TORQUE):
        return unknown_ratio(gear, settled)
    return unknown_torque(gear, settled) if state in (NO_BALANCE, TWO_BALANCES) else settled


def _efficiencies(case: Transmission, columns: Columns, index: int) -> list[Any]:
    efficiencies: list[Any] = []
    for owner, mechanism in enumerate(case.mechanisms):
        forward = columns.get(CaseNumber(index, "efficiency", owner), [mechanism.efficiency])[0]
        back = columns.get(CaseNumber(index, "back_efficiency", owner), [mechanism.back_efficiency])
        backward = forward if back[0] is None else back[0]
        efficiencies.append(Efficiency(float(forward), float(backward)))
    return efficiencies
