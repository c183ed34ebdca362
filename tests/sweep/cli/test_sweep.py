"""`vstatics sweep`: its options, its exit status, what it says and where."""

import csv
import json
import re
from pathlib import Path

import openpyxl
import pytest

from tests.commands import CASES, MZKT, process, shell, vstatics
from tests.processes import names
from tests.sweep.sweeps import CASE_TEXT, small_pieces
from vstatics import load
from vstatics.sweep.output import Output

VARY = ("--vary", "D.ratio=-4:-2:5")
COLUMNS = "variant,D.ratio,status,ratio[direct],ratio[low]"


@pytest.fixture(autouse=True)
def _case(folder: Path) -> None:
    (folder / "box.yaml").write_text(CASE_TEXT, "utf-8")


def test_a_grid_on_stdout() -> None:
    """The low gear has the ratio 1 - u."""
    said = vstatics("sweep", "box.yaml", *VARY, "--out", "ratio")
    rows = [f"{n},{u:g},ok,1,{1 - u:g}" for n, u in enumerate((-4, -3.5, -3, -2.5, -2))]
    assert (said.status, said.out.splitlines()) == (0, [COLUMNS, *rows])
    assert re.fullmatch(
        r"<stdout>: 5 rows of 5 variants; [\d.e-]+ s, [\d,]+ variants? a second\n", said.err
    )


def test_values_in_pairs_a_table_and_a_sample() -> None:
    pairs = ("--zip", "--vary", "D.ratio=-4,-2", "--vary", "D.efficiency=.9,1")
    said = vstatics("sweep", "box.yaml", *pairs, "--out", "ratio[low]")
    assert said.out.splitlines()[1:] == ["0,-4,0.9,ok,5", "1,-2,1,ok,3"]
    Path("own.csv").write_text("D.efficiency,D.ratio\n.9,-4\n1,-2\n", "utf-8")
    said = vstatics("sweep", "box.yaml", "--variants", "own.csv", "--out", "ratio[low]")
    head = "variant,D.efficiency,D.ratio,status,ratio[low]"
    assert said.out.splitlines() == [head, "0,0.9,-4,ok,5", "1,1,-2,ok,3"]
    sample = ("--vary", "D.ratio=-4:-2", "--sample", "9", "--method", "random", "--seed")
    one, same, other = (vstatics("sweep", "box.yaml", *sample, seed).out for seed in (1, 1, 2))
    assert one == same
    assert one != other
    assert all(-4 <= float(row.split(",")[1]) <= -2 for row in one.splitlines()[1:])


def test_a_condition_and_the_best() -> None:
    """The efficiency (1 - u eta)/(1 - u) of the low gear grows as u goes to 0."""
    said = vstatics("sweep", "box.yaml", *VARY, "--out", "ratio", "--where", "ratio[low] < 4.2")
    assert [row.split(",")[0] for row in said.out.splitlines()[1:]] == ["2", "3", "4"]
    assert said.err.startswith("<stdout>: 3 rows of 5 variants;")
    best = ("--max", "efficiency[low]", "--best", 2, "-f", "jsonl")
    said = vstatics("sweep", "box.yaml", *VARY, *best)
    assert [json.loads(line)["variant"] for line in said.out.splitlines()] == [4, 3]


def test_variants_without_a_solution_are_rows_and_are_counted() -> None:
    said = vstatics("sweep", "box.yaml", "--vary", "D.ratio=0,1,-2", "--out", "ratio[low]")
    assert said.out.splitlines()[1:] == ["0,0,invalid,", "1,1,tied up,", "2,-2,ok,3"]
    assert "3 rows of 3 variants (1 tied up, 1 invalid);" in said.err
    assert said.status == 0
    said = vstatics("sweep", "box.yaml", "--vary", "D.ratio=0,1")
    assert said.status == 1
    assert said.err.endswith(
        "no variant has a solution in every gear that is asked for\n"
        "D.ratio: read 0 in variant 0, expected a finite ratio other than 0\n"
    )
    locked = CASES / "self-locking.yaml"
    name = load(locked).mechanisms[0].name
    said = vstatics("sweep", locked, "--vary", f"{name}.efficiency=.5,1")
    assert said.status == 0
    assert "(1 locked)" in said.err


