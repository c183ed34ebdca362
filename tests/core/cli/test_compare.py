"""`vstatics compare`: which results are compared with which, and what cannot be compared."""

import xml.etree.ElementTree as ET
from itertools import product
from pathlib import Path

import pytest

import vstatics as library
from tests.commands import CASES, MZKT, NEUTRAL, json_answer, vstatics

FORMS = ("csv", "json", "jsonl", "parquet")
pytestmark = pytest.mark.usefixtures("files")


def results(output: str, *cases: object, raw: bool = False) -> str:
    assert vstatics("run", *cases, "-o", output, "-q", *["--raw"] * raw).status <= 1
    return output


def lines(actual: str, expected: str, *options: str) -> list[str]:
    said = vstatics("compare", actual, expected, *options)
    assert said.status == bool(said.out), said.err
    return said.out.splitlines()


@pytest.mark.parametrize("form", ["text", "markdown", "text --summary"])
def test_unreadable_results_of_directories_are_counted(form: str) -> None:
    for folder, name in product(("new", "golden"), ("neutral", "locked", "open")):
        Path(folder).mkdir(exist_ok=True)
        results(f"{folder}/{name}.json", f"{name}.yaml")
    Path("new/locked.json").write_text("{", "utf-8")
    Path("golden/open.json").write_bytes(b"\xff")
    said = vstatics("compare", "new", "golden", "-f", *form.split())
    assert said.fails("differ in 2 places")
    assert said.out.endswith("1 same, 0 changed, 0 added, 0 gone, 2 unreadable\n")
    assert "not JSON" in next(line for line in said.out.splitlines() if "locked" in line)
    document = json_answer("compare", "new", "golden")
    assert (document["same"], document["unreadable"]) == (1, 2)
    states = [(case["state"], len(case.get("errors", ()))) for case in document["cases"]]
    assert states == [("unreadable", 1), ("same", 0), ("unreadable", 1)]
    suite = ET.fromstring(vstatics("compare", "new", "golden", "-f", "junit").out)[0]  # noqa: S314
    assert (suite.get("tests"), suite.get("failures")) == ("3", "2")
    verdict = library.compare("new", "golden")
    assert (verdict.same, verdict.unreadable, verdict.differs) == (1, 2, True)
    assert [problem.id for problem in verdict.cases[0].problems] == ["E110"]


@pytest.mark.parametrize("form", [*FORMS, "lst"])
def test_cases_of_one_file_name_are_paired_by_their_folders(form: str) -> None:
    """In any order, and from wherever they were named."""
    for box in ("neutral", "locked", "open"):
        folder = Path("boxes", box)
        folder.mkdir(parents=True)
        for name in ("a.yaml", "b.yaml"):
            (folder / name).write_bytes(Path(f"{box}.yaml").read_bytes())
    expected = results(f"expected.{form}", "boxes/**/*.yaml")
    less = ["boxes/open/b.yaml", "boxes/open/a.yaml", "boxes/locked/b.yaml"]
    less += [f"{Path.cwd()}/boxes/neutral/{name}.yaml" for name in "ab"]
    told = ["locked/a: gone (no actual result)", "5 same, 0 changed, 0 added, 1 gone"]
    assert lines(results("actual.csv", *less), expected) == told


def test_a_case_that_is_there_again_is_named() -> None:
    """Results of one name are paired in their order, whatever stands between them."""
    twice = results("a.jsonl", "neutral.yaml", "neutral.yaml", "locked.yaml")
    text = Path(twice).read_text("utf-8").splitlines()
    Path("b.jsonl").write_text("\n".join([text[2], *text[:2]]), "utf-8")
    assert lines("b.jsonl", twice) == []
    Path("c.jsonl").write_text("\n".join([text[2], text[0]]), "utf-8")
    assert lines("b.jsonl", "c.jsonl")[0] == "neutral (there twice): added (no expected result)"


