"""Operating points: any number of a case varied, in SI, with all that follows from a load.

`paths` tells which numbers a path names, `parts` which points are of a case of their own,
`relative` what numbers are relative to the load, and which points go alike; `laws` follows drags
and efficiencies that depend on speed or torque, `balance` looks for the torque that balances a
battery.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from vstatics.core.errors import not_allowed
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.statics import diagnosis
from vstatics.core.statics.efficiency import Efficiency
from vstatics.core.statics.points.balance import (
    NO_BALANCE,
    TWO_BALANCES,
    balanced,
    settled_gear,
    sought_link,
    without_balances,
)
from vstatics.core.statics.points.laws import NONE, SEVERAL, Followed, follow_laws
from vstatics.core.statics.points.parts import cases_of_points, joined
from vstatics.core.statics.points.paths import CaseNumber, Columns, columns_of, numbers_of, together
from vstatics.core.statics.points.relative import solve_points, with_numbers
from vstatics.core.statics.result_arrays import ARRAYS, Message, OperatingPoints
from vstatics.core.statics.results import Results

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


SAID = frozenset({"W418", "W420", "W423", "W424"})
"""What is said of torques that do not exist, where a message of laws or balances says why."""


def solve_varied(case: Transmission, vary: Mapping[str, ArrayLike]) -> Results:
    """Every gear of a case at many points; see `vstatics.solve`."""
    vary = dict(vary)  # a table of pandas has keys, too
    arrays, variants = together(vary)
    known = case.part_numbers() if vary.keys() - numbers_of(case).keys() else {}
    parts = {path: arrays.pop(path) for path in vary if path in known}
    columns = columns_of(case, arrays, known)
    with np.errstate(all="ignore"):
        if not parts:
            return _at_points(case, columns, variants)
        made = [*cases_of_points(case, parts)]
        found = [_at_points(one.case, one.columns(columns), one.chosen.size) for one in made]
    return joined(case, [one.chosen for one in made], found)


def _at_points(case: Transmission, columns: Columns, variants: int) -> Results:
    if not case.depends:
        return solve_points(case, columns, variants)
    answer = _followed(case, columns, variants)
    points = answer.results.points
    assert points is not None  # noqa: S101 - for mypy
    return answer.results._replace(
        case=case,
        points=points._replace(open=answer.open, outside={**points.outside, **answer.outside}),
    )


def _followed(case: Transmission, columns: Columns, variants: int) -> Followed:
    """All that depends on load and speed, with the torques of balances."""
    if not any(gear.balance for gear in case.gears):
        return follow_laws(case, columns, variants)
    plain, balances = without_balances(case)
    return balanced(plain, balances, columns, variants, partial(follow_laws, plain))


def solve_laws(
    case: Transmission, axes: tuple[int, ...], ratios: Floats | None, efficiencies: Floats | None
) -> Results:
    """A case with laws, or variants of its numbers, of shape (variants, mechanisms).

    An efficiency that is its law's number is left to the law.
    """
    columns: dict[CaseNumber, Floats] = {}
    for owner, mechanism in enumerate(case.mechanisms):
        for quantity, given in (("ratio", ratios), ("efficiency", efficiencies)):
            own = float(getattr(mechanism, quantity))
            if given is None or np.allclose(given[:, owner], own, 0, 0, equal_nan=True):
                continue
            for index in range(len(case.gears)):
                columns[CaseNumber(index, quantity, owner)] = given[:, owner]  # type: ignore[arg-type] # one of the two
    with np.errstate(all="ignore"):
        if axes:
            found = _at_points(case, columns, int(np.prod(axes)))
            arrays = {name: found.in_own_unit(name) for name in ARRAYS}
            shaped: Any = {n: array.reshape(*axes, *array.shape[1:]) for n, array in arrays.items()}
            return found._replace(**shaped, points=_shaped(found.points, axes))
        return _alone(case, _followed(case, columns, 1))


def _shaped(points: Any, axes: tuple[int, ...]) -> OperatingPoints:
    """Points of one axis as those of several."""

    def turned(array: Any) -> Any:
        return array.reshape(*axes, *array.shape[1:])

    gears = [
        gear._replace(torques={link: turned(one) for link, one in gear.torques.items()})
        for gear in points.gears
    ]
    scales = {unit: turned(scale) for unit, scale in points.scales.items()}
    outside = {name: turned(where) for name, where in points.outside.items()}
    loaded, is_open = turned(points.loaded), turned(points.open)
    return points._replace(scales=scales, loaded=loaded, gears=gears, open=is_open, outside=outside)  # type: ignore[no-any-return] # a named tuple


def _alone(case: Transmission, answer: Followed) -> Results:
    """The results of one case, with its messages."""
    results, points = answer.results, answer.results.points
    assert points is not None  # noqa: S101 - for mypy
    settled = with_numbers(results.case, answer.columns)
    points = points._replace(
        scales={unit: scale[0] for unit, scale in points.scales.items()},
        loaded=points.loaded[0],
        gears=[
            *map(settled_gear, [case] * len(case.gears), settled.gears, answer.open[0].tolist())
        ],
        efficiencies=[_efficiencies(settled, answer.columns, n) for n in range(len(case.gears))],
        open=answer.open[0],
        outside={name: where[0] for name, where in answer.outside.items()},
    )
    arrays = {name: results.in_own_unit(name)[0] for name in ARRAYS}
    own = results._replace(case=settled, points=points, **arrays)
    unknown = [gear.name for gear, state in zip(case.gears, answer.open[0], strict=True) if state]
    said = [one for one in diagnosis.messages(own) if not (one.gear in unknown and one.id in SAID)]
    said += not_allowed(_messages(case, points), case.untold)
    return own._replace(case=case, messages=tuple(said))


def _efficiencies(case: Transmission, columns: Columns, index: int) -> list[Any]:
    """Of each mechanism in a gear, as its laws say."""
    found: list[Any] = []
    for owner, mechanism in enumerate(case.mechanisms):
        forward = columns.get(CaseNumber(index, "efficiency", owner), [mechanism.efficiency])[0]
        back = columns.get(CaseNumber(index, "back_efficiency", owner), [mechanism.back_efficiency])
        own = forward if back[0] is None else back[0]
        found.append(Efficiency(float(forward), float(own), mechanism.kind == "variator"))
    return found


def _messages(case: Transmission, points: Any) -> Iterator[Message]:
    """Where no single torque agrees with efficiencies, or balances a battery."""
    for gear, settled, state in zip(case.gears, points.gears, points.open.tolist(), strict=True):
        if state in (NONE, SEVERAL):
            words = "no torques agree" if state == NONE else "more than one torque agrees"
            text = f"{words} with the losses that depend: there are no torques with losses"
            yield Message("W426", text, gear.name)
        if state in (NO_BALANCE, TWO_BALANCES):
            link = sought_link(gear, settled)
            none, two = "none of the torques on {} balances", "two of the torques on {} balance"
            text = (none if state == NO_BALANCE else two).format(case.link_name(link))
            text = f"balance: {text} the battery: there are no torques"
            yield Message("W427", text, gear.name)
