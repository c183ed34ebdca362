"""`vstatics compare`: which results are held against which, and what is left out."""

from __future__ import annotations

import json
import xml.etree.ElementTree as ET
from itertools import product
from pathlib import Path

import pytest

import vstatics as library
from tests.commands import CASES, MZKT, NEUTRAL, json_answer, vstatics

FORMS = ("csv", "json", "jsonl", "parquet")
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


def test_results_of_several_cases_are_the_same_in_every_format_and_order() -> None:
    cases = ["neutral.yaml", MZKT, CASES / "simpson-th400.yaml", "tied.yaml"]
    expected = [results(f"expected.{form}", *cases) for form in FORMS]
    actual = [results(f"actual.{form}", *cases) for form in FORMS]
    turned = [results(f"turned.{form}", *reversed(cases)) for form in FORMS]
    for one, other in product([*actual, *turned], expected):
        assert lines(one, other) == [], (one, other)


def test_directories_without_a_result_are_not_the_same(tmp_path: Path) -> None:
    both = [tmp_path / "new", tmp_path / "golden"]
    for one in both:
        one.mkdir()
        (one / "box.yaml").write_text("links: 3", encoding="utf-8")
    for form in ("text", "json"):
        said = vstatics("compare", *both, "-f", form)
        assert (said.status, said.out, "nothing to compare" in said.err) == (1, "", True)


def test_a_result_that_cannot_be_read_is_told_and_counted_in_every_format(tmp_path: Path) -> None:
    new, golden = both = [tmp_path / "new", tmp_path / "golden"]
    for one in both:
        one.mkdir()
        for name in ("neutral", "locked", "open"):
            results(str(one / f"{name}.json"), f"{name}.yaml")
    (new / "locked.json").write_text("{", encoding="utf-8")
    results(str(new / "open.json"), "neutral.yaml")
    (golden / "open.json").write_bytes(b"\xff")
    for form in ("text", "markdown", "text --summary"):
        said = vstatics("compare", *both, "-f", *form.split())
        assert said.status == 1
        assert said.out.endswith("1 same, 0 changed, 0 added, 0 gone, 2 unreadable\n")
        assert "not JSON" in next(one for one in said.out.splitlines() if "locked" in one)
        assert said.err.splitlines()[-1].endswith("differ in 2 places")
    document = json_answer("compare", *both)
    assert (document["same"], document["unreadable"]) == (1, 2)
    states = {one["name"]: (one["state"], len(one.get("errors", ()))) for one in document["cases"]}
    assert states == {
        "locked": ("unreadable", 1),
        "neutral": ("same", 0),
        "open": ("unreadable", 1),
    }
    suite = ET.fromstring(vstatics("compare", *both, "-f", "junit").out)[0]  # noqa: S314 - our own
    assert (suite.get("tests"), suite.get("failures")) == ("3", "2")
    made = library.compare(*both)
    assert (made.same, made.unreadable, made.differs) == (1, 2, True)
    assert [one.id for one in made.cases[0].problems] == ["E110"]


@pytest.mark.parametrize("one", [*FORMS, "lst"])
@pytest.mark.parametrize("other", ["csv", "jsonl"])
def test_cases_of_one_file_name_are_paired_by_their_folders(one: str, other: str) -> None:
    """Whatever is missing, and from wherever they were named."""
    boxes = ["neutral.yaml", "locked.yaml", "open.yaml"]
    for box in boxes:
        folder = Path("boxes", Path(box).stem)
        folder.mkdir(parents=True)
        for name in ("a.yaml", "b.yaml"):
            (folder / name).write_bytes(Path(box).read_bytes())
    expected = results(f"expected.{one}", "boxes/**/*.yaml")
    less = [f"boxes/open/{name}.yaml" for name in "ba"]
    less += [f"{Path.cwd()}/boxes/neutral/{name}.yaml" for name in "ab"]
    assert lines(results(f"actual.{other}", *less, "boxes/locked/b.yaml"), expected) == [
        "locked/a: gone",
        "5 same, 0 changed, 0 added, 1 gone",
    ]


def test_tolerances_that_are_none_are_wrong_use() -> None:
    file = results("x.json", "neutral.yaml")
    for number in ("nan", "inf", "-1"):
        for option in ("--rtol", "--atol"):
            assert vstatics("compare", file, file, option, number).status == 2
        assert vstatics("summary", "neutral.yaml", "--reserve", number).status == 2
        with pytest.raises(ValueError, match="tolerance of compare"):
            library.compare(file, file, rtol=float(number))
    assert "(with a decimal point)" in vstatics("summary", "neutral.yaml", "--reserve", "1,2").err


def test_a_golden_result_of_python_is_that_of_the_command(tmp_path: Path) -> None:
    for case in ("neutral.yaml", MZKT, CASES / "umdm.yaml"):
        said = vstatics("run", case, "-q", "-f", "json")
        assert library.solve(library.load(case)).to_json(str(case)) == said.out
    made = library.solve(library.load("neutral.yaml"))
    (tmp_path / "golden.json").write_text(made.to_json(), encoding="utf-8")
    assert library.compare(made, tmp_path / "golden.json", leave_out="ratio").same == 1


