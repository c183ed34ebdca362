"""An exercise can be solved from its sheet: whatever changes a blank changes what is given."""

import copy
import re
from collections.abc import Iterator
from pathlib import Path
from random import Random
from typing import Any

import pytest

from tests.chance import examples, seeded
from tests.commands import CASES, SHIPPED
from tests.core.explain.explained import equations
from tests.shipped import shipped_results
from vstatics import Gear, Mechanism, ShiftElement, Transmission, load, loads, solve
from vstatics.core.errors import CaseError, ReadError
from vstatics.core.explain import explain_gear
from vstatics.core.explain.exercise import exercise, worksheet
from vstatics.core.explain.given import given
from vstatics.core.tables import markdown
from vstatics.core.writers.named import mapping

LAWFUL = """
links: [in, mid, out]
shift_elements: {C: {links: [in, mid], drag: "0.2 + 0.001*w"}, F: {kind: freewheel, links: [out]}}
elements:
  pair: {kind: gear_pair, first: in, second: mid, teeth: {first: 20, second: 41}}
mechanisms:
  M: {first: mid, second: out, ratio: -1.5,
      efficiency: {over: torque, points: [[0, 0.9], [150, 0.97]]}}
load: {speed: 1000 rpm, torque: 100 N*m}
gears: {g: {engaged: [], drag: {out: 2 N*m}, torques: {mid: 10 N*m}}}
"""
MAPPED = """
links: [in, ring, mid, out]
elements:
  P: {kind: planetary, sun: in, ring: ring, carrier: mid, teeth: {sun: 30, ring: 72}, planets: 3,
      efficiency: {over: [speed, torque], columns: [10, 200], rows: [[50, 0.9, 0.96], [400, 0.93, 0.98]]}}
mechanisms: {worm: {first: mid, second: out, ratio: 20, efficiency: "0.9 - 2/(T + 9) - 1e-4*w"}}
shift_elements: {B: [ring, housing]}
load: {speed: 1000 rpm, torque: 100 N*m}
gears:
  g: {engaged: [B], loss: {over: [speed, torque], columns: [0, 200], rows: [[0, 20, 60], [500, 300, 700]]}}
fatigue: {P.sun: {torque: 900, cycles: 3e6, exponent: 6.6}}
bearings: {pin: {on: P.planet, torque_of: P.carrier, load_per_torque: 12, dynamic: 24000}}
"""
NUMBER = re.compile(r"-?\d+(\.\d+)?(e-?\d+)?")


