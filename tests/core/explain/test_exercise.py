"""Exercises: what is blank is what `run` calculates, and drawn teeth can be put together."""

import json
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.chance import seeded
from tests.commands import CASES, MZKT, json_answer, vstatics
from vstatics import Gear, Load, ShiftElement, exercise, load, loads, solve
from vstatics.core.elements import Element, transmission
from vstatics.core.elements.drawing import Drawing
from vstatics.core.elements.teeth.doubtful_teeth import doubts, fitting, misfits
from vstatics.core.explain.drawn_numbers import drawn_numbers
from vstatics.core.model.parts import OfLoad

ZF = str(CASES / "zf-8hp70.yaml")
SHOWN = [ZF, str(MZKT)] + [str(CASES / f"{n}.yaml") for n in ("differential", "ravigneaux-gf4a")]
DRAWN = (
    *("zf-8hp70", "ravigneaux-aod", "ravigneaux-gf4a"),
    *("simpson-th400", "ford-10r80", "gm-thm440"),
)
PAIR = "links: 2\nmechanisms: {P: {first: 1, second: 2, ratio: -2}}\ngears: {g: []}\n"
HOIST = """
links: [in, a, b, c, d, e, f, out]
elements:
  worm: {kind: worm, worm: in, wheel: a, teeth: {worm: 1, wheel: 40},
         efficiency: {worm: 0.7, wheel: 0.4}}
  chain: {kind: chain, first: a, second: b, teeth: {first: 19, second: 57}}
  belt: {kind: belt, first: b, second: c, diameters: {first: 120, second: 90.5}}
  axle: {kind: bevel_pair, first: c, second: d, teeth: {first: 11, second: 41}}
  odd: {kind: gear_pair, first: d, second: e, teeth: {first: 6, second: 125}}
mechanisms:
  back: {first: e, second: f, ratio: -1}
  variator: {kind: variator, first: f, second: out, speed_ratio: 1}
gears: {low: {engaged: [], speed_ratios: {variator: 0.5}}, even: []}
"""


def rows_of(case: Any) -> dict[str, list[str]]:
    """Names of the rows of a case of mechanisms, as docs/results.md has them."""
    mechanisms = [one.name for one in case.mechanisms]
    elements = [one.name for one in case.shift_elements]
    torques = [*elements, *mechanisms, "Mx"]
    return {
        "speeds": case.link_names,
        "slip_speeds": elements,
        **dict.fromkeys(("torques", "lossy_torques"), torques),
        **dict.fromkeys(("planet_speeds", "power_sign", "losses"), mechanisms),
    }


@pytest.mark.parametrize("case", SHOWN)
@pytest.mark.parametrize("seed", [("--seed", "5"), ()])
def test_a_blank_has_the_value_of_run(case: str, seed: tuple[str, ...], tmp_path: Path) -> None:
    """Of the case that the solution carries, which is calculated again from its file."""
    gear = load(case).gears[0].name
    made = json_answer("explain", case, "--solution", "--gear", gear, *seed)
    assert list(made) == ["case", "gear", "seed", "blanks"]
    assert (made["gear"], made["seed"]) == (gear, int(seed[1]) if seed else None)
    assert len(made["blanks"]) >= 10
    assert loads(json.dumps(made)) == loads(json.dumps(made["case"]))
    assert [one["number"] for one in made["blanks"]] == [*range(1, len(made["blanks"]) + 1)]
    written = tmp_path / "case.json"
    written.write_text(json.dumps(made["case"]), "utf-8")
    result = json_answer("run", str(written))
    place = result["gears"].index(gear)
    rows = result.get("rows") or rows_of(load(written))
    for one in made["blanks"]:
        values = result[one["table"]]
        values = values if one["row"] is None else values[rows[one["table"]].index(one["row"])]
        assert values[place] == one["value"], one


