"""The status of a gear: one for each kind of faulty gear, the same from state and arrays."""

import math
from typing import Any, get_args

import vstatics
from tests.commands import CASES
from tests.core.statics.differential import train
from tests.core.statics.test_freewheels import pair
from vstatics import Gear, solve
from vstatics.core.statics.status import OK, STATUSES, UNDECIDED, statuses
from vstatics.core.texts import Language, translated

FAULTY = {
    "tied up": (train([(2, 0), (3, 0)], Gear([1, 2])), 1),
    "freewheels in conflict": (pair(), 1),
    "the output is at rest": (train([(3, 0)], Gear([1])), 1),
    "neutral": (train([(2, 0)], Gear()), 1),
    "torques do not balance": (train([(2, 0)], Gear(speeds={3: 0.25})), 1),
    "self-locking": (vstatics.load(CASES / "self-locking.yaml"), 2),
    "back-driven": (train([(2, 0)], Gear([1], drag={1: 1.5})), 1),
}


SOUND: dict[str, Any] = {
    **dict.fromkeys(("tied_up", "conflict", "locked", "undecided"), False),
    "output_speed": 0.5,
    "balanced": True,
}
"""Arguments of `statuses` for a gear without a fault."""


def test_each_kind_of_faulty_gear_has_its_status() -> None:
    for words, (case, number) in FAULTY.items():
        results = solve(case)
        assert results.status(number).english == words
        assert results.gear(number).status == results.status(number)
        fails = words in ("tied up", "freewheels in conflict")
        assert results.failed == fails
        assert results.status(number).is_fault == (fails or words == "self-locking")


def test_a_sound_gear_has_none_but_where_a_search_was_cut_short() -> None:
    results = solve(train([(2, 0)], Gear([1])))
    assert results.status(1) == results.gear(1).status == OK
    assert statuses(**SOUND) == []
    assert statuses(**SOUND | {"undecided": True}) == [UNDECIDED]
    # the cause comes first: a tied-up gear has neither an output speed nor balanced torques
    marks = SOUND | {"tied_up": True, "output_speed": math.nan, "balanced": False}
    assert [one.name for one in statuses(**marks)] == ["tied up", "open", "no torques"]


def test_statuses_differ_in_every_language() -> None:
    for language in get_args(Language):
        for words in zip(*(one[:3] for one in STATUSES), strict=True):
            said = [translated(one, language) for one in words]
            assert len({*said}) == len(STATUSES)
            assert all(said)
            assert language == "en" or not {*said} & {*words}
    faults = [one.is_fault for one in STATUSES]
    assert faults == sorted(faults, reverse=True)
    assert OK not in STATUSES
