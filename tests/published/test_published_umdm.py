"""The universal multi-flow differential mechanism: every relation and table of its paper.

Source: Voloshko V.V., Galimyanov I.D., Salakhov I.I., Mavleev I.R., Kinematic and force
analysis of the universal multi-flow differential mechanism (UMDM) of automatic gearboxes
(in Russian). Numbers of equations and tables in parentheses are the paper's. The paper has
no teeth; the numbers here follow from invented ones (`umdm_cases.GOLDEN`):
z1=36 z2=18 z6=72, z2'=21 z3=30 z7=84, z3'=20 z4=34 z8=74.

Put right against print: (3) gives the absolute speed of a planet; in (7) and (8) one
superscript and one denominator; the sign of (24); the subscripts of (31); i_75 in the last
entry of table 4; `-+` is lost in (26) to (28). Each is noted where it is used.
"""

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from tests.commands import CASES, vstatics
from tests.core.elements.element_cases import (
    efficiencies,
    link_speeds,
    ratios,
    reading,
    solved,
    torque,
)
from tests.oracle.single_meshes import speeds
from tests.published.umdm_cases import (
    DIRECTIONS,
    GOLDEN,
    LINKS,
    PAIRS,
    WHEELS,
    Teeth,
    gear,
    group_case,
    internal_ratio,
    lock,
    ratio,
    star_case,
)
from vstatics.core.statics.results import Results

Speeds = Mapping[str, Mapping[str, float]]
"""Gear, then link."""

PRECISION = 1e-12
FIVE_DECIMALS = 0.5e-5
Z = GOLDEN
I14, I16, I17, I18 = (internal_ratio(Z, "1", k) for k in "4678")

PROGRAM = ("meshes", "reduced", *(f"star on {wheel}" for wheel in WHEELS))
WAYS = ("single meshes", *PROGRAM)


@pytest.fixture(scope="module")
def results() -> dict[str, Results]:
    """What the program calculates, by the way the mechanism is written down."""
    cases = {losses: group_case(losses=losses) for losses in ("meshes", "reduced")}
    cases |= {f"star on {wheel}": star_case(wheel) for wheel in WHEELS}
    return {way: solved(case) for way, case in cases.items()}


@pytest.fixture(scope="module", params=WAYS)
def of(request: pytest.FixtureRequest, results: dict[str, Results]) -> Speeds:
    """The speeds of every gear by one of the ways: by the program, and without it."""
    if request.param == "single meshes":
        document = group_case()
        return {
            name: {link: float(speed) for link, speed in speeds(document, name).items()}
            for name in document["gears"]
        }
    found = results[request.param]
    return {name: link_speeds(found, name) for name in ratios(found)}


@pytest.fixture(scope="module", params=PROGRAM)
def solution(request: pytest.FixtureRequest, results: dict[str, Results]) -> Results:
    """What the program calculates, for each way to write the mechanism down."""
    return results[request.param]


def close(value: Fraction | float) -> object:
    """Equal but for rounding."""
    return pytest.approx(float(value), rel=PRECISION, abs=PRECISION)


def close_to(values: Mapping[str, Fraction]) -> object:
    """Return a mapping that is equal to `values` up to rounding."""
    expected = {name: float(value) for name, value in values.items()}
    return pytest.approx(expected, rel=PRECISION, abs=PRECISION)


def of_speeds(found: Speeds, name: str) -> float:
    """The ratio of a gear from the speed of its output."""
    output = name.split(" ", maxsplit=1)[0].split("-")[1]
    return 1 / found[name][output]


# --- Structure: (1), number of variants -------------------------------------------------


def test_internal_ratios_of_the_example() -> None:
    """i_14 = -z2 z3 z4/(z1 z2' z3'), i_16 = -z6/z1, i_17 = z2 z7/(z1 z2'), i_18 by z8."""
    found = {"4": I14, "6": I16, "7": I17, "8": I18}
    assert found == {"4": Fraction(-17, 14), "6": -2, "7": 2, "8": Fraction(37, 14)}


def test_1_six_links_less_four_mechanisms_leave_two_degrees_of_freedom(solution: Results) -> None:
    case = solution.case
    assert case.links - len(case.mechanisms) == 2
    assert not solution.failed
    assert (solution.missing == 0).all()
    assert (solution.excess == 0).all()


