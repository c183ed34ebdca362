"""A gearbox is the same in whatever order its parts are written."""

from pathlib import Path
from typing import Any

import pytest
import yaml

from tests.chance import generator
from tests.commands import CASES, vstatics
from vstatics import Gear, ShiftElement, Transmission, compare, load, solve
from vstatics.core.comparison.namesakes import row_names_of
from vstatics.core.comparison.verdicts import CaseVerdict

SHUFFLED = (
    *("simpson", "zf-8hp70", "ravigneaux-aod", "wilson-preselector"),
    *("tarasik-truck", "moskvich-start"),  # with springs, which no deck has
)
NAMED = ("mechanisms", "elements", "shift_elements", "springs", "gears")
"""What a case has by name."""


def written(data: dict[str, Any], path: Path, form: str) -> Path:
    """The results of a case as JSON or CSV."""
    case = path.with_suffix(".yaml")
    case.write_text(yaml.safe_dump(data, sort_keys=False), "utf-8")
    made = path.with_suffix(f".{form}")
    assert vstatics("run", case, "-q", "-o", made).status == 0
    return made


def parts(name: str) -> dict[str, Any]:
    """A shipped case as plain data, with its ports named."""
    path = CASES / f"{name}.yaml"
    case = load(path)
    data: dict[str, Any] = yaml.safe_load(path.read_text("utf-8"))
    ports = {"input": case.link_name(case.input), "output": case.link_name(case.output)}
    return {**ports, **data}


def shuffled(data: dict[str, Any], seed: int) -> dict[str, Any]:
    """The same case with its parts in another order."""
    order = generator(seed)
    made = dict(data)
    for key in NAMED:
        if key in made:
            names = list(made[key])
            turned = [names[place] for place in order.permutation(len(names))]
            made[key] = {name: made[key][name] for name in turned}
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


@pytest.mark.parametrize("form", ["json", "csv", "txt"])
@pytest.mark.parametrize("name", SHUFFLED)
def test_no_number_differs_by_the_order_of_parts(name: str, form: str, tmp_path: Path) -> None:
    data = parts(name)
    before = written(data, tmp_path / "before", form)
    for seed in range(3):
        said = compare(written(shuffled(data, seed), tmp_path / "after", form), before)
        assert (list(said.cases[0].numbers), said.differs) == ([], False), seed


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
        assert {n.table for n in said.cases[0].numbers} <= {"step"}, seed
        assert said.differs == bool(seed)
        assert said.cases[0].case


@pytest.mark.parametrize("form", ["json", "csv"])
def test_a_part_more_hides_no_number_of_the_others(form: str, tmp_path: Path) -> None:
    """A brake that no gear engages; and a set with another efficiency."""
    data = parts("simpson")
    before = written(data, tmp_path / "before", form)
    elements = {"N": ["ring 1", "housing"], **data["shift_elements"]}
    losing = {**data["mechanisms"]["P1"], "efficiency": 0.9}
    data |= {"shift_elements": elements, "mechanisms": {**data["mechanisms"], "P1": losing}}
    found = compare(written(data, tmp_path / "after", form), before).cases[0].numbers
    new = {n.table for n in found if n.row == "N" or n.gear == "N"}
    assert new >= {"slip_speeds", "torques", "distribution_matrix"}
    assert all(n.expected == "not there" for n in found if n.row == "N")
    now, then = (solve(load(tmp_path / f"{name}.yaml")) for name in ("after", "before"))
    lost = [n for n in found if n.table == "losses"]
    assert {n.row for n in lost} == {"P1", "P2"}
    for n in lost:
        place = "losses", str(n.row), str(n.gear)
        assert (n.actual, n.expected) == (now[place], then[place])


def changed(data: dict[str, Any], folder: Path, form: str = "json", **keys: Any) -> CaseVerdict:
    """Compare a case with other keys with the case as it is."""
    before = written(data, folder / "before", form)
    return compare(written({**data, **keys}, folder / "after", form), before).cases[0]


def test_a_clutch_of_another_name_is_another_clutch_in_csv(tmp_path: Path) -> None:
    """CSV has rows and columns alone, so the clutch is told under both names.

    A gear that has another name is in the first line.
    """
    data = parts("simpson")
    elements = {"X" if name == "A" else name: part for name, part in data["shift_elements"].items()}
    pairs = data["gears"].items()
    gears = {name: ["X" if e == "A" else e for e in g["engaged"]] for name, g in pairs}
    said = changed(data, tmp_path, "csv", shift_elements=elements, gears=gears)
    rows = {n.row for n in said.numbers if n.table in ("slip_speeds", "distribution_matrix")}
    assert rows == {"A", "X"}
    gears = {"back" if name == "R" else name: gear for name, gear in data["gears"].items()}
    said = changed(data, tmp_path, gears=gears)
    assert said.differs
    assert said.headline.endswith("no number differs, but gears are not the same")


def test_a_link_that_becomes_the_input_by_its_place_is_a_change_of_the_case(tmp_path: Path) -> None:
    """The first link is the input where nothing else is told, the last link the output."""
    data = parts("simpson")
    del data["input"], data["output"]
    first, last = data["links"][0], data["links"][-1]
    said = changed(data, tmp_path, links=data["links"][::-1])
    assert [*map(tuple, said.case)] == [("input", first, last), ("output", last, first)]
    assert not changed(data, tmp_path, input=first, output=last).case


def test_renamed_clutches_are_matched_in_order_or_by_the_gears_that_engage_them() -> None:
    old, new, parallel, swapped = (
        Transmission(
            4,
            [ShiftElement(*ends, name) for ends, name in clutches],
            [],
            [Gear([first], name="low"), Gear([3 - first], name="high")],
        )
        for clutches, first in (
            ([((1, 2), "A"), ((3, 4), "B")], 1),
            ([((1, 3), "X"), ((2, 4), "Y")], 1),
            ([((1, 2), "A"), ((1, 2), "B")], 1),
            ([((1, 2), "X"), ((1, 2), "Y")], 2),
        )
    )
    assert row_names_of(new, old)[1] == {"X": "A", "Y": "B"}
    assert row_names_of(swapped, parallel)[1] == {"X": "B", "Y": "A"}
