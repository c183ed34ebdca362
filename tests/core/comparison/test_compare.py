"""Comparing results: listings and JSON in any mix, number by number."""

import json
import math
import re
from collections.abc import Callable
from itertools import product
from pathlib import Path
from typing import Any

import pytest

from tests.commands import BAD, CASES, MZKT, NEUTRAL, Said, vstatics
from vstatics.core.comparison.numbers import Difference
from vstatics.core.comparison.steps import steps_of
from vstatics.core.tables.written_results import Figure, WrittenResult

SPLIT = CASES / "power-split.yaml"
"""A case with names, given speeds and holding torques."""
WITHOUT_DEVICES = "links: 2\nmechanisms: {}\ngears: {a: {}}"
SINGLE = "links: 2\nshift_elements: {C: [1, 2]}\nmechanisms: {}\ngears: {a: {engaged: [C]}}"
Write = Callable[..., Path]


@pytest.fixture
def written(folder: Path) -> Write:
    """Writes a result to a file; changes it where told."""

    def write(text: str, *replaced: tuple[str, str]) -> Path:
        path = Path(f"{len(list(folder.iterdir()))}.txt")
        for old, new in replaced:
            assert old in text
            text = text.replace(old, new, 1)
        path.write_text(text, "utf-8")
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


@pytest.mark.parametrize("case", [MZKT, SPLIT, NEUTRAL, WITHOUT_DEVICES, SINGLE])
def test_any_two_forms_of_one_result_agree(written: Write, case: Path | str) -> None:
    """Tables without rows or columns are not printed, and are in JSON; stdin is either of them."""
    texts = [result(case, *options) for options in ((), ("--lang", "ru"), ("-f", "json"))]
    for text, file in product(texts, map(written, texts)):
        for files in (("-", file), (file, "-")):
            assert vstatics("compare", *files, stdin=text.encode()) == Said(0, "", "")


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("3.461   1.800   1.000  -5.538", "3.462   1.800   1.000  -5.538",
         ("torques", "Mx", "2", 3.461, 3.462)),
        (".395    .711", ".395    .811", ("slip_speeds", "F5", "2", 0.711, 0.811)),
        (".161", ".162", ("speeds", "6", "1", 0.161, 0.162)),
        (".953    .979", ".953 *******", ("efficiency", None, "2", 0.979, None)),
        ("  1  -1   1", "  1   1   1", ("power_sign", "D1", "2", -1.0, 1.0)),
        (".800    .000", ".900    .000", ("distribution_matrix", "2", "D1", 0.8, 0.9)),
    ],
)  # fmt: skip
def test_a_difference_is_named_by_table_row_and_gear(
    written: Write, old: str, new: str, told: tuple[object, ...]
) -> None:
    text = result(MZKT)
    actual, expected = written(text, (old, new)), written(text)
    said = vstatics("compare", actual, expected, "-f", "json")
    assert (said.status, numbers(said)) == (1, [told])
    assert said.err == f"{actual} and {expected} differ in 1 place\n"


def test_names_of_the_case_are_those_of_the_message(written: Write) -> None:
    changed = document(SPLIT)
    changed["speeds"][2][0] += 1
    changed["holding_torques"][1][1] = None
    text = json.dumps(changed, ensure_ascii=False)
    said = vstatics("compare", written(text), written(result(SPLIT)))
    first, second = [re.split("  +", line.strip()) for line in said.out.splitlines()[1:]]
    assert first[:2] == ["speeds", "MG2, hybrid"]
    assert second[:3] == ["holding_torques", "MG1, mechanical point", "-0.278 -> no value"]


def test_half_of_the_last_digit_is_the_limit(written: Write) -> None:
    """Gear 1 prints its efficiency as .953: from .9525 to .9535."""
    listing, changed = written(result(MZKT)), document()
    for value, status in ((0.9525, 0), (0.9535, 0), (0.95249, 1), (0.95351, 1)):
        changed["efficiency"][0] = value
        other = written(json.dumps(changed))
        for files in ((other, listing), (listing, other)):
            assert vstatics("compare", *files).status == status, value


def test_a_result_whose_keys_were_sorted_is_rejected(written: Write) -> None:
    """pre-commit/pre-commit-hooks/issues/156: its formatter of JSON sorts keys by default."""
    files = [written(json.dumps(document(SPLIT), sort_keys=sort)) for sort in (True, False)]
    assert vstatics("compare", *files).fails("result 1 has sorted keys, so the names in its case")
    assert vstatics("compare", files[1], files[1]).status == 0
    inner = written(json.dumps(document(SPLIT) | {"case": {"gears": {}, "links": 2}}))
    assert vstatics("compare", files[1], inner).fails("result 1 has sorted keys")


def test_tolerances_are_absolute_and_relative(written: Write) -> None:
    changed = document()
    changed["ratio"][0] += 3e-6  # of 6.23
    files = written(json.dumps(changed)), written(result(MZKT, "-f", "json"))
    accepted = {"--atol 1e-5", "--rtol 1e-5"}
    for options in (*accepted, "", "--atol 1e-7", "--rtol 1e-7", "--atol 0 --rtol 0"):
        status = vstatics("compare", *files, *options.split()).status
        assert status == (options not in accepted), options
    assert vstatics("compare", *files[1:] * 2, "--atol", "0", "--rtol", "0").status == 0