def test_1_at_the_meshes_two_planets_and_six_meshes_leave_the_same_two(
    results: dict[str, Results],
) -> None:
    case = results["meshes"].case
    assert (case.links, len(case.mechanisms)) == (8, 6)
    assert [len(results[way].case.mechanisms) for way in PROGRAM[1:]] == [4] * 6


def test_meshes_are_the_default_where_planets_are_shared() -> None:
    assert len(reading(group_case()).case.mechanisms) == 6


def test_15_pairs_of_links_have_30_directions() -> None:
    """The paper's G = 15 counts unordered pairs of input and output."""
    assert (len(PAIRS), len(DIRECTIONS)) == (15, 30)


def test_three_pairs_of_planets_can_be_put_in() -> None:
    assert not any("assembled" in told.message for told in reading(group_case()).warnings)


# --- Kinematics: (2) to (16), tables 1 to 3 ---------------------------------------------


def test_2_willis_relation_of_any_two_wheels_in_every_gear(of: Speeds) -> None:
    """n_in = n_out i + n_H (1 - i), which is also (4), and (9) to (12) where 1 drives."""
    for n in of.values():
        for a in WHEELS:
            for b in WHEELS:
                if a != b:
                    i = float(internal_ratio(Z, a, b))
                    assert n[a] == pytest.approx(n[b] * i + n["5"] * (1 - i), abs=1e-10)


def test_3_gives_the_absolute_speed_of_a_planet(results: dict[str, Results]) -> None:
    """With i_q,out = n_q/n_out of a planet q; printed as the relative speed: put right here."""
    i_a6, i_b8 = Z["6"] / Z["2"], Z["8"] / Z["3'"]
    for name in group_case()["gears"]:
        n = link_speeds(results["meshes"], name)
        assert n["P.A"] == close(n["6"] * i_a6 + n["5"] * (1 - i_a6)), name
        assert n["P.B"] == close(n["8"] * i_b8 + n["5"] * (1 - i_b8)), name


def of_meshes() -> list[Fraction]:
    """i_12, i_23, i_34, i_38, i_26 and i_37, without signs."""
    meshes = ("1", "2"), ("2'", "3"), ("3'", "4"), ("3'", "8"), ("2", "6"), ("3", "7")
    return [Fraction(Z[b], Z[a]) for a, b in meshes]


def test_5_to_8_ratios_from_1_to_8(of: Speeds) -> None:
    """With 5 stopped i_18, with q = 4, 6 or 7 stopped (1 - i_1q)/(1 - i_8q).

    Put right: (7) prints `i_1-4^7` for i_1-8^7, and (8) `1 + i_8-7` for 1 + abs(i_84).
    """
    i12, i23, i34, i38, i26, i37 = of_meshes()
    expected = {
        "5": (-i12) * (-i23) * i38,  # (5)
        "6": (1 - (-i12) * i26) / (1 - (1 / i38) * (-1 / i23) * i26),  # (6)
        "7": (1 - (-i12) * (-i23) * i37) / (1 - (1 / i38) * i37),  # (7)
        "4": (1 - (-i12) * (-i23) * (-i34)) / (1 - (1 / i38) * (-i34)),  # (8)
    }
    assert expected == {
        "5": Fraction(37, 14),
        "6": Fraction(111, 65),
        "7": Fraction(-37, 9),
        "4": Fraction(1147, 756),
    }
    for q, value in expected.items():
        assert of_speeds(of, gear("1", "8", q)) == close(value)


def test_13_and_14_with_4_stopped(of: Speeds) -> None:
    """n_H = n_1/(1 - i_14), n_8 = (n_1 - n_H (1 - i_18))/i_18, from (9): print says (1)."""
    n = of[gear("1", "8", "4")]
    assert n["5"] == close(1 / (1 - I14))
    assert n["8"] == close((1 - (1 - I18) / (1 - I14)) / I18)


TABLE_2 = {
    "84": I14 / I18,
    "86": I16 / I18,
    "87": I17 / I18,
    "48": I18 / I14,
    "46": I16 / I14,
    "47": I17 / I14,
    "64": I14 / I16,
    "67": I17 / I16,
    "68": I18 / I16,
    "74": I14 / I17,
    "76": I16 / I17,
    "78": I18 / I17,
}
"""(15) is its first entry: i_ab = i_1b/i_1a."""