@pytest.mark.parametrize("form", ["text", "markdown", "latex"])
def test_a_worksheet_is_its_solution_without_numbers(form: str) -> None:
    """Both have the same blanks in the same order; the line stands where the number is."""
    common = "explain", ZF, "--gear", "2", "-f", form
    sheet = vstatics(*common, "--worksheet").out
    if form == "latex":  # where a line below means an index
        assert not re.search(r"(?<!\\)_", re.sub(r"\$.*?\$", "", sheet))
    sheet = re.sub(r"[\\{}]", "", sheet)
    solved = re.sub(r"[\\{}$]", "", vstatics(*common, "--solution").out)
    blanks = re.findall(r"\[(\d+)\] ____", sheet)
    assert blanks == [str(one) for one in range(1, len(blanks) + 1)]
    assert re.findall(r"\[(\d+)\] -?\d*\.?\d+", solved) == blanks
    assert "____" not in solved
    solved = vstatics(*common, "--solution", "--digits", 2).out
    assert re.findall(r"\[}?(\d+)\W+\d", solved) == blanks


@pytest.mark.parametrize("name", DRAWN)
@pytest.mark.parametrize("seed", [0, 7])
def test_drawn_teeth_can_be_put_together_and_change_the_ratios(name: str, seed: int) -> None:
    """Where no number of planets is given, three to six of them go in; no tips newly touch."""
    case = load(CASES / f"{name}.yaml")
    drawn = drawn_numbers(case, seed)
    assert isinstance(drawn.drawing, Drawing)
    assert isinstance(case.drawing, Drawing)
    told = {problem.id for problem in doubts(case.drawing)}
    assert {problem.id for problem in doubts(drawn.drawing)} <= told | {"N318"}
    for one in drawn.drawing.elements:
        numbers = [one.planets] if one.planets or not one.planet_names else range(3, 7)
        assert any(list(misfits(replace(one, planets=n))) == [] for n in numbers), one
        if one.kind == "planetary" and not one.planets:
            whole = one.teeth["sun"] + one.teeth["ring"]
            assert any(whole % n == 0 for n in numbers if n)
    before, after = solve(case).ratio, solve(drawn).ratio
    assert (abs(after / before - 1) > 1e-6).any()
    assert ((after > 0) == (before > 0)).all()


def test_seeds_give_boxes_of_their_own_while_there_are_some() -> None:
    """Tooth numbers limit the number of boxes; 15 and 51 teeth do not fit five planets."""
    members = {"sun": 1, "ring": 2, "carrier": 3}
    plain = Element("P", "planetary", members, {"sun": 15, "ring": 51}, planets=5)
    case = transmission(Drawing(3, [plain]), shift_elements=[ShiftElement(2)], gears=[Gear([1])])
    fit = {(one[0], one[1]) for one in fitting(plain, seeded(59))}
    drawn = [drawn_numbers(case, seed).drawing for seed in range(len(fit) + 1)]
    teeth = [tuple(one.elements[0].teeth.values()) for one in drawn if isinstance(one, Drawing)]
    assert {*teeth[:-1]} == fit
    assert teeth[-1] == teeth[0]
    for rounds in (3, 10**30):
        assert drawn_numbers(case, 1 + rounds * len(fit)).drawing == drawn_numbers(case, 1).drawing


