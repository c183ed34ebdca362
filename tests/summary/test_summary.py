"""The summary of a transmission: design table, shifts, largest values, sensitivities."""

from __future__ import annotations

import json
import math
from itertools import pairwise

import numpy as np
import pytest

from tests.commands import CASES, LOCKED, NEUTRAL, ROOT, TIED_UP, vstatics
from vstatics import Gear, Mechanism, ShiftElement, Transmission, load, solve
from vstatics.summary import Summary, summarize
from vstatics.summary.extremes import Largest
from vstatics.summary.sensitivity import sensitivities

PUBLISHED = json.loads((ROOT / "tests" / "published" / "zf-8hp70.json").read_text())["ratio"]


def summary_of(name: str) -> Summary:
    return summarize(solve(load(CASES / name)))


@pytest.fixture(scope="module")
def zf() -> Summary:
    return summary_of("zf-8hp70.yaml")


def assert_largest(line: Largest, value: float, gear: str) -> None:
    assert line.value == pytest.approx(value)
    assert line.gear == gear


def differential(u: float = -2.5, **more: object) -> Transmission:
    """Sun in, carrier out; the brake holds the ring, the clutch joins sun and ring."""
    return Transmission(
        links=3,
        shift_elements=[ShiftElement(1, 2, "C"), ShiftElement(2, 0, "B")],
        mechanisms=[Mechanism(1, 2, 3, u, 0.96)],
        gears=[Gear([2], name="low"), Gear([1], name="direct")],
        **more,  # type: ignore[arg-type]
    )


def test_steps_and_spread_are_those_of_the_published_ratios(zf: Summary) -> None:
    """ZF 8HP70 as printed to four digits; see tests/published/zf-8hp70.json."""
    forward = [PUBLISHED[str(gear)] for gear in range(1, 9)]
    lines = {line.gear: line for line in zf.design.gears}
    for gear, (one, other) in zip("1234567", pairwise(forward), strict=True):
        assert lines[gear].next == str(int(gear) + 1)
        assert lines[gear].step == pytest.approx(one / other, abs=2e-4)
    assert zf.design.spread == pytest.approx(7.04, abs=0.01)  # the maker's figure
    assert lines["8"].next == lines["R"].next == ""
    assert math.isnan(lines["R"].step)


def test_each_shift_of_the_8hp_changes_one_element(zf: Summary) -> None:
    """A property that the source names: one clutch opens and one closes, up to jumps of one."""
    assert {transition.word for transition in zf.transitions} == {"single"}
    assert [(one.start, one.end) for one in zf.transitions if one.jumped == "5"] == [("4", "6")]
    first = zf.transitions[0]
    assert (first.released, first.engaged) == (["C"], ["E"])  # ABC to ABE


def test_a_freewheel_takes_part_in_a_shift_by_itself() -> None:
    """TH400: in gear 1 the low roller clutch holds, in gear 2 it overruns."""
    first, *_ = summary_of("simpson-th400.yaml").transitions
    assert first.released == ["low roller clutch"]
    assert first.engaged == ["intermediate clutch"]


def test_two_elements_out_and_two_in_is_a_double_transition() -> None:
    """MZKT 7922, from its deck: gear 2 is F2 and T4, gear 3 is T1 and F5."""
    shifts = {(one.start, one.end): one for one in summary_of("mzkt7922.dat").transitions}
    assert shifts["2", "3"].word == "double"
    assert shifts["1", "2"].word == "single"


def test_reverse_gears_are_neighbours_of_reverse_gears_only() -> None:
    """MZKT 7922: four forward and two reverse gears."""
    found = summary_of("mzkt7922.dat")
    assert found.design.forward == ["1", "2", "3", "4"]
    assert {line.gear: line.next for line in found.design.gears}["5"] == "6"


def test_most_gears_are_forward_whatever_sign_the_final_drive_gives_them() -> None:
    case = differential()
    turned = Transmission(
        links=4,
        shift_elements=case.shift_elements,
        mechanisms=[*case.mechanisms, Mechanism(3, 4, 0, -2.0)],
        gears=case.gears,
    )
    made = summarize(solve(turned)).design
    assert made.forward == ["low", "direct"]
    assert made.spread == pytest.approx(3.5)


def test_gears_are_neighbours_by_ratio_and_not_by_place() -> None:
    case = differential()
    turned = Transmission(3, case.shift_elements, case.mechanisms, case.gears[::-1])
    made = summarize(solve(turned))
    assert made.design.forward == ["low", "direct"]
    assert [(one.start, one.end) for one in made.transitions] == [("low", "direct")]


def test_largest_values_of_a_differential_worked_by_hand() -> None:
    """The brake holds the ring with -u = 2.5; the planet has p = (u + 1)/2 = -.75."""
    found = summarize(solve(differential())).largest
    carrier = 1 / 3.5
    [planet] = found["WSAT"]
    assert_largest(planet, (1 - carrier) / -0.75, "low")
    clutch, brake = found["AMLG"]
    assert_largest(brake, -2.5, "low")
    assert_largest(clutch, 2.5 / 3.5, "direct")
    assert found["AMLGP"][1].value == pytest.approx(-2.5 * 0.96)
    open_clutch, open_brake = found["WFRI"]
    assert (open_clutch.value, open_clutch.gear) == (1, "low")
    assert (open_brake.value, open_brake.gear) == (1, "direct")


