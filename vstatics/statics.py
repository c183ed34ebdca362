"""Transmission -> Results: speeds, torques without and with losses, what is determined."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

from vstatics import diagnosis, signs
from vstatics.arrays import Booleans, Floats
from vstatics.errors import CaseError, Problem
from vstatics.losses import Flow
from vstatics.matrix import by_mechanism
from vstatics.model import HOUSING, Gear, IdleConvention, Mechanism, Transmission
from vstatics.results import Results
from vstatics.speeds import solve_speeds
from vstatics.torques import solve_torques


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
        In place of the case's own numbers; the leading axes are the variants. Planet
        ratios that the case gives stay as they are. [-]
    coast : bool, optional
        Power enters at the output; the case's own when not given.
    idle : {"exact", "published"}, optional
        Convention for idle mechanisms; the case's own when not given.

    Returns
    -------
    Results
        Arrays with the leading axes of `ratios` and `efficiencies`, then gears. For
        arrays of variants there are no `messages`, and `case` is the one given.

    Raises
    ------
    CaseError
        If a ratio or an efficiency in the arrays is none, or `idle` no convention.
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
    if coast not in (None, case.coast) or idle not in (None, case.idle):
        case = replace(
            case,
            coast=case.coast if coast is None else coast,
            idle=case.idle if idle is None else idle,
        )
    axes, u, eta = _variants(case, ratios, efficiencies)
    given = ratios is not None or efficiencies is not None
    if axes == () and given:
        case = replace(case, mechanisms=_with_numbers(case, u[:, 0], eta[:, 0]))
    with np.errstate(all="ignore"):
        gears = [_solve_gear(case, gear, u, eta) for gear in case.gears]
        arrays = {name: _stacked([gear[name] for gear in gears], axes) for name in gears[0]}
        results = Results(case=case, **arrays)
        if axes == ():
            results = results._replace(messages=tuple(diagnosis.messages(results)))
    return results


def _with_numbers(case: Transmission, ratios: Floats, efficiencies: Floats) -> list[Mechanism]:
    """The mechanisms with other ratios and efficiencies."""
    return [
        mechanism._replace(ratio=float(ratio), efficiency=float(efficiency))
        for mechanism, ratio, efficiency in zip(case.mechanisms, ratios, efficiencies, strict=True)
    ]


def _variants(
    case: Transmission, ratios: ArrayLike | None, efficiencies: ArrayLike | None
) -> tuple[tuple[int, ...], Floats, Floats]:
    """The axes of the variants, and ratios and efficiencies (mechanisms, variants)."""
    own_ratios = [mechanism.ratio for mechanism in case.mechanisms]
    own_efficiencies = [mechanism.efficiency for mechanism in case.mechanisms]
    count = len(case.mechanisms)
    u = by_mechanism("ratios", own_ratios if ratios is None else ratios, count)
    eta = by_mechanism(
        "efficiencies", own_efficiencies if efficiencies is None else efficiencies, count
    )
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
    where = f" in variant {', '.join(map(str, variant))}" if variant else ""
    message = f"read {given[(*variant, mechanism)]:g}{where}, expected {expected}"
    return [Problem(message, ("mechanisms", mechanism + 1, name))]


def _solve_gear(case: Transmission, gear: Gear, u: Floats, eta: Floats) -> dict[str, Any]:
    """The arrays of `Results` for one gear, with the variants as last axis."""
    speeds = solve_speeds(case, gear, u)
    torques = solve_torques(case, gear, u)
    flow = Flow(case, gear, u, eta, speeds.links, speeds.motion, torques.first, torques.holding)
    outcome = signs.search(flow, torques.consistent & speeds.consistent)
    lossy = outcome.lossy
    output_speed = speeds.links[case.gear_output(gear) - 1]
    return {
        "speeds": speeds.links,
        "planet_speeds": speeds.motion / _planet_ratios(case, u),
        "slip_speeds": speeds.slips,
        "ratio": np.where(output_speed == 0, np.nan, 1 / output_speed),
        "torques": torques.first,
        "holding_torques": torques.holding,
        "lossy_torques": lossy.torques,
        "lossy_holding_torques": lossy.holding,
        "efficiency": lossy.efficiency,
        "power_sign": lossy.signs,
        "idle": outcome.idle,
        "losses": lossy.losses,
        "power_balance": lossy.balance,
        "consistent": lossy.admissible,
        "locked": outcome.locked,
        "undecided": outcome.undecided,
        "turned": outcome.turned,
        "choices": outcome.choices,
        "tied_up": ~speeds.consistent,
        "missing": speeds.missing,
        "excess": speeds.excess,
        "balanced": torques.consistent,
    }


def _planet_ratios(case: Transmission, u: Floats) -> Floats:
    """First link to planet with the third link held, NaN where there is none."""
    made = np.full_like(u, np.nan)
    for number, mechanism in enumerate(case.mechanisms):
        if mechanism.planet_ratio is not None:
            made[number] = mechanism.planet_ratio
        else:
            made[number] = np.where(mechanism.is_plain(u[number]), (u[number] + 1) / 2, np.nan)
    return made


def _stacked(gears: list[Any], axes: tuple[int, ...]) -> Any:
    """Arrays (..., variants) of the gears -> (axes of the variants, gears, ...).

    Without -0; what overflowed does not exist.
    """
    array = np.moveaxis(np.stack(gears), -1, 0)
    if array.dtype == np.float64:
        array = array + 0.0
        array[np.isinf(array)] = np.nan
    return np.ascontiguousarray(array).reshape(*axes, *array.shape[1:])
