"""`vstatics synth structures` and `synth case` as they are called.

Counts are those of the lemma of Burnside (`tests/oracle/schemes.py`).
"""

import json
from pathlib import Path

import pytest

from tests.commands import vstatics
from tests.core.cli.test_schemas import validator
from vstatics import load, solve
from vstatics.core.cli.shared import estimates
from vstatics.synthesis.cli import structures as synth_structures

pytestmark = pytest.mark.usefixtures("folder")

BELAZ = "0-1-2-1-3-4-1-5-3-3-5-6"
"""Sun, carrier and ring of its four sets in turn, links numbered as they come."""


def structures(*options: object) -> list[dict[str, object]]:
    said = vstatics("synth", "structures", *options)
    assert said.is_without_messages()
    found = [json.loads(line) for line in said.out.splitlines()]
    assert [*validator("structures").iter_errors(found[0])] == []
    return found


def refused(*words: object) -> str:
    said = vstatics("synth", *words)
    assert said.is_wrong_use()
    return said.err.split("Error: ")[1].rstrip()


@pytest.mark.parametrize("options", [(), ("--ports",), ("--classes", "order")])
def test_a_list_has_a_line_for_each_scheme_and_a_matrix_a_one_for_each_member(
    options: tuple[str, ...],
) -> None:
    """Member n of the code is on the link of its number, and on no other."""
    found = structures("--sets", 2, "--matrix", *options)
    without = structures("--sets", 2, *options)
    assert [{k: v for k, v in one.items() if k != "matrix"} for one in found] == without
    for one in found:
        code = [int(link) for link in str(one["code"]).split("-")]
        links = range(max(code) + 1)
        assert one["links"] == len(links)
        assert one["matrix"] == [[int(link == member) for member in code] for link in links]


def test_a_count_is_a_document() -> None:
    said = vstatics("synth", "structures", "--sets", 3, "--all", "--count")
    by_links = {"5": 1242, "6": 864, "7": 189}
    assert said.json == {"sets": 3, "count": 2295, "by_links": by_links}
    assert said.out.startswith('{\n "sets": 3,\n')
    for links in (("--links", "7,5"), ("--links", 5, "--links", "7")):
        [found] = structures("--sets", 3, "--count", "-f", "jsonl", *links)
        assert found == {"sets": 3, "count": 1269, "by_links": {"5": 1080, "7": 189}}


def test_a_dry_run_tells_how_many_how_large_how_long(monkeypatch: pytest.MonkeyPatch) -> None:
    assert vstatics("synth", "structures", "--sets", 2, "-o", "two.jsonl").is_silent()
    size = Path("two.jsonl").stat().st_size
    Path("two.jsonl").unlink()
    shown = vstatics("synth", "structures", "--sets", 2, "--dry-run").out
    rows = [line.split(None, 1)[0] for line in shown.splitlines()]
    assert rows == ["schemes", "4", "5", "size", "time"]
    assert shown.startswith("schemes   27\n4 links   18\n5 links   9\n")
    [known] = structures("--sets", 2, "--dry-run", "-f", "jsonl")
    told = {name: known[name] for name in ("sets", "count", "exact", "bytes")}
    assert told == {"sets": 2, "count": 27, "exact": True, "bytes": size}
    [known] = structures("--sets", 2, "--dry-run", "--count", "-f", "jsonl")
    assert known["bytes"] is None
    monkeypatch.setattr(synth_structures, "QUICK_SETS", 1)
    monkeypatch.setattr(estimates, "free_room", lambda _: 1000)
    said = vstatics("synth", "structures", "--sets", 2, "-o", "two.jsonl")
    assert said.fails("two.jsonl: error: needs about 1.81 kB, but only 1 kB are free there")
    assert not Path("two.jsonl").exists()


def test_a_case_is_one_that_others_take() -> None:
    """Ratios of the BelAZ-7516 with p = 2, 2.6, 2.2, 2.4: the published formulas, T and F alike."""
    call = ("case", BELAZ, "--input", "L2", "--output", "L5", "--ratios", "-2,-2.6", "-o", "b.yaml")
    said = vstatics("synth", *call, "--ratios", "P4=-2.4,P3=-2.2")
    assert said.is_silent()
    case = load("b.yaml")
    ratios = dict(zip([gear.engaged for gear in case.gears], solve(case).ratio, strict=True))
    names = {one.name: number for number, one in enumerate(case.shift_elements, 1)}
    p1, p2, p3, p4 = 2, 2.6, 2.2, 2.4
    splitter = (1 + p1) / p1
    expected = {
        ("T-L0", "T-L4"): splitter * (1 + p2) * (1 + p3) / (1 + p2 + p3),
        ("T-L0", "T-L3"): splitter * (1 + p3),
        ("T-L0", "T-L6"): splitter * (1 - p3 * p4),
        ("T-L3", "F-L2-L0"): 1 + p3,
        ("T-L6", "F-L2-L0"): 1 - p3 * p4,
    }
    for (first, second), ratio in expected.items():
        assert ratios[names[first], names[second]] == pytest.approx(ratio, rel=1e-12)
    assert vstatics("check", "b.yaml", "--strict").status == 0


