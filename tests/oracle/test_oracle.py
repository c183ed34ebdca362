"""The oracle against things outside of it: print, closed forms, other formulas.

Source of the method and of the MZKT 7922 table: Algin V.B., "Schematization and
calculation of mobile machine presented as multibody system. Kinematics and
quasistatics". Source of the UMDM: Voloshko V.V., Salakhov I.I., "Universal
multi-flow differential mechanism"; its teeth here are invented, so the expected
numbers follow from the tooth counts by hand.
"""

from fractions import Fraction

import pytest
from hypothesis import given, settings

from tests.chance import count, seeded
from tests.core.readers.deck.test_reader import MZKT7922
from tests.oracle.cases import NASTY
from tests.oracle.gears import flow_of, solve, solve_gear
from tests.oracle.linear import exact, sign
from tests.oracle.losses import Trial, admissible_sets, probed_sign, published_sign
from tests.oracle.systems import mechanism_column
from tests.shipped import PRINTED
from tests.trains import is_regular, no_losses, random_train, regular_trains, shown, trains
from vstatics.core.model.transmission import (
    Gear,
    IdleConvention,
    Mechanism,
    ShiftElement,
    Transmission,
)

pytestmark = pytest.mark.slow  # nothing in them is the program's own
BIG = 700
"""Trains in a seeded run; together they have over 2000 mechanisms."""


def mzkt(*, coast: bool = False, idle: IdleConvention = "published") -> Transmission:
    """MZKT 7922, the printed example."""
    return MZKT7922.replace(idle=idle, coast=coast)


def test_published_tables() -> None:
    for number, gear in enumerate(solve(mzkt())):
        for table, values in {
            "W": gear.speeds,
            "WSAT": gear.planet_speeds,
            "WFRI": gear.slip_speeds,
            "AMLG": gear.torques.listed,
            "AMLGP": gear.lossy_torques.listed,
        }.items():
            printed = [row[number] for row in PRINTED[table]]
            for value, expected in zip(values, printed, strict=True):
                assert value is not None
                assert abs(value - exact(expected)) <= Fraction(5, 10**4), (table, number + 1)


def test_published_efficiency_and_signs() -> None:
    gears = solve(mzkt())
    for gear, expected in zip(gears, PRINTED["ETA"], strict=True):
        assert gear.efficiency is not None
        assert abs(gear.efficiency - exact(expected)) <= Fraction(5, 10**4)
    signs = [list(row) for row in zip(*(gear.power_sign for gear in gears), strict=True)]
    assert signs == PRINTED["IX"]  # the idle sign that was printed as -1 is put right there


def test_published_matrix() -> None:
    case = mzkt()
    for k, mechanism in enumerate(case.mechanisms):
        printed = [exact(row[len(case.shift_elements) + k]) for row in PRINTED["AJK"]]
        assert mechanism_column(case.links, mechanism, exact(mechanism.ratio)) == printed


def test_idle_conventions_differ_in_signs_only_where_idle() -> None:
    for one, other in zip(solve(mzkt()), solve(mzkt(idle="exact")), strict=True):
        for x, y, idle in zip(one.power_sign, other.power_sign, one.idle, strict=True):
            assert y == (0 if idle else x)
        assert one.efficiency == other.efficiency


def test_reverse_gears_when_coasting() -> None:
    efficiencies = [gear.efficiency for gear in solve(mzkt(coast=True))[4:]]
    assert [round(float(eta or 0), 4) for eta in efficiencies] == [0.9014, 0.9212]


def held_ring(
    ratio: float, efficiency: float, ports: tuple[int, int] = (3, 2), *, coast: bool = False
) -> Transmission:
    """First link held, carrier in, second link out."""
    mechanism, gear = (
        Mechanism(1, 2, 3, ratio, efficiency),
        Gear([1], input=ports[0], output=ports[1]),
    )
    return Transmission(3, [ShiftElement(1)], [mechanism], [gear], coast=coast)


def test_great_ratio_with_a_sixth_of_the_power_is_locked_when_coasting() -> None:
    # w_out = 1 - 1/u; Mx = u'/(u' - 1) with u' = u/eta
    [gear] = solve(held_ring(1.004, 0.98))
    assert gear.ratio == 251
    assert gear.efficiency == Fraction(1, 6)
    assert gear.power_sign == (-1,)
    case = held_ring(1.004, 0.98, coast=True)
    [gear] = solve(case)
    assert gear.locked
    assert not gear.consistent
    assert (gear.efficiency, gear.power_sign) == (None, (1,))
    flow = flow_of(case, case.gears[0])
    eta = Trial(flow, flow.closed_form).eta
    assert eta is not None
    assert round(float(eta), 2) == -4.10
    assert round(float(251 / eta), 1) == -61.2


