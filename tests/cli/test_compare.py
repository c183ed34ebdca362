"""`vstatics compare`: which results are held against which, and what is left out."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.commands import CASES, MZKT, NEUTRAL, vstatics

FORMS = ("csv", "json", "jsonl")
SWEPT = ("csv", "jsonl", "npz", "parquet")
pytestmark = pytest.mark.usefixtures("files")


def results(output: str, *cases: object, raw: bool = False) -> str:
    """The name of a file with the results of cases."""
    assert vstatics("run", *cases, "-o", output, "-q", *["--raw"] * raw).status <= 1
    return output


def lines(actual: str, expected: str, *options: str) -> list[str]:
    said = vstatics("compare", actual, expected, *options)
    assert said.status == bool(said.out), said.err
    return said.out.splitlines()


@pytest.mark.parametrize("one", FORMS)
@pytest.mark.parametrize("other", FORMS)
def test_results_of_several_cases_are_the_same_in_every_format_and_order(
    one: str, other: str
) -> None:
    cases = ["neutral.yaml", MZKT, CASES / "simpson-th400.yaml", "tied.yaml"]
    expected = results(f"expected.{other}", *cases)
    assert lines(results(f"actual.{one}", *cases), expected) == []
    assert lines(results(f"turned.{one}", *reversed(cases)), expected) == []


def test_directories_without_a_result_are_not_the_same(tmp_path: Path) -> None:
    both = [tmp_path / "new", tmp_path / "golden"]
    for one in both:
        one.mkdir()
        (one / "box.yaml").write_text("links: 3", encoding="utf-8")
    for form in ("text", "json"):
        said = vstatics("compare", *both, "-f", form)
        assert (said.status, said.out, "nothing to compare" in said.err) == (1, "", True)


def test_a_directory_that_is_not_there_is_named(tmp_path: Path) -> None:
    for named in ((tmp_path, "goldn"), ("goldn", tmp_path)):
        said = vstatics("compare", *named)
        assert said.status == 2
        assert "goldn: no such file or directory" in said.err


@pytest.mark.parametrize("form", FORMS)
def test_a_case_that_is_missing_is_one_line(form: str) -> None:
    expected = results(f"all.{form}", "neutral.yaml", MZKT, "locked.yaml")
    actual = results(f"less.{form}", MZKT, "locked.yaml", "open.yaml")
    assert lines(actual, expected) == [
        "neutral: gone",
        "open: added",
        "2 same, 0 changed, 1 added, 1 gone",
    ]


@pytest.mark.parametrize("form", FORMS)
def test_a_gear_that_is_missing_is_one_line_and_the_others_are_compared_by_name(form: str) -> None:
    """The other gears of `neutral` and `tied` have the same state and name: `low`."""
    expected = results(f"expected.{form}", "neutral.yaml")
    Path("neutral.yaml").write_text(
        NEUTRAL.replace("{N: {}, low: {engaged: [B]}}", "{low: {engaged: [B]}, P: [C]}"), "utf-8"
    )
    actual = results(f"actual.{form}", "neutral.yaml")
    first, *others = (line.split() for line in lines(actual, expected))
    assert "ratios" not in first
    assert sorted(line[1:2] for line in others if line[0] == "case") == [["gears.N"], ["gears.P"]]


def test_gears_of_no_common_name_are_those_of_one_number() -> None:
    """Their names are a change of the case without effect."""
    expected = results("expected.json", "neutral.yaml")
    Path("neutral.yaml").write_text(NEUTRAL.replace("N: ", "a: ").replace("low: ", "b: "), "utf-8")
    said = vstatics("compare", results("actual.json", "neutral.yaml"), expected, "--summary")
    assert (said.status, said.out) == (0, "neutral: 4 changes of the case; no number differs\n")


@pytest.mark.parametrize("raw", [False, True])
def test_names_with_an_apostrophe_before_them_are_read(raw: bool) -> None:
    Path("x.yaml").write_text(NEUTRAL.replace("low: ", "'-R': "), "utf-8")
    actual = results("x.csv", "x.yaml", raw=raw)
    assert ("'-R" in Path(actual).read_text("utf-8")) is not raw
    assert lines(actual, results("x.json", "x.yaml")) == []


@pytest.mark.parametrize("name", ["efficiency", "ETA"])
def test_a_table_is_left_out_by_name_or_alias(name: str) -> None:
    expected = results("expected.csv", "neutral.yaml")
    Path("neutral.yaml").write_text(NEUTRAL.replace("0.96", "0.95"), "utf-8")
    actual = results("actual.csv", "neutral.yaml")
    found = {line.split()[0] for line in lines(actual, expected, "--all")[1:]}
    assert "efficiency" in found
    others = [one for table in found - {"efficiency"} for one in ("--leave-out", table)]
    left = lines(actual, expected, "--all", *others)[1:]
    assert {line.split()[0] for line in left} == {"efficiency"}
    assert lines(actual, expected, *others, "--leave-out", name) == []


def test_a_table_that_is_none_gets_the_nearest_name() -> None:
    file = results("x.csv", "neutral.yaml")
    said = vstatics("compare", file, file, "--leave-out", "losess")
    assert said.status == 1
    assert "did you mean `losses`?" in said.err


# sweeps


def sweep(output: str, values: str = "-2,-3,-4", case: str = "neutral.yaml") -> str:
    said = vstatics("sweep", case, "--vary", f"D.ratio={values}", "-o", output, "-q")
    assert said.status == 0, said.err
    return output


@pytest.mark.parametrize("one", SWEPT)
@pytest.mark.parametrize("other", SWEPT)
def test_sweeps_are_the_same_in_every_format(one: str, other: str) -> None:
    assert lines(sweep(f"a.{one}"), sweep(f"b.{other}")) == []


def test_variants_that_are_missing_are_one_line_and_others_go_by_number() -> None:
    expected = sweep("expected.csv")
    kept = [line for line in Path(expected).read_text("utf-8").splitlines() if line[:2] != "0,"]
    Path("actual.csv").write_text("\n".join([kept[0], *reversed(kept[1:])]) + "\n", "utf-8")
    assert lines("actual.csv", expected) == ["variant 0: not there, expected"]


def test_numbers_of_a_sweep_are_told_by_variant_and_column() -> None:
    """The ratio with B engaged is that of the input to the carrier: 1 - u."""
    actual, expected = sweep("a.csv", "-2,-3,-5"), sweep("b.npz")
    told = lines(actual, expected)
    assert "variant 2, D.ratio: -5.0, expected -4.0" in told
    assert "variant 2, ratio[low]: 6.0, expected 5.0" in told
    told = lines(actual, expected, "--leave-out", "efficiency", "--leave-out", "ratio")
    assert told == ["variant 2, D.ratio: -5.0, expected -4.0"]


def test_a_column_with_many_other_numbers_is_told_in_short() -> None:
    told = lines(sweep("a.csv", "-3:-2:500"), sweep("b.csv", "-4:-3.1:500"))
    assert len(told) == 3 * 21
    assert "D.ratio: 480 more variants differ" in told


def test_a_sweep_is_no_result() -> None:
    said = vstatics("compare", sweep("a.csv"), results("x.csv", "neutral.yaml"))
    assert said.status == 2
    assert "expected two of a kind" in said.err


@pytest.mark.parametrize(
    "data",
    [
        b"variant,status\nx,ok\n",
        b"variant,a\n1\n",
        b"PK\x03\x04 no archive",
        b"PAR1 no table",
        b'{"variant": }',
        b"table,row,gear,value\n",
        b"table,row,gear,value\nW,1\n",
        b"table,row,gear,value\nXX,1,1,1\n",
        b"table,row,gear,value\nW,1,1,x\n",
        b'{"W": [[1]]}\n{"W": ]}\n',
    ],
)
def test_what_is_no_table_is_told_with_its_file(data: bytes) -> None:
    Path("x").write_bytes(data)
    said = vstatics("compare", "x", "x")
    assert said.status == 1
    assert said.err.startswith("x:")
    assert "an error of vstatics" not in said.err
