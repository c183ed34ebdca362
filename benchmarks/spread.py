"""What it costs where variants do not go alike.

Ratios and efficiencies at random: ratios by up to 10 %, by up to a factor of 2, and by a
factor of up to 4 with any sign. Plans of any sign serve what does not go alike; few variants
are calculated one by one. The time of the peer does not depend on the numbers. Calls are made
ten in a turn, as in `variants`.
"""

import tempfile
from functools import partial
from pathlib import Path

import numpy as np
from common import MZKT, Peer, medians, options, print_table, timed
from variants import CALLS, SEED, all_read, in_a_row

from vstatics import load, solve

COUNT = 5000
SPREADS = {
    "by up to 10 %": (1.1, (1,)),
    "by up to a factor of 2": (2.0, (1,)),
    "by up to a factor of 4, any sign": (4.0, (1, -1)),
}
"""In words -> factor at most, signs."""


def main() -> None:
    """Measure and print."""
    given = options(__doc__)
    count, rounds, repeats = (100, 1, 1) if given.quick else (COUNT, 3, 20)
    rows = []
    rng = np.random.default_rng(SEED)
    with tempfile.TemporaryDirectory() as folder:
        for path in (MZKT, MZKT.with_name("zf-8hp70.yaml")):
            case = load(path)
            peer, gears = Peer(given.peer, case, Path(folder)), len(case.gears)
            for words, (most, signs) in SPREADS.items():
                shape = (count, len(case.mechanisms))
                factors = most ** rng.uniform(-1, 1, shape) * rng.choice(signs, shape)
                ratios = factors * [mechanism.ratio for mechanism in case.mechanisms]
                efficiencies = rng.uniform(0.9, 0.99, shape)
                call = partial(solve, case, ratios=ratios, efficiencies=efficiencies)
                read = partial(all_read, call)
                first = timed(read)
                measured = medians(
                    {
                        "peer": partial(peer.seconds, repeats * count),
                        "vstatics": partial(in_a_row, read, 1 if given.quick else CALLS),
                    },
                    rounds,
                )
                theirs = 1e6 * measured["peer"] / (repeats * count * gears)
                ours = 1e6 * measured["vstatics"] / (count * gears)
                rows.append(
                    (
                        f"{path.stem}, {words}",
                        f"{1e3 * first:.0f} ms",
                        f"{theirs:.2f}",
                        f"{ours:.3f}",
                        f"{theirs / ours:.2g}",
                    )
                )
    print_table(
        f"Variants that do not go alike, calls of {count:,}",
        (
            "ratios varied",
            "first call",
            "peer: µs a variant and gear",
            "vstatics: µs a variant and gear",
            "times the peer",
        ),
        rows,
    )


if __name__ == "__main__":
    main()
