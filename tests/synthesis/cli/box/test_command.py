"""`vstatics synth box` as it is called; the search itself is stood in for, and tested by room.

A simple set with the sun as input and the carrier as output has 1 + p with the ring held, and 1
with two members clutched, whichever they are.
"""

import csv
import importlib.util
import json
import math
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from tests.commands import Said, environment, json_answer, json_file, vstatics
from tests.processes import names
from tests.synthesis.boxes.states import prepare_boxes
from vstatics import load, solve
from vstatics.core.cli.schemas import schemas
from vstatics.synthesis.boxes.batches import work
from vstatics.synthesis.boxes.batches.found import FoundPiece
from vstatics.synthesis.boxes.box import HELD, BoxSearch, FoundBox
from vstatics.synthesis.cli.box import command
from vstatics.synthesis.cli.box.output import RECORD
from vstatics.synthesis.structures.scheme import SetScheme

ASKED = ("--sets", 1, "--shift-elements", 2, "--engaged", 1, "--ratios", "3,1", "-j", 1)
PIECES = 6
LEAST = [("T-L2", "F-L0-L2"), ("T-L2", "F-L1-L2"), ("T-L2", "F-L0-L1")]


def one(clutch: tuple[int, int], p: float = 2.0) -> FoundBox:
    scheme, error = SetScheme.of_code("0-1-2"), math.log((1 + p) / 3)
    return FoundBox(scheme, None, 0, 1, ((2, HELD), clutch), (-p,), ((0,), (1,)), max(error, 1e-9))


CHECK = Draft202012Validator(schemas()["box"]).validate
TABLES = ["boxes.csv", "boxes.html", "boxes.json", "boxes.txt"]
BOXES = {0: one((0, 1), 2.01), 2: one((1, 2)), 3: one((0, 2)), 5: one((1, 2))}
"""By the piece that has it; one is found twice. That with another p loses p/(1 + p) more."""


class Searched:
    """In place of the search: which pieces were searched; at one of them a signal comes."""

    def __init__(self) -> None:
        self.pieces: list[int] = []
        self.stop_at: int | None = None
        self.given_up = 0

    def found_in(self, search: BoxSearch, piece: int, count: int) -> FoundPiece:
        """As `found_in` of the pieces."""
        assert count == PIECES
        if piece == self.stop_at:
            signal.raise_signal(signal.SIGINT)
        self.pieces.append(piece)
        has = piece in BOXES and search.tolerance > BOXES[piece].error
        return FoundPiece(100, (BOXES[piece],) if has else (), self.given_up)


