"""Motions: six seconds of a box, a clutch that is dumped, and a thousand variants of a shift.

Beside each stand integrations of the same equations with smoothed friction (`smoothed.py`), in the
same process on one core, after imports; they have no energies, heats and torques. Their numbers
are compared before anything is measured.
"""

import os
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path

from common import medians, options, print_table, timed
from smoothed import Box, Chain

import vstatics
from vstatics import Gear, Mechanism, ShiftElement, Spring, Transmission
from vstatics.core.model.springs import Twist, between
from vstatics.simulation import (
    Capacity,
    Formula,
    Motion,
    Points,
    Scenario,
    Start,
    constant,
    simulate,
)
from vstatics.simulation.variants.subject import load_varied

SCENARIO = Path(__file__).parents[1] / "cases/scenarios/tarasik-box.yaml"
ROUNDS = 7
VARIANTS = 1000
ONE_THREAD = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}
K1 = -67 / 33
RAMPS = {
    1: ((0, 3000), (2, 3000), (2, 0), (4, 0), (4.3, 3000)),
    2: ((1.9, 0), (2.2, 3000), (4, 3000), (4, 0)),
    3: ((0, 0), (0.4, 9000), (4.05, 9000), (4.05, 0)),
    4: ((3.9, 0), (4.3, 6000)),
}
"""Capacities of the elements over time [N*m]."""
NAMES = ("FH", "FB", "F1", "F2", "F3", "FR")
SMOOTHINGS = (1e-7, 3e-8)
TOLERANCES = (1e-7, 1e-8, 1e-9, 1e-10, 1e-11)
"""Of the stiff runs of which the fastest counts that has the lock times."""
STIFF = "BDF, tanh of {:g} rad/s"


def box() -> Transmission:
    """Seven links, four sets, six shift elements."""
    pairs = ((1, 3), (3, 0), (5, 0), (4, 0), (2, 5), (6, 0))
    sets = ((3, 2, 1, K1), (2, 4, 5, K1), (2, 5, 7, -3.0), (5, 6, 7, -2.04))
    return Transmission(
        7,
        [ShiftElement(*pair, name) for pair, name in zip(pairs, NAMES, strict=True)],
        [Mechanism(*one) for one in sets],
        [Gear()],
        inertias=dict(enumerate((3.6, 0.5, 0.2, 0.4, 0.7, 0.5, 41.2), 1)),
    )


def law(pairs: tuple[tuple[float, float], ...]) -> Points:
    """Points over time."""
    x, y = zip(*pairs, strict=True)
    return Points(tuple(map(float, x)), tuple(map(float, y)))


def run_of_box() -> Scenario:
    """Its start in the first gear, a shift of one element, a shift of two."""
    controls = {number: Capacity(law(pairs)) for number, pairs in RAMPS.items()}
    loads = ((1, constant(1500.0)), (7, Formula("-1200*tanh(speed/0.05)")))
    return Scenario(box(), 6.0, Start(speeds={1: 60.0, 7: 0.0}, engaged=(1,)), controls, loads)


def chain(clutch: Points | Formula) -> Scenario:
    """A car starts in gear 1, reduced to the input shaft: the clutch is dumped, tyres may slip.

    Source: I. S. Tsitovich, V. B. Algin, Vehicle dynamics (in Russian), Minsk 1981, tables 2.2,
    3.9 and 3.10.
    """
    inertias = (0.15, 0.0032, 0.000733, 8.4e-5, 0.000206, 0.0044, 0.00705, 0.639)
    half_shafts: Twist = ((5, 1.0), (7, -1.0), (6, -1.0))
    shafts = [between(2, 3), between(3, 4), between(4, 5)]
    twists = [*shafts, half_shafts, between(6), between(7, 8)]
    compliances = (84e-5, 0.00167, 0.0005, 0.01476, 0.01525, 0.00211)
    dampings = (2.42, 0.193, 0.229, 0.052, 0.33, 0.705)
    springs = [
        Spring(twist, compliance=compliance, damping=damping)
        for twist, compliance, damping in zip(twists, compliances, dampings, strict=True)
    ]
    springs[-1] = springs[-1]._replace(limit=130.0)
    case = Transmission(
        8,
        [ShiftElement(1, 2, "C")],
        [],
        [Gear()],
        inertias=dict(enumerate(inertias, 1)),
        springs=springs,
    )
    start = Start(speeds={1: 262.0} | dict.fromkeys(range(2, 9), 0.0))
    return Scenario(case, 0.45, start, {1: Capacity(clutch)})


CLUTCHES: dict[str, Points | Formula] = {
    "at once": constant(145.6),
    "within .02 s": Points((0.0, 0.02), (0.0, 145.6)),
    "by a formula": Formula("145.6*(1 - exp(-60*t))"),
}
"""How the clutch of the chain is engaged."""