def test_table_2_ratios_with_the_carrier_stopped(of: Speeds) -> None:
    found = {pair: of_speeds(of, gear(pair[0], pair[1], "5")) for pair in TABLE_2}
    assert found == close_to(TABLE_2)


TABLE_3 = {
    "1": 1 / (1 - 1 / I18),
    "6": 1 / (1 - I16 / I18),
    "4": 1 / (1 - I14 / I18),
    "7": 1 / (1 - I17 / I18),
}
"""(16): i_58^q = 1/(1 - i_8q)."""


def test_table_3_ratios_from_the_carrier_to_8(of: Speeds) -> None:
    assert {q: of_speeds(of, gear("5", "8", q)) for q in TABLE_3} == close_to(TABLE_3)


def test_every_direction_with_every_brake(of: Speeds) -> None:
    """All 30 directions, 120 ratios: i_ab^q = (1 - i_aq)/(1 - i_bq); so (6), (30) hold, too."""
    for a, b in DIRECTIONS:
        for q in LINKS:
            if q not in (a, b):
                assert of_speeds(of, gear(a, b, q)) == close(ratio(Z, a, b, q))


def test_the_ratio_is_that_of_the_speeds(solution: Results) -> None:
    for name, value in ratios(solution).items():
        if not name.startswith("lock"):
            a, b, q = name[0], name[2], name[-1]
            assert value == close(ratio(Z, a, b, q)), name


TABLE_1 = {
    "1-4": {"5": "-", "6": "-", "7": "-", "8": "-"},
    "1-8": {"4": "+", "5": "+", "6": "+", "7": "+-"},
    "1-5": {"4": "+", "6": "+", "7": "-", "8": "-"},
    "5-4": {"1": "+", "6": "-", "7": "+", "8": "+"},
    "5-8": {"1": "+", "4": "+", "6": "+", "7": "+-"},
    "6-4": {"1": "+", "5": "+", "7": "+", "8": "+"},
    "6-8": {"1": "+", "4": "+", "5": "-", "7": "+-"},
    "6-5": {"1": "+", "4": "+", "7": "+", "8": "+"},
}
"""As printed: input-output, then the sign with each brake."""


def test_table_1_signs(of: Speeds) -> None:
    for direction, signs in TABLE_1.items():
        for q, sign in signs.items():
            value = of_speeds(of, f"{direction} T{q}")
            assert ("+" if value > 0 else "-") in sign, (direction, q)


def test_output_4_is_not_always_slower_to_drive_than_the_carrier(of: Speeds) -> None:
    """The paper calls i_54 always much less than one; with 6 stopped it is 1.545 here."""
    assert abs(of_speeds(of, gear("5", "4", "6"))) == close(1 / (internal_ratio(Z, "4", "6") - 1))
    assert abs(of_speeds(of, gear("5", "4", "6"))) > 1


SPEEDS = {
    # n4, nH, n6, n7, n8 for n1 = 1, then planets A and B against the carrier
    gear("1", "8", "5"): ("-14/17", "0", "-1/2", "1/2", "14/37", -2, 1.4),
    gear("1", "8", "6"): ("-11/51", "1/3", "0", "2/3", "65/111", -1.33333, 0.93333),
    gear("1", "8", "4"): ("0", "14/31", "11/62", "45/62", "756/1147", -1.09677, 0.76774),
    gear("1", "8", "7"): ("-45/17", "-1", "-2", "0", "-9/37", -4, 2.8),
    gear("1", "4", "8"): ("-756/391", "-14/23", "-65/46", "9/46", "0", -3.21739, 2.25217),
    lock("1", "4"): ("1", "1", "1", "1", "1", 0, 0),
}
"""Gears TH, T6, T4, T7 (reverse), neutral (8 stands) and lock-up, by hand from (9) to (12)."""


def test_speeds_of_the_gears_from_1_to_8(of: Speeds) -> None:
    for name, (*expected, a, b) in SPEEDS.items():
        n = of[name]
        for link, value in zip("45678", expected, strict=True):
            assert n[link] == close(Fraction(value)), (name, link)
        for planet, relative in (("P.A", a), ("P.B", b)):
            if planet in n:
                slip = n[planet] - n["5"]
                assert slip == pytest.approx(relative, rel=0, abs=FIVE_DECIMALS + 1e-12), name


