"""Documents of found boxes as input of commands."""

import json
import re
from pathlib import Path

import pytest

from tests.commands import CASES, json_answer, json_file, vstatics
from tests.synthesis.boxes.listed_boxes import many, simpson


@pytest.fixture
def boxes(tmp_path: Path) -> Path:
    path = tmp_path / "boxes.json"
    path.write_text(json.dumps(many(4)))
    return path


def test_plot_and_report(tmp_path: Path, boxes: Path) -> None:
    boxes.write_text(json.dumps(simpson()))
    plot = ("plot", boxes, "--kind", "boxes", "--dark", "-o", tmp_path / "boxes.png")
    assert vstatics(*plot).is_silent()
    assert vstatics("report", boxes, "-o", tmp_path / "boxes.html").is_silent()
    assert (tmp_path / "boxes.png").read_bytes().startswith(b"\x89PNG")
    assert "<h1>1 found box</h1>" in (tmp_path / "boxes.html").read_text()


def test_a_box_that_was_edited_without_its_case_is_reported(tmp_path: Path, boxes: Path) -> None:
    document = simpson()
    document["boxes"][0]["ratios"]["P1"] = -2.2
    boxes.write_text(json.dumps(document))
    for command in ("plot --kind boxes -o boxes.svg", "report -o boxes.html", "summary"):
        said = vstatics(*command.replace("boxes.", f"{tmp_path}/boxes.").split(), boxes)
        assert said.status == 0
        message = "box 1: the ratio of set P1 is -2.2, but -2.08571429 in its `case`"
        assert said.err == f"{boxes}: warning: {message}\n"
    assert vstatics("summary", boxes, "--strict").status == 1
    assert vstatics("summary", boxes, "--allow", "W806").err == ""


def test_summaries_stand_side_by_side(boxes: Path) -> None:
    said = vstatics("summary", boxes, "--gearbox", "1,4")
    assert said.status == 0
    assert re.search(r"^B: .*boxes\.json box 4 \(box ", said.out, re.MULTILINE)
    assert re.search(r"^1 +2\.479 +2\.479 +1\.676 +1\.676 ", said.out, re.MULTILINE)
    assert re.search(r"^of them between two links +2 +2$", said.out, re.MULTILINE)
    assert len(json_answer("summary", boxes)) == 4
    tables = vstatics("summary", boxes).out.partition("Gears")[2]
    assert max(map(len, tables.splitlines())) <= 80
    assert tables.count("mean forward efficiency") == 2  # two boxes beside two others


def test_wrong_use(boxes: Path) -> None:
    for options, said in (
        (("summary", "BOXES", "--gearbox", "5"), "read 5, but the boxes have the numbers 1 to 4"),
        (("summary", "BOXES", "--gearbox", "x"), "read 'x', expected numbers of boxes"),
        (
            ("summary", CASES / "simpson.yaml", "--gearbox", "1"),
            "--gearbox: expected one file of found",
        ),
        (("plot", "BOXES", "--kind", "boxes", "--gear", "1", "-o", "x.svg"), "--gear: found boxes"),
        (("report", "BOXES", "-o", "x/"), "found boxes give one page: expected -o FILE, not x/"),
        (("plot", "BOXES", "BOXES", "--kind", "boxes", "-o", "x/"), "expected one document"),
    ):
        answer = vstatics(*(boxes if one == "BOXES" else one for one in options))
        assert answer.is_wrong_use(said)


def test_other_commands_tell_what_it_is(tmp_path: Path, boxes: Path) -> None:
    for command in ("run", "check", "plot --kind plan -o x.svg", "synth fit --ratios 1=2"):
        answer = vstatics(*command.split(), boxes)
        assert answer.fails("these are found boxes, expected a case; plot --kind boxes, report and")
    plot = ("plot", "--kind", "boxes", "-o", str(tmp_path / "a.svg"))
    assert vstatics(*plot, CASES / "simpson.yaml").fails("not valid JSON")
    document = json_file(boxes)
    case = document["boxes"][0]["case"]
    case["gears"]["1"]["engaged"] = list(case["shift_elements"])
    boxes.write_text(json.dumps(document))
    said = vstatics("summary", boxes, "--gearbox", "1")
    assert said.fails("boxes.json box 1: error: gear 1: tied up: ")
    boxes.write_text('{"searched": 5, "found": 0, "families": 0, "boxes": []}')
    for told in (plot, ("report", "-o", str(tmp_path / "a.html")), ("summary",)):
        assert vstatics(*told, boxes).fails("no gearbox was found")
