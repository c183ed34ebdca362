"""Compliances and dampings from a measured mode: table П2.1 of the book, round trips."""

import math
from collections.abc import Sequence
from typing import Any

import pytest

from tests.torsion.systems import sprung
from tests.torsion.vibration.test_decrements import TABLE_P2_1
from vstatics import CaseError, Gear, ShiftElement, Spring, Transmission, loads
from vstatics.torsion.vibration.gear_modes import Mode, modes
from vstatics.torsion.vibration.measured import Identified, damping, identify

DRIVELINE = """\
inertias: {engine: 0.15, disc: 0.0032, gear wheels: 0.001, wheel: 1.53, vehicle: 138, casing: 0.9}
springs:
  damper: {links: [engine, disc], compliance: 84e-5}
  "prop, shaft": {links: [gear wheels, pinion], compliance: 50e-5}
  tyre: {links: [wheel, vehicle], stiffness: 10309}
  wind-up: {links: [casing, housing], compliance: 7.02e-5}
shift_elements:
  I: {links: [countershaft, gear wheels], stiffness: 1e5}
  IV: [disc, gear wheels]
mechanisms:
  pair: {first: disc, second: countershaft, ratio: 3.49}
  final drive: {first: pinion, second: wheel, third: casing, ratio: 4.22, stiffness: 9e4,
    planet_ratio: 1}
gears: {1: [I], 4: [IV], both: [I, IV]}
"""
"""About as a Москвич-412, with a clutch and a mechanism that are elastic, too."""


def corrected(case: Transmission, made: Identified) -> Transmission:
    def those(devices: Sequence[Any]) -> list[Any]:
        found = []
        for one in devices:
            own: dict[str, float | None] = {"compliance": None} if isinstance(one, Spring) else {}
            if one.name in made.compliances:
                own |= {"stiffness": 1 / made.compliances[one.name]}
                own |= {"damping": made.dampings[one.name]}
            found.append(one._replace(**own))
        return found

    parts = ("springs", "mechanisms", "shift_elements")
    return case.replace(**{part: those(getattr(case, part)) for part in parts})


def mode(case: Transmission, gear: str, number: int = 1) -> Mode:
    [found] = modes(case, [gear])
    return found.modes[number - 1]


@pytest.mark.parametrize("gear", TABLE_P2_1)
def test_table_p2_1(gear: str) -> None:
    """Tsitovich, Algin, Vehicle dynamics (1981), ВАЗ-2101."""
    given = TABLE_P2_1[gear]
    first, second, third = given.inertias
    shaft = Spring({1: 1, 2: -1}, compliance=given.compliance, name="all")
    case = sprung(2, [shaft], {1: first + second, 2: third})
    made = identify(case, 1, given.measured, given.decrement)
    if given.calculated is not None:
        assert made.omega == pytest.approx(given.calculated, rel=0.3e-2)
    assert made.compliances["all"] == pytest.approx(given.corrected, rel=1.5e-2)
    inertia = 1 / (1 / (first + second) + 1 / third)
    exact = inertia * given.decrement * given.measured / math.pi  # (П2.3)
    assert made.dampings["all"] == pytest.approx(exact)
    if given.damping is not None:
        assert made.dampings["all"] == pytest.approx(given.damping, rel=0.3e-2)


@pytest.mark.parametrize(("gear", "number"), [("1", 1), ("1", 3), ("4", 1), ("4", 2)])
def test_a_corrected_case_has_the_measured_mode(gear: str, number: int) -> None:
    """All shapes stay; the damping is in proportion to the stiffness, so its ratio is exact."""
    case = loads(DRIVELINE)
    before = mode(case, gear, number)
    made = identify(case, gear, 0.8 * before.omega, 0.7, number)
    after = mode(corrected(case, made), gear, number)
    assert made.omega == before.omega
    assert after.omega == pytest.approx(0.8 * before.omega, rel=1e-12)
    assert after.shape == pytest.approx(before.shape)
    assert after.damping_ratio == pytest.approx(0.7 / (2 * math.pi))


