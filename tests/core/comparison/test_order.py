"""A gearbox is the same in whatever order its parts are written."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
import yaml

from tests.chance import generator
from tests.commands import CASES, vstatics
from vstatics import compare, load, solve
from vstatics.core.comparison.verdicts import Verdict

NAMED = ("mechanisms", "elements", "shift_elements", "springs", "gears")
"""What a case has by name."""


def written(data: dict[str, Any], path: Path, form: str) -> Path:
    """The results of a case as JSON or CSV."""
    case = path.with_suffix(".yaml")
    case.write_text(yaml.safe_dump(data, sort_keys=False), encoding="utf-8")
    made = path.with_suffix(f".{form}")
    assert vstatics("run", case, "-q", "-o", made).status == 0
    return made


def parts(name: str) -> dict[str, Any]:
    """A shipped case as plain data, with its ports named."""
    path = CASES / f"{name}.yaml"
    case = load(path)
    data: dict[str, Any] = yaml.safe_load(path.read_text(encoding="utf-8"))
    ports = {"input": case.link_name(case.input), "output": case.link_name(case.output)}
    return {**ports, **data}


def shuffled(data: dict[str, Any], seed: int) -> dict[str, Any]:
    """The same case with its parts in another order."""
    order = generator(seed)
    made = dict(data)
    for key in NAMED:
        if key in made:
            names = list(made[key])
            made[key] = {
                names[place]: made[key][names[place]] for place in order.permutation(len(names))
            }
    if isinstance(made["links"], list):
        made["links"] = [str(name) for name in order.permutation(made["links"])]
    return made


def renamed(data: dict[str, Any]) -> dict[str, Any]:
    """The same case with other names of all its links and parts."""
    kinds = [key for key in (*NAMED[:-1], "inertias") if key in data]
    names = {name: f"another {name}" for key in kinds for name in data[key]}
    names |= {name: f"another {name}" for name in data["links"]}

    def with_names(value: Any) -> Any:
        if isinstance(value, dict):
            return {key: with_names(one) for key, one in value.items()}
        if isinstance(value, list):
            return [with_names(one) for one in value]
        return names.get(value, value) if isinstance(value, str) else value

    made: dict[str, Any] = with_names(data)
    parts = {key: {names[name]: one for name, one in made[key].items()} for key in kinds}
    return made | parts


def told(said: Verdict) -> list[str]:
    """What differs, in words."""
    [one] = said.cases
    return [f"{n.table} {n.row} {n.gear}: {n.expected} {n.actual}" for n in one.numbers]


@pytest.mark.parametrize("form", ["json", "csv", "txt"])
@pytest.mark.parametrize(
    "name",
    [
        *("simpson", "zf-8hp70", "ravigneaux-aod", "wilson-preselector"),
        *("tarasik-truck", "moskvich-start"),  # with springs, which no deck has
    ],
)
def test_no_number_differs_by_the_order_of_parts(name: str, form: str, tmp_path: Path) -> None:
    data = parts(name)
    before = written(data, tmp_path / "before", form)
    for seed in range(3):
        after = written(shuffled(data, seed), tmp_path / "after", form)
        said = compare(after, before)
        assert not told(said), seed
        assert not said.differs


@pytest.mark.parametrize("form", ["json", "txt"])
@pytest.mark.parametrize("name", ["simpson", "ford-6r80", "umdm", "wilson-preselector"])
def test_parts_of_other_names_are_the_same_by_what_they_join(
    name: str, form: str, tmp_path: Path
) -> None:
    """In any order, and with a gear less; the case tells what they are called."""
    data = parts(name)
    before = written(data, tmp_path / "before", form)
    gears = list(data["gears"])
    for seed in range(3):
        after = shuffled(renamed(data), seed)
        if seed:
            del after["gears"][gears[seed]]
        said = compare(written(after, tmp_path / "after", form), before)
        assert {one.split()[0] for one in told(said)} <= {"step"}, seed
        assert said.differs == bool(seed)


@pytest.mark.parametrize("form", ["json", "csv"])
def test_a_part_more_hides_no_number_of_the_others(form: str, tmp_path: Path) -> None:
    """A brake that no gear engages; and a set with another efficiency."""
    data = parts("simpson")
    before = written(data, tmp_path / "before", form)
    elements = {"N": ["ring 1", "housing"], **data["shift_elements"]}
    losing = {**data["mechanisms"]["P1"], "efficiency": 0.9}
    data |= {"shift_elements": elements, "mechanisms": {**data["mechanisms"], "P1": losing}}
    [one] = compare(written(data, tmp_path / "after", form), before).cases
    new = {n.table for n in one.numbers if n.row == "N" or n.gear == "N"}
    assert new >= {"slip_speeds", "torques", "distribution_matrix"}
    assert all(n.expected == "not there" for n in one.numbers if n.row == "N")
    now, then = (solve(load(tmp_path / f"{name}.yaml")) for name in ("after", "before"))
    lost = [n for n in one.numbers if n.table == "losses"]
    assert {n.row for n in lost} == {"P1", "P2"}
    for n in lost:
        place = "losses", str(n.row), str(n.gear)
        assert (n.actual, n.expected) == (now[place], then[place])


def test_a_link_of_another_name_is_the_same_link(tmp_path: Path) -> None:
    """The case tells the name; no number differs."""
    before = written(parts("simpson"), tmp_path / "before", "json")
    text = (tmp_path / "before.yaml").read_text(encoding="utf-8").replace("ring 1", "annulus")
    after = written(yaml.safe_load(text), tmp_path / "after", "json")
    said = compare(after, before)
    assert not told(said)
    assert not said.differs
    assert said.cases[0].case


def test_gears_that_one_result_lacks_are_told_in_the_first_line(tmp_path: Path) -> None:
    data = parts("simpson")
    before = written(data, tmp_path / "before", "json")
    data["gears"] = {"back" if name == "R" else name: one for name, one in data["gears"].items()}
    said = compare(written(data, tmp_path / "after", "json"), before)
    assert said.differs
    assert said.cases[0].headline.endswith("no number differs, but gears are not the same")


def test_an_element_of_another_name_is_another_one_where_no_case_tells_names(
    tmp_path: Path,
) -> None:
    """CSV has rows and columns alone: a clutch in place of another is told in both."""
    data = parts("simpson")
    before = written(data, tmp_path / "before", "csv")
    elements = {"X" if name == "A" else name: one for name, one in data["shift_elements"].items()}
    gears = {
        name: {"engaged": ["X" if e == "A" else e for e in one["engaged"]]}
        for name, one in data["gears"].items()
    }
    changed = {**data, "shift_elements": elements, "gears": gears}
    [one] = compare(written(changed, tmp_path / "after", "csv"), before).cases
    rows = {n.row for n in one.numbers if n.table in ("slip_speeds", "distribution_matrix")}
    assert rows == {"A", "X"}


def test_a_link_that_becomes_the_input_by_its_place_is_a_change_of_the_case(
    tmp_path: Path,
) -> None:
    """The first link is the input where nothing else is told, the last one the output."""
    data = parts("simpson")
    del data["input"], data["output"]
    before = written(data, tmp_path / "before", "json")
    turned = {**data, "links": data["links"][::-1]}
    [one] = compare(written(turned, tmp_path / "after", "json"), before).cases
    first, last = data["links"][0], data["links"][-1]
    assert [*map(tuple, one.case)] == [("input", first, last), ("output", last, first)]
    told_ports = {"input": first, "output": last, **data}
    assert not compare(written(told_ports, tmp_path / "told", "json"), before).cases[0].case
