"""A case without gears: one gear without shift elements, else a message of what to write."""

import json
import re
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from typing import Any

import openpyxl
import pytest
import yaml

from tests.chance import count, examples, seeded
from tests.commands import vstatics
from tests.trains import random_train
from vstatics import ReadError, Transmission, load, loads, solve
from vstatics.core.writers.named import mapping


@examples(25, 100, 1000)
def test_a_chain_of_pairs_has_the_product_of_their_ratios(examples: int) -> None:
    chance = seeded(15)
    for _ in range(examples):
        ratios = [Fraction(chance.randint(-9, 9) or 1, chance.randint(1, 9)) for _ in range(4)]
        pairs = {
            f"p{n}": {"first": n, "second": n + 1, "ratio": str(ratio)}
            for n, ratio in enumerate(ratios, 1)
        }
        data: dict[str, Any] = {"links": 5, "mechanisms": pairs}
        data |= chance.choice(({}, {"gears": None}, {"gears": {}}, {"shift_elements": {}}))
        results = solve(loads(chance.choice((json.dumps, yaml.safe_dump))(data)))
        product = float(ratios[0] * ratios[1] * ratios[2] * ratios[3])
        assert results.ratio == pytest.approx([product], rel=1e-12)
        assert [gear.name for gear in results.case.gears] == ["1"]


def test_a_workbook_may_go_without_its_sheet_of_gears(tmp_path: Path) -> None:
    """Ring 9 held, planets 8 and 7, ring 8 driven: i = 1/(1 - 9*7/(8*8)) = 64."""
    case = tmp_path / "case.yaml"
    case.write_text(
        "input: cam\noutput: out\nelements: {c: {kind: stepped, ring: housing, ring2: out, "
        "carrier: cam, teeth: {ring: 9, planet: 8, planet2: 7, ring2: 8}}}",
        "utf-8",
    )
    assert solve(load(case)).ratio == pytest.approx([64])
    vstatics("convert", case, tmp_path / "case.xlsx")
    book = openpyxl.load_workbook(tmp_path / "case.xlsx")
    del book["gears"]
    book.save(tmp_path / "case.xlsx")
    assert solve(load(tmp_path / "case.xlsx")).ratio == pytest.approx([64])


@examples(25, 100, 1000)
def test_the_gears_that_a_message_shows_can_be_written(examples: int) -> None:
    chance = seeded(16)
    for _ in range(examples):
        train = random_train(chance)
        if not train.shift_elements:
            continue
        data = mapping(train)
        del data["gears"]
        with pytest.raises(ReadError) as error:
            Transmission.from_dict(data)
        [problem] = [one for one in error.value.problems if one.id == "E205"]
        shown = re.search(r"such as `gears: (\{.*\})`", problem.message)
        assert shown
        gears = yaml.safe_load(shown[1])
        case = Transmission.from_dict({**data, "gears": gears})
        needed = max(train.links - len(train.mechanisms) - 1, 1)
        assert len(case.gears[0].engaged) == min(needed, len(train.shift_elements))


def test_bodies_without_gears_need_no_shift_element() -> None:
    """Links with inertias or masses, some geared in pairs: free by count, noted and not warned of.

    What is free: bodies less mechanisms, less the input whose speed is the unit.
    """
    for seed in range(count(12, 300)):
        rng = seeded(seed)
        links = [f"l{number}" for number in range(rng.randint(2, 6))]
        pairs = rng.randint(0, len(links) - 2)
        straight = {link for link in links[pairs + 2 :] if rng.random() < 0.5}
        keys: dict[str, dict[str, Any]] = {
            "inertias": {link: rng.uniform(0.1, 9) for link in links if link not in straight},
            "masses": {link: rng.uniform(1, 900) for link in straight},
            "mechanisms": {
                f"{first}-{second}": {"first": first, "second": second, "ratio": -3.0}
                for first, second in pairwise(links[: pairs + 1])
            },
        }
        given = {key: value for key, value in keys.items() if value}
        results = solve(loads(json.dumps({"links": links, **given})))
        missing = len(links) - pairs - 1
        assert int(results.missing[0]) == missing
        ids = [one.id for one in results.messages if one.id in ("W414", "N420")]
        assert ids == (["N420"] if missing else [])