def numbers(data: Any, way: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """Ways to all numbers of plain data, also those of texts."""
    parts = data.items() if isinstance(data, dict) else enumerate(data)
    for key, one in parts:
        if isinstance(one, dict | list):
            yield from numbers(one, (*way, key))
        elif isinstance(one, bool):
            continue
        elif isinstance(one, int | float) or NUMBER.match(one):
            yield (*way, key)


def other(one: Any) -> Any:
    """Another number of the kind, not far away."""
    if isinstance(one, str):
        return NUMBER.sub(lambda found: str(other(float(found[0]))), one, count=1)
    if isinstance(one, int):
        return one + 2
    return 0.97 * one if one else 0.01


def filled(case: Transmission) -> dict[str, Any]:
    """A case as plain data, with the defaults that solving reads."""
    data = mapping(case)
    if "elements" in data:
        efficiencies = {"external": 0.98, "internal": 0.99, "bevel": 0.97}
        data["mesh_efficiency"] = efficiencies | data.get("mesh_efficiency", {})
    for one in data.get("mechanisms", {}).values():
        one.setdefault("efficiency", 1.0)
    return data


def said_and_asked(case: Transmission, place: int) -> tuple[str, list[tuple[Any, ...]]]:
    """What is given on the sheet, and its blanks with nine digits."""
    sheet = worksheet(solve(case), place)
    told = markdown.write([], given(sheet.results, place))
    return told, [(one.table, one.row, f"{one.value:.8e}") for one in sheet.blanks]


def unsaid(case: Transmission, random: Random, most: int) -> list[str]:
    """Numbers that change a blank of some gear, but nothing that is given."""
    place = random.randrange(len(case.gears))
    data = filled(case)
    gear = case.gears[place].name
    data["gears"] = {gear: data["gears"][gear]}
    try:
        before = said_and_asked(Transmission.from_dict(data), 0)
    except CaseError:  # a gear without numbers
        return []
    ways = [*numbers({k: v for k, v in data.items() if k != "links"})]
    missed = []
    for way in random.sample(ways, min(most, len(ways))):
        changed = copy.deepcopy(data)
        part = changed
        for key in way[:-1]:
            part = part[key]
        part[way[-1]] = other(part[way[-1]])
        try:
            after = said_and_asked(Transmission.from_dict(changed), 0)
        except (CaseError, ReadError):  # teeth that can't be, a name that is a number
            continue
        if after[1] != before[1] and after[0] == before[0]:
            missed.append(f"{case.name} {gear}: {way}")
    return missed


def test_maps_and_formulas_stand_on_the_sheet() -> None:
    """Also of a case that names members for its life, which the equations do not have."""
    case = loads(MAPPED)
    assert unsaid(case, seeded(3), 99) == []
    told = said_and_asked(case, 0)[0].replace("\\", "")
    assert "(50, 10, 0.9), (50, 200, 0.96), (400, 10, 0.93), (400, 200, 0.98)" in told
    assert "0.9 - 2/(T + 9) - 1e-4*w |" in told  # without the unit of drag
    assert explain_gear(solve(case), "g").ratio == pytest.approx((1 + 72 / 30) * 20)


@examples(1, 5, 12)
def test_what_changes_a_blank_stands_on_the_sheet(tmp_path: Path, examples: int) -> None:
    file = tmp_path / "laws.yaml"
    file.write_text(LAWFUL, "utf-8")
    case = load(file)
    assert {"lossy_torques", "losses", "efficiency"} <= {
        one.table for one in worksheet(solve(case), 0).blanks
    }
    assert unsaid(case, seeded(1), 99) == []
    random = seeded(2)
    for path in random.sample(SHIPPED, examples):
        assert unsaid(load(path), random, 4) == []


@pytest.mark.slow
@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.stem)
def test_what_changes_a_blank_of_any_shipped_case_stands_on_its_sheet(path: Path) -> None:
    case = load(path)
    for seed in range(min(len(case.gears), 3)):
        assert unsaid(case, seeded(seed), 60) == []


def asked(text: str) -> tuple[str, dict[tuple[str, str | None], float]]:
    """The sheet of the first gear of a case, and the values of its blanks."""
    sheet = worksheet(solve(loads(text)), 0)
    return sheet.worksheet(), {(one.table, one.row): one.value for one in sheet.blanks}


def test_what_is_given_is_not_asked() -> None:
    """Speeds of links, and signs that a convention sets."""
    case = load(CASES / "toyota-p410.yaml")
    rows = {one.row for one in worksheet(solve(case), 0).blanks if one.table == "speeds"}
    assert rows == {*case.link_names} - {"engine", "MG1", "right wheel"}
    results = shipped_results("mzkt7922.yaml")
    assert results.idle[0].tolist() == [False, True, False]
    signs = [one.row for one in worksheet(results, 0).blanks if one.table == "power_sign"]
    assert "D2" not in signs


def test_a_converter_is_solved_from_its_sheet() -> None:
    """K at .3 lies between 2.2 and 1 at 0 and .6; its loss is what it does not pass on."""
    text = """
links: [pump, turbine]
mechanisms: {TC: {kind: converter, first: pump, second: turbine, points: [[0, 2.2], [0.6, 1]]}}
gears: {g: {speed_ratios: {TC: 0.3}}}
"""
    told, _ = said_and_asked(loads(text), 0)
    points = "(speed ratio, K): (0, 2.2), (0.6, 1)"
    assert f"| TC | converter | pump | turbine | - | - | 0.3 | {points} |" in told
    assert "Losses, third link held" not in told
    k = 2.2 + (1 - 2.2) * 0.3 / 0.6
    _, blanks = asked(text)
    assert blanks["lossy_torques", "Mx"] == pytest.approx(k)
    assert blanks["losses", "TC"] == pytest.approx(1 - k * 0.3)
    gear = explain_gear(solve(loads(text)), "g")
    assert equations(gear.speeds)[0] == "w_pump - 3.3333 w_turbine = 0"
    assert equations(gear.torques)[1] == "-1.6 M_TC + Mx = 0"
    assert gear.efficiency == pytest.approx(k * 0.3)
    with pytest.raises(CaseError, match="gear g: TC has the speed ratio 0"):
        explain_gear(solve(loads(text.replace("0.3}}}", "0}}}"))), "g")


