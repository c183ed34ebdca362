"""How the time grows with the size of the train, against dense elimination.

Trains of 6, 12, 24 and 48 links are made by chaining one unit, output to input, by
clutches that are always engaged. There are two units: a differential of three links
with a clutch, a brake and losses (two gears), and the MZKT gearbox of six links (six
gears). The units are not all in the same gear.
"""

import tempfile
from dataclasses import replace
from functools import partial
from pathlib import Path

from common import MZKT, Peer, medians, options, print_table, timed
from variants import all_read, like_the_peer, same_sum

from vstatics import Gear, Mechanism, ShiftElement, Transmission, load, solve

COUNT = 5000
LINKS = (6, 12, 24, 48)
PEER_SECONDS = 0.2
"""The peer calculates at least for so long, which are fewer variants of large trains."""


def chained(unit: Transmission, links: int) -> Transmission:
    """Units in series until there are so many links; unit k of gear g is in gear g + k."""
    units = links // unit.links
    elements: list[ShiftElement] = []
    mechanisms: list[Mechanism] = []
    engaged: list[list[int]] = [[] for _ in unit.gears]
    for number in range(units):
        before = number * unit.links
        moved = [0, *range(before + 1, before + unit.links + 1)]
        if number:
            elements.append(ShiftElement(before, before + 1))
        for position, numbers in enumerate(engaged):
            if number:
                numbers.append(len(elements))
            own = unit.gears[(position + number) % len(unit.gears)].engaged
            numbers += [len(elements) + element for element in own]
        elements += [
            ShiftElement(moved[element.first], moved[element.second])
            for element in unit.shift_elements
        ]
        mechanisms += [
            mechanism._replace(
                first=moved[mechanism.first],
                second=moved[mechanism.second],
                third=moved[mechanism.third],
                name="",
            )
            for mechanism in unit.mechanisms
        ]
    return Transmission(links, elements, mechanisms, [Gear(numbers) for numbers in engaged])


def enough(peer: Peer) -> int:
    """So many variants that starting the peer does not count."""
    some = 16
    while peer.seconds(some) < PEER_SECONDS:
        some *= 2
    return some


def measured(
    program: Path, folder: Path, case: Transmission, count: int, rounds: int
) -> tuple[float, float, float]:
    """Seconds of the first call, and by variant for the peer and for a later call."""
    peer = Peer(program, case, folder)
    call = partial(solve, case, ratios=like_the_peer(case, count))
    first = timed(partial(all_read, call))
    same_sum(peer, call())
    some = enough(peer)
    found = medians(
        {"peer": partial(peer.seconds, some), "": partial(timed, partial(all_read, call))}, rounds
    )
    return first, found["peer"] / some, found[""] / count


def main() -> None:
    """Measure and print."""
    given = options(__doc__)
    count, rounds, sizes = (500, 1, LINKS[:2]) if given.quick else (COUNT, 7, LINKS)
    differential = load(MZKT.parent / "differential.yaml")
    lossy = [mechanism._replace(efficiency=0.97) for mechanism in differential.mechanisms]
    differential = replace(differential, mechanisms=lossy)
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for name, unit in (("differentials", differential), ("MZKT gearboxes", load(MZKT))):
            for links in sizes:
                case = chained(unit, links)
                first, theirs, ours = measured(given.peer, Path(folder), case, count, rounds)
                pairs = len(case.gears) / 1e6
                rows.append(
                    (
                        f"{links // unit.links} {name}",
                        links,
                        len(case.devices) + 1,
                        f"{1e3 * first:.0f} ms",
                        f"{theirs / pairs:.2f}",
                        f"{ours / pairs:.3f}",
                        f"{theirs / ours:.0f}",
                    )
                )
    print_table(
        f"Growth with size, calls of {count:,}",
        (
            "train",
            "links",
            "torques",
            "first call",
            "peer: µs a variant and gear",
            "vstatics: µs a variant and gear",
            "times the peer",
        ),
        rows,
    )


if __name__ == "__main__":
    main()