# --- Generalised kinematic plan (figure 5) ----------------------------------------------


def test_the_plan_has_a_straight_line_for_every_link(of: Speeds) -> None:
    """y_k = (u_k x - 1)/(u_k - 1) at x = n_8/n_1: through (1, 1), and 0 where k is stopped."""
    rays = {k: float(ratio(Z, "1", "8", k)) for k in "4567"}
    for name, n in of.items():
        if name.startswith(("1-", "lock")):
            for k, u in rays.items():
                assert n[k] == pytest.approx((u * n["8"] - 1) / (u - 1), abs=1e-10)


def test_links_4_and_1_are_fastest_against_one_another_in_reverse(of: Speeds) -> None:
    """The paper says so of a forward gear; the points k, l, e that it prints are reverse's."""
    apart = {q: abs(of[gear("1", "8", q)]["4"] - 1) for q in "4567"}
    assert max(apart, key=lambda q: apart[q]) == "7"
    expected = {"7": 3.647, "5": 1.824, "6": 1.216, "4": 1}
    assert apart == pytest.approx(expected, abs=0.5e-3 + 1e-12)


# --- Lock-up clutch: (17) to (19) -------------------------------------------------------


def test_17_and_18_lock_up_torque_from_the_speeds_of_neutral(solution: Results) -> None:
    """M_F = M_1 n_1/(n_x - n_y) with n_8 = 0: there the output torque does no work.

    (19), the clutch of the smallest torque, is in `test_the_lock_up_torques_of_all_15_pairs`.
    """
    neutral = speeds(group_case(), gear("1", "4", "8"))
    for x, y in PAIRS:
        expected = 1 / (neutral[x] - neutral[y])
        assert torque(solution, lock(x, y), f"F{x}-{y}") == close(expected), (x, y)
        assert ratios(solution)[lock(x, y)] == close(1)


# --- Torques: (20) to (32), table 4 -----------------------------------------------------


def test_20_to_25_torques_of_a_differential_mechanism(solution: Results) -> None:
    """External torques on 1, on wheel k and on the carrier, which stands and so holds.

    Put right: print has (24) M_H = M_in (1 - i); by (20) and (23) it is -M_in (1 - i).
    (26) to (28) are (23) to (25) with k = abs(i); their `-+` is lost in print.
    """
    for k, i in (("8", I18), ("4", I14), ("6", I16), ("7", I17)):
        name = gear("1", k, "5")
        m_in, m_out = 1.0, -output_torque(solution, name)
        m_carrier = -torque(solution, name, "T5")
        n = link_speeds(solution, name)
        assert m_in + m_carrier + m_out == pytest.approx(0, abs=1e-11), k  # (20)
        power = m_in * n["1"] + m_carrier * n["5"] + m_out * n[k]
        assert power == pytest.approx(0, abs=1e-11), k  # (21)
        against = m_in * (n["1"] - n["5"]) + m_out * (n[k] - n["5"])
        assert against == pytest.approx(0, abs=1e-11), k  # (22)
        assert m_out / m_in == close(-i), k  # (23)
        assert m_carrier == close(-(1 - i)), k  # (24), put right
        assert m_out == close(m_carrier * float(i / (1 - i))), k  # (25)


def output_torque(solution: Results, name: str) -> float:
    """What the output link gives to its load, without losses."""
    return float(solution.output_torque[list(ratios(solution)).index(name)])


def test_29_and_31_output_torque_is_the_ratio_in_every_direction(solution: Results) -> None:
    """M_out = M_in (1 - i_in,q)/(1 - i_out,q). Print has H for q among the subscripts."""
    for a, b in DIRECTIONS:
        for q in LINKS:
            if q not in (a, b):
                assert output_torque(solution, gear(a, b, q)) == close(ratio(Z, a, b, q))


