"""The bar of gears: pieces of time in which all elements of a gear stick, and what is between.

The run: A and B hold gear 1; C takes over from B in gear 2. By hand: C slips from 1 s and locks at
3 s, B slips from 2 s; D is of a third gear.
"""

from itertools import combinations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.simulation.pictures.test_shift import run
from vstatics import loads, solve
from vstatics.simulation import Motion
from vstatics.simulation.pictures.elements import ElementStates
from vstatics.simulation.pictures.gears import (
    GearElements,
    ShiftPhase,
    common,
    element_sets,
    gear_pieces,
    phases,
)

GEARS = {
    name: GearElements(frozenset(stick))
    for name, stick in zip("123", ("AB", "AC", "CD"), strict=True)
}
ROWS = [
    ElementStates("A", 0, ((4.0, 5.0),), ((0.0, 4.0),)),
    ElementStates("B", 1, ((2.0, 2.5),), ((0.0, 2.0),)),
    ElementStates("C", 2, ((1.0, 3.0),), ((3.0, 5.0),)),
]


def shifting(**sticks: list[int]) -> Motion:
    """A run of which it is known what sticks between whole seconds, A to D by default."""
    known = {"A": [1, 1, 1, 1, 0], "B": [1, 1, 0, 0, 0], "C": [0, 0, 0, 1, 1]}
    known |= {"D": [0] * len(sticks.get("A", known["A"]))} | sticks
    table = {name: np.r_[0.0, values] for name, values in known.items()}
    time = np.arange(1.0 + len(known["A"]))
    return run()._replace(time=time, elements=tuple(table), beside={"sticks": table})


def test_between_two_gears_are_a_torque_phase_and_an_inertia_phase() -> None:
    motion = shifting()
    assert phases(GEARS, motion, gear_pieces(GEARS, motion, ROWS), ROWS) == [
        ShiftPhase("torque", 1.0, 2.0),
        ShiftPhase("inertia", 2.0, 3.0),
        ShiftPhase("slip", 4.0, 5.0),
    ]


def test_of_gears_within_one_another_the_one_with_more_elements_holds() -> None:
    pieces = gear_pieces({"0": GearElements(frozenset("A")), **GEARS}, shifting(), ROWS)
    assert [(one.gear, one.start, one.end) for one in pieces] == [
        ("1", 0.0, 2.0), ("0", 2.0, 3.0), ("2", 3.0, 4.0),
    ]  # fmt: skip


def test_a_lock_up_clutch_that_slips_leaves_the_gear_in_brackets() -> None:
    motion = shifting(L=[0, 0, 0, 0, 0])
    gears = {name: GearElements(stick | {"L"}) for name, (stick, *_) in GEARS.items()}
    assert common(gears, motion) == ["L"]
    assert gear_pieces(gears, motion, ROWS) == []
    found = phases(gears, motion, [], ROWS)
    parts = [(one.gear, one.start, one.end) for one in found if one.phase == "part"]
    assert parts == [("1", 0.0, 2.0), ("2", 3.0, 4.0)]


def test_a_gear_with_a_slip_is_named_while_it_slips() -> None:
    """C slips under torque from 1 s to 3 s. Gears with the same elements share a piece."""
    held = frozenset("A")
    gears = {name: GearElements(held) for name in ("1", "1 coast")}
    gears["1 slip"] = GearElements(held, frozenset("C"))
    pieces = gear_pieces(gears, shifting(), ROWS)
    assert [piece[:3] for piece in pieces] == [
        ("1, 1 coast", 0.0, 1.0), ("1 slip", 1.0, 3.0), ("1, 1 coast", 3.0, 4.0),
    ]  # fmt: skip


@pytest.mark.parametrize("load", ["", "load: {speed: 2000 rpm, torque: -30 N*m}"])
def test_a_gear_needs_the_freewheel_that_drives_it(load: str) -> None:
    """The freewheel holds the ring in first gear, behind a converter and also if the case coasts."""
    case = loads(f"""
    links: [engine, turbine, sun, ring, out]
    {load}
    shift_elements:
      F: {{kind: freewheel, links: [ring, housing]}}
      A: [turbine, sun]
      B: [sun, ring]
    mechanisms: {{set: {{first: sun, second: ring, third: out, ratio: -2}}}}
    converters: {{TC: {{links: [engine, turbine], points: [[0, 2, 4e-3], [1, 1, 0]]}}}}
    gears: {{"1": [A], "2": [A, B], N: []}}
    """)
    sets = element_sets(solve(case))
    assert {name: {*elements.sticking} for name, elements in sets.items()} == {
        "1": {"A", "F"}, "2": {"A", "B"}, "N": set(),
    }  # fmt: skip
    motion = shifting(A=[0, 0, 1, 1], B=[0, 0, 0, 1], F=[1, 1, 1, 0])
    pieces = gear_pieces(sets, motion, [ElementStates("A", 0, ((1.0, 2.0),), ())])
    assert [piece[:3] for piece in pieces] == [("N", 0.0, 1.0), ("1", 2.0, 3.0), ("2", 3.0, 4.0)]


def test_a_gear_of_a_rounding_error_is_not_named() -> None:
    motion = shifting(A=[1, 0, 0, 0, 0])._replace(time=np.array([0, 1e-12, 2.0, 3.0, 4.0, 5.0]))
    assert gear_pieces({"0": GearElements(frozenset("A"))}, motion, ROWS) == []


def test_without_what_sticks_there_is_no_bar() -> None:
    assert gear_pieces(GEARS, shifting()._replace(beside={}), ROWS) == []


@given(st.lists(st.tuples(*[st.booleans()] * 4), min_size=1, max_size=12))
def test_pieces_are_where_all_elements_of_a_gear_stick(states: list[tuple[bool, ...]]) -> None:
    """At any second: whichever gear holds, all of it sticks; if none does, none could."""
    columns = {name: [int(row[n]) for row in states] for n, name in enumerate("ABCD")}
    motion = shifting(**columns)
    gears = {"".join(two): GearElements(frozenset(two)) for two in combinations("ABCD", 2)}
    pieces = gear_pieces(gears, motion, ROWS)
    for second, row in enumerate(states):
        stuck = {name for name, does in zip("ABCD", row, strict=True) if does}
        shown = [one.gear for one in pieces if one.start <= second < one.end]
        held = [name for name, elements in gears.items() if elements.sticking <= stuck]
        assert shown == [", ".join(held)] * bool(held)  # names never cover each other


@pytest.mark.parametrize("lost", ["B", "C"])
def test_a_gear_that_comes_back_is_no_inertia_phase(lost: str) -> None:
    kept = {"B": [1, 0, 1, 1, 1], "C": [0, 0, 0, 0, 0]}
    motion = shifting(A=[1, 1, 1, 1, 1], **kept)
    rows = [ElementStates(lost, 0, ((1.0, 2.0),), ())]
    [phase] = phases(GEARS, motion, gear_pieces(GEARS, motion, rows), rows)
    assert phase == ShiftPhase("slip", 1.0, 2.0)
