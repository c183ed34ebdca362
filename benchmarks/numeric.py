"""A transmission as a text of numbers, which the peer reads.

In this order, separated by blanks: links, shift elements, mechanisms, mechanisms with a
planet ratio of their own; first links of the elements, then second ones; first, second
and third links of the mechanisms; ratios; efficiencies; numbers of the mechanisms with
planet ratios, then these; gears; how many elements are engaged, by gear; these elements,
gear by gear; two rows of zeros. Run alone it prints the text of a case.
"""

import argparse
from collections.abc import Sequence
from pathlib import Path

from vstatics import Transmission, load


def numeric(case: Transmission) -> str:
    """The text of a case with one input, one output and nothing given but engaged elements.

    Raises
    ------
    ValueError
        If the peer has no place for what the case says.
    """
    plain = case.input == 1 and case.output == case.links and not case.coast
    for gear in case.gears:
        plain = plain and not (gear.speeds or gear.torques or gear.input or gear.output)
    if not plain:
        raise ValueError("the peer takes the input to be link 1, the output to be the last one")
    mechanisms, elements = case.mechanisms, case.shift_elements
    planets = {n: m.planet_ratio for n, m in enumerate(mechanisms, 1) if m.planet_ratio is not None}
    rows: list[Sequence[float]] = [
        [case.links, len(elements), len(mechanisms), len(planets)],
        *zip(*((element.first, element.second) for element in elements), strict=True),
        *zip(*(mechanism.links for mechanism in mechanisms), strict=True),
        [mechanism.ratio for mechanism in mechanisms],
        [mechanism.efficiency for mechanism in mechanisms],
        list(planets),
        list(planets.values()),
        [len(case.gears)],
        [len(gear.engaged) for gear in case.gears],
        *(gear.engaged for gear in case.gears),
        *2 * [[0] * len(case.gears)],
    ]
    return "".join(" ".join(map(repr, row)) + "\n" for row in rows)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("case", type=Path)
    print(numeric(load(parser.parse_args().case)), end="")