def test_output_without_torque_is_locked() -> None:
    # second in, first held, third out: Mx = (u' - 1)/u', and u' = u eta = 1
    case = held_ring(1.25, 0.8, (2, 3))
    [gear] = solve(case)
    assert gear.ratio == Fraction(1, 5)
    assert gear.locked
    assert Trial(flow_of(case, case.gears[0]), (1,)).torques.mx() == 0


def test_singular_with_losses_is_locked() -> None:
    # third in, first held, second out, coasting: Mx = u'/(u' - 1), and u' = u eta = 1
    [gear] = solve(held_ring(1.25, 0.8, coast=True))
    assert gear.ratio == gear.torques.output == 5
    assert gear.locked
    assert gear.efficiency is None
    assert solve(held_ring(1.25, 0.8))[0].efficiency == Fraction(5, 9)


# Teeth of the UMDM: z1=36 z2=18 z6=72; z2'=21 z3=30 z7=84; z3'=20 z4=34 z8=74.
# Links here: 1, 4 -> 2, carrier -> 3, 6 -> 4, 7 -> 5, 8 -> 6; planets A = 7, B = 8.
MESHES = [
    (1, 7, Fraction(-18, 36), "external"),
    (4, 7, Fraction(18, 72), "internal"),
    (7, 8, Fraction(-30, 21), "external"),
    (5, 8, Fraction(30, 84), "internal"),
    (2, 8, Fraction(-20, 34), "external"),
    (6, 8, Fraction(20, 74), "internal"),
]
UMDM_ELEMENTS = [ShiftElement(*ends) for ends in ((3,), (4,), (2,), (1, 2), (5,))]
UMDM_GEARS = [Gear([n]) for n in range(1, 6)]
UMDM_RATIOS = [Fraction(one) for one in ("37/14", "111/65", "1147/756", "1", "-37/9")]


def umdm(idle: IdleConvention = "exact") -> Transmission:
    """At the meshes: planets are links, one mechanism a mesh."""
    loss = {"external": 0.98, "internal": 0.99}
    mechanisms = [Mechanism(i, j, 3, float(u), loss[kind]) for i, j, u, kind in MESHES]
    return Transmission(8, UMDM_ELEMENTS, mechanisms, UMDM_GEARS, output=6, idle=idle)


def umdm_star(centre: int, idle: IdleConvention = "exact") -> Transmission:
    """Four three-link mechanisms with one common first link; planets are not links.

    The ratio of two wheels is the product of the meshes between them, and so is
    the efficiency: 1-A-6, 1-A-B-7, 1-A-B-4, 1-A-B-8.
    """
    others = [wheel for wheel in (1, 2, 4, 5, 6) if wheel != centre]
    mechanisms = []
    for wheel in others:
        (to_centre, loss_centre), (to_wheel, loss_wheel) = _arm(centre), _arm(wheel)
        bridge, loss_bridge = Fraction(1), Fraction(1)
        if (centre in (1, 4)) != (wheel in (1, 4)):
            bridge, loss_bridge = Fraction(-30, 21), Fraction(98, 100)
        if centre not in (1, 4):
            bridge = 1 / bridge
        ratio, eta = to_centre * bridge / to_wheel, loss_centre * loss_bridge * loss_wheel
        mechanisms.append(Mechanism(centre, wheel, 3, float(ratio), float(eta)))
    return Transmission(6, UMDM_ELEMENTS, mechanisms, UMDM_GEARS, idle=idle)


def _arm(wheel: int) -> tuple[Fraction, Fraction]:
    """Ratio and efficiency from a wheel to its planet."""
    u, kind = next((u, kind) for first, _, u, kind in MESHES if first == wheel)
    return u, Fraction(98 if kind == "external" else 99, 100)


@pytest.mark.parametrize("case", [umdm(), umdm_star(1)], ids=["meshes", "star"])
def test_umdm_ratios_and_torques(case: Transmission) -> None:
    gears = solve(case)
    for gear, ratio in zip(gears, UMDM_RATIOS, strict=True):
        assert float(gear.ratio or 0) == pytest.approx(float(ratio), rel=1e-12)
        assert gear.torques.output == gear.ratio
    brakes = [float(gear.torques.elements[n] or 0) for n, gear in enumerate(gears) if n != 3]
    # column 3 of the paper's table: M_q = M_1 (1 - i_18^q)
    expected = [float(1 - ratio) for ratio in UMDM_RATIOS if ratio != 1]
    assert brakes == pytest.approx(expected, rel=1e-12)