def test_cases_of_one_stem_are_named_with_their_suffixes() -> None:
    assert vstatics("convert", "neutral.yaml", "neutral.dat").status == 0
    both = results("both.jsonl", "neutral.yaml", "neutral.dat")
    told = lines(results("other.jsonl", "neutral.yaml", "locked.yaml"), both)
    assert told[0] == "neutral.dat: gone (no actual result)"
    assert told[1:] == ["locked: added (no expected result)", "1 same, 0 changed, 1 added, 1 gone"]


def test_wrong_use_is_named(tmp_path: Path) -> None:
    file = results("x.csv", "neutral.yaml")
    calls = {
        (tmp_path, "goldn"): "goldn: no such file or directory",
        ("goldn", tmp_path): "goldn: no such file or directory",
        (tmp_path, file): "one is a directory, the other is not",
        (file, file, "--leave-out", "losess"): "did you mean `losses`?",
        (file, file, "--leave-out", "losses,ratio"): "give each name separately",
        (file, file, "--all", "--summary"): "--all and --summary exclude each other",
        (file, file, "--all", "-f", "json"): "json has all numbers",
        (sweep("a.csv"), file): "a.csv is a sweep, x.csv is not: expected two sweeps or two",
    }
    for option, number in product(("--rtol", "--atol"), ("nan", "inf", "-1")):
        calls[file, file, option, number] = "0 or more"
        assert vstatics("summary", "neutral.yaml", "--reserve", number).status == 2
        with pytest.raises(ValueError, match="tolerance of compare"):
            library.compare(file, file, rtol=float(number))
    for call, words in calls.items():
        assert vstatics("compare", *call).is_wrong_use(words), call
    assert "(with a decimal point)" in vstatics("summary", "neutral.yaml", "--reserve", "1,2").err
    for side in ("new", "old"):
        Path(side).mkdir()
        Path(side, "box.yaml").touch()
    assert vstatics("compare", "new", "old", "-f", "json").gives_nothing("nothing to compare")


NO_TABLE = "is not a table of numbers"
NO_RESULTS = {
    "words only": "the file contains no table of results",
    "{": "x:1:2: error: the file is not JSON: ",
    "[" * 200_000: "nested too deeply",
    "{\n<<<<<<< HEAD\n}": "x:2:1: error: the file has an unresolved merge conflict",
    "[]": "an empty array, as `check -f json` writes",
    '["x"]': "result 1 is not a JSON object",
    "{}": "result 1 has none of the tables distribution_matrix",
    '{"a": 1, "b": 2, "c": 3, "d": 4}': "has keys `a`, `b`, `c`, ..., none",
    '{"efficiency": {"1": 1}}': NO_TABLE,
    '{"efficiency": "0.9"}': NO_TABLE,
    '{"efficiency": ["0.9"]}': NO_TABLE,
    '{"speeds": [3]}': NO_TABLE,
    f'{{"efficiency": [1{"0" * 400}]}}': NO_TABLE,
    f'{{"efficiency": [1{"0" * 5000}]}}': "the JSON cannot be read",
    '{"efficiency": [1e999]}': NO_TABLE,
    '{"speeds": [[1]]}\n{"speeds": ]}\n': "x:2:12: error: the file is not JSON: ",
    "\x00\x01\x02": "x:1:1: error: the file is binary",
    "variant,status\nx,ok\n": "error: not a table of variants: ",
    "variant,a\n1\n": "x:2:1: error: not a table of variants: read 1 cells, expected 2",
    "PK\x03\x04 no archive": "error: not a table of variants: ",
    "PAR1 no table": "error: not a table of variants: ",
    '{"variant": }': "x:1:1: error: not a table of variants: ",
    "table,row,gear,value\n": "the file contains no result",
    "table,row,gear,value\nW,1\n": "x:2:1: error: no row of a result in CSV",
    "table,row,gear,value\nXX,1,1,1\n": "x:2:1: error: no row of a result in CSV",
    "table,row,gear,value\nW,1,1,x\n": "x:2:1: error: read 'x', expected a finite number",
}