def test_a_gear_that_nobody_asks_for_takes_no_part_in_the_status() -> None:
    """A gear that is tied up at any ratio stands beside one of (u - 1)/u, told by name or step."""
    Path("tied.yaml").write_text(
        "links: [s, r, c]\noutput: c\nshift_elements: {B: [r, housing], L: [s, r]}\n"
        "mechanisms: {P: {first: s, second: r, third: c, ratio: -2}}\n"
        "gears: {low: [B], lock: [L], X: [B, L]}\n"
    )
    for out, status in {
        "ratio[low]": "ok",
        "ratio[low]/ratio[lock]": "ok",
        "P.ratio*ratio[X]": "tied up",
        "ratio[low],ratio[X]": "tied up",
        "ratio[low],spread": "tied up",
        "ratio": "tied up",
    }.items():
        ran = vstatics("sweep", "tied.yaml", "--vary", "P.ratio=-2,-4", "--out", out)
        rows = [row.split(",") for row in ran.out.splitlines()[1:]]
        assert [row[2] for row in rows] == [status] * 2, out
        assert ran.status == ("no variant has a solution" in ran.err) == (status != "ok")
        if out != "P.ratio*ratio[X]":
            assert [float(row[3]) for row in rows] == [3, 5]
    ran = vstatics("sweep", "tied.yaml", "--vary", "P.ratio=-2", "--where", "ratio[low] > 2")
    assert ran.out.count("tied up") == 1  # without --out all gears are asked for


ANY_STATUS = """
links: [first, second, carrier, drum]
shift_elements:
  A: [first, housing]
  B: [second, housing]
  C: [second, drum]
  F: {kind: freewheel, links: [housing, drum]}
mechanisms: {P: {first: first, second: second, third: carrier, ratio: 1.004, efficiency: 0.98}}
gears:
  regular: {engaged: [A], input: carrier, output: second}
"""


@pytest.mark.parametrize(
    ("status", "gear"),
    [
        ("ok", "[]"),
        ("locked", "[A], input: second, output: carrier"),
        ("tied up", "[A, B], input: carrier, output: second"),
        ("conflict", "[A, C], input: carrier, output: second"),
    ],
)
def test_a_gear_has_one_status_in_all_outputs(status: str, gear: str) -> None:
    """Two rings that differ by one tooth lock the carrier if the ring drives (`self-locking`)."""
    Path("box.yaml").write_text(f"{ANY_STATUS}  G: {{engaged: {gear}}}\n")
    fails = status in ("tied up", "conflict")
    state = vstatics("summary", "box.yaml", "-f", "json").json["gears"][1]["state"]
    assert state == status.replace("ok", "open")
    assert vstatics("run", "box.yaml").status == fails
    for options in (["--out", "ratio[G]"], ["--by", "gear", "--out", "ratio"]):
        call = "sweep", "box.yaml", "--vary", "P.efficiency=.979,.98", *options
        table = vstatics(*call)
        assert table.status == fails
        rows = [*csv.DictReader(table.out.splitlines())]
        lines = map(json.loads, vstatics(*call, "-f", "jsonl").out.splitlines())
        for row in (*rows, *lines):
            assert row["status"] == ("ok" if row.get("gear") == "regular" else status)


@pytest.mark.parametrize("form", ["csv", "jsonl", "npz", "parquet"])
def test_the_format_is_chosen_by_the_suffix_or_by_name(form: str, folder: Path) -> None:
    pytest.importorskip("pyarrow")
    assert vstatics("sweep", "box.yaml", *VARY, "-o", f"out.{form}").status == 0
    assert vstatics("sweep", "box.yaml", *VARY, "-o", "out", "-f", form).status == 0
    one, other = (Path(name).read_bytes() for name in (f"out.{form}", "out"))
    assert one == other
    assert names(folder) == ["box.yaml", "out", f"out.{form}"]
    starts = {"csv": b"variant,", "jsonl": b'{"variant', "npz": b"PK\3\4", "parquet": b"PAR1"}
    assert one.startswith(starts[form])


