"""Points of load and speed of an e-axle whose drags depend on speed, against a loop of cases.

Drag by a formula at the engine, by points at the output, an open clutch that drags. One process,
all tables; the loop makes the case of each point and solves it.
"""

from functools import partial

import numpy as np
from common import medians, options, print_table, timed

from vstatics import Load, Transmission, solve
from vstatics.core.readers import loads

CASE = """\
links: [engine, mid, out]
load: {speed: 2000 rpm, torque: 80 N*m}
drag: {engine: "1.2 + 0.004*w", out: [[0, 2.0], [300, 3.5]]}
shift_elements:
  C1: {links: [mid, out], drag: [[0, 0], [200, 6]]}
mechanisms:
  a: {first: engine, second: mid, ratio: -3, efficiency: 0.985}
  b: {first: mid, second: out, ratio: -2.8, efficiency: 0.985}
gears: {drive: []}
"""
COUNTS = (1_000, 10_000, 100_000)
LOOPED = 500
"""Points of the loop."""
SEED = 7
RPM = 30 / np.pi


def points(count: int) -> dict[str, np.ndarray]:
    """Speeds [rad/s] and torques [N*m] at random."""
    rng = np.random.default_rng(SEED)
    return {"load.speed": rng.uniform(50, 1500, count), "load.torque": rng.uniform(15, 300, count)}


def loop(case: Transmission, vary: dict[str, np.ndarray]) -> list[float]:
    """The efficiency of each point by a case of its own."""
    pairs = zip(vary["load.speed"] * RPM, vary["load.torque"], strict=True)
    return [solve(case.replace(load=Load(speed, torque))).efficiency[0] for speed, torque in pairs]


def main() -> None:
    """Time both, and compare what they say."""
    given = options(__doc__, peer=False)
    counts = COUNTS[:2] if given.quick else COUNTS
    case, few = loads(CASE), points(100 if given.quick else LOOPED)
    together = solve(case, vary=few).efficiency[:, 0]
    np.testing.assert_allclose(together, loop(case, few), rtol=1e-12)
    calls = {f"{count:,} points": partial(solve, case, vary=points(count)) for count in counts}
    actions = {name: partial(timed, call) for name, call in calls.items()}
    actions["a loop of cases"] = partial(timed, partial(loop, case, few))
    seconds = medians(actions, 3 if given.quick else 7)
    each = [*counts, len(few["load.speed"])]
    micro = {name: one / n * 1e6 for (name, one), n in zip(seconds.items(), each, strict=True)}
    rows = [
        (name, f"{float(f'{one:.3g}'):g}", f"{micro['a loop of cases'] / one:.0f}")
        for name, one in micro.items()
    ]
    print_table("Points of an e-axle", ("", "µs a point", "times the loop"), rows)


if __name__ == "__main__":
    main()
