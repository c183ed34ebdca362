"""Pieces of a search hold every choice of ports once, however many they are.

Source of the choices: those of tests/oracle/boxes.py, found among all schemes in the simplest way.
"""

from collections import Counter

import pytest

from tests.chance import seeded, with_slow
from tests.oracle.boxes import HELD, Frame, Space, all_frames, names
from vstatics.synthesis.boxes.batches.cut import ranges
from vstatics.synthesis.boxes.box import BoxSearch
from vstatics.synthesis.boxes.schemes.choices import BoxScheme
from vstatics.synthesis.boxes.schemes.stems import UNIT, box_schemes, stems

SMALL = {
    "one set": Space(1, 2, 1, (3, 1)),
    "two": Space(2, 4, 1, (3, 1)),
    "meshed, own input": Space(2, 4, 2, (3, 1), meshed=1, own_input=True),
    "held, in parts": Space(2, 5, 2, (3, 1), fixed=1, meshed=1),
    "shaft, own output": Space(2, 5, 3, (3, 1), shafts=1, own_output=True),
    "two held": Space(2, 4, 1, (3, 1), fixed=2),
    "meshed, own output": Space(2, 4, 2, (3, 1), own_output=True, meshed=1),
    "held, own ports": Space(2, 5, 3, (3, 1), own_input=True, own_output=True, fixed=1),
}
LARGER = {
    "three": Space(3, 5, 2, (3, 1)),
    "three, held, meshed": Space(3, 5, 2, (3, 1), fixed=1, meshed=1),
    "three, own ports, shaft": Space(3, 5, 4, (3, 1), own_input=True, own_output=True, shafts=1),
}


def named(one: BoxScheme, shafts: int = 0) -> list[Frame]:
    """The least names of a scheme with its ports."""
    code = tuple(link for own in one.scheme.sets for link in own)
    held = HELD if one.held is None else one.held
    return [min(names(Frame(code, one.meshed, held, *ports, shafts), ()))[0] for ports in one.ports]


def asked(space: Space) -> BoxSearch:
    return BoxSearch(**{key: value for key, value in space._asdict().items() if key != "cells"})


@pytest.mark.parametrize("name", with_slow(SMALL, LARGER))
def test_every_choice_is_in_one_piece(name: str) -> None:
    space, count = (SMALL | LARGER)[name], seeded(3).randrange(2, 50 if name in SMALL else 500)
    search = asked(space)
    every = Counter(min(names(frame, ()))[0] for frame in all_frames(space))
    schemes = [one for piece in range(count) for one in ranges(search, piece, count)]
    assert Counter(frame for one in schemes for frame in named(one, search.shafts)) == every
    assert {*every.values()} == {1}
    assert sum(len(one.ports) for one in box_schemes(search)) == len(every)


def test_all_schemes_have_all_choices_of_ports() -> None:
    """Classes of sound schemes with ordered input and output, by Burnside's lemma.

    tests/oracle/schemes.py counts those of `vstatics synth structures --ports` apart.
    """
    counts = {(2, 1): (12, 111), (2, 2): (6, 90), (3, 1): (190, 3656), (3, 2): (155, 4428)}
    for (sets, engaged), counted in (counts | {(3, 3): (37, 1350)}).items():
        found = list(box_schemes(BoxSearch(sets, 4, engaged, (2.0,))))
        assert (len(found), sum(len(one.ports) for one in found)) == counted


@pytest.mark.slow
def test_stems_weigh_as_much_as_grows_from_them() -> None:
    """Classes of five sets with nine links: 146 523 by Burnside, see tests/oracle/schemes.py."""
    found = stems(BoxSearch(5, 5, 3, (3.0, 1.0)))
    assert found.ends[-1] / UNIT == pytest.approx(146_523, rel=0.1)
    chosen = seeded(5).sample(range(len(found.ends)), 200)
    weights = [int(found.ends[stem] - found.ends[stem - 1]) / UNIT for stem in chosen]
    assert sum(len(found.schemes(stem)) for stem in chosen) == pytest.approx(sum(weights), rel=0.4)