def test_tolerances_do_not_hide_a_change_of_the_case(written: Write) -> None:
    expected = result(MZKT, "-f", "json")
    changed = written(expected, ('"ratio": -2.461', '"ratio": -2.46'))
    said = vstatics("compare", changed, written(expected), "--rtol", "0.1").out
    assert "1 change of the case; no number differs" in said


def test_a_deviation_is_relative_to_the_magnitude_and_none_of_rounding_noise() -> None:
    """Rounding noise is expected up to 1e-12; of an expected 0 no deviation exists."""
    assert Difference("ratio", "", "R", -4.0, -3.0).shown_deviation == pytest.approx(-1 / 3)
    assert Difference("ratio", "", "1", 1.1, 1.0).shown_deviation == pytest.approx(0.1)
    noise = Difference("efficiency", "", "N", 0.5, 1e-16)
    assert noise.deviation == pytest.approx(5e15)
    assert math.isnan(noise.shown_deviation)
    assert math.isnan(Difference("ratio", "", "1", 0.5, 0.0).deviation)


def test_the_rounding_of_a_step_ratio_is_that_of_both_ratios() -> None:
    """First order: the relative roundings of dividend and divisor add up."""
    ratios = [Figure(4.0, 0.04), Figure(-0.5, 0.01), Figure(-0.2, 0.01)]
    result = WrittenResult({"ratio": [ratios]}, None, False)
    [(pair, step)] = steps_of(result, ["1", "R1", "R2"], None).items()
    assert pair == ("R1", "R2")
    assert step == pytest.approx((2.5, 2.5 * (0.01 / 0.5 + 0.01 / 0.2)))


def test_a_ratio_of_0_is_compared(written: Write) -> None:
    """A step from or to it does not exist."""
    changed = document()
    changed["ratio"][0] = 0.0
    files = written(json.dumps(changed)), written(result(MZKT, "-f", "json"))
    found = numbers(vstatics("compare", *files, "-f", "json"))
    assert found == [
        ("ratio", None, "1", pytest.approx(6.23, abs=5e-4), 0.0),
        ("step", None, "1", pytest.approx(1.8, abs=5e-4), None),
    ]
    assert len(numbers(vstatics("compare", *files[::-1], "-f", "json"))) == 2


def test_tables_of_other_shapes_are_named(written: Write) -> None:
    changed = document()
    changed["speeds"].pop()
    changed["planet_speeds"][1].pop()
    del changed["power_sign"]
    said = vstatics("compare", written(json.dumps(changed)), written(result(MZKT)))
    assert [re.split("  +", line.strip()) for line in said.out.splitlines()[1:]] == [
        ["speeds", "6 rows -> 5 rows"],
        ["planet_speeds", "D2", "6 columns -> 5 columns"],
        ["power_sign", "there -> not there"],
    ]
    said = vstatics("compare", written(result(MZKT)), written(result(SPLIT)), "-f", "json")
    assert ("holding_torques", None, None, "there", "not there") in numbers(said)


@pytest.mark.parametrize("form", ["csv", "json", "listing"])
def test_rows_of_a_renamed_element_are_the_same_where_the_case_tells_it(
    form: str, written: Write
) -> None:
    """CSV has no case, so the rows of one name are gone, and those of the other are new."""
    case = (CASES / "wheel-hub.yaml").read_text("utf-8")
    [name] = re.findall(r"(?m)^ +(.*): .*kind: ", case)[:1]
    texts = case, case.replace(f"  {name}:", "  other:")
    said = vstatics("compare", *(written(result(t, "-f", form)) for t in texts), "-f", "json")
    found = numbers(said)
    assert (said.status, bool(found)) == ((1, True) if form == "csv" else (0, False))
    if form == "csv":
        assert ("torques", f"{name}.sun", None, "not there", "there") in found
        assert ("torques", "other.sun", None, "there", "not there") in found
        assert "Mx" not in [row for _, row, *_ in found]


def test_several_results_are_paired_by_the_names_of_their_cases(written: Write) -> None:
    both = vstatics("run", MZKT, SPLIT, "-f", "json").out
    listings = vstatics("run", MZKT, SPLIT).out
    assert vstatics("compare", written(listings), written(both)).all == ""
    said = vstatics("compare", written(listings, ("  1  -1   1", "  1   1   1")), written(both))
    first, second, tally = said.out.splitlines()
    assert first.endswith(": 1 other number differs")
    assert second.split() == ["power_sign", "D1,", "2", "-1.000", "->", "1.000", "+200.00", "%"]
    assert tally == "1 same, 1 changed, 0 added, 0 gone"
    said = vstatics("compare", written(both), written(result(MZKT)))
    tally = "1 same, 0 changed, 1 added, 0 gone"
    assert said.out == f"power-split: added (no expected result)\n{tally}\n"


def test_a_failed_case_equals_a_failed_case_only(written: Write) -> None:
    case, both = Path("case.yaml"), []
    for data in (BAD.encode(), SPLIT.read_bytes()):
        case.write_bytes(data)
        both.append(written(vstatics("run", MZKT, case, "-f", "json").out))
    assert vstatics("compare", both[0], both[0]).status == 0
    said = vstatics("compare", *both)
    assert said.out.splitlines()[0] == "case: a case in error, expected a result"


def test_a_listing_of_the_source_has_its_tables_only(written: Write) -> None:
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