def test_few_rows_go_to_tables_that_people_read(folder: Path) -> None:
    """In Markdown with the digits of CSV, in a workbook as numbers; not more than 100,000."""
    for suffix in ("csv", "md", "tex", "xlsx"):
        said = vstatics("sweep", "box.yaml", *VARY, "-o", f"out.{suffix}")
        assert said.status == 0, said.err
    rows = list(csv.reader((folder / "out.csv").read_text("utf-8").splitlines()))
    lines = (folder / "out.md").read_text("utf-8").replace("\\", "").splitlines()
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines[4:]]
    assert cells == rows[1:]
    told = (folder / "out.tex").read_text("utf-8")
    tables = told.count(r"\begin{tabular}")  # which go on beside the variants' numbers
    assert told.count("\\\\\n") == len(rows) * tables
    assert sum(line.count(" & ") for line in told.splitlines()) == (len(rows[0]) - 1) * len(rows)
    head, *body = openpyxl.load_workbook("out.xlsx")["Variants"].iter_rows(values_only=True)
    assert list(head) == rows[0]
    numbers = [[float(cell) for cell in row if cell != "ok"] for row in rows[1:]]
    assert [[cell for cell in row if cell != "ok"] for row in body] == [
        pytest.approx(row) for row in numbers
    ]
    said = vstatics("sweep", "box.yaml", "--vary", "D.ratio=-3:-2:100001", "-o", "many.xlsx")
    assert said.is_wrong_use("xlsx is for 100000 rows at most, not for 100001: expected another")
    assert not Path("many.xlsx").exists()


def test_rounding_makes_no_variant_the_best() -> None:
    """The direct gear has the ratio 1 whatever D1 is, in some variants with an error of 2e-16."""
    best = ("--max", "ratio[4]", "--best", 3, "--out", "ratio[4]")
    said = vstatics("sweep", MZKT, "--vary", "D1.ratio=-.9:-.5:90", *best)
    assert [row.split(",")[0] for row in said.out.splitlines()] == ["variant", "0", "1", "2"]


def test_an_output_is_replaced_also_by_resume_as_it_may_be_of_another_sweep() -> None:
    asked = ("sweep", "box.yaml", *VARY, "-o", "out.csv")
    assert vstatics(*asked, "--resume").err.startswith("out.csv: 5 rows of 5 variants;")
    whole = Path("out.csv").read_text("utf-8")
    for more in ((), ("--resume",)):
        Path("out.csv").write_text("old", "utf-8")
        said = vstatics(*asked, *more)
        assert (said.status, Path("out.csv").read_text("utf-8")) == (0, whole)
    first, _ = said.err.splitlines()
    assert first == "out.csv may be of another sweep: every variant is calculated again"


