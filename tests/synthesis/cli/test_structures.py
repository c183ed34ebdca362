"""`vstatics synth structures` and `synth case` as they are called; what they find is tested by room.

Counts are those of the lemma of Burnside (`tests/oracle/schemes.py`).
"""

import json
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

from tests.commands import vstatics
from vstatics import load, solve
from vstatics.core.cli.schemas import schemas
from vstatics.core.cli.shared import estimates
from vstatics.core.jobs.files import STDOUT
from vstatics.synthesis.cli import structures as synth_structures

pytestmark = pytest.mark.usefixtures("folder")

BELAZ = "0-1-2-1-3-4-1-5-3-3-5-6"
"""Sun, carrier and ring of its four sets in turn, links numbered as they come."""


def structures(*options: object) -> list[dict[str, object]]:
    said = vstatics("synth", "structures", *options)
    assert (said.status, said.err) == (0, "")
    return [json.loads(line) for line in said.out.splitlines()]


def refused(*words: object) -> str:
    said = vstatics("synth", *words)
    assert said.is_wrong_use()
    return said.err.split("Error: ")[1].rstrip()


# structures


def test_a_list_has_a_line_for_each_scheme() -> None:
    found = structures("--sets", 3, "--classes", "sets")
    assert len(found) == 382
    assert found[0] == {"code": "0-1-2-0-1-3-0-1-4", "links": 5, "input": None, "output": None}
    assert all(len(set(str(one["code"]).split("-"))) == one["links"] for one in found)


@pytest.mark.parametrize("options", [(), ("--ports",), ("--classes", "order")])
def test_a_matrix_has_a_one_for_each_member(options: tuple[str, ...]) -> None:
    """Member n of the code is on the link of its number, and on no other."""
    found = structures("--sets", 2, "--matrix", *options)
    without = structures("--sets", 2, *options)
    assert [{k: v for k, v in one.items() if k != "matrix"} for one in found] == without
    for one in found:
        code = [int(link) for link in str(one["code"]).split("-")]
        links = range(max(code) + 1)
        assert one["matrix"] == [[int(link == member) for member in code] for link in links]


def test_a_count_has_no_matrix() -> None:
    said = refused("structures", "--sets", 2, "--matrix", "--count")
    assert said == "--matrix is of a list: expected it without --count"


def test_ports_are_links_of_the_code() -> None:
    """Two sets with one sun: the sets may be exchanged, so 10 of 20 pairs are left."""
    found = structures("--sets", 2, "--classes", "sets", "--ports", "-f", "json")
    assert len(found) == 201
    one = [(x["input"], x["output"]) for x in found if x["code"] == "0-1-2-0-3-4"]
    assert one == [
        *[(0, 1), (0, 2), (1, 0), (1, 2), (1, 3), (1, 4), (2, 0), (2, 1), (2, 3), (2, 4)]
    ]


def test_a_count_is_a_document() -> None:
    said = vstatics("synth", "structures", "--sets", 3, "--all", "--count")
    assert said.json == {"sets": 3, "count": 2295, "by_links": {"5": 1242, "6": 864, "7": 189}}
    assert said.out.startswith('{\n "sets": 3,\n')


@pytest.mark.parametrize("links", [("--links", "7,5"), ("--links", 5, "--links", "7")])
def test_links_are_repeated_or_listed(links: tuple[object, ...]) -> None:
    [found] = structures("--sets", 3, "--count", "-f", "jsonl", *links)
    assert found == {"sets": 3, "count": 1269, "by_links": {"5": 1080, "7": 189}}


def test_a_file_holds_what_stdout_would() -> None:
    said = vstatics("synth", "structures", "--sets", 2, "-o", "two.jsonl")
    assert (said.status, said.all) == (0, "")
    printed = vstatics("synth", "structures", "--sets", 2).out
    assert Path("two.jsonl").read_text(encoding="utf-8") == printed


def test_a_dry_run_tells_how_many_how_large_how_long() -> None:
    said = vstatics("synth", "structures", "--sets", 2, "--dry-run")
    size = len(vstatics("synth", "structures", "--sets", 2).out)
    lines = [line.split(None, 1) for line in said.out.splitlines()]
    assert [line[0] for line in lines] == ["schemes", "4", "5", "size", "time"]
    assert said.out.startswith("schemes   27\n4 links   18\n5 links   9\n")
    [known] = structures("--sets", 2, "--dry-run", "-f", "jsonl")
    assert {name: known[name] for name in ("sets", "count", "exact", "bytes")} == {
        "sets": 2,
        "count": 27,
        "exact": True,
        "bytes": size,
    }


def test_what_has_no_room_is_refused_before_it_begins(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(synth_structures, "QUICK_SETS", 1)
    monkeypatch.setattr(estimates, "free_room", lambda _: 1000)
    said = vstatics("synth", "structures", "--sets", 2, "-o", "two.jsonl")
    assert said.status == 1
    assert said.err.startswith(
        "two.jsonl: error: would have about 1.81 kB, but 1 kB are free there"
    )
    assert not Path("two.jsonl").exists()


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--sets", 0), "Invalid value for '--sets': 0 is not in the range 1<=x<=10."),
        (("--sets", 11), "Invalid value for '--sets': 11 is not in the range 1<=x<=10."),
        (("--sets", 2, "--links", 6), "Invalid value for --links: read 6 links, but 2 sets have"),
        (("--sets", 2, "--links", "4,,"), "Invalid value for '--links': read ``, expected a"),
        (("--sets", 2, "--links", "-4"), "Invalid value for '--links': read `-4`, expected a"),
        (("--sets", 2, "--classes", "set"), "Invalid value for '--classes': 'set' is not one of"),
    ],
)
def test_wrong_use_of_structures(words: tuple[object, ...], message: str) -> None:
    assert refused("structures", *words).startswith(message)


