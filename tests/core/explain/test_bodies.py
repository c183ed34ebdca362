"""Which links turn together, and why."""

from __future__ import annotations

from tests.core.explain.explained import explained
from vstatics import solve
from vstatics.core.explain import explain_gear
from vstatics.core.model.transmission import Gear, Mechanism, ShiftElement, Transmission


def test_links_turn_together_by_structure_and_not_by_coincidence() -> None:
    """Link 3 turns as link 1 does only because -2 times -1/2 is 1; the clutch joins 4 to 1."""
    case = Transmission(
        4,
        [ShiftElement(1, 4, name="C")],
        [Mechanism(1, 2, 0, -2), Mechanism(2, 3, 0, -0.5)],
        [Gear([1])],
        output=3,
    )
    found = explain_gear(solve(case), 1)
    assert found.speeds.values["w_3"] == 1
    assert [(body.links, body.elements) for body in found.together] == [(["1", "4"], ["C"])]


def test_a_locked_set_turns_as_one_piece() -> None:
    direct = explained("differential.yaml", "1")
    assert [body.links for body in direct.together] == [["1", "2", "3"]]
    assert direct.one_piece == ["D"]


def test_what_the_housing_holds_stands() -> None:
    [body] = explained("differential.yaml", "2").together
    assert (body.links, body.stands, body.elements) == (["2"], True, ["T"])