def test_a_sweep_that_failed_goes_on_with_its_pieces(monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    small_pieces(monkeypatch)
    asked = ("sweep", "box.yaml", "--vary", "D.ratio=-4:-2:20", "-o", "out.csv")
    with monkeypatch.context() as patch:
        patch.setattr(Output, "assemble", full)
        assert vstatics(*asked).fails("out.csv: error: cannot be written: No space left")
    said = vstatics(*asked, "--resume")
    assert said.status == 0
    assert said.err.startswith("out.csv: 20 rows of 20 variants, 20 of them before;")


def test_a_dry_run_says_how_much_and_writes_nothing(folder: Path) -> None:
    """A row of NPZ: 8 bytes for the number, for D.ratio and for four columns, 1 for the status."""
    for options, told in {
        ":1000000 -o out.csv": "variants  1000000\nrows      1000000\n",
        ":1000 --where ratio[low]>4": "rows      about 500\n",
        ":1000 --max ratio[low]": "rows      the best, at most 20\n",
        ":1000000000 -o o.npz": "size      about 49 GB\n",
        ":9": "columns   7: variant, D.ratio, status, ratio[direct], ",
    }.items():
        said = vstatics("sweep", "box.yaml", "--dry-run", *f"--vary D.ratio=-4:-2{options}".split())
        assert said.is_without_messages()
        assert told in said.out
        assert re.search(r"\ntime      about (a second|[\d.]+ (s|minutes|hours))\n$", said.out)
        assert names(folder) == ["box.yaml"]


def test_wrong_use_is_2_and_says_how() -> None:
    for arguments in (
        *("", "box.yaml", "--vary D.ratio=1", "box.yaml --vary D.ratio=1:2 --sample 0"),
        "box.yaml --variants own.csv --vary D.ratio=1",
        "box.yaml --variants own.csv --sample 3",
        "box.yaml --variants own.csv --zip",
        "box.yaml --vary D.ratio=1:2 --zip --sample 3",
    ):
        assert vstatics("sweep", *arguments.split()).is_wrong_use("\nError: "), arguments
    for option in (
        *("--seed 3", "--method lhs", "--best 3", "--max ratio[low] --best 0", "--resume"),
        *("-o out.xls", "-o out", "-f npz", "-o - -f parquet", "-o out.csv --jobs 0"),
        "--jobs 2 --scheduler tcp://127.0.0.1:1",
    ):
        said = vstatics("sweep", "box.yaml", "--vary", "D.ratio=1", *option.split())
        assert said.is_wrong_use("\nError: "), option
        assert (".csv .jsonl .ndjson .npz .parquet" in said.err) == (
            option in {"-o out.xls", "-o out"}
        )


def test_what_is_wrong_is_1_and_is_reported_with_its_place() -> None:
    Path("folder.csv").mkdir()
    for arguments, words in {
        "D.ratoi=1": "--vary:1:3: error: read `ratoi`",
        "D.ratio=1 --where ratio[lwo]>1": "--where:1:7: error: there is no gear `lwo`",
        "D.ratio=1 --out efficiencey": "--out:1:1: error: there is no table `efficiencey`",
        "D.ratio=1 --min ratio": "--min:1:1: error: `ratio` has one value per gear",
        "D.ratio=1:2": "--vary:1:1: error: D.ratio=1:2 needs the number of values",
        "D.ratio=1 --file nowhere.yaml": "nowhere.yaml: error: cannot be read",
        "D.ratio=1 -o nowhere/out.csv": "cannot be written: there is no directory nowhere",
        "D.ratio=1 -o folder.csv": "folder.csv: error: cannot be written: Is a directory",
    }.items():
        said = vstatics("sweep", "box.yaml", "--vary", *arguments.split())
        assert said.gives_nothing(words), arguments
        assert not [name for name in names(Path()) if name.endswith(".parts")]


def test_a_missing_package_is_reported_before_anything_is_calculated(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    import importlib.util

    find = importlib.util.find_spec
    for package, arguments, extra in (
        ("pyarrow", "-o out.parquet", "parquet"),
        ("distributed", "--scheduler tcp://127.0.0.1:1", "dask"),
        ("scipy", "--sample 9", "sample"),
    ):
        missing = {package}
        monkeypatch.setattr(
            importlib.util,
            "find_spec",
            lambda name, missing=missing: None if name in missing else find(name),
        )
        said = vstatics("sweep", "box.yaml", "--vary", "D.ratio=-4:-2", *arguments.split())
        assert said.gives_nothing(f'needs the package {package}: pip install ".[{extra}]"')


@pytest.mark.parametrize("jobs", [2, 1])
def test_a_reader_that_has_seen_enough_ends_the_sweep_quietly(jobs: int) -> None:
    line = f"vstatics sweep {MZKT} --vary D1.ratio=-.9:-.7:66000 --jobs {jobs} | head -n 2"
    status, out, err = shell(line)
    assert (status, out.count(b"\n")) == (1, 2)
    # a busy machine takes more than 5 s, after which the progress is shown
    assert all(b" after " in progress for progress in err.splitlines()), err


def test_rows_go_to_what_is_no_file(folder: Path) -> None:
    status, out, err = process("sweep", "box.yaml", *VARY, "-o", "/dev/stdout", cwd=folder)
    assert (status, out.count(b"\n")) == (0, 6)
    assert err.startswith(b"/dev/stdout: 5 rows")
    if Path("/dev/full").exists():
        full = b"<stdout>: error: cannot be written: No space left on device [E030]\n"
        assert shell(f"vstatics sweep {MZKT} --vary D1.ratio=-.9 > /dev/full") == (1, b"", full)


@pytest.mark.parametrize("where", ["/dev/stdout", "/dev/fd/1"])
def test_rows_stand_where_the_file_behind_a_stream_is(where: str) -> None:
    line = f"cd '{Path.cwd()}'; (echo a; vstatics sweep box.yaml --vary D.ratio=-4 -o {where}; echo end) > all.txt"
    assert shell(line)[0] == 0
    first, head, row, last = Path("all.txt").read_text("utf-8").splitlines()
    assert (first, last) == ("a", "end")
    assert head.startswith("variant,")
    assert row.startswith("0,-4,ok")


def test_headings_stay_as_they_are_where_that_is_asked_for(tmp_path: Path) -> None:
    said = ("sweep", MZKT, "--vary", "D1.ratio=-3:-2:2", "--out", "-ratio[1]")
    heads = []
    for option in ((), ("--raw",)):
        assert vstatics(*said, *option, "-o", tmp_path / "out.csv").status == 0
        written = (tmp_path / "out.csv").read_text("utf-8")
        assert vstatics(*said, *option).out == written
        heads.append(written.splitlines()[0])
    assert heads == ["variant,D1.ratio,status,'-ratio[1]", "variant,D1.ratio,status,-ratio[1]"]


def test_a_file_that_a_sweep_file_names_is_reported_at_its_place() -> None:
    for text, said in {
        "vary: [D.ratio=-3]\n\ncase: nowhere.yaml\n": "3:7: error: nowhere.yaml cannot be read",
        'case: "a\\0b"\n': r"1:7: error: read 'a\x00b', expected the name of a file",
        'variants: "a\\0b"\n': r"1:11: error: read 'a\x00b', expected the name of a file",
        'output: "a\\0b"\n': r"1:9: error: read 'a\x00b', expected the name of a file",
    }.items():
        Path("w.yaml").write_text(text, "utf-8")
        assert vstatics("sweep", "--file", "w.yaml").gives_nothing(f"w.yaml:{said}")


@pytest.mark.parametrize("output", ["", "-o out.csv", "-o out.npz --max ratio[low]", "-j 2"])
def test_a_sweep_without_rows_tells_what_each_condition_removed(output: str, folder: Path) -> None:
    """The ratio of the set is 1 - p: 3 to 5 for p from -2 to -4 by quarters."""
    asked = ("sweep", "box.yaml", "--vary", "D.ratio=-4:-2:9", *output.split())
    where = ("--where", "ratio[low] > 3.9 and D.ratio > -3 and 1")
    said = vstatics(*asked, *where)
    assert said.status == 0
    assert said.err.splitlines()[1:] == [
        "`ratio[low] > 3.9` removed 4 of 9",
        "`D.ratio > -3` removed 5 of 5",
        "`1` removed 0 of 0",
    ]
    if "out.csv" in output:
        assert (folder / "out.csv").read_text("utf-8").startswith("variant,D.ratio,status,")
    said = vstatics(*asked, "--min", "sqrt(2 - ratio[low])")
    assert "no variant has a value for `sqrt(2 - ratio[low])`" in said.err
    assert vstatics(*asked, *where, "--fail-empty").status == 3
    assert vstatics(*asked, "--fail-empty").status == 0
