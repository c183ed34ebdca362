"""Boxes by chance: any scheme, ports, held link, meshed sets, elements, and gears of these."""

from collections.abc import Iterator
from functools import cache
from itertools import combinations
from typing import NamedTuple

from tests.chance import seeded
from vstatics.synthesis import FoundScheme, SetScheme, StructureSearch, schemes
from vstatics.synthesis.boxes.box import HELD, BoxSearch, FoundBox
from vstatics.synthesis.boxes.chosen_gears import set_ratios
from vstatics.synthesis.boxes.figures.measured import MeasuredBox, measured


class RandomBox(NamedTuple):
    """A box with the search that could have found it."""

    search: BoxSearch
    box: FoundBox

    def measured(self) -> MeasuredBox:
        """With its figures."""
        return measured(self.search, self.box, 0.97)


def numbered_box(_: object) -> str:
    return "box"


@cache
def _ported(sets: int) -> list[FoundScheme]:
    return list(schemes(StructureSearch(sets, "sets", ports=True)))


def random_boxes(count: int, seed: int) -> Iterator[RandomBox]:
    """So many boxes of two and three sets with two gears or more."""
    rng = seeded(seed)
    found = 0
    while found < count:
        one = rng.choice(_ported(rng.choice([2, 2, 3])))
        scheme = SetScheme.of_code(one.code)
        assert one.input is not None
        assert one.output is not None
        own_input, is_held = rng.random() < 0.3, rng.random() < 0.3
        links = list(range(scheme.links + own_input))
        source = links[-1] if own_input else one.input
        inner = [link for link in links if link not in (source, one.output)]
        held = rng.choice(inner) if is_held else None
        moving = [link for link in links if link != held]
        engaged = len(moving) - len(scheme.sets) - 1
        there = [(link, HELD) for link in inner if link != held] + [*combinations(moving, 2)]
        size = min(len(there), engaged + rng.choice([1, 2, 3]))
        elements = sorted(rng.sample(there, size), key=lambda pair: pair[1] != HELD)
        signs = [1 if rng.random() < 0.3 else -1 for _ in scheme.sets]
        ratios = tuple(sign * rng.uniform(1.4, 4.5) for sign in signs)
        box = FoundBox(scheme, held, source, one.output, tuple(elements), ratios, ((0,),), 0.0)
        if engaged < 1 or len(elements) <= engaged:
            continue
        sets = list(combinations(range(len(elements)), engaged))
        gears: dict[float, tuple[int, ...]] = {}
        for own, ratio in zip(sets, set_ratios(box, sets).tolist(), strict=True):
            if 0.05 < abs(ratio) < 20 and all(abs(ratio / other - 1) > 1e-6 for other in gears):
                gears[ratio] = own
        chosen = rng.sample([*gears], min(len(gears), rng.choice([3, 4, 6])))
        if len(chosen) < 2:
            continue
        found += 1
        targets = tuple(chosen)
        search = BoxSearch(len(scheme.sets), len(elements), engaged, targets)
        yield RandomBox(search, box._replace(gears=tuple(gears[ratio] for ratio in targets)))
