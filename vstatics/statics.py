"""Transmission -> Results: speeds, torques without and with losses, what is determined."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from vstatics import diagnosis, elimination, losses, matrix, signs
from vstatics.errors import CaseError, Problem
from vstatics.model import HOUSING, Gear, IdleConvention, Mechanism, Transmission
from vstatics.results import Booleans, Floats, Integers, Results


def solve(
    case: Transmission,
    *,
    ratios: ArrayLike | None = None,
    efficiencies: ArrayLike | None = None,
    coast: bool | None = None,
    idle: IdleConvention | None = None,
) -> Results:
    """Calculate every gear of a transmission, or of many variants of it.

    Parameters
    ----------
    case : Transmission
    ratios, efficiencies : array_like, shape (..., mechanisms), optional
        In place of the case's own numbers; the leading axes are the variants. [-]
    coast : bool, optional
        Power enters at the output; the case's own when not given.
    idle : {"exact", "published"}, optional
        Convention for idle mechanisms; the case's own when not given.

    Returns
    -------
    Results
        Arrays with the leading axes of `ratios` and `efficiencies`, then gears.

    Raises
    ------
    CaseError
        If a ratio or an efficiency in the arrays is none.
    ValueError
        If the arrays do not have one number for each mechanism.

    Examples
    --------
    >>> from vstatics.model import Gear, Mechanism, ShiftElement
    >>> case = Transmission(3, [ShiftElement(1, 2), ShiftElement(2, 0)],
    ...                     [Mechanism(1, 2, 3, -2.5, 0.96)], [Gear([1]), Gear([2])])
    >>> results = solve(case)
    >>> results.ratio
    array([1. , 3.5])
    >>> results.speeds.shape, results.torques.shape
    ((2, 3), (2, 4))
    >>> solve(case, ratios=[[-2.0], [-2.5], [-3.0]]).ratio
    array([[1. , 3. ],
           [1. , 3.5],
           [1. , 4. ]])
    """
    case = replace(
        case,
        coast=case.coast if coast is None else coast,
        idle=case.idle if idle is None else idle,
    )
    axes, u, eta = _variants(case, ratios, efficiencies)
    if axes == ():
        case = replace(case, mechanisms=_with_numbers(case, u[:, 0], eta[:, 0]))
    with np.errstate(all="ignore"):
        gears = [_solve_gear(case, gear, u, eta) for gear in case.gears]
        arrays = {
            name: _with_axes(np.stack([getattr(gear, name) for gear in gears]), axes)
            for name in _Gear._fields
        }
        results = Results(case=case, **arrays)
        if axes == ():
            results = replace(results, messages=tuple(diagnosis.messages(results)))
    return results


def _with_numbers(case: Transmission, ratios: Floats, efficiencies: Floats) -> list[Mechanism]:
    """The mechanisms with other ratios and efficiencies."""
    return [
        replace(mechanism, ratio=float(ratio), efficiency=float(efficiency))
        for mechanism, ratio, efficiency in zip(case.mechanisms, ratios, efficiencies, strict=True)
    ]


def _variants(
    case: Transmission, ratios: ArrayLike | None, efficiencies: ArrayLike | None
) -> tuple[tuple[int, ...], Floats, Floats]:
    """The axes of the variants, and ratios and efficiencies (mechanisms, variants)."""
    own_ratios = [mechanism.ratio for mechanism in case.mechanisms]
    own_efficiencies = [mechanism.efficiency for mechanism in case.mechanisms]
    u = np.asarray(own_ratios if ratios is None else ratios, dtype=np.float64)
    eta = np.asarray(own_efficiencies if efficiencies is None else efficiencies, dtype=np.float64)
    count = len(case.mechanisms)
    for name, given in (("ratios", u), ("efficiencies", eta)):
        if given.ndim == 0 or given.shape[-1] != count:
            raise ValueError(f"{name} of shape {given.shape}: expected a last axis of {count}")
    u, eta = np.broadcast_arrays(u, eta)
    problems = []
    if ratios is not None:
        joined = [HOUSING not in mechanism.links for mechanism in case.mechanisms]
        wrong = ~np.isfinite(u) | (u == 0) | ((u == 1) & np.array(joined, dtype=np.bool_))
        problems += _wrong("ratio", u, wrong, "a finite ratio, not 0, and not 1 with three links")
    if efficiencies is not None:
        expected = "an efficiency above 0 and up to 1"
        problems += _wrong("efficiency", eta, ~((eta > 0) & (eta <= 1)), expected)
    if problems:
        raise CaseError(problems)
    axes = u.shape[:-1]
    variants = math.prod(axes)
    return axes, u.reshape(variants, count).T, eta.reshape(variants, count).T


def _wrong(name: str, given: Floats, wrong: Booleans, expected: str) -> list[Problem]:
    """The first wrong number in an array of variants."""
    if not wrong.any():
        return []
    *variant, mechanism = (int(index) for index in np.argwhere(wrong)[0])
    message = f"read {given[(*variant, mechanism)]:g} in variant {tuple(variant)}"
    return [Problem(f"{message}, expected {expected}", ("mechanisms", mechanism + 1, name))]


class _Gear(NamedTuple):
    """The arrays of `Results` for one gear, with the variants as last axis."""

    speeds: Floats
    planet_speeds: Floats
    slip_speeds: Floats
    ratio: Floats
    torques: Floats
    holding_torques: Floats
    lossy_torques: Floats
    lossy_holding_torques: Floats
    efficiency: Floats
    power_sign: Floats
    idle: Booleans
    losses: Floats
    power_balance: Floats
    consistent: Booleans
    locked: Booleans
    undecided: Booleans
    turned: Booleans
    choices: Integers
    tied_up: Booleans
    missing: Integers
    excess: Integers
    balanced: Booleans


def _solve_gear(case: Transmission, gear: Gear, u: Floats, eta: Floats) -> _Gear:
    flow, solution = ideal_flow(case, gear, u, eta)
    balanced: Booleans = np.logical_not(np.isnan(flow.torques).all(axis=0))
    outcome = signs.search(flow, balanced & solution.consistent)
    lossy = outcome.lossy
    slips = solution.values[case.links + len(case.mechanisms) :]
    output_speed = flow.speeds[case.gear_output(gear) - 1]
    return _Gear(
        speeds=flow.speeds,
        planet_speeds=flow.motion / _planet_ratios(case, u),
        slip_speeds=slips,
        ratio=np.where(output_speed == 0, np.nan, 1 / output_speed),
        torques=flow.torques,
        holding_torques=flow.holding,
        lossy_torques=lossy.torques,
        lossy_holding_torques=lossy.holding,
        efficiency=lossy.efficiency,
        power_sign=lossy.signs,
        idle=outcome.idle,
        losses=lossy.losses,
        power_balance=lossy.balance,
        consistent=lossy.admissible,
        locked=outcome.locked,
        undecided=outcome.undecided,
        turned=outcome.turned,
        choices=outcome.choices,
        tied_up=~solution.consistent,
        missing=solution.missing,
        excess=solution.excess,
        balanced=balanced,
    )


def ideal_flow(
    case: Transmission, gear: Gear, u: Floats, eta: Floats
) -> tuple[losses.Flow, elimination.Solution]:
    """Speeds and torques of a gear without losses.

    Parameters
    ----------
    u, eta : ndarray, shape (mechanisms, variants)

    Returns
    -------
    flow : losses.Flow
    solution : elimination.Solution
        Of the speeds: links, then ``w_first - w_third`` of each mechanism, then
        the slip speed of each shift element.
    """
    columns = matrix.columns(case, list(u))
    differences = [(mechanism.first, mechanism.third) for mechanism in case.mechanisms]
    slips = [(element.first, element.second) for element in case.shift_elements]
    sums = [_difference(*pair) for pair in (*differences, *slips)]
    rows = matrix.speed_rows(case, gear, columns)
    solution = elimination.solve(rows, case.links, sums, variants=u.shape[1])
    speeds = solution.values[: case.links]
    motion = solution.values[case.links : case.links + len(case.mechanisms)]
    torques, holding = losses.solve_torques(case, gear, u)
    flow = losses.Flow(
        case,
        gear,
        ratios=u,
        efficiencies=eta,
        speeds=speeds,
        motion=losses.motion(speeds, case, motion),
        torques=torques,
        holding=holding,
    )
    return flow, solution


def _difference(first: int, second: int) -> dict[int, float]:
    """The difference of two link speeds as a sum of unknowns."""
    terms = {first - 1: 1.0, second - 1: -1.0}
    terms.pop(HOUSING - 1, None)
    return terms


def _planet_ratios(case: Transmission, u: Floats) -> Floats:
    """First link to planet with the third link held, NaN where there is none."""
    made = np.full_like(u, np.nan)
    for number, mechanism in enumerate(case.mechanisms):
        if mechanism.planet_ratio is not None:
            made[number] = mechanism.planet_ratio
        else:
            plain = [mechanism.is_plain(ratio) for ratio in u[number]]
            made[number] = np.where(plain, (u[number] + 1) / 2, np.nan)
    return made


def _with_axes(array: Any, axes: tuple[int, ...]) -> Any:
    """(gears, ..., variants) -> (axes of the variants, gears, ...), without -0."""
    if array.dtype == np.float64:
        array = array + 0.0
    return np.ascontiguousarray(np.moveaxis(array, -1, 0)).reshape(*axes, *array.shape[:-1])
