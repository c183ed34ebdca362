"""Cases of schemes, against speeds that follow without any solver."""

import pytest

from vstatics import solve
from vstatics.synthesis import SetScheme, scheme_case

CHAIN = "0-1-2-0-3-1-2-4-5-5-6-7-7-8-9-9-10-11-11-12-13-13-14-15"
"""Eight sets, of which six hang in a row by ring and sun."""


def test_a_row_of_reductions_is_their_product() -> None:
    """Rings braked: each set of the row reduces by 1 - K, from sun to carrier."""
    row = "0-1-2-1-3-4-3-5-6"
    ratios = (-2.0, -2.5, -3.0)
    case = scheme_case(SetScheme.of_code(row), 0, 5, ratios)
    names = [element.name for element in case.shift_elements]
    wanted = tuple(names.index(name) + 1 for name in ("T-L2", "T-L4", "T-L6"))
    [gear] = [number for number, one in enumerate(case.gears) if one.engaged == wanted]
    assert solve(case).ratio[gear] == pytest.approx(3 * 3.5 * 4, rel=1e-12)
    assert case.gears[gear].name == "1"


def test_many_combinations_are_all_tried() -> None:
    """3432 of them, and the first that gives a gear stands late."""
    ratios = [-2 - number / 10 for number in range(8)]
    case = scheme_case(SetScheme.of_code(CHAIN), 0, 14, ratios)
    assert len(case.gears) > 1
    results = solve(case)
    assert results.calculable.all()
    assert len(set(results.ratio.round(9))) == len(case.gears)


@pytest.mark.parametrize("code", ["0-1-2-0-3-4-5-2-6-7-8-1", "0-1-2-3-4-1-2-5-6"])
def test_every_speed_is_determined_in_a_gear(code: str) -> None:
    """No link turns as it likes, and nothing is engaged in excess."""
    scheme = SetScheme.of_code(code)
    case = scheme_case(scheme, scheme.links - 1, scheme.links - 3, [-2.0] * len(scheme.sets))
    results = solve(case)
    assert results.calculable.all()
    assert all(len(gear.engaged) == scheme.mobility - 1 for gear in case.gears)
