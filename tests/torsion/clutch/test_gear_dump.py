"""Clutches that are dumped in a case: table 3.8 of the book from own values of two cars."""

import math

import pytest

from tests.torsion.book import TABLE_3_8, Line
from vstatics import ClutchDump, loads
from vstatics.torsion.clutch.dumped import DumpTorque, dump
from vstatics.torsion.clutch.gear_dump import GearDump, gear_dumps
from vstatics.torsion.clutch.given import Dump

CARS = {"ВАЗ-2101": ("[3.75, 2.30, 1.493, 1]", 4.3), "Москвич-412": ("[3.49, 2.04, 1.33, 1]", 4.22)}
"""Ratios of the gearbox, as those of omega1 in table 3.7, and of the final drive."""


def car(vehicle: str) -> str:
    """Own values: engine, disc and gear wheels by gear 4, the rest by the final drive.

    J_3 is ``a i^2 + b``, of the shafts before and behind the gearbox, by gears 1 and 4.
    """
    lines = {one.gear: one.given for one in TABLE_3_8 if one.vehicle == vehicle}
    first, direct = lines[1], lines[4]
    ratios, final = CARS[vehicle]
    own = [float(one) for one in ratios.strip("[]").split(",")]
    before = (first.J3 - direct.J3) / (own[0] ** 2 - 1)
    square = final**2
    pair = "  pair {0}: {{first: disc, second: wheel {0}, ratio: {1}}}"
    pairs = "\n".join(pair.format(n, one) for n, one in enumerate(own, 1))
    elements = ", ".join(f"dog {n}: [wheel {n}, propshaft]" for n in range(1, 5))
    gears = ", ".join(f"{n}: [clutch, dog {n}]" for n in range(1, 5))
    shafts = "{crown wheel: 1, wheels: -1, axle: -1}"
    return f"""\
output: vehicle
inertias:
  engine: {direct.J1}
  disc: {direct.J2}
  input shaft: {before}
  propshaft: {direct.J3 - before}
  wheels: {direct.J4 * square}
  vehicle: {direct.J5 * square}
  axle: 0.9
springs:
  half-shafts: {{twist: {shafts}, compliance: {direct.E / square / 2}}}
  tyres: {{links: [wheels, vehicle], compliance: {direct.E / square / 8}}}
  leaf springs: {{links: [axle, housing], compliance: {direct.E / square * 3 / 8}}}
shift_elements: {{clutch: [engine, disc], {elements}}}
mechanisms:
  shaft: {{first: disc, second: input shaft, ratio: 1}}
{pairs}
  final drive: {{first: propshaft, second: crown wheel, ratio: {final}}}
gears: {{{gears}, N: [clutch], open: [dog 1]}}
dump: {{J1: [engine], J2: [disc], J3: [input shaft, propshaft], J4: [wheels], J5: [vehicle],
  M_C0: {direct.M_C0}, M_phi: {direct.M_phi * final}, omega1: {direct.omega1}, to: propshaft}}
"""


def only(text: str, gear: str = "1") -> GearDump:
    [found] = gear_dumps(loads(text), [gear])
    return found


def answer(text: str, gear: str = "1") -> tuple[Dump, DumpTorque]:
    found = only(text, gear)
    assert found.given is not None
    assert found.made is not None
    return found.given, found.made


@pytest.mark.parametrize(
    "line",
    [one for one in TABLE_3_8 if one.vehicle in CARS],
    ids=lambda one: f"{one.vehicle}-{one.gear}",
)
def test_table_3_8_from_own_values(line: Line) -> None:
    """Tsitovich, Algin, Vehicle dynamics (1981); inertias are rounded in table 3.7."""
    given, made = answer(car(line.vehicle), str(line.gear))
    assert given == pytest.approx(line.given, rel=3e-2)
    assert made.case == line.case
    largest, at_input_shaft, *_ = line.torques
    assert made.max_torque / 1e3 == pytest.approx(largest, rel=1e-2)
    if at_input_shaft is not None:
        assert made.input_shaft_torque / 1e3 == pytest.approx(at_input_shaft, rel=1e-2)
    assert made[:6] == dump(given)[:6]
    [with_rate] = gear_dumps(loads(car(line.vehicle)), [str(line.gear)], 50)
    assert with_rate.made is not None
    assert with_rate.made.engagement == dump(given, 50).engagement


