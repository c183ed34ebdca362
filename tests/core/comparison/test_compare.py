"""Comparing results: listings and JSON in any mix, number by number."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.commands import BAD, CASES, MZKT, NEUTRAL, Said, vstatics

SPLIT = CASES / "power-split.yaml"
"""A case with names, given speeds and holding torques."""
SINGLE = "links: 2\nshift_elements: {C: [1, 2]}\nmechanisms: {}\ngears: {a: {engaged: [C]}}"
BAD_INPUT = [
    b"",
    b"words only",
    b"{",
    b'{"speeds": [[1, 2]',
    b"[" * 200_000,
    b"null",
    b"[]",
    b"3",
    b'["x"]',
    b"{}",
    b'{"efficiency": {"1": 1}}',
    b'{"efficiency": "0.9"}',
    b'{"efficiency": ["0.9"]}',
    b'{"speeds": 3}',
    b'{"speeds": [3]}',
    b'{"speeds": {"1": [2]}}',
    b'{"efficiency": [1' + b"0" * 400 + b"]}",
    b'{"efficiency": [1' + b"0" * 5000 + b"]}",
    b'{"efficiency": [1e999]}',
    b'{"efficiency": [NaN]}',
    b"\x00\x01\x02",
    b"\xff\xfe1\x00",
    NEUTRAL.encode(),
    MZKT.read_bytes(),
]


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., Path]:
    """Writes a result to a file; changes it where told."""
    folder = tmp_path_factory.mktemp("results")

    def write(text: str | bytes, *replaced: tuple[str, str]) -> Path:
        path = folder / f"{len(list(folder.iterdir()))}.txt"
        if isinstance(text, str):
            for old, new in replaced:
                assert old in text
                text = text.replace(old, new, 1)
            text = text.encode()
        path.write_bytes(text)
        return path

    return write


def result(case: Path | str, *options: str) -> str:
    data = case.encode() if isinstance(case, str) else case.read_bytes()
    return vstatics("run", "-", *options, stdin=data).out


def document(case: Path | str = MZKT) -> dict[str, Any]:
    """A result as plain data."""
    found: dict[str, Any] = json.loads(result(case, "-f", "json"))
    return found


def numbers(said: Said) -> list[tuple[object, ...]]:
    """Table, row, gear, expected and actual of each number that differs."""
    [case] = said.json["cases"]
    return [tuple(number.values())[:5] for number in case["numbers"]]


FORMS = {"listing": (), "russian": ("--lang", "ru"), "json": ("-f", "json")}


@pytest.mark.parametrize("case", [MZKT, SPLIT, NEUTRAL], ids=["MZKT", "split", "neutral"])
@pytest.mark.parametrize("actual", FORMS)
@pytest.mark.parametrize("expected", FORMS)
def test_any_two_forms_of_one_result_agree(
    written: Callable[..., Path], case: Path | str, actual: str, expected: str
) -> None:
    files = [written(result(case, *FORMS[form])) for form in (actual, expected)]
    assert vstatics("compare", *files) == Said(0, "", "")


def test_a_case_without_devices_agrees_with_itself(written: Callable[..., Path]) -> None:
    """Tables without rows or columns are not printed, and stand in JSON."""
    for case in ("links: 2\nmechanisms: {}\ngears: {a: {}}", SINGLE):
        forms = [written(result(case, *options)) for options in FORMS.values()]
        for actual in forms:
            assert [vstatics("compare", actual, other).all for other in forms] == [""] * 3


def test_standard_input_is_either_of_them(written: Callable[..., Path]) -> None:
    text = result(MZKT)
    assert vstatics("compare", "-", written(text), stdin=text.encode()).status == 0
    assert vstatics("compare", written(text), "-", stdin=text.encode()).status == 0


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("6.230   3.461   1.800   1.000  -5.538", "6.230   3.462   1.800   1.000  -5.538",
         ("torques", "Mx", "2", 3.461, 3.462)),
        (".395    .711", ".395    .811", ("slip_speeds", "F5", "2", 0.711, 0.811)),
        (".161", ".162", ("speeds", "6", "1", 0.161, 0.162)),
        (".953    .979", ".953 *******", ("efficiency", None, "2", 0.979, None)),
        ("  1  -1   1", "  1   1   1", ("power_sign", "D1", "2", -1.0, 1.0)),
        (".800    .000", ".900    .000", ("distribution_matrix", "2", "D1", 0.8, 0.9)),
    ],
)  # fmt: skip
def test_a_difference_is_named_by_table_row_and_gear(
    written: Callable[..., Path], old: str, new: str, told: tuple[object, ...]
) -> None:
    text = result(MZKT)
    actual, expected = written(text, (old, new)), written(text)
    said = vstatics("compare", actual, expected, "-f", "json")
    assert (said.status, numbers(said)) == (1, [told])
    assert said.err == f"{actual} and {expected} differ in 1 place\n"


def test_names_of_the_case_are_those_of_the_message(written: Callable[..., Path]) -> None:
    changed = document(SPLIT)
    changed["speeds"][2][0] += 1
    changed["holding_torques"][1][1] = None
    text = json.dumps(changed, ensure_ascii=False)
    said = vstatics("compare", written(text), written(result(SPLIT)))
    lines = [re.split("  +", line.strip()) for line in said.out.splitlines()[1:]]
    assert [line[:2] for line in lines] == [
        ["speeds", "MG2, hybrid"],
        ["holding_torques", "MG1, mechanical point"],
    ]
    assert lines[1][2] == "-0.278 -> no value"


def test_half_of_the_last_digit_is_the_limit(written: Callable[..., Path]) -> None:
    """Gear 1 prints its efficiency as .953: from .9525 to .9535."""
    listing = written(result(MZKT))
    for value, same in ((0.9525, True), (0.9535, True), (0.95249, False), (0.95351, False)):
        changed = document()
        changed["efficiency"][0] = value
        said = vstatics("compare", written(json.dumps(changed)), listing)
        assert (said.status == 0) == same, value
        assert (vstatics("compare", listing, written(json.dumps(changed))).status == 0) == same


@pytest.mark.parametrize(
    ("options", "status"),
    [
        ([], 1),
        (["--atol", "1e-5"], 0),
        (["--atol", "1e-7"], 1),
        (["--rtol", "1e-5"], 0),
        (["--rtol", "1e-7"], 1),
    ],
)
def test_tolerances_are_absolute_and_relative(
    written: Callable[..., Path], options: list[str], status: int
) -> None:
    changed = document()
    changed["ratio"][0] += 3e-6  # of 6.23
    files = written(json.dumps(changed)), written(result(MZKT, "-f", "json"))
    assert vstatics("compare", *files, *options).status == status
    assert vstatics("compare", *files, "--atol", "0", "--rtol", "0").status == 1
    assert vstatics("compare", files[1], files[1], "--atol", "0", "--rtol", "0").status == 0


def test_tables_of_other_shapes_are_named(written: Callable[..., Path]) -> None:
    changed = document()
    changed["speeds"].pop()
    changed["planet_speeds"][1].pop()
    del changed["power_sign"]
    said = vstatics("compare", written(json.dumps(changed)), written(result(MZKT)))
    told = [re.split("  +", line.strip()) for line in said.out.splitlines()[1:]]
    assert told == [
        ["speeds", "6 rows -> 5 rows"],
        ["planet_speeds", "D2", "6 columns -> 5 columns"],
        ["power_sign", "there -> not there"],
    ]
    said = vstatics("compare", written(result(MZKT)), written(result(SPLIT)), "-f", "json")
    assert said.status == 1
    assert ("holding_torques", None, None, "there", "not there") in numbers(said)


@pytest.mark.parametrize("form", ["json", "listing", "csv"])
def test_rows_of_an_element_of_another_name_are_the_same_where_the_case_tells_it(
    form: str, written: Callable[..., Path], tmp_path: Path
) -> None:
    case = (CASES / "wheel-hub.yaml").read_text(encoding="utf-8")
    actual = written(result(CASES / "wheel-hub.yaml", "-f", form))
    renamed = tmp_path / "renamed.yaml"
    name = next(line for line in case.splitlines() if "kind: " in line).split(":")[0].strip()
    renamed.write_text(case.replace(f"  {name}:", "  other:"), encoding="utf-8")
    said = vstatics("compare", actual, written(result(renamed, "-f", form)), "-f", "json")
    found = numbers(said)
    if form != "csv":
        assert (said.status, found) == (0, [])
        return
    assert ("torques", f"{name}.sun", None, "not there", "there") in found
    assert ("torques", "other.sun", None, "there", "not there") in found
    assert "Mx" not in [row for _, row, *_ in found]


def test_several_results_are_compared_in_their_order(written: Callable[..., Path]) -> None:
    both = vstatics("run", MZKT, SPLIT, "-f", "json").out
    listings = vstatics("run", MZKT, SPLIT).out
    assert vstatics("compare", written(listings), written(both)).all == ""
    said = vstatics("compare", written(listings, ("  1  -1   1", "  1   1   1")), written(both))
    first, second, tally = said.out.splitlines()
    assert first.endswith(": 1 other number differs")
    assert second.split() == ["power_sign", "D1,", "2", "-1.000", "->", "1.000", "+200.00", "%"]
    assert tally == "1 same, 1 changed, 0 added, 0 gone"
    said = vstatics("compare", written(both), written(result(MZKT)))
    assert (said.status, said.out) == (
        1,
        "power-split: added\n1 same, 0 changed, 1 added, 0 gone\n",
    )


def test_a_failed_case_equals_a_failed_case_only(
    written: Callable[..., Path], tmp_path: Path
) -> None:
    bad = tmp_path / "bad.yaml"
    bad.write_bytes((CASES / "zf-8hp70.yaml").read_bytes())
    good = vstatics("run", MZKT, bad, "-f", "json").out
    bad.write_text(BAD, encoding="utf-8")
    failed = vstatics("run", MZKT, bad, "-f", "json").out
    assert vstatics("compare", written(failed), written(failed)).status == 0
    said = vstatics("compare", written(failed), written(good))
    assert said.out.splitlines()[0] == "bad: a case in error, expected a result"


def test_a_listing_of_the_source_has_its_tables_only(written: Callable[..., Path]) -> None:
    """No echo of the input, no tables but the published ones, Fortran numbers."""
    text = result(MZKT).replace("W(I,J)", "W (I, J)").replace("  .726", "0.726")
    tables = text[text.index("Structural") : text.index("Ratio of the gears")]
    for other in (text, result(MZKT, "-f", "json")):
        assert vstatics("compare", written(tables), written(other)).all == ""
        assert vstatics("compare", written(other), written(tables)).all == ""
    changed = tables.replace("  3.461   1.800", "  3.461  .18E+01", 1)
    assert vstatics("compare", written(changed), written(text)).all == ""
    changed = re.sub(r"(?m)^ +\.161 .*\n", "", tables, count=1)
    said = vstatics("compare", written(changed), written(text), "-f", "json")
    assert numbers(said) == [("speeds", None, None, "6 rows", "5 rows")]
    without = tables[: tables.index("Efficiency")] + tables[tables.index("Sign of") :]
    said = vstatics("compare", written(without), written(text), "-f", "json")
    assert numbers(said) == [("efficiency", None, None, "there", "not there")]


@pytest.mark.parametrize("data", BAD_INPUT, ids=lambda data: repr(data[:24]))
def test_what_is_no_result_is_an_error_at_its_place(
    written: Callable[..., Path], data: bytes
) -> None:
    path, good = written(data), written(result(MZKT))
    for files in ((path, good), (good, path)):
        said = vstatics("compare", *files)
        assert said.status == 1
        assert said.out or said.err.startswith(f"{path}:")
