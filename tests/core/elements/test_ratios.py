"""A Ravigneaux set of which the ratios are known, and no teeth."""

from typing import Any

import numpy as np
import pytest

from vstatics import CaseError, solve
from vstatics.core.elements.drawing import Drawing, transmission
from vstatics.core.elements.element import Element
from vstatics.core.model.transmission import Gear, Mechanism, ShiftElement, Transmission

MEMBERS = {"small_sun": 1, "large_sun": 2, "ring": 3, "carrier": 4}
ELEMENTS = [ShiftElement(4), ShiftElement(2), ShiftElement(1, 4), ShiftElement(1, 2)]
GEARS = [Gear([1]), Gear([2]), Gear([3]), Gear([4])]


def drawn(element: Element) -> Transmission:
    drawing = Drawing(4, (element,))
    return transmission(drawing, shift_elements=ELEMENTS, gears=GEARS, input=1, output=3)


def of_ratios(small: float, large: float, **others: object) -> Transmission:
    ratios = {"small_sun": small, "large_sun": large}
    own: dict[str, Any] = {"ratios": ratios, "efficiency": 0.97, **others}
    return drawn(Element("R", "ravigneaux", MEMBERS, **own))


def test_it_is_two_sets_of_one_carrier_and_ring() -> None:
    rng = np.random.default_rng(12)
    for large in -rng.uniform(1.3, 4.0, 5):
        small = -large * rng.uniform(0.9, 1.5)  # the ZF 5HP 19 has 98/38 and -98/34
        sets = [Mechanism(1, 3, 4, small, 0.97), Mechanism(2, 3, 4, large, 0.97)]
        apart = solve(Transmission(4, ELEMENTS, sets, GEARS, input=1, output=3))
        own = solve(of_ratios(small, large))
        assert own.speeds.tolist() == apart.speeds.tolist()
        assert own.efficiency.tolist() == apart.efficiency.tolist()
        assert own.torques[:, :4].tolist() == apart.torques[:, :4].tolist()


def test_it_turns_as_one_with_such_teeth() -> None:
    """Ring 85, suns 31 and 38; the long planets fill the gap between ring and large sun."""
    teeth = {"small_sun": 31, "large_sun": 38, "ring": 85}
    toothed = solve(drawn(Element("R", "ravigneaux", MEMBERS, teeth)))
    own = solve(of_ratios(85 / 31, -85 / 38))
    assert own.speeds == pytest.approx(toothed.speeds, rel=1e-12, nan_ok=True)
    assert own.planet_speeds == pytest.approx(toothed.planet_speeds, rel=1e-12, nan_ok=True)


def test_what_is_no_such_set_is_reported() -> None:
    others: tuple[dict[str, Any], ...]
    others = {"efficiency": None}, {"teeth": {"ring": 85}}, {"stiffness": 1e5}
    wrong = (0.5, -2.5), (-2.5, -2.0), (2.5, -0.5), (float("nan"), -2.0)
    for small, large, other in (*((*one, {}) for one in wrong), *((2.5, -2.0, o) for o in others)):
        with pytest.raises(CaseError, match="E797"):
            of_ratios(small, large, **other)