def test_a_listing_of_the_source_has_gears_by_number_and_mechanisms_for_rows() -> None:
    """Of drawn elements it has the mechanisms: their rows are not those of the members."""
    for name, is_drawn in (("umdm.yaml", True), ("mzkt7922.dat", False), ("simpson.yaml", False)):
        case = CASES / name
        said = vstatics("run", case, "-q", "-f", "source")
        Path("source.lst").write_text(said.out, encoding="utf-8")
        for form in ("json", "csv"):
            other = results(f"x.{form}", case, "--unloaded", "published")
            said = vstatics("compare", "source.lst", other)
            assert (said.status, "rows for mechanisms" in said.err) == (is_drawn, is_drawn)


def test_a_deviation_of_rounding_noise_is_none() -> None:
    file = results("x.json", "neutral.yaml")
    document = json.loads(Path(file).read_text("utf-8"))
    for name, gears in (("noise", [1e-16, 1.0]), ("actual", [0.5, 1.1])):
        document["efficiency"] = gears
        Path(f"{name}.json").write_text(json.dumps(document), encoding="utf-8")
    told = {line.split()[1]: line for line in lines("actual.json", "noise.json", "--all")[1:]}
    assert ("%" in told["N"], "+10.00 %" in told["low"]) == (False, True)


def test_a_result_of_another_command_is_named() -> None:
    Path("x.json").write_text(vstatics("summary", "neutral.yaml", "-f", "json").out, "utf-8")
    said = vstatics("compare", "x.json", "x.json")
    assert said.fails("result 1 is a document of vstatics summary; expected a result of")


def test_what_is_no_result_is_told_by_what_it_is() -> None:
    told = {
        "a problem that `vstatics check` reports": vstatics("check", "open.yaml", "-f", "json").out,
        "an explanation of `vstatics check --explain`": vstatics(
            "check", "--explain", "W201", "-f", "json"
        ).out,
        "is a case, not a result": vstatics("convert", "open.yaml", "-", "--to", "json").out,
        "error: the file is a case, not a result": Path("open.yaml").read_text("utf-8"),
        "the file is a case, not a result; create": Path(MZKT).read_text("utf-8"),
        "no table of results": vstatics("run", "open.yaml", "-f", "markdown").out,
        "of check where all is well": "[]",
        "has keys `a`, `b`, `c`, ..., none": '{"a": 1, "b": 2, "c": 3, "d": 4}',
    }
    for words, text in told.items():
        Path("x.json").write_text(text, "utf-8")
        said = vstatics("compare", "x.json", "x.json")
        taken = "expected a result of `vstatics run` (listing, JSON"
        made = "is a case, not a result; create a result with `vstatics run CASE -f json -o"
        assert said.fails(words, made if "is a case" in words else taken)


def test_a_case_that_is_there_again_is_named() -> None:
    """Those of one name go in their order, whatever stands between them."""
    twice = results("a.jsonl", "neutral.yaml", "neutral.yaml", "locked.yaml")
    text = Path(twice).read_text("utf-8").splitlines()
    Path("b.jsonl").write_text("\n".join([text[2], *text[:2]]), "utf-8")
    assert lines("b.jsonl", twice) == []
    Path("c.jsonl").write_text("\n".join([text[2], text[0]]), "utf-8")
    assert lines("b.jsonl", "c.jsonl")[0] == "neutral (there twice): added"


def test_a_directory_that_is_not_there_is_named(tmp_path: Path) -> None:
    for named in ((tmp_path, "goldn"), ("goldn", tmp_path)):
        said = vstatics("compare", *named)
        assert said.is_wrong_use("goldn: no such file or directory")


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
    assert said.is_wrong_use("did you mean `losses`?")
    said = vstatics("compare", file, file, "--leave-out", "losses,ratio")
    assert said.is_wrong_use("give each name separately")


# sweeps


def sweep(output: str, values: str = "-2,-3,-4", case: str = "neutral.yaml") -> str:
    said = vstatics("sweep", case, "--vary", f"D.ratio={values}", "-o", output, "-q")
    assert said.status == 0, said.err
    return output


@pytest.mark.parametrize("one", SWEPT)
@pytest.mark.parametrize("other", SWEPT)
def test_sweeps_are_the_same_in_every_format(one: str, other: str) -> None:
    assert lines(sweep(f"a.{one}"), sweep(f"b.{other}")) == []


def test_variants_that_are_missing_are_counted_and_others_go_by_number() -> None:
    expected = sweep("expected.csv")
    kept = [line for line in Path(expected).read_text("utf-8").splitlines() if line[:2] != "0,"]
    Path("actual.csv").write_text("\n".join([kept[0], *reversed(kept[1:])]) + "\n", "utf-8")
    assert lines("actual.csv", expected) == [
        "actual: 1 variant gone",
        "  variant     0  there -> not there",
    ]


