"""What is idle, what turns as one piece."""

import numpy as np
import pytest

from tests.commands import SHIPPED
from tests.oracle.cases import NASTY
from tests.shipped import shipped_results
from vstatics import Mechanism, Results, Transmission, load, solve
from vstatics.core.model.transmission import Gear, ShiftElement
from vstatics.core.statics.roles import mechanism_roles, roles


def by_name(results: Results, gear: str) -> dict[str, str]:
    number = results.case.gear_number(gear) - 1
    names = [device.name for device in results.case.own_devices]
    return dict(zip(names, roles(results, number), strict=True))


def test_a_set_that_only_holds_is_one_piece_and_not_idle() -> None:
    """Ford 10R80, gear 1: P1 stands and carries 3.696 on the carrier, as issue 16 has it."""
    results = shipped_results("ford-10r80.yaml")
    assert results["torques", "P1.carrier", "1"] == pytest.approx(-3.696, abs=5e-4)
    words = dict.fromkeys(("P2", "P3"), "unloaded") | {"P1": "locked up", "P4": ""}
    assert by_name(results, "1") == words
    assert mechanism_roles(results.gear("1")) == ["locked up", "unloaded", "unloaded", ""]


def test_a_shaft_of_ratio_1_transmits_power_and_a_support_only_holds() -> None:
    """Both links of the shaft turn alike, against the housing; a support has one link."""
    sets = [Mechanism(1, 3, 2, -2.0), Mechanism(3, 4, 0, 1.0, 0.99), Mechanism(2, 0, 0, 2.0, 0.9)]
    case = Transmission(4, [ShiftElement(2)], sets, [Gear([])])
    assert roles(solve(case), 0) == ["", "", ""]


@pytest.mark.slow
def test_words_agree_with_the_array_and_with_those_of_mechanisms() -> None:
    """What has a word is marked in the array; a plain mechanism is a device of its own."""
    cases = [load(path) for path in SHIPPED] + list(NASTY.values())
    for results in map(solve, cases):
        for number in np.flatnonzero(results.calculable).tolist():
            said = roles(results, number)
            marked = results.idle[number].tolist()
            assert all(map(bool.__le__, map(bool, said), marked))
            if results.case.drawing is None:
                assert said == mechanism_roles(results.gear(number + 1))