def test_umdm_speeds() -> None:
    gears = solve(umdm())
    for number, speeds in {  # 4, carrier, 6, 7, 8 as printed for the gears with one brake
        0: "-14/17 0 -1/2 1/2 14/37",
        1: "-11/51 1/3 0 2/3 65/111",
        2: "0 14/31 11/62 45/62 756/1147",
        4: "-45/17 -1 -2 0 -9/37",
    }.items():
        seen = [float(speed or 0) for speed in gears[number].speeds[1:6]]
        expected = [float(Fraction(speed)) for speed in speeds.split()]
        assert seen == pytest.approx(expected, abs=1e-12)


LOSSES = {
    "meshes": (0.95080, 0.97159, 0.97084, 0.84903),
    1: (0.95080, 0.97159, 0.97084, 0.69427),
    6: (0.95080, 0.95847, 0.96655, 0.81339),
    5: (0.93188, 0.95035, 0.96053, 0.84903),
    4: (0.93188, 0.96307, 0.96053, 0.69605),
    2: (0.91314, 0.93800, 0.95848, 0.69867),
}


@pytest.mark.parametrize("centre", list(LOSSES))
@pytest.mark.parametrize("idle", ["exact", "published"])
def test_umdm_losses(centre: int | str, idle: IdleConvention) -> None:
    case = umdm(idle) if isinstance(centre, str) else umdm_star(centre, idle)
    gears = solve(case)
    efficiencies = [float(gears[n].efficiency or 0) for n in (0, 1, 2, 4)]
    assert efficiencies == pytest.approx(LOSSES[centre], abs=5e-6)
    assert gears[3].efficiency == 1


def test_closed_form_is_the_published_test() -> None:
    """And of some the test with a very small step."""
    count = 0
    for seed in range(BIG):
        case = random_train(seeded(seed), regular=True, gears=1, coast=False)
        if not is_regular(case, case.gears[0]):
            continue
        flow = flow_of(case, case.gears[0])
        for k, power in enumerate(flow.powers):
            assert power is not None
            assert published_sign(flow, k) == sign(power), shown(case)
            count += 1
            if power and seed < 60:
                assert probed_sign(flow, k) == sign(power), shown(case)
    assert count >= 2000


@settings(max_examples=count(24, 180))
@given(trains())
def test_power_balance_is_zero(case: Transmission) -> None:
    for gear in case.gears:
        result, flow = solve_gear(case, gear), flow_of(case, gear)
        assert result.power_balance in (0, None)
        assert flow.ideal.power(flow.speeds, flow.ideal.ports()) in (0, None)
        is_open = None in result.torques.mechanisms or None in result.speeds
        assert result.power_balance == 0 or is_open or not result.consistent


@given(regular_trains())
def test_output_torque_times_output_speed_is_one(case: Transmission) -> None:
    gear = case.gears[0]
    result = solve_gear(case, gear)
    speed = result.speeds[case.gear_output(gear) - 1]
    if is_regular(case, gear):
        assert speed is not None
        assert result.torques.output == result.ratio == 1 / speed


@given(trains())
def test_efficiency_one_changes_nothing(case: Transmission) -> None:
    ideal = no_losses(case)
    for gear in ideal.gears:
        result = solve_gear(ideal, gear)
        if result.consistent:
            assert result.lossy_torques == result.torques
            assert result.efficiency in (1, None)
            assert set(result.losses) <= {0}


@given(regular_trains())
def test_efficiency_is_a_share(case: Transmission) -> None:
    result = solve_gear(case, case.gears[0])
    assert result.efficiency is None or 0 < result.efficiency <= 1
    if result.consistent:
        found = admissible_sets(flow_of(case, case.gears[0]))
        assert result.power_sign in [trial.signs for trial in found]


def test_most_regular_gears_can_be_solved() -> None:
    cases = [random_train(seeded(seed), regular=True, gears=1) for seed in range(200)]
    good = sum(is_regular(case, case.gears[0]) for case in cases)
    assert good >= 170


@pytest.mark.parametrize("name", NASTY)
def test_nasty_cases_are_what_their_names_say(name: str) -> None:
    (gear,) = solve(NASTY[name])
    assert gear.power_balance in (0, None)
    assert gear.locked == name.startswith("locked")
    assert gear.tied_up == name.startswith(("tied up", "right count"))
    assert gear.several == (name.startswith("several") or "largest" in name)
    assert gear.turned == (gear.several or name.startswith("turned"))
    if name.startswith("redundant"):
        assert gear.power_sign[0] is None
        assert gear.torques.output is not None
        assert gear.efficiency is None