def test_elastic_devices_of_the_gear_are_corrected() -> None:
    case = loads(DRIVELINE)
    always = {"damper", "prop, shaft", "tyre", "wind-up", "final drive"}
    assert identify(case, 1, 15).compliances.keys() == always | {"I"}
    assert identify(case, "4", 15).compliances.keys() == always
    assert identify(case, "4", 15).dampings == {}
    factor = (mode(case, "4").omega / 15) ** 2
    assert identify(case, "4", 15).compliances["final drive"] == pytest.approx(factor / 9e4)


def test_dampings_give_the_decrement_back() -> None:
    """Lightly damped, the ratio of the mode follows from its decrement."""
    case = loads(DRIVELINE)
    given = {"prop, shaft": 0.003, "tyre": 0.004, "wind-up": 0.009, "final drive": 0.001}
    made = damping(case, "4", given)
    assert made.omega == mode(case, "4").omega
    damped = case.replace(
        springs=[one._replace(damping=made.dampings.get(one.name, 0.0)) for one in case.springs],
        mechanisms=[
            one._replace(damping=made.dampings.get(one.name, 0.0)) for one in case.mechanisms
        ],
    )
    ratio = mode(damped, "4").damping_ratio
    assert made.decrement == pytest.approx(2 * math.pi * ratio, rel=1e-4)
    elastic = mode(case, "4").elastic
    assert made.shares == {name: elastic[name] for name in given}
    assert made.notes == []


def test_dampings_of_the_case_are_listed() -> None:
    """A loss factor adds ``pi * loss factor`` by its share, a damping K ``pi E omega K``, (П2.3)."""
    own = mode(loads(DRIVELINE), "4")
    for written, added in (("{loss_factor: 0.1}", 0.1), ("0.3", 84e-5 * own.omega * 0.3)):
        text = DRIVELINE.replace("84e-5", f"84e-5, damping: {written}")
        made = damping(loads(text), "4", {"tyre": 0.2})
        assert made.decrement == 0.2 * made.shares["tyre"]
        whole = f"{math.pi * added * own.elastic['damper']:.4g}"
        assert made.notes == [f"by its damping in the case damper adds {whole} to the decrement"]


def test_a_decrement_of_0_means_no_damping() -> None:
    found = identify(loads(DRIVELINE), "4", 15.0, 0.0)
    assert {*found.dampings.values()} == {0.0}
    assert damping(loads(DRIVELINE), "4", {"tyre": 0.0}).decrement == 0


def test_what_can_be_no_decrement() -> None:
    for decrements, message in (
        ({}, "read no decrement"),
        ({"tyer": 0.1}, "no elastic component `tyer`; did you mean `tyre`?"),
        ({"pair": 0.1}, "`pair` is not elastic in gear 4; elastic are `final drive`, `damper`"),
        ({"I": 0.1}, "`I` is not elastic in gear 4"),
        ({"tyre": -0.1}, "decrement of tyre: read -0.1, expected a number of 0 or more"),
        ({"tyre": math.nan}, "decrement of tyre: read nan"),
    ):
        with pytest.raises(ValueError, match="^" + message.replace("?", r"\?")):
            damping(loads(DRIVELINE), "4", decrements)


def test_what_can_be_no_frequency_and_no_mode() -> None:
    for omega in (0.0, -1.0, math.nan, math.inf, 1e-300, 1e300):
        with pytest.raises(ValueError, match=r"a number above 0|numbers so large"):
            identify(loads(DRIVELINE), "4", omega, 0.5)
    count = len(modes(loads(DRIVELINE), ["4"])[0].modes)
    with pytest.raises(ValueError, match=f"^no mode {count + 1} in gear 4; it has {count}$"):
        identify(loads(DRIVELINE), "4", 15.0, mode=count + 1)
    brake = ShiftElement(1, name="B")
    stuck = Transmission(1, [brake], [], [Gear([]), Gear([1])], inertias={1: 1.0})
    with pytest.raises(CaseError, match=r"gears\[2\]: tied up"):
        identify(stuck, 2, 15.0)
    pair = "links: 2\ninertias: {1: 1}\nmechanisms: {D: {first: 1, second: 2, ratio: 3}}\n"
    with pytest.raises(CaseError, match=r"gears\[1\]: nothing elastic connects the inertias"):
        identify(loads(pair + "gears: {1: []}"), 1, 15.0)