def test_what_is_no_result_is_an_error_at_its_file() -> None:
    good = results("good.json", MZKT)
    for text, words in NO_RESULTS.items():
        Path("x").write_text(text, "utf-8")
        for files in (("x", good), (good, "x")):
            said = vstatics("compare", *files)
            assert said.gives_nothing(words), (text[:40], said)
            assert said.err.startswith("x:")


def test_documents_that_are_no_results_are_named_by_what_they_are() -> None:
    case = "is a case, not a result; create a result with `vstatics run CASE -f json -o"
    for words, call in {
        "a problem that `vstatics check` reports": "check open.yaml -f json",
        "an explanation of `vstatics check --explain`": "check --explain W201 -f json",
        "result 1 is a document of vstatics summary": "summary neutral.yaml -f json",
        "no table of results": "run open.yaml -f markdown",
        case: "convert open.yaml - --to json",
    }.items():
        Path("x.json").write_text(vstatics(*call.split()).out, "utf-8")
        said = vstatics("compare", "x.json", "x.json")
        assert said.fails(words, "" if words == case else "expected a result of"), call
    for name in ("open.yaml", MZKT):
        assert vstatics("compare", name, name).fails(f"error: the file {case}")
    book = results("a.xlsx", "neutral.yaml")
    assert vstatics("compare", book, book).fails("a workbook; expected a result of `vstatics run`")


def test_a_golden_result_of_python_is_that_of_the_command(tmp_path: Path) -> None:
    said = vstatics("run", "neutral.yaml", "-q", "-f", "json")
    made = library.solve(library.load("neutral.yaml"))
    assert made.to_json("neutral.yaml") == said.out
    (tmp_path / "golden.json").write_text(made.to_json(), "utf-8")
    assert library.compare(made, tmp_path / "golden.json", leave_out="ratio").same == 1


def test_a_listing_of_the_source_has_gears_by_number_and_mechanisms_for_rows() -> None:
    """Of drawn elements it has the mechanisms: their rows are not those of the members."""
    for name, is_drawn in (("umdm.yaml", True), ("mzkt7922.dat", False), ("simpson.yaml", False)):
        case = CASES / name
        said = vstatics("run", case, "-q", "-f", "source")
        Path("source.lst").write_text(said.out, "utf-8")
        for form in ("json", "csv"):
            other = results(f"x.{form}", case, "--unloaded", "published")
            said = vstatics("compare", "source.lst", other)
            assert (said.status, "rows for mechanisms" in said.err) == (is_drawn, is_drawn)


@pytest.mark.parametrize("form", ["csv", "json"])
def test_a_gear_that_is_missing_is_one_line_and_the_others_are_compared_by_name(form: str) -> None:
    """The other gear has the same state and name: `low`."""
    expected = results(f"expected.{form}", "neutral.yaml")
    gears = NEUTRAL.replace("{N: {}, low: {engaged: [B]}}", "{low: {engaged: [B]}, P: [C]}")
    Path("neutral.yaml").write_text(gears, "utf-8")
    told = lines(results(f"actual.{form}", "neutral.yaml"), expected)
    assert "ratios" not in told[0]
    gone = [line.split()[1] for line in told[1:] if line.startswith("  case")]
    assert sorted(gone) == ["gears.N", "gears.P"]


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


def test_a_table_is_left_out_by_name_or_alias() -> None:
    expected = results("expected.csv", "neutral.yaml")
    Path("neutral.yaml").write_text(NEUTRAL.replace("0.96", "0.95"), "utf-8")
    actual = results("actual.csv", "neutral.yaml")
    found = {line.split()[0] for line in lines(actual, expected, "--all")[1:]}
    others = [one for table in found - {"efficiency"} for one in ("--leave-out", table)]
    left = lines(actual, expected, "--all", *others)[1:]
    assert {line.split()[0] for line in left} == {"efficiency"}
    for name in ("efficiency", "ETA"):
        assert lines(actual, expected, *others, "--leave-out", name) == []