def test_the_link_changes_torques_by_its_ratio() -> None:
    texts = car("ВАЗ-2101"), car("ВАЗ-2101").replace(", to: propshaft", "")
    assert [only(text, "2").to for text in texts] == ["propshaft", "disc"]
    (_, on_propshaft), (given, on_disc) = (answer(text, "2") for text in texts)
    assert on_disc.max_torque == pytest.approx(on_propshaft.max_torque / 2.3)
    assert on_disc.dynamic_factor == pytest.approx(on_propshaft.dynamic_factor)
    assert (given.M_C0, given.omega1) == (142, 586)


def test_a_given_compliance_is_on_the_link_and_without_grip_tyres_always_grip() -> None:
    text = car("ВАЗ-2101").replace("to: propshaft", "to: propshaft, E: 0.005")
    assert [answer(text, gear)[0].E for gear in ("1", "4")] == [0.005, 0.005]
    text = car("ВАЗ-2101")
    given, made = answer(text[: text.index("M_phi")] + text[text.index("omega1") :])
    assert (given.M_phi, made.case) == (math.inf, "A2")


def test_links_that_are_forgotten_are_named() -> None:
    """But not the axle: it stands, and bears the reaction."""
    text = car("ВАЗ-2101").replace("J3: [input shaft, propshaft]", "J3: [propshaft]")
    told = "note: links that rotate with propshaft are in none of J1 to J5: input shaft [N505]"
    assert told in map(str, answer(text)[1].messages)


def test_planets_go_with_the_links_of_their_set() -> None:
    """A ring that is held, planets on pins: their orbit by m r^2, their spin by Willis."""
    text = """\
elements:
  set: {kind: planetary, sun: disc, ring: housing, carrier: shaft, teeth: {sun: 30, ring: 60},
    planets: 3, planet: {inertia: 2e-4, mass: 0.5, radius: 0.1}}
inertias: {engine: 0.2, disc: 0.01, shaft: 0.05, vehicle: 90}
springs: {tyre: {links: [shaft, vehicle], compliance: 1e-3}}
shift_elements: {clutch: [engine, disc]}
gears: {1: [clutch]}
input: engine
output: vehicle
dump: {J1: [engine], J2: [disc], J3: [shaft], J5: [vehicle], M_C0: 200, omega1: 400, to: shaft}
"""
    given, made = answer(text)
    spin = (15 - 60) / 15  # planet against carrier -60/15, with the carrier 1 more
    assert spin == -3
    shaft = 0.05 + 3 * (2e-4 * spin**2 + 0.5 * 0.1**2)
    assert given[:4] == pytest.approx((0.2 * 9, 0.01 * 9, shaft, 0.0))
    assert not [one for one in made.messages if "none of" in str(one)]


def test_why_there_is_no_torque() -> None:
    for gear, old, new, error in (
        ("open", "", "", "engine of J1 does not rotate with propshaft; is the clutch engaged in"),
        ("N", "", "", "engine of J1 does not rotate with propshaft; is the clutch engaged in this"),
        ("N", ", to: propshaft", "", "propshaft of J3 does not rotate with disc"),
        ("1", "J4: [wheels]", "J4: [wheels, axle]", "axle of J4 does not rotate with propshaft"),
        ("1", "  disc: 0.0044\n", "", "the links of J2 have no inertia"),
        ("1", "to: propshaft", "to: axle", "link axle does not turn: nothing can be reduced to it"),
        ("1", "J5: [vehicle]", "J5: [crown wheel]", "nothing elastic is between J2 and J5; "),
    ):
        text = car("ВАЗ-2101").replace(old, new)
        if "crown wheel]" in new:
            text = text.replace("inertias:\n", "inertias:\n  crown wheel: 1\n")
        found = only(text, gear)
        assert (found.given, found.made) == (None, None)
        assert found.error.startswith(error)


def test_numbers_that_give_no_torque_are_reported() -> None:
    found = only(car("ВАЗ-2101").replace("M_C0: 142.0", "M_C0: 1e308"))
    assert found.made is None
    assert "expected a finite number above 0" in found.error or "too large" in found.error


def test_an_unknown_gear_is_rejected() -> None:
    with pytest.raises(ValueError, match="no gear"):
        gear_dumps(loads(car("ВАЗ-2101")), ["7"])


def test_links_may_be_numbers_in_python() -> None:
    case = loads(car("ВАЗ-2101"))
    names = ("engine", "disc", "propshaft", "wheels", "vehicle")
    first, second, third, fourth, fifth = ([case.link_number(one)] for one in names)
    made = ClutchDump(first, second, third, fourth, fifth, M_C0=142, omega1=586)
    [found] = gear_dumps(case.replace(dump=made), ["4"])
    assert found.to == "disc"