def test_numbers_of_a_sweep_are_told_by_variant_and_column() -> None:
    """The ratio with B engaged is that of the input to the carrier: 1 - u."""
    actual, expected = sweep("a.csv", "-2,-3,-5"), sweep("b.npz")
    told = [line.split("  ") for line in lines(actual, expected)]
    cells = [[cell.strip() for cell in line if cell] for line in told]
    assert ["D.ratio", "variant 2", "-4.000 -> -5.000", "-25.00 %"] in cells
    assert ["ratio[low]", "variant 2", "5.000 -> 6.000", "+20.00 %"] in cells
    out = ("--leave-out", "efficiency", "--leave-out", "ratio")
    assert lines(actual, expected, *out, "--summary") == [
        "a: 1 of 3 variants, 1 of 1 column differ"
    ]


def test_sweeps_are_compared_in_every_format_and_in_directories() -> None:
    for folder, values in (("new", "-2,-3,-5"), ("golden", "-2,-3,-4")):
        Path(folder).mkdir()
        sweep(f"{folder}/a.csv", values)
        results(f"{folder}/b.json", "neutral.yaml")
    sweep("golden/c.npz")
    [case] = json_answer("compare", "new/a.csv", "golden/a.csv")["cases"]
    assert [case["numbers"][0][key] for key in ("table", "row", "gear", "expected", "actual")] == [
        "D.ratio", "variant 2", None, -4.0, -5.0
    ]  # fmt: skip
    for found in (vstatics("compare", "new", "golden").out, library.compare("new", "golden").tally):
        assert "1 same, 1 changed, 0 added, 1 gone" in found
    said = vstatics("compare", "new/a.csv", "golden/a.csv", "-f", "junit")
    assert 'failures="1"' in said.out
    assert f'message="{lines("new/a.csv", "golden/a.csv", "--summary")[0]}"' in said.out
    results("new/a.csv", "neutral.yaml")
    assert "1 unreadable" in vstatics("compare", "new", "golden").out


@pytest.mark.parametrize("broken", [0, 1])
def test_one_file_that_cannot_be_read_fails_in_every_format(broken: int) -> None:
    names = [results(f"{name}.json", "neutral.yaml") for name in ("new", "golden")]
    Path(names[broken]).write_text("{", encoding="utf-8")
    suite = ET.fromstring(vstatics("compare", *names, "-f", "junit").out)[0]  # noqa: S314 - our own
    assert (suite.get("tests"), suite.get("failures")) == ("1", "1")
    document = json_answer("compare", *names)
    assert (document["unreadable"], document["same"]) == (1, 0)
    for form in ("text", "markdown"):
        said = vstatics("compare", *names, "-f", form)
        assert said.fails("the file is not JSON")


def test_mechanisms_of_a_deck_are_not_elements_of_a_drawing_by_their_place() -> None:
    """As many rows of torques, but none of one part: a deck has meshes, YAML members."""
    case = CASES / "ravigneaux-aod.yaml"
    vstatics("convert", case, "box.dat")  # a deck keeps no description
    assert vstatics("convert", "box.dat", "box.yaml").status == 0
    names = results("deck.json", "box.yaml"), results("drawn.json", case)
    document = json_answer("compare", *names)
    torques = [one for one in document["cases"][0]["numbers"] if one["table"] == "torques"]
    assert torques
    assert not [one for one in torques if one["deviation"] is not None]


def test_an_empty_line_of_a_sweep_is_none_and_a_workbook_is_told() -> None:
    name = sweep("a.csv", "-3:-2:3")
    text = Path(name).read_text(encoding="utf-8")
    Path("b.csv").write_text(text.replace("\n", "\n\n", 2), encoding="utf-8")
    assert lines("b.csv", name) == []
    said = vstatics("compare", results("a.xlsx", "neutral.yaml"), name)
    assert said.fails("a workbook; expected a result of `vstatics run`")


def test_of_many_numbers_of_a_sweep_some_of_each_column_are_told() -> None:
    both = sweep("a.csv", "-3:-2:500"), sweep("b.csv", "-4:-3.1:500")
    told = lines(*both)
    assert (len(told), told[-1]) == (20, f"  ... {3 * 500 - 18} more numbers: --all")
    assert len(lines(*both, "--all")) == 1 + 3 * 500


def test_a_sweep_is_no_result() -> None:
    said = vstatics("compare", sweep("a.csv"), results("x.csv", "neutral.yaml"))
    assert said.is_wrong_use("a.csv is a sweep, x.csv is not: expected two sweeps or two results")


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
        b'{"speeds": [[1]]}\n{"speeds": ]}\n',
    ],
)
def test_what_is_no_table_is_told_with_its_file(data: bytes) -> None:
    Path("x").write_bytes(data)
    said = vstatics("compare", "x", "x")
    assert said.status == 1
    assert said.err.startswith("x:")
    assert "an error of vstatics" not in said.err