def best_stiff(smooth: Box | Chain, motion: Motion, rounds: int) -> tuple[float, float]:
    """The smoothing and the tolerance of the fastest stiff run with all lock times to 1e-9 s.

    Of an element that locks several times, the last. With one round nothing is looked for.
    """
    if rounds == 1:
        return SMOOTHINGS[0], TOLERANCES[0]
    exact = {
        motion.elements.index(one.element): one.time
        for one in motion.events
        if one.event == "locks" and one.element in motion.elements
    }
    found = []
    for smoothing in SMOOTHINGS:
        for tolerance in TOLERANCES:
            locks = smooth.stiff(smoothing, tolerance).locks
            if all(abs(locks.get(n, 0.0) - time) < 1e-9 for n, time in exact.items()):
                taken = timed(partial(smooth.stiff, smoothing, tolerance))
                found.append((taken, smoothing, tolerance))
    if not found:
        sys.exit("no stiff run has the lock times")
    _, smoothing, tolerance = min(found)
    return smoothing, tolerance


Rows = list[tuple[object, ...]]


def of_box(rounds: int) -> Rows:
    """Six seconds of the box of seven links, all events and energies included."""
    scenario = run_of_box()
    box, motion = Box(scenario), simulate(scenario)
    smoothing, tolerance = best_stiff(box, motion, rounds)
    actions: dict[str, Callable[[], float]] = {
        "plain": partial(timed, box.plain),
        "stiff": partial(timed, partial(box.stiff, smoothing, tolerance)),
        "events": partial(timed, partial(simulate, scenario)),
    }
    found = medians(actions, rounds)
    apart = abs(box.plain() - motion.speeds[-1]).max()
    names = {
        "plain": f"`solve_ivp` as it is, tanh of .01 rad/s (speeds to {apart:.1g} rad/s)",
        "stiff": STIFF.format(smoothing),
        "events": "`simulate`",
    }
    return _rows("6 s of a box", names, found)


def of_chain(rounds: int) -> Rows:
    """A chain of six springs with dump and tyre, by each way to engage the clutch."""
    rows: Rows = []
    for words, clutch in list(CLUTCHES.items())[: 1 if rounds == 1 else None]:
        scenario = chain(clutch)
        motion, smooth = simulate(scenario), Chain(scenario)
        smoothing, tolerance = best_stiff(smooth, motion, rounds)
        actions: dict[str, Callable[[], float]] = {
            "stiff": partial(timed, partial(smooth.stiff, smoothing, tolerance)),
            "events": partial(timed, partial(simulate, scenario)),
        }
        names = {"stiff": STIFF.format(smoothing), "events": "`simulate`"}
        rows += _rows(f"dump of a clutch {words}", names, medians(actions, rounds))
    return rows


def of_variants(count: int) -> Rows:
    """A loop over variants of a shift: two elements overlap, by another time each."""
    scenario = run_of_box()

    def variant(number: int) -> Scenario:
        end = 2.05 + 0.35 * number / count
        controls = dict(scenario.controls or {})
        controls[2] = Capacity(law(((1.9, 0), (end, 3000), (4, 3000))))
        return scenario._replace(duration=3.0, controls=controls)

    def loop() -> None:
        for number in range(count):
            simulate(variant(number))

    taken = timed(loop)
    return [
        (f"{count:,} variants of 3 s with a shift", "`simulate` in a loop", f"{taken:.1f} s", "")
    ]


def of_sweep(count: int) -> Rows:
    """The same by a sweep: each variant is the documents with its numbers, read again, and run."""
    box = load_varied(str(SCENARIO))
    vary: dict[str, str | list[float]] = {"controls.FB.2.1": f"2.05:2.4:{count}", "duration": [3.0]}

    def swept() -> None:
        for chunk in vstatics.sweep(box, vary, out="heat[FB],max(abs(slips[FB])),locks[FB]"):
            if set(chunk.counts) != {"ok"}:
                sys.exit("a variant has no numbers")

    return [("the same", "`vstatics.sweep` of the documents", f"{timed(swept):.1f} s", "")]


def _rows(what: str, names: dict[str, str], found: dict[str, float]) -> Rows:
    own = found["events"]
    return [
        (what, names[key], f"{1e3 * taken:.1f} ms", f"{taken / own:.1f}")
        for key, taken in found.items()
    ]


def main() -> None:
    """Measure and print."""
    given = options(__doc__, peer=False)
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    rounds = 1 if given.quick else ROUNDS
    rows = [
        *of_box(rounds),
        *of_chain(rounds),
        *of_variants(VARIANTS // (100 if given.quick else 1)),
        *of_sweep(VARIANTS // (100 if given.quick else 1)),
    ]
    print_table("Motions, one core", ("", "", "time", "times `simulate`"), rows)


if __name__ == "__main__":
    if any(os.environ.get(name) != value for name, value in ONE_THREAD.items()):
        os.execve(sys.executable, [sys.executable, *sys.argv], {**os.environ, **ONE_THREAD})  # noqa: S606
    main()