# a case


def test_a_case_is_one_that_others_take() -> None:
    """Ratios of the BelAZ-7516 with p = 2, 2.6, 2.2, 2.4: the published formulas, T and F alike."""
    call = ("case", BELAZ, "--input", "L2", "--output", "L5", "--ratios", "-2,-2.6", "-o", "b.yaml")
    said = vstatics("synth", *call, "--ratios", "P4=-2.4,P3=-2.2")
    assert (said.status, said.all) == (0, "")
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


@pytest.mark.parametrize("form", ["yaml", "json", "deck"])
def test_a_case_in_every_format(form: str) -> None:
    call = ("synth", "case", "0-1-2", "--input", "0", "--output", "l1", "--ratios", "-73/35")
    said = vstatics(*call, "-f", form)
    told = {"deck": "a deck holds no inertias: those of input and output are left out\n"}
    assert (said.status, said.err) == (0, told.get(form, ""))
    if form == "json":
        assert said.json["output"] == "L1"
    if form == "yaml":
        assert "ratio: -2.0857" in said.out


def test_ratios_that_are_not_given_are_told() -> None:
    said = vstatics("synth", "case", "0-1-2-0-3-1", "--input", "L0", "--output", "L1")
    assert said.status == 0
    assert said.err == "no ratios are given, so the gear sets have -2 and -2.1\n"


def test_sets_that_turn_as_one_body_are_told(tmp_path: Path) -> None:
    """Sets 1 and 2 share three links; the case is one of `--all`."""
    code = structures("--sets", 3, "--all", "--links", 5)[0]["code"]
    assert code == "0-1-2-0-1-2-0-3-4"
    call = ("--input", "L0", "--output", "L3", "--ratios", "-2,-3,-4", "-o", "locked.yaml")
    said = vstatics("synth", "case", code, *call)
    assert said.status == 0
    assert said.err == (
        "warning: sets 1 and 2 have 3 links only, so they turn as one body whatever "
        "their ratios are\n"
    )
    assert vstatics("run", tmp_path / "locked.yaml").status == 0


@pytest.mark.parametrize(
    ("code", "message"),
    [
        ("", "read nothing in the code, expected numbers of links joined by `-`"),
        ("0-1-2-", "read nothing in the code"),
        ("0-1-x", "read `x` in the code"),
        ("0-1-\u0662", "read `\u0662` in the code"),
        ("0-1-2-0", "read 4 links in the code, expected three for each set: sun, carrier, ring"),
        ("0-1-2-0-3-5", "no set has link 4, but the greatest is 5; expected 0, 1, 2, ..."),
        ("0-1-2-0-3-999999999999", "no set has link 4, 5, 6, ..., but the greatest is"),
        ("0-1-2-3-0-3", "sun and ring of set 2 are both link 3; expected three links"),
        ("0-1-2-3-4-5", "its sets share no link: these are several gearboxes, expected one"),
        ("0-1-2-2-1-0", "2 sets with 3 links turn as one body; expected 4 links or more"),
        ("-".join(["0"] * 99), "read `0-0-0-0-0-"),
    ],
)
def test_codes_that_are_none(code: str, message: str) -> None:
    said = refused("case", "--input", "L0", "--output", "L1", "--", code)
    assert message in said


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--input", "L5", "--output", "L1"), "--input: read `L5`, but the scheme has L0 to L3"),
        (("--input", "L0", "--output", "0"), "--output: read L0, which is the input"),
        (("--input", "housing", "--output", "L1"), "--input: read `housing`, but the scheme has"),
    ],
)
def test_links_that_a_scheme_has_not(words: tuple[str, ...], message: str) -> None:
    assert refused("case", "0-1-2-0-3-1", *words).startswith(f"Invalid value for {message}")


@pytest.mark.parametrize(
    ("ratios", "message"),
    [
        ("-2", "P2 without a ratio, expected 2, one for each set"),
        ("-2,-3,-4", "read 3 ratios, expected 2, one for each set"),
        ("-2,P1=-3", "P1 has two ratios, expected one"),
        ("P1=-2,P3=-3", "read a ratio of `P3`, but there is no such set"),
        ("-2,x", "read `x`"),
        ("-2,-3 rpm", "read `-3 rpm`, expected a number such as -2.5 or -73/35"),
        ("-2,0", "P2: "),
        ("-2,nan", "read `nan`"),
        ("-2,1e999", "read `1e999`"),
    ],
)
def test_ratios_that_are_none(ratios: str, message: str) -> None:
    ports = ("--input", "L0", "--output", "L1")
    said = refused("case", "0-1-2-0-3-1", *ports, "--ratios", ratios)
    assert said.startswith(f"Invalid value for --ratios: {message}")


def test_a_case_is_written_to_stdout_by_default() -> None:
    call = ("synth", "case", "0-1-2", "--input", "L0", "--output", "L1", "--ratios", "-2")
    assert vstatics(*call).out == vstatics(*call, "-o", STDOUT).out


@pytest.mark.parametrize("options", [(), ("--count",), ("--dry-run",), ("--dry-run", "--count")])
def test_all_documents_fit_the_schema(options: tuple[str, ...]) -> None:
    validator = Draft202012Validator(schemas()["structures"])
    for one in structures("--sets", 2, "--ports", "-f", "jsonl", *options):
        assert list(validator.iter_errors(one)) == []
