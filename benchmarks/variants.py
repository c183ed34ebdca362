"""Variants a second of the MZKT deck, all tables, against the compiled peer.

One process, calls of 20,000 variants, ten in a turn; every number of the results is read again by a
sum over each array. Two sorts of variants: the ratios of the peer, times
1 + 1e-6*(i mod 1000); and ratios varied by up to 10 %, efficiencies from .9 to .99, at
random. The time of the peer does not depend on the numbers. The first call, which makes
the plans, stands apart.
"""

import sys
import tempfile
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from common import MZKT, Peer, medians, options, print_table, timed

from vstatics import Transmission, load, solve
from vstatics.core.statics.results import Results

COUNT = 20_000
CALLS = 10
"""Calls in a turn: the peer's turn takes as long as some tens of them."""
SEED = 7
Call = Callable[[], Results]


def like_the_peer(case: Transmission, count: int) -> np.ndarray[Any, Any]:
    """The ratios of the peer's variants, shape (count, mechanisms)."""
    factors = 1 + 1e-6 * (np.arange(1, count + 1) % 1000)
    return factors[:, None] * [mechanism.ratio for mechanism in case.mechanisms]


def calls(case: Transmission, count: int) -> dict[str, Call]:
    """A call for each sort of variants."""
    near = like_the_peer(case, count)
    rng = np.random.default_rng(SEED)
    ratios = near[:1] * rng.uniform(0.9, 1.1, near.shape)
    efficiencies = rng.uniform(0.9, 0.99, near.shape)
    return {
        "ratios as in the peer": lambda: solve(case, ratios=near),
        "ratios and efficiencies at random": lambda: solve(
            case, ratios=ratios, efficiencies=efficiencies
        ),
    }


def read(results: Results) -> float:
    """Read every number; one that stands for all variants, without memory, is read once."""
    total = 0.0
    for array in results:
        if isinstance(array, np.ndarray):
            own = array[tuple(slice(None) if step else slice(1) for step in array.strides)]
            total += np.count_nonzero(own) if own.dtype == np.bool_ else own.sum()
    return total


def all_read(call: Call) -> float:
    """Call and read; the memory of the results is free again afterwards."""
    return read(call())


def in_a_row(action: Callable[[], object], calls: int) -> float:
    """Seconds of one call among some."""

    def repeated() -> None:
        for _ in range(calls):
            action()

    return timed(repeated) / calls


def same_sum(peer: Peer, results: Results) -> None:
    """Compare with the sum that the peer prints."""
    count = len(results.efficiency)
    own = results.lossy_torques[:, 0, -1].sum() + results.efficiency[:, -1].sum()
    if not np.isclose(own, peer.check_sum(count), rtol=1e-9, atol=0):
        sys.exit("the peer has other results")


def main() -> None:
    """Measure and print."""
    given = options(__doc__)
    count, rounds, per_turn = (2000, 2, 2) if given.quick else (COUNT, 9, CALLS)
    case = load(MZKT)
    with tempfile.TemporaryDirectory() as folder:
        peer = Peer(given.peer, case, Path(folder))
        solvers = calls(case, count)
        first = {name: timed(partial(all_read, call)) for name, call in solvers.items()}
        same_sum(peer, next(iter(solvers.values()))())
        actions: dict[str, Callable[[], float]] = {"peer": partial(peer.seconds, count)}
        for name, call in solvers.items():
            actions[name] = partial(in_a_row, partial(all_read, call), per_turn)
            actions[f"{name}, not read"] = partial(in_a_row, call, per_turn)
        measured = medians(actions, rounds)
    bare = measured["peer"]
    rows = [("peer", "", f"{1e6 * bare / count:.2f}", f"{count / bare:,.0f}", "1")]
    for name, seconds in measured.items():
        if name != "peer":
            ms = f"{1e3 * first[name]:.0f} ms" if name in first else ""
            per = f"{1e6 * seconds / count:.2f}"
            rows.append((name, ms, per, f"{count / seconds:,.0f}", f"{bare / seconds:.1f}"))
    print_table(
        f"Variants of the MZKT deck, six gears, calls of {count:,}",
        ("", "first call", "µs a variant", "variants a second", "times the peer"),
        rows,
    )


if __name__ == "__main__":
    main()