def test_mechanisms_of_a_deck_are_not_elements_of_a_drawing_by_their_place() -> None:
    """As many rows of torques, but no common part: a deck has meshes, YAML members."""
    case = CASES / "ravigneaux-aod.yaml"
    vstatics("convert", case, "box.dat")  # a deck keeps no description
    assert vstatics("convert", "box.dat", "box.yaml").status == 0
    both = results("deck.json", "box.yaml"), results("drawn.json", case)
    numbers = json_answer("compare", *both)["cases"][0]["numbers"]
    assert {row["deviation"] for row in numbers if row["table"] == "torques"} == {None}


def sweep(output: str, values: str = "-2,-3,-4") -> str:
    said = vstatics("sweep", "neutral.yaml", "--vary", f"D.ratio={values}", "-o", output, "-q")
    assert said.status == 0, said.err
    return output


def test_sweeps_are_the_same_in_every_format_and_order() -> None:
    expected = sweep("b.csv")
    for form in ("csv", "jsonl", "npz", "parquet"):
        assert lines(sweep(f"a.{form}"), expected) == []
    text = Path("a.csv").read_text("utf-8")  # empty lines are no variants
    Path("a.csv").write_text(text.replace("\n", "\n\n", 2), "utf-8")
    assert lines("a.csv", expected) == []
    # variants are compared by number
    expected = sweep("expected.csv")
    heading, _, *others = Path(expected).read_text("utf-8").splitlines()
    Path("actual.csv").write_text("\n".join([heading, *reversed(others)]) + "\n", "utf-8")
    gone = ["actual: 1 variant gone", "  variant     0  there -> not there"]
    assert lines("actual.csv", expected) == gone


def test_numbers_of_a_sweep_are_named_by_variant_and_column() -> None:
    """The ratio with B engaged is that of the input to the carrier: 1 - u."""
    actual, expected = sweep("a.csv", "-2,-3,-5"), sweep("b.npz")
    told = [line.split("  ") for line in lines(actual, expected)]
    cells = [[cell.strip() for cell in line if cell] for line in told]
    assert ["D.ratio", "variant 2", "-4.000 -> -5.000", "-25.00 %"] in cells
    assert ["ratio[low]", "variant 2", "5.000 -> 6.000", "+20.00 %"] in cells
    out = ("--leave-out", "efficiency", "--leave-out", "ratio")
    summary = ["a: 1 of 3 variants, 1 of 1 column differ"]
    assert lines(actual, expected, *out, "--summary") == summary


def test_sweeps_are_compared_in_every_format_and_in_directories() -> None:
    for folder, values in (("new", "-2,-3,-5"), ("golden", "-2,-3,-4")):
        Path(folder).mkdir()
        sweep(f"{folder}/a.csv", values)
        results(f"{folder}/b.json", "neutral.yaml")
    sweep("golden/c.npz")
    both = "new/a.csv", "golden/a.csv"
    number = json_answer("compare", *both)["cases"][0]["numbers"][0]
    assert [*number.values()] == ["D.ratio", "variant 2", None, -4.0, -5.0, -0.25]
    for found in (vstatics("compare", "new", "golden").out, library.compare("new", "golden").tally):
        assert "1 same, 1 changed, 0 added, 1 gone" in found
    said = vstatics("compare", *both, "-f", "junit").out
    assert f'message="{lines(*both, "--summary")[0]}"' in said
    results("new/a.csv", "neutral.yaml")
    assert "1 unreadable" in vstatics("compare", "new", "golden").out


def test_of_many_numbers_of_a_sweep_some_of_each_column_are_named() -> None:
    both = sweep("a.csv", "-3:-2:500"), sweep("b.csv", "-4:-3.1:500")
    told = lines(*both)
    assert (len(told), told[-1]) == (20, f"  ... {3 * 500 - 18} more numbers: --all")
    assert len(lines(*both, "--all")) == 1 + 3 * 500