def table_4() -> dict[str, tuple[Fraction, Fraction]]:
    """M_8 and M_q for M_1 = 1, as printed: factors i_xy of two meshing wheels without sign.

    Put right: in the last entry print has i_75 for i_73.
    """
    i12, i23, i34, i38, i26, i37 = of_meshes()
    i83, i32, i43, i62, i73 = 1 / i38, 1 / i23, 1 / i34, 1 / i26, 1 / i37
    i18 = (-i12) * (-i23) * i38
    return {
        "5": (i18, 1 - i18),
        "4": (
            (1 - (-i12) * (-i23) * (-i34)) / (1 - i83 * (-i34)),
            (1 - i18) / (1 - (-i43) * i38),
        ),
        "6": (
            (1 - (-i12) * i26) / (1 - i83 * (-i32) * i26),
            (1 - i18) / (1 - i62 * (-i23) * i38),
        ),
        "7": (
            (1 - (-i12) * (-i23) * i37) / (1 - i83 * i37),
            (1 - i18) / (1 - i73 * i38),
        ),
    }


TABLE_4_NUMBERS = {
    "5": (Fraction(37, 14), Fraction(-23, 14)),
    "6": (Fraction(111, 65), Fraction(-46, 65)),
    "4": (Fraction(1147, 756), Fraction(-391, 756)),
    "7": (Fraction(-37, 9), Fraction(46, 9)),
}


def test_table_4_torques_of_link_8_and_of_the_brake(solution: Results) -> None:
    """Column 2 is what link 8 gives, column 3 what the brake gets; together they are M_1."""
    assert table_4() == TABLE_4_NUMBERS
    for q, (m_8, m_q) in TABLE_4_NUMBERS.items():
        assert m_8 + m_q == 1
        name = gear("1", "8", q)
        assert output_torque(solution, name) == close(m_8), q
        assert torque(solution, name, f"T{q}") == close(m_q), q


def test_32_the_brake_torque_is_the_ratio_with_the_output_stopped(of: Speeds) -> None:
    """i_1q^8 = (1 - i_18)/(1 - i_q8) = 1 - i_18^q, at whatever speed the output runs."""
    for q, (_, m_q) in TABLE_4_NUMBERS.items():
        assert of_speeds(of, gear("1", q, "8")) == close(m_q), q
        assert 1 - ratio(Z, "1", "8", q) == m_q


# --- Losses: not in the paper -----------------------------------------------------------

EFFICIENCY = {
    "meshes": (0.95080, 0.97159, 0.97084, 0.84903),
    "star on 1": (0.95080, 0.97159, 0.97084, 0.69427),
    "star on 8": (0.95080, 0.95847, 0.96655, 0.81339),
    "star on 7": (0.93188, 0.95035, 0.96053, 0.84903),
    "star on 6": (0.93188, 0.96307, 0.96053, 0.69605),
    "star on 4": (0.91314, 0.93800, 0.95848, 0.69867),
}
"""Gears 1-8 with 5, 6, 4, 7 stopped; meshes .98 outside, .99 inside.

By an own calculation from the flow of power at each mesh or mechanism, not from the paper.
"""


@pytest.mark.parametrize("way", EFFICIENCY)
def test_efficiency_depends_on_the_choice_of_mechanisms(
    results: dict[str, Results], way: str
) -> None:
    found = efficiencies(results[way])
    for q, value in zip("5647", EFFICIENCY[way], strict=True):
        assert found[gear("1", "8", q)] == pytest.approx(value, rel=0, abs=FIVE_DECIMALS + 1e-12), q


def test_carrier_stopped_every_mesh_on_the_way_takes_its_part(results: dict[str, Results]) -> None:
    """1-2, 2'-3, 3'-8: .98 .98 .99, exactly; the mechanism is a train of fixed axes then."""
    assert efficiencies(results["meshes"])[gear("1", "8", "5")] == close(0.98 * 0.98 * 0.99)


def test_reduced_to_three_links_it_is_one_of_the_stars(results: dict[str, Results]) -> None:
    """Which one is a matter of the order of the wheels; none is right in every gear."""
    found = efficiencies(results["reduced"])
    gears = [gear("1", "8", q) for q in "5647"]
    stars = [
        [efficiencies(results[f"star on {wheel}"])[name] for name in gears] for wheel in WHEELS
    ]
    mine = [found[name] for name in gears]
    assert any(mine == pytest.approx(star, rel=1e-9) for star in stars)


# --- Other teeth ------------------------------------------------------------------------