def test_a_case_in_every_format() -> None:
    call = ("synth", "case", "0-1-2", "--input", "0", "--output", "l1", "--ratios", "-73/35")
    said = {form: vstatics(*call, "-f", form) for form in ("yaml", "json", "deck")}
    left_out = "a deck holds no inertias: those of input and output are left out\n"
    assert [(one.status, one.err) for one in said.values()] == [(0, ""), (0, ""), (0, left_out)]
    assert said["json"].json["output"] == "L1"
    assert "ratio: -2.0857" in said["yaml"].out


def test_ratios_that_are_not_given_and_sets_that_turn_as_one_body_are_reported() -> None:
    """Sets 1 and 2 share three links; the case is one of `--all`."""
    said = vstatics("synth", "case", "0-1-2-0-3-1", "--input", "L0", "--output", "L1")
    assert said.status == 0
    assert said.err == "no ratios are given, so the gear sets have -2 and -2.1\n"
    code = structures("--sets", 3, "--all", "--links", 5)[0]["code"]
    assert code == "0-1-2-0-1-2-0-3-4"
    call = ("--input", "L0", "--output", "L3", "--ratios", "-2,-3,-4", "-o", "locked.yaml")
    said = vstatics("synth", "case", code, *call)
    text = "sets 1 and 2 have 3 links only, so they turn as one body whatever their ratios are"
    assert (said.status, said.err) == (0, f"warning: {text}\n")
    assert vstatics("run", "locked.yaml").status == 0


PORTS = ("--input", "L0", "--output", "L1")
TWO = ("case", "0-1-2-0-3-1")


def with_code(code: str) -> tuple[str, ...]:
    return ("case", *PORTS, "--", code)


def with_ratios(ratios: str) -> tuple[str, ...]:
    return (*TWO, *PORTS, "--ratios", ratios)


def test_wrong_use() -> None:
    for words, message in (
        (("structures", "--sets", 0), "'--sets': 0 is not in the range 1<=x<=10."),
        (("structures", "--sets", 2, "--links", 6), "--links: read 6 links, but 2 sets have"),
        (("structures", "--sets", 2, "--links", "4,,"), "'--links': read ``, expected a"),
        (("structures", "--sets", 2, "--links", "-4"), "'--links': read `-4`, expected a"),
        (("structures", "--sets", 2, "--classes", "set"), "'--classes': 'set' is not one of"),
        (
            ("structures", "--sets", 2, "--matrix", "--count"),
            "--matrix cannot be combined with --count",
        ),
        (with_code(""), "read nothing in the code, expected numbers of links joined by `-`"),
        (with_code("0-1-x"), "read `x` in the code"),
        (with_code("0-1-\u0662"), "read `\u0662` in the code"),
        (with_code("0-1-2-0"), "read 4 links in the code, expected three for each set: sun, carr"),
        (with_code("0-1-2-0-3-5"), "no set has link 4, but the greatest is 5; expected 0, 1, 2"),
        (with_code("0-1-2-0-3-999999999999"), "no set has link 4, 5, 6, ..., but the greatest is"),
        (with_code("0-1-2-3-0-3"), "sun and ring of set 2 are both link 3; expected three links"),
        (with_code("0-1-2-3-4-5"), "its sets share no link: these are several gearboxes, expected"),
        (with_code("0-1-2-2-1-0"), "2 sets with 3 links turn as one body; expected 4 links or"),
        (with_code("-".join(["0"] * 99)), "read `0-0-0-0-0-"),
        ((*TWO, "--input", "L5", *PORTS[2:]), "--input: read `L5`, but the structure has L0 to L3"),
        ((*TWO, *PORTS[:2], "--output", "0"), "--output: read L0, which is the input"),
        (with_ratios("-2"), "--ratios: P2 without a ratio, expected 2, one for each set"),
        (with_ratios("-2,-3,-4"), "--ratios: read 3 ratios, expected 2, one for each set"),
        (with_ratios("-2,P1=-3"), "--ratios: P1 has two ratios, expected one"),
        (with_ratios("P1=-2,P3=-3"), "--ratios: read a ratio of `P3`, but there is no such set"),
        (with_ratios("-2,-3 rpm"), "read `-3 rpm`, expected a number such as -2.5 or -73/35"),
        (with_ratios("-2,0"), "--ratios: P2: "),
        (with_ratios("-2,nan"), "--ratios: read `nan`"),
        (with_ratios("-2,1e999"), "--ratios: read `1e999`"),
    ):
        assert message in refused(*words)
