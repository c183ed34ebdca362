"""What can be no transmission as a whole: told with its path."""

from __future__ import annotations

import re
from typing import Any

import pytest

from vstatics import CaseError, Gear, Mechanism, ShiftElement, Transmission
from vstatics import solve as solved


def test_there_may_be_no_more_than_eight() -> None:
    def many(count: int) -> Transmission:
        made = [ShiftElement(number, 0, kind="freewheel") for number in range(3, 3 + count)]
        mechanisms = [Mechanism(1, link, 0, -1.0) for link in range(2, 3 + count)]
        return Transmission(2 + count, made, mechanisms, [Gear()], output=2)

    assert solved(many(8)).conflict
    with pytest.raises(CaseError) as caught:
        many(9)
    (problem,) = caught.value.problems
    assert problem.path == ("shift_elements", 9)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"outputs": [3, 3]}, "outputs[2]: link 3 is listed twice, expected each output once"),
        ({"outputs": [3, 9]}, "outputs[2]: read 9, expected a link number from 1 to 3"),
        ({"outputs": [3, 1]}, "outputs[2]: link 1 is the input, expected another link"),
        ({"outputs": [2, 3], "output": 3}, "outputs: the first output is 2, but `output` is 3"),
    ],
)
def test_outputs_are_different_links(given: dict[str, Any], said: str) -> None:
    with pytest.raises(CaseError, match=re.escape(said)):
        Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear()], **given)


def test_the_first_of_several_outputs_is_the_output() -> None:
    case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear()], outputs=[2, 3])
    assert (case.output, case.outputs, case.further_outputs(case.gears[0])) == (2, (2, 3), [3])
    assert Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear()], outputs=[2]).outputs == ()