def test_of_equal_values_the_first_gear_is_named() -> None:
    """In the TH400 the direct clutch carries the whole input torque in R alone; forward in 1, 2."""
    forward = summary_of("simpson-th400.yaml").largest["AMLG"][0]
    assert_largest(forward, 1, "1")


def test_with_a_load_the_gear_of_the_largest_torque_may_be_another() -> None:
    """In gear direct, of little torque, the load is a hundred times as large."""
    made = vstatics("summary", "-", "-f", "json", stdin=LOADED.encode())
    found = json.loads(made.out)["largest"]
    assert found["AMLG"][0] == {"row": "C", "value": pytest.approx(2.5 / 3.5), "gear": "direct"}
    brake, clutch = found["AMLG_Nm"][1], found["AMLG_Nm"][0]
    assert brake["value"] == pytest.approx(-2.5 * 100)
    assert clutch["value"] == pytest.approx(10000 * 2.5 / 3.5)
    assert found["WFRI_rpm"][0]["value"] == pytest.approx(2100)


LOADED = """\
links: 3
load: {speed: 2100 rpm, torque: 100 N*m}
shift_elements: {C: [1, 2], B: [2, housing]}
mechanisms: {D: {first: 1, second: 2, third: 3, ratio: -2.5, efficiency: 0.96}}
gears: {low: {engaged: [B]}, direct: {engaged: [C], load: {torque: 10000 N*m}}}
"""


@pytest.mark.parametrize("u", [-4.0, -2.5, -0.3, 0.4, 3.0])
def test_sensitivity_of_a_planetary_set_in_closed_form(u: float) -> None:
    """Sun in, ring held, carrier out: i = 1 - u, so (u/i) di/du = -u/(1 - u)."""
    low, direct = sensitivities(solve(differential(u)))
    assert low == pytest.approx(-u / (1 - u))
    assert direct == pytest.approx(0, abs=1e-12)


def test_sensitivities_of_gear_pairs_in_a_row_are_one() -> None:
    """The ratio is i = u1 u2."""
    case = Transmission(3, [], [Mechanism(1, 2, 0, -2.0), Mechanism(2, 3, 0, -3.0)], [Gear()])
    assert sensitivities(solve(case)) == pytest.approx(np.ones((1, 2)))


@pytest.mark.parametrize(
    "name", ["zf-8hp70", "ravigneaux-aod", "simpson-th400", "power-split", "wolfrom"]
)
def test_sensitivities_agree_with_finite_differences(name: str) -> None:
    """Central differences of step 1e-5; power-split has given speeds and further torques."""
    results = solve(load(CASES / f"{name}.yaml"))
    own = np.array([mechanism.ratio for mechanism in results.case.mechanisms])
    step = 1e-5
    numbers = np.concatenate([own * (1 + step * sign * np.eye(len(own))) for sign in (1, -1)])
    more, less = np.split(solve(results.settled, ratios=numbers).ratio, 2)
    expected = ((more - less) / (2 * step * results.ratio)).T
    assert sensitivities(results) == pytest.approx(expected, abs=1e-6, rel=1e-5, nan_ok=True)


def test_a_further_torque_changes_no_sensitivity() -> None:
    """The ratio does not know the torques."""
    case = differential()
    loaded = [gear._replace(torques={2: 0.7}) for gear in case.gears]
    other = Transmission(3, case.shift_elements, case.mechanisms, loaded)
    assert sensitivities(solve(other)) == pytest.approx(sensitivities(solve(case)))


def test_a_neutral_gear_has_no_step_and_is_no_neighbour() -> None:
    made = json.loads(vstatics("summary", "-", "-f", "json", stdin=NEUTRAL.encode()).out)
    neutral, low = made["gears"]
    assert (neutral["ratio"], neutral["state"], low["state"]) == (None, "open", "")
    assert made["transitions"] == []
    assert made["sensitivity"]["D"] == [None, pytest.approx(2.5 / 3.5)]


def test_a_gear_that_is_tied_up_makes_the_status_1() -> None:
    said = vstatics("summary", "-", stdin=TIED_UP.encode())
    assert said.status == 1
    assert "tied up" in said.out
    assert "tied up" in said.err


def test_a_gear_that_is_tied_up_has_no_largest_torque() -> None:
    """Its brakes hold the input itself; the torque of F in the other gear is 2.5/3.5."""
    case = Transmission(
        links=3,
        shift_elements=[ShiftElement(1, 2, "F"), ShiftElement(2, 0, "T")],
        mechanisms=[Mechanism(1, 2, 3, -2.5)],
        gears=[Gear([1], name="direct"), Gear([1, 2], name="tied")],
    )
    clutch, brake = summarize(solve(case)).largest["AMLG"]
    assert_largest(clutch, 2.5 / 3.5, "direct")
    assert math.isnan(brake.value)


def test_a_locked_gear_has_a_ratio_and_no_efficiency() -> None:
    made = json.loads(vstatics("summary", "-", "-f", "json", stdin=LOCKED.encode()).out)
    [line] = made["gears"]
    assert line["ratio"] == pytest.approx(0.004 / 1.004)  # (u - 1)/u, driven from its slow end
    assert (line["efficiency"], line["state"]) == (None, "locked")


def test_tables_are_80_columns_wide_with_many_gears() -> None:
    """MZKT and the ten gears of the 10R80; a table of numbers goes on below."""
    said = vstatics("summary", CASES / "ford-10r80.yaml")
    assert said.status == 0
    assert max(map(len, said.out.splitlines())) <= 80
    assert said.out.count("mechanism ") == 2