@st.composite
def any_teeth(draw: st.DrawFn) -> dict[str, int]:
    """Wheels that turn at clearly different speeds on a stopped carrier."""
    rims = {wheel: draw(st.integers(14, 36)) for wheel in ("2", "2'", "3", "3'")}
    suns = {wheel: draw(st.integers(14, 50)) for wheel in ("1", "4")}
    rings = {wheel: draw(st.integers(60, 110)) for wheel in ("6", "7", "8")}
    z = rims | suns | rings
    for a in WHEELS:
        for b in WHEELS:
            assume(a == b or abs(1 - internal_ratio(z, a, b)) > Fraction(1, 50))
    return z


@pytest.mark.slow
@given(z=any_teeth())
@settings(max_examples=6)
def test_every_direction_with_every_brake_and_any_teeth(z: Teeth) -> None:
    """Ten signs of table 1 change if i_17, i_18 or i_46 is below 1; 19 hold for any teeth."""
    document = group_case(z)
    found = ratios(solved(document))
    for a, b in DIRECTIONS:
        for q in LINKS:
            if q not in (a, b):
                expected = float(ratio(z, a, b, q))
                assert found[gear(a, b, q)] == pytest.approx(expected, rel=1e-11)


LINK_NAMES = dict(
    zip(LINKS, ["sun 1", "sun 4", "carrier", "ring 6", "ring 7", "ring 8"], strict=True)
)


def of_ports(*ports: str) -> dict[str, dict[str, Any]]:
    """Combinations of one element of `cases/umdm.yaml` by ports, then by the element."""
    asked = ",".join(":".join(LINK_NAMES[link] for link in one.split("-")) for one in ports)
    said = vstatics(
        *("synth", "combinations", CASES / "umdm.yaml", "--shift-elements", "auto"),
        *("--ports", asked, "-f", "json"),
    )
    assert said.status == 0
    blocks = said.json["ports"]
    own = {"TH": "T-carrier", "T6": "T-ring 6", "T4": "T-sun 4", "T7": "T-ring 7"}
    own["F"] = "F-sun 1-sun 4"
    return {
        port: {own.get(one["engaged"][0], one["engaged"][0]): one for one in block["combinations"]}
        for port, block in zip(ports, blocks, strict=True)
    }


def test_table_1_by_one_command_for_all_ports() -> None:
    """29 signs, and three that depend on the teeth, all with their ratios in fractions."""
    found = of_ports(*TABLE_1)
    printed = [sign for row in TABLE_1.values() for sign in row.values()]
    assert (len(printed), printed.count("+-")) == (32, 3)
    for port, row in TABLE_1.items():
        brakes = [name for name in found[port] if name.startswith("T-")]
        assert set(brakes) == {f"T-{LINK_NAMES[q]}" for q in LINKS if q not in port.split("-")}
        for q, sign in row.items():
            one = found[port][f"T-{LINK_NAMES[q]}"]
            first, last = port.split("-")
            expected = float(ratio(Z, first, last, q))
            assert (one["kind"], one["ratio"]) == ("gear", pytest.approx(expected, rel=PRECISION))
            assert ("+" if one["ratio"] > 0 else "-") in sign


def test_the_lock_up_torques_of_all_15_pairs() -> None:
    """(17) to (19): M_F/M_1 = n_1/(n_x - n_y) with the speeds of neutral, n_8 = 0, by fractions."""
    neutral = speeds(group_case(), gear("1", "4", "8"))
    found = {name: one for name, one in of_ports("1-8")["1-8"].items() if one["kind"] == "direct"}
    assert len(found) == 15
    for first, second in PAIRS:
        name = f"F-{LINK_NAMES[first]}-{LINK_NAMES[second]}"
        slip = neutral[first] - neutral[second]
        assert found[name]["slip"] == pytest.approx(float(slip), rel=PRECISION)
        assert [*found[name]["torques"].values()] == [pytest.approx(float(1 / slip), rel=PRECISION)]
    least = min(found.values(), key=lambda one: abs(one["slip"] ** -1))
    assert least["engaged"] == ["F"]
    assert least["torques"]["F"] == pytest.approx(0.34089, abs=FIVE_DECIMALS)


def test_torques_of_the_brakes_are_those_of_table_4() -> None:
    """M_q/M_1 = 1 - i_18^q to the brake, by the sign of a torque that a link gives."""
    for name, one in of_ports("1-8")["1-8"].items():
        if one["kind"] == "gear":
            [given] = one["torques"].values()
            assert given == pytest.approx(1 - one["ratio"], rel=PRECISION), name