def test_sentences_of_a_sheet_are_as_wide_as_a_terminal() -> None:
    text = exercise(solve(load(CASES / "zf-8hp70.yaml")), "1").worksheet()
    sentences = [part for part in text.split("\n\n") if part.rstrip().endswith((".", "> 0"))]
    assert len(sentences) == 4
    assert max(len(line) for part in sentences for line in part.splitlines()) <= 80
    assert "In a plain set, the ratio of the first link to a planet is (u + 1)/2" in text


def test_a_sheet_tells_over_what_a_law_goes() -> None:
    """Those of efficiency and drag, each where the case has such; a belt has no teeth."""
    told = said_and_asked(loads(LAWFUL), 0)[0]
    plain = said_and_asked(load(CASES / "differential.yaml"), 0)[0]
    for law in ("on the torque on the first link with losses", "w is the magnitude in rad/s"):
        assert (law in told, law in plain) == (True, False)
    belt = "{B: {kind: belt, first: in, second: out, diameters: {first: 120, second: 90}}}"
    told = said_and_asked(loads(f"links: [in, out]\nelements: {belt}\ngears: {{g: []}}\n"), 0)[0]
    assert "| B | belt | first: in, second: out | diameters: first 120, second 90 |" in told
    assert told.count("120") == 1


def test_a_gear_of_drag_alone_asks_for_torques_in_newton_metres() -> None:
    """2 N*m between two pairs, the second driven from the output: 2 * 3/.97 N*m."""
    sheet, blanks = asked("""
links: [in, mid, out]
load: {speed: 1000 rpm, torque: 0 N*m}
drag: {mid: 2 N*m}
mechanisms:
  P: {first: in, second: mid, ratio: -2, efficiency: 0.98}
  Q: {first: mid, second: out, ratio: -3, efficiency: 0.97}
gears: {g: []}
""")
    assert ("speeds", "in") not in blanks
    assert blanks["lossy_torques_Nm", "Mx"] == pytest.approx(-6 / 0.97)
    assert blanks["power_sign", "Q"] == -1
    assert blanks["lossy_torques_Nm", "Q"] == pytest.approx(2)
    assert "M (w_first - w_third) > 0, M with drag" in sheet


def test_teeth_of_planets_that_fill_a_gap_are_listed() -> None:
    """Long planets between the large sun (42) and the ring (84) have 21: w_ring 84/21."""
    sheet, blanks = asked("""
links: [small, large, ring, carrier]
output: ring
shift_elements: {C: [carrier, housing]}
elements:
  set:
    {kind: ravigneaux, small_sun: small, large_sun: large, ring: ring, carrier: carrier,
     teeth: {small_sun: 30, large_sun: 42, ring: 84}}
gears: {g: [C]}
""")
    long = blanks["planet_speeds", "set.long"]
    assert long == pytest.approx(blanks["speeds", "ring"] * 84 / 21)
    rule = "A planet between a sun and a ring has (ring - sun)/2 teeth"
    assert rule in sheet
    assert rule not in worksheet(shipped_results("simpson.yaml"), 0).worksheet()


def test_a_neutral_gear_says_so_and_asks_nothing_of_power() -> None:
    clutch, loose = ShiftElement(1, 2), Mechanism(2, 3, 4, -2.5, 0.96)
    case = Transmission(4, [clutch], [loose], [Gear([1])], coast=True)
    sheet = worksheet(solve(case), 0).worksheet()
    assert "neutral: the speed of the output is not determined" in sheet
    assert ("Coasting" in sheet, "eta^x" in sheet) == (False, False)


def test_conventions_of_a_calculation_stand_on_the_sheet() -> None:
    """Power that enters at the output, the sign of idle mechanisms, what freewheels do."""
    case = load(CASES / "mzkt7922.yaml")
    for one in (case.with_coast(coast=True), case.replace(idle="exact")):
        assert said_and_asked(one, 0) != said_and_asked(case, 0)
        assert said_and_asked(one, 0)[0] != said_and_asked(case, 0)[0]
    told = said_and_asked(load(CASES / "ravigneaux-gf4a.yaml"), 0)[0]
    assert "| one-way clutch 2 | freewheel | carrier | housing | holds |" in told