@pytest.fixture(autouse=True)
def searched(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Searched:
    """A search of six pieces, in a folder of its own; nothing is drawn."""
    monkeypatch.chdir(tmp_path)
    made = Searched()
    prepare_boxes(monkeypatch, PIECES)
    monkeypatch.setattr(work, "found_in", made.found_in)
    return made


def boxes(*options: object) -> list[dict[str, Any]]:
    """The boxes that a search tells, all of them as the schema says."""
    said = vstatics("synth", "box", *ASKED, *options, "-f", "json")
    assert said.is_without_messages()
    document = said.json
    CHECK(document)
    assert (document["searched"], document["found"]) == (600, len(document["boxes"]))
    found: list[dict[str, Any]] = document["boxes"]
    return found


def refused(*options: object) -> str:
    said = vstatics("synth", "box", *options)
    assert said.is_wrong_use()
    return said.err.split("Error: ")[1].rstrip()


def test_boxes_are_listed_once_and_in_order_whichever_piece_has_them() -> None:
    found = boxes()
    assert [tuple(box["elements"]) for box in found] == LEAST
    assert [(box["family"], box["core"]) for box in found] == [(1, 1), (1, 1), (2, 2)]
    gears = {name: (own["engaged"], own["ratio"]) for name, own in found[0]["gears"].items()}
    assert gears == {"1": (["T-L2"], 3.0), "2": (["F-L0-L2"], 1.0)}
    assert boxes("-j", 2) == found
    assert vstatics("synth", "box", *ASKED, "-o", "found.jsonl").status == 0
    lines = [json.loads(line) for line in Path("found.jsonl").read_text("utf-8").splitlines()]
    assert lines == found
    CHECK(lines[0])
    assert names(Path.cwd()) == ["found.jsonl"]
    said = vstatics("synth", "box", *ASKED)
    assert said.is_without_messages()
    assert said.out.startswith("1 set, 2 shift elements, 1 of them engaged in each gear\n\nBoxes\n")
    assert "\nPareto list\n" in said.out
    assert "\nFamilies\n" in said.out


def test_boxes_stand_by_a_figure_that_is_asked_for() -> None:
    """The slips of the clutches that lock a set are 1, 1/3 and 2/3 of its input with p = 2."""
    found = boxes("--sort", "slip,drag", "--weights", "2=3")
    slips = [(box["slip"], box["drag"]) for box in found]
    assert slips == sorted(slips)
    drags = [found[0]["gears"][name]["drag"] for name in ("1", "2")]
    assert found[0]["drag"] == pytest.approx((drags[0] + 3 * drags[1]) / 4)
    best = boxes("--pareto", "slip")
    assert [box["pareto"] for box in best] == [box["slip"] == slips[0][0] for box in best]


def test_a_table_has_gears_in_columns() -> None:
    vstatics("synth", "box", *ASKED, "-o", "found", "-q")
    with Path("found/boxes.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    listed = json_file(Path("found/boxes.json"))["boxes"]
    for row, box in zip(rows, listed, strict=True):
        assert row["known"] == (box["known"] or "")
        for name, gear in box["gears"].items():
            assert float(row[f"ratio {name}"]) == gear["ratio"]
            assert row[f"engaged {name}"].split() == gear["engaged"]
            assert float(row[f"drag {name}"]) == gear["drag"]
            for figure in ("torques", "slips", "carriers", "planets", "losses"):
                pairs = (one.split("=") for one in row[f"{figure} {name}"].split())
                expected = {key: pytest.approx(own, rel=1e-5) for key, own in gear[figure].items()}
                assert {key: float(value) for key, value in pairs} == expected


def test_filters() -> None:
    """The brake carries p = 2 or 2.01 times the input torque."""
    for options, count in {
        "--brakes 1": 3,
        "--brakes 0,1 --clutches 1": 3,
        "--limit torque=2.005,loss=1/100": 2,
        "--limit error=.001 --limit torque=3": 2,
        "--single --planar": 3,
    }.items():
        assert len(boxes(*options.split())) == count


def test_where_none_is_found_the_status_tells() -> None:
    near = "the nearest has 1: 3, 2: 1: --tolerance 1.01e-09 finds it"
    for options, told in {
        "--tolerance 1e-300": f"none of 600 is within 1e-300 of these ratios; {near}",
        "--tolerance 1e-300,1=.0001 --brakes 1": "none of 600 is within these ranges",
        "--brakes 0": "4 boxes with these ratios, none as wanted",
        "--limit torque=1.9": "4 boxes with these ratios, none as wanted",
    }.items():
        said = vstatics("synth", "box", *ASKED, *options.split(), "-f", "json", "-q")
        assert (said.status, said.json["boxes"]) == (1, [])
        assert said.err == f"no gearbox is found: {told}\n"


@pytest.mark.parametrize("given_up", [0, 2])
def test_a_list_tells_whether_it_is_complete(searched: Searched, given_up: int) -> None:
    searched.given_up = given_up
    for options, status in [((), 0), (("--complete",), int(given_up > 0))]:
        said = vstatics("synth", "box", *ASKED, *options, "-f", "json")
        document = said.json
        assert (said.status, len(document["boxes"])) == (status, 3)
        told = document["complete"], document["given_up"]
        assert told == (not given_up, PIECES * given_up)
        assert ("could not be searched" in said.err) == (given_up > 0)


def test_a_dry_run_says_how_many(monkeypatch: pytest.MonkeyPatch) -> None:
    """Six choices of ports, two of four elements; 1 + p = 3 and one of three ways to lock it.

    A step of 3 is also that from 1 to 1/(1 + p).
    """
    dry = ("synth", "box", "--dry-run", *ASKED)
    said = vstatics(*dry)
    assert (said.status, said.out) == (0, "boxes  36\nfound  3\ntime   about a second\n")
    document = json_answer(*dry)
    CHECK(document)
    assert 0 < document.pop("seconds") < 10
    assert 0 <= document.pop("compile_seconds") < 10
    assert document == {"searched": 36, "found": 3, "exact": True, "at_least": False}
    steps = (*dry[:-4], "--gears", 2, "--step-ratios", "2.9:3.1")
    assert json_answer(*steps)["found"] == 3 + 3
    said = vstatics(*dry, "-o", "found")
    assert "files  3 cases, 3 diagrams, in about a second\n" in said.out
    assert not Path("found").exists()
    monkeypatch.setattr(command, "LOADING_SECONDS", -1.0)
    said = vstatics(*dry)
    assert "compiled  now, in a second, and " in said.out


def test_a_directory_has_all_boxes_as_cases() -> None:
    said = vstatics("synth", "box", *ASKED, "-o", "found")
    assert said.status == 0
    assert said.err.startswith("found: 3 boxes in 2 families of 600 that were looked at; ")
    each = [f"box-000{number}.{suffix}" for number in (1, 2, 3) for suffix in ("svg", "yaml")]
    assert names(Path("found")) == [RECORD, *each, *TABLES]
    assert names(Path.cwd()) == ["found"]
    for number, clutch in enumerate(LEAST, 1):
        case = load(f"found/box-000{number}.yaml")
        assert tuple(element.name for element in case.shift_elements) == clutch
        assert solve(case).ratio.tolist() == pytest.approx([3.0, 1.0], rel=0.004)
    assert Path("found/boxes.txt").read_text("utf-8") == said.out
    Path("found/letter.txt").write_text("dear", "utf-8")
    less = ("--limit", "error=.001", "-f", "json", "-q")
    said = vstatics("synth", "box", *ASKED, *less, "-o", "found/")
    assert said.is_without_messages()
    assert said.json == json_file(Path("found/boxes.json"))
    assert names(Path("found")) == [RECORD, *each[:4], *TABLES, "letter.txt"]


def test_files_that_no_search_wrote_are_not_lost() -> None:
    """Cases that are edited, also where the next search goes on; cases and links of others."""
    assert vstatics("synth", "box", *ASKED, "-o", "found", "-q").status == 0
    edited = Path("found/box-0002.yaml")
    edited.write_text(f"# mine\n{edited.read_text('utf-8')}", "utf-8")
    for more in ((), ("--resume",), ("--limit", "error=.001"), ("--dry-run",)):
        told = refused(*ASKED, "-o", "found/", *more)
        assert "found/box-0002.yaml is not as a search wrote it, so it may be yours" in told
    assert edited.read_text("utf-8").startswith("# mine")
    mine = edited.rename("found/box-0999.yaml")
    assert "box-0999.yaml is not as a search wrote it" in refused(*ASKED, "-o", "found/")
    mine = mine.rename("mine.yaml")
    for name in ("box-0001.yaml", "boxes.csv", "boxes.html"):
        Path("found", name).unlink()
        Path("found", name).symlink_to(mine.absolute())
    assert vstatics("synth", "box", *ASKED, "-o", "found", "-q").status == 0
    assert len(names(Path("found"))) == 3 * 2 + 4 + 1
    assert not any(path.is_symlink() for path in Path("found").iterdir())
    Path("link").symlink_to("found")
    Path("link.json").symlink_to(mine)
    for output in ("link.json", "link", "link/"):
        told = refused(*ASKED, "-o", output)
        assert f"{output} is a link: expected a directory or a file" in told
    assert mine.read_text("utf-8").startswith("# mine")


def test_where_there_are_many_the_first_are_drawn(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("vstatics.synthesis.cli.box.output.MOST_DRAWN_CASES", 2)
    said = vstatics("synth", "box", *ASKED, "-o", "found")
    assert said.err.startswith("found: 2 of 3 boxes have a diagram: those of the Pareto list, ")
    written = [name for name in names(Path("found")) if name.startswith("box-")]
    assert [name[7:] for name in written] == ["1.svg", "1.yaml", "2.yaml", "3.svg", "3.yaml"]


def stopped(searched: Searched, output: str) -> Said:
    searched.stop_at = 3
    said = vstatics("synth", "box", *ASKED, "-o", output, "-q")
    searched.stop_at = None
    return said


@pytest.mark.parametrize("output", ["found.json", "found"])
def test_a_search_that_is_stopped_goes_on(searched: Searched, output: str) -> None:
    said = stopped(searched, output)
    kept = "stopped; 3 of 6 pieces of the search are finished and kept in"
    assert said.status == 130
    assert said.err == f"{kept} {output}.parts; the same command with --resume goes on\n"
    assert names(Path.cwd()) == [f"{output}.parts"]
    searched.pieces.clear()
    more = ("--limit", "error=.001", "--efficiency", ".95")
    said = vstatics("synth", "box", *ASKED, *more, "-o", output, "-q", "--resume")
    assert said.is_without_messages()
    assert searched.pieces == [3, 4, 5]
    assert names(Path.cwd()) == [output]
    document = Path(output if output.endswith("json") else "found/boxes.json")
    found = json_file(document)
    assert (found["searched"], len(found["boxes"])) == (600, 2)


SEQUENCE = "--gears 2 --spread 2:4 --step-ratios 1.2:4"


@pytest.mark.parametrize(
    "asked", [SEQUENCE, "--ratios 3:3.5,1 --planar --single --brakes 1 --bounds 1.5:3"]
)
def test_any_search_that_is_stopped_goes_on(searched: Searched, asked: str) -> None:
    """What is searched for is compared with its description in JSON, which has no tuples."""
    searched.stop_at = 3
    command = ("synth", "box", *ASKED[:6], *asked.split(), "-o", "found.json", "-q", "-j", 1)
    assert vstatics(*command).status == 130
    searched.stop_at = None
    searched.pieces.clear()
    assert "another search" not in vstatics(*command, "--resume").err
    assert searched.pieces == [3, 4, 5]


def test_pieces_that_are_not_asked_for_are_not_lost(searched: Searched) -> None:
    stopped(searched, "found")
    for options, told in {
        "": "holds 3 of 6 finished pieces of this search, which was stopped; continue with --re",
        "--resume --tolerance 0.02": "of another search: tolerance changed; repeat that",
        "--resume --bounds 2:3": "of another search: bounds changed",
    }.items():
        said = vstatics("synth", "box", *ASKED, *options.split(), "-o", "found")
        assert said.gives_nothing(told)
        assert len(names(Path("found.parts"))) == 5  # three pieces, the lock, what is searched


def test_a_search_without_a_file_tells_how_far_it_came(
    searched: Searched, monkeypatch: pytest.MonkeyPatch
) -> None:
    searched.stop_at = 4
    said = vstatics("synth", "box", *ASKED)
    assert (said.status, said.out) == (130, "")
    assert said.err == "stopped after 4 of 6 pieces of the search\n"
    searched.stop_at = None
    monkeypatch.setattr(work, "MOST_FOUND_BOXES", 3)
    said = vstatics("synth", "box", *ASKED)
    assert said.gives_nothing("more than 3 gearboxes are found: expected a smaller --tolerance")


def test_what_cannot_be_asked_for_is_wrong_use() -> None:
    for options, told in (
        (("--ratios", "a"), "--ratios: read `a`, expected a number"),
        (("--ratios", ""), "--ratios: read ``, expected"),
        (("--ratios", "2:-3"), "--ratios: read `2:-3`, expected two different ratios of one sign"),
        (("--shift-elements", 10**30), f"--shift-elements: read {10**30}, expected 1,"),
        (("--bounds", "2"), "--bounds: read 2:2, expected two numbers above 1"),
        (("--bounds", "a:b"), "--bounds: read `a:b`, expected LOW:HIGH, such as 1.4:5"),
        (("--bounds", "1,6:4"), "or one number (with a decimal point)"),
        (("--bounds", "2:3,4:5"), "--bounds: read `2:3,4:5`, expected LOW:HIGH"),
        (("--tolerance", "nan"), "--tolerance: read `nan`, expected a number"),
        (("--tolerance", ".7"), "--tolerance: read `.7`, expected a number above 0, up to 0.5"),
        (("--tolerance", ".1,.2"), "--tolerance: read `.2`, expected one number, and GEAR=T"),
        (("--tolerance", "R=.1"), "read `R`, but there is no such gear; expected 1 or"),
        (("--efficiency", 0), "--efficiency: read 0, expected a number above 0, up to 1"),
        (("--double-pinion", 2), "--double-pinion: read 2, expected 0 to 1"),
        (("--brakes", 3), "--brakes: read `3`, expected a number from 0 to 2"),
        (("--brakes", 2, "--clutches", 1), "--clutches: read 1, but with 2 brakes these are not 2"),
        (("--limit", "torq=3"), "--limit: read `torq`, but there is no such figure; did you mean"),
        (("--limit", "torque"), "--limit: read 'torque', expected FIGURE=X"),
        (("--limit", "torque=3", "--limit", "torque=4"), "--limit: torque is given twice"),
        (("--sort", "los"), "--sort: read `los`, but there is no such figure; did you mean `loss`"),
        (("--pareto", "loss,x"), "--pareto: read `x`, but there is no such figure; expected error"),
        (("--weights", "R=2"), "--weights: read `R`, but the gears of the mean are 1 and 2"),
        (("--weights", "1=-2"), "--weights: 1: read -2, expected a number, 0 or above"),
        (("--gears", "x"), "expected how many, such as 6:8"),
        (("--gears", "1"), "--gears: read 1:1, expected numbers from 2 to 24"),
        (("--gears", "7"), "--gears: read 9 gears, but 2 elements with 1 engaged give 2 gears"),
        (("--gears", "3", "--step-ratios", "1.8:1.2"), "--step-ratios: read 1.8:1.2, expected two"),
        (("--falling",), "describe --gears"),
        (("--free", "elements=1"), "--free applies to the case of --keep"),
        (("--resume",), "--resume needs the output of the stopped search"),
        (("-j", 2, "--scheduler", "tcp://h:1"), "--jobs and --scheduler exclude one another"),
        (("-o", "found.abc"), "found.abc: no format has this suffix here"),
        (("-o", "letter/"), "letter/ is a file: expected a directory"),
        (("-o", ""), "-o names nothing: expected a directory or a file"),
    ):
        Path("letter").write_text("dear", "utf-8")
        assert told in refused(*ASKED, *options)
        assert names(Path.cwd()) == ["letter"]


@pytest.mark.parametrize(
    ("package", "options"),
    [("networkx", ()), ("networkx", ("-o", "f/")), ("distributed", ("--scheduler", "tcp://h:1"))],
)
def test_packages_that_are_missing_are_reported_first(
    package: str, options: tuple[object, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    hide(package, monkeypatch)
    said = vstatics("synth", "box", *ASKED, *options)
    assert said.gives_nothing(f"needs the package {package}: pip install")


def hide(package: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let a package be missing for whoever looks whether it is installed."""
    find = importlib.util.find_spec
    monkeypatch.setattr(
        importlib.util, "find_spec", lambda name: None if name == package else find(name)
    )


def test_without_a_compiler_a_search_finds_the_same_and_says_so() -> None:
    """Three of 36 boxes, as an example of `found_in` derives; plain functions search for them."""
    hidden = "import sys; sys.modules['numba'] = None; from vstatics.core.cli import entry; entry()"

    def said(*options: str) -> str:
        words = [sys.executable, "-c", hidden, "synth", "box", *map(str, ASKED), *options]
        both = {"stderr": subprocess.STDOUT, "env": environment(), "text": True}
        return str(subprocess.check_output(words, **both))  # type: ignore[call-overload]

    text = said()
    assert "warning: without the package numba" in text
    counts = [line.split() for line in text.splitlines() if line[:6] in ("search", "found ")]
    assert counts == [["searched", "36"], ["found", "3"]]
    assert "not: without the package numba" in said("--dry-run")


def test_without_the_extra_for_pictures_a_directory_has_all_but_the_pictures(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    vstatics("synth", "box", *ASKED, "-o", "drawn/")
    hide("matplotlib", monkeypatch)
    said = vstatics("synth", "box", *ASKED, "-o", "plain/")
    assert (said.status, said.err.count("warning")) == (0, 1)
    assert 'a diagram needs the package matplotlib: pip install ".[plot]"' in said.err
    drawn, plain = ({one.name: one for one in Path(name).iterdir()} for name in ("drawn", "plain"))
    assert {name for name in drawn if not name.endswith(".svg")} == plain.keys()
    for name in plain.keys() - {"boxes.html", ".vstatics-boxes"}:
        assert plain[name].read_bytes() == drawn[name].read_bytes(), name
    assert ".svg" not in plain["boxes.html"].read_text("utf-8")
