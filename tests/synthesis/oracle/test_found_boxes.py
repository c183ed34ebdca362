"""The program's search for boxes against the brute force: complete lists of small spaces."""

from collections.abc import Iterator
from itertools import combinations

import pytest

from tests.chance import seeded
from tests.oracle import test_boxes as built_boxes
from tests.oracle.boxes import HELD, Box, Frame, Space, all_frames, found_in, names, triples
from tests.oracle.boxes import searched as all_searched
from tests.oracle.test_boxes import Built, Pairs, holds, ratio
from tests.synthesis.boxes.batches.test_cut import asked, named
from tests.synthesis.boxes.hand_boxes import FORD_10R, FORD_10R_SEARCH
from vstatics.synthesis.boxes.batches.cut import ranges
from vstatics.synthesis.boxes.batches.found import found_in as search_piece
from vstatics.synthesis.boxes.batches.ports import PortSearch
from vstatics.synthesis.boxes.box import BoxSearch, FoundBox
from vstatics.synthesis.boxes.least_form import identity, least_box
from vstatics.synthesis.boxes.schemes.choices import BoxScheme
from vstatics.synthesis.structures.scheme import SetScheme

pytestmark = pytest.mark.slow  # they compile
Name = tuple[Frame, Pairs]
NEAR = 0.02
"""A box with a gear so near to the end of its range may be found or not."""


def ports_of(search: BoxSearch, frame: Frame) -> PortSearch:
    scheme = SetScheme(tuple(triples(frame.code)))  # type: ignore[arg-type]
    held = None if frame.held == HELD else frame.held
    return PortSearch(search, BoxScheme(scheme, frame.meshed, held, ()))


def name_of(box: FoundBox, shafts: int = 0) -> Name:
    frame = Frame(
        tuple(link for one in box.scheme.sets for link in one),
        tuple(ratio > 0 for ratio in box.ratios),
        HELD if box.held is None else box.held,
        box.input,
        box.output,
        shafts,
    )
    return min(names(frame, box.elements))


def frames_of(piece: list[BoxScheme]) -> Iterator[Frame]:
    """The frames of a piece, in their least names."""
    for one in piece:
        yield from named(one)


def compare(space: Space, found: list[FoundBox], boxes: list[Box]) -> None:
    """All boxes are found, no other ones, with their errors."""
    own: dict[Name, float] = {}
    for box in found:  # shafts of no set are named in all orders
        name = name_of(box, space.shafts)
        own[name] = min(box.error, own.get(name, box.error))
    others = {(box.frame, box.elements): box for box in boxes}
    surely = {name for name, box in others.items() if box.farthest < 1 - NEAR}
    perhaps = {name for name, box in others.items() if box.farthest < 1 + NEAR}
    assert surely <= set(own) <= perhaps
    within = [name for name in surely if others[name].error < min(space.widths)]
    assert [own[name] for name in within] == pytest.approx(
        [others[name].error for name in within], abs=1e-3 * min(space.widths)
    )


BUILT = [built_boxes.SIMPSON, built_boxes.AOD, built_boxes.GF4A, built_boxes.A41TE]
SMALL = {
    "simpson": built_boxes.SIMPSON.space,
    "aod": built_boxes.AOD.space,
    "gf4a": built_boxes.GF4A.space,
    "41te": built_boxes.A41TE.space,
    "one set": Space(1, 2, 1, (3.5, 1), cells=100),
    "two meshed": Space(2, 5, 2, (1, 0.739, -4.857, -0.529), meshed=2, own_input=True),
    "held": Space(2, 4, 1, (1, -2.667, -1.886, -1.059), fixed=1),
    "held, meshed, in parts": Space(2, 5, 2, (6.581, 1.523, 1, -0.68), meshed=1, fixed=1),
    "two held": Space(2, 5, 2, (1.948, 1, -4.047, -2.077, -0.481), own_input=True, fixed=2),
    "ranges": Space(
        2, 4, 2, (2.6, 1.5, 1, -2.4), own_input=True, tolerances=(0.1, 0.05, 0.01, 0.2)
    ),
    "one set, ranges": Space(1, 2, 1, (3.5, 1), tolerances=(0.2, 0.01), cells=100),
    "own output": Space(2, 4, 2, (0.345, -1.35), own_output=True),
    "shaft of one set": Space(1, 4, 2, (3, 1), shafts=1, cells=100),
    "shaft": Space(2, 5, 3, (2.45, 1.45, 1, -2.2), shafts=1),
    "wide": Space(2, 4, 2, (3.5, 2, 1, -3), (1.2, 8), tolerance=0.03),
}