def test_a_seed_draws_whatever_has_numbers() -> None:
    """Starts and gear of a worm, chains, belts, bevel pairs, speed ratios; what stays is named."""
    case = loads(HOIST)
    made = [exercise(solve(case), "even", seed=seed) for seed in range(9)]
    cases = [one.results.case for one in made]
    ratios = np.array([[abs(one.ratio) for one in each.mechanisms] for each in cases])
    own = np.array([abs(one.ratio) for one in case.mechanisms])
    ways = [len({*column}) for column in ratios.T.tolist()]
    assert [way > 5 for way in ways] == [True] * 4 + [False] * 2 + [True]
    assert (np.abs(np.log(ratios / own)) < 0.36).all()
    assert len({each.gears[0].speed_ratios[2] for each in cases}) > 5
    for each in cases:
        assert isinstance(each.drawing, Drawing)
        worm, chain, _, axle, _ = (one.teeth for one in each.drawing.elements)
        assert 1 <= worm["worm"] <= 4
        assert worm["wheel"] >= 28
        assert (min(chain.values()) >= 17, min(axle.values()) >= 11) == (True, True)
    assert made[3].titles("hoist.yaml") == ["hoist.yaml (--seed 3; as before: odd)"]
    assert repr(made[3]) == f"<GearExercise 'even': {len(made[3].blanks)} blanks, seed 3>"


def test_a_drawn_ravigneaux_set_of_ratios_is_one_still() -> None:
    members = {"small_sun": 1, "large_sun": 2, "ring": 3, "carrier": 4}
    ratios = {"small_sun": 2.4, "large_sun": -2.0}
    bare = Element("R", "ravigneaux", members, ratios=ratios, efficiency=0.97)
    case = transmission(Drawing(4, [bare]), shift_elements=[ShiftElement(4)], gears=[Gear([1])])
    assert len({drawn_numbers(case, seed).mechanisms[0].ratio for seed in range(9)}) == 9


@pytest.mark.parametrize("given", [None, Load(2000, 250)])
def test_elements_of_a_drawn_box_have_the_margins_of_the_given_one(given: Load | None) -> None:
    """Else it would have elements that carry more than they can, by other ratios."""
    results = solve(load(CASES / "simpson-th400.yaml").replace(load=given))
    whole = given.torque if given and given.torque else 1.0
    least = np.where(results.holds, np.fabs(results.torques[:, : results.holds.shape[1]]), 0).max(0)
    own = [
        one._replace(capacity=OfLoad(1.001 * torque * whole, whole) if given else 1.001 * torque)
        for one, torque in zip(results.case.shift_elements, least.tolist(), strict=True)
    ]
    results = solve(results.case.replace(shift_elements=own))
    for seed in range(6):
        made = exercise(results, 1, seed=seed).results
        assert "W430" not in {one.id for one in made.messages}
        assert np.abs(made.ratio - results.ratio).max() > 0
        torques = np.fabs(made.torques[:, : made.holds.shape[1]])
        largest = np.where(made.holds, torques, 0).max(0)
        for element, torque in zip(made.case.shift_elements, largest, strict=True):
            assert element.capacity is not None
            assert 1.0 <= element.capacity / torque < 1.02


def test_an_exercise_is_of_one_gear_and_has_numbers() -> None:
    said = vstatics("explain", str(CASES / "simpson.yaml"), "--worksheet")
    assert said.is_wrong_use("covers one gear, expected one of 1, 2, 3, R")
    only = ("explain", str(CASES / "wolfrom.yaml"), "--solution", "--seed", "3")
    shown = vstatics(*only).out
    assert shown.splitlines()[0].endswith("(--seed 3)")
    assert vstatics(*only, "--gear", "drive").out == shown != vstatics(*only[:3]).out
    for options in ("--seed 3", "--gear 1 --worksheet -f json", "--gear 1 --worksheet --solution"):
        assert vstatics("explain", ZF, *options.split()).is_wrong_use()
    for form in ("csv", "xlsx"):
        said = vstatics("explain", ZF, "--solution", "--gear", "1", "-o", f"sheet.{form}")
        assert said.is_wrong_use("expected text, markdown or latex")
    tied_up = PAIR.replace("mechanisms", "shift_elements: {A: [1, 0], B: [2, 0]}\nmechanisms")
    stdin = tied_up.replace("[]", "[A, B]").encode()
    said = vstatics("explain", "-", "--gear", "g", "--worksheet", stdin=stdin)
    assert said.fails("has no results for an exercise")