@pytest.mark.parametrize("space", SMALL.values(), ids=SMALL)
def test_complete_lists_of_small_spaces(space: Space) -> None:
    search = asked(space)
    pieces = [search_piece(search, piece, 3) for piece in range(3)]
    assert sum(piece.searched for piece in pieces) == all_searched(space)
    boxes = [box for frame in all_frames(space) for box in found_in(space, frame)]
    assert boxes
    built = (one for one in BUILT if one.space == space)
    assert all(holds(boxes, one) for one in built)
    compare(space, [box for piece in pieces for box in piece.boxes], boxes)


@pytest.mark.parametrize(
    "empty",
    [
        Space(1, 5, 3, (), shafts=2),
        Space(1, 5, 4, (), shafts=1, own_input=True, own_output=True),
        Space(2, 5, 2, (), shafts=1, meshed=1),
        Space(2, 5, 3, (), shafts=1, own_input=True, fixed=1),
        Space(2, 5, 3, (), own_input=True, own_output=True),
    ],
)
def test_what_shafts_without_a_set_give(empty: Space) -> None:
    """In frames and for ratios of chance, that some choice of elements has."""
    chance = seeded(32)
    frames, found_some = all_frames(empty), 0
    while found_some < 8:
        frame = chance.choice(frames)
        ratios = [(1 if one else -1) * chance.uniform(1.6, 4) for one in frame.meshed]
        elements = chance.sample(frame.possible, empty.elements)
        values = (ratio(frame, some, ratios) for some in combinations(elements, empty.engaged))
        gears = {round(value, 6) for value in values if 0.2 < abs(value) < 8}
        ends = [link for one in elements for link in one]
        near = any(1 < one / other < 1.1 for one in gears for other in gears)  # may be one gear
        if len(gears) < 2 or near or any(ends.count(shaft) < 3 for shaft in frame.further):
            continue
        space = empty._replace(targets=tuple(sorted(gears)))
        found = ports_of(asked(space), frame).boxes(frame.input, frame.output)
        found_some += len(found) > 0
        compare(space, found, found_in(space, frame))


def test_the_ten_speed_of_ford_is_found() -> None:
    """Its ratios and structure: cases/ford-10r80.yaml and the sources there."""
    known = least_box(FORD_10R)
    one = BoxScheme(FORD_10R.scheme, (False,) * 4, None, ((0, 7),))
    found = PortSearch(FORD_10R_SEARCH, one).boxes(0, 7)
    assert identity(known) in [identity(least_box(box)) for box in found]


PIECES = 40
"""Each has a hundred choices of ports or more."""


@pytest.mark.parametrize("built", [built_boxes.GM6, built_boxes.LEPELLETIER], ids=["6t70", "6hp26"])
def test_built_gearboxes_are_found(built: Built) -> None:
    """In the piece with the scheme, of which some other frames are compared, too."""
    search = asked(built.space)
    wanted = min(names(built.frame, built.elements))
    pieces = [[*ranges(search, piece, PIECES)] for piece in range(PIECES)]
    [number] = [n for n, piece in enumerate(pieces) if any(map(wanted[0].__eq__, frames_of(piece)))]
    found = {name_of(box): box for box in search_piece(search, number, PIECES).boxes}
    assert wanted in found
    frames = list(frames_of(pieces[number]))
    for other in seeded(15).sample(frames, min(len(frames), 10)):
        same = [box for name, box in found.items() if name[0] == other]
        compare(built.space, same, found_in(built.space, other))
