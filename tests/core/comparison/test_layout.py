"""What `vstatics compare` tells first: the changes of the case, and the largest that follow."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import pytest

from tests.commands import CASES, NEUTRAL, json_answer, vstatics

ZF = (CASES / "zf-8hp70.yaml").read_text("utf-8")
TEETH = 86
"""Of the ring of P4, in place of 85."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with results of the box as it is, and with another ring."""
    folder = tmp_path_factory.mktemp("compared")
    for side, text in {"old": ZF, "new": ZF.replace("ring: 85", f"ring: {TEETH}")}.items():
        (folder / side).mkdir()
        case = folder / side / "zf-8hp70.yaml"
        case.write_text(text, "utf-8")
        assert vstatics("run", case, "-o", folder / side / "zf.json", "-q").status == 0
    return folder


def told(folder: Path, *options: str) -> list[str]:
    said = vstatics("compare", folder / "new/zf.json", folder / "old/zf.json", *options)
    assert said.status == 1
    return said.out.splitlines()


def numbers_in(document: dict[str, Any]) -> Iterator[float | None]:
    """All numbers of the tables of a result."""
    for key, value in document.items():
        if key not in ("case", "rows", "gears", "messages", "conventions"):
            rows = value if isinstance(value, list) else []
            for row in rows:
                yield from row if isinstance(row, list) else [row]


def test_the_case_comes_first_then_the_largest_of_each_kind(folder: Path) -> None:
    lines = told(folder)
    assert lines[0] == (
        "zf-8hp70: 1 change of the case; 5 of 9 ratios, 4 of 7 steps, 5 of 9 efficiencies differ"
    )
    assert lines[1] == "  case        P4.teeth.ring  85 -> 86"
    assert lines[2] == "  ratio       R              -3.297 -> -3.343    -1.41 %"
    assert "  step        2-3            1.488 -> 1.498      +0.65 %" in lines
    assert lines[-1] == "  ... 164 more numbers: --all"
    assert len(lines) == 1 + 1 + 5 + 4 + 5 + 1
    assert told(folder, "--summary") == lines[:1]
    assert len(told(folder, "--all")) == len(lines) - 1 + 164


def test_json_has_every_number_that_differs(folder: Path) -> None:
    """Gear 1 holds the ring of P4, so its ratio is 1 + ring/sun; steps are quotients of ratios."""
    made = json.loads("\n".join(told(folder, "-f", "json")))
    assert [made[key] for key in ("same", "changed", "added", "gone")] == [0, 1, 0, 0]
    [case] = made["cases"]
    assert (case["name"], case["state"]) == ("zf-8hp70", "changed")
    assert case["case"] == [{"path": "P4.teeth.ring", "expected": 85, "actual": TEETH}]
    new, old = (json.loads((folder / side / "zf.json").read_text()) for side in ("new", "old"))
    pairs = zip(numbers_in(new), numbers_in(old), strict=True)
    different = [pair for pair in pairs if pair[0] != pytest.approx(pair[1], rel=1e-9, abs=1e-12)]
    steps = [one for one in case["numbers"] if one["table"] == "step"]
    assert len(case["numbers"]) == len(different) + len(steps)
    assert list(dict.fromkeys(one["table"] for one in case["numbers"]))[:3] == [
        "ratio", "step", "efficiency",
    ]  # fmt: skip
    [first] = [one for one in case["numbers"] if (one["table"], one["gear"]) == ("ratio", "1")]
    assert first["row"] is None
    ratios = 1 + 85 / 23, 1 + TEETH / 23
    assert (first["expected"], first["actual"]) == pytest.approx(ratios)
    assert first["deviation"] == pytest.approx(ratios[1] / ratios[0] - 1)
    forward = {
        side: dict(zip(document["gears"], document["ratio"], strict=True))
        for side, document in {"expected": old, "actual": new}.items()
    }
    for step in steps:
        for side, ratio in forward.items():
            following = str(int(step["gear"]) + 1)
            assert step[side] == pytest.approx(ratio[step["gear"]] / ratio[following])


def test_no_more_than_twenty_lines_are_told_of_a_case(folder: Path, tmp_path: Path) -> None:
    other = ZF.replace("efficiency: 0.98", "efficiency: 0.97").replace("ring: 96", "ring: 97")
    assert other.count("0.97") > 2
    (tmp_path / "zf-8hp70.yaml").write_text(other, "utf-8")
    vstatics("run", tmp_path / "zf-8hp70.yaml", "-o", tmp_path / "x.json", "-q")
    lines = vstatics("compare", tmp_path / "x.json", folder / "old/zf.json").out.splitlines()
    assert len(lines) == 20
    kinds = {line.split()[0] for line in lines[1:-1]}
    assert kinds == {"case", "ratio", "step", "efficiency"}
    assert "more changes" in lines[-1] or "more numbers" in lines[-1]


def test_a_change_without_effect_is_told_and_no_failure(tmp_path: Path) -> None:
    for name, text in {"a": NEUTRAL, "b": NEUTRAL + "inertias: {1: 0.2}\n"}.items():
        (tmp_path / "x.yaml").write_text(text, "utf-8")
        vstatics("run", tmp_path / "x.yaml", "-o", tmp_path / f"{name}.json", "-q")
    said = vstatics("compare", tmp_path / "b.json", tmp_path / "a.json")
    assert (said.status, said.out) == (
        0,
        "x: 1 change of the case; no number differs\n  case        1.inertia  null -> 0.2\n",
    )


# directories


@pytest.fixture
def two(folder: Path, tmp_path: Path) -> tuple[Path, Path]:
    """Two directories: one result is same, one changed, one added, one gone."""
    sides = tmp_path / "new", tmp_path / "old"
    for side in sides:
        (side / "deep").mkdir(parents=True)
        (side / "README.md").write_text(str(side), "utf-8")
        result = (folder / side.name / "zf.json").read_bytes()
        (side / "deep/zf.json").write_bytes(result)
        for name in ("same", f"only-{side.name}"):
            (side / f"{name}.json").write_bytes((folder / "old/zf.json").read_bytes())
    return sides


def test_directories_are_compared_file_by_file(two: tuple[Path, Path]) -> None:
    said = vstatics("compare", *two)
    lines = said.out.splitlines()
    assert said.status == 1
    assert [line for line in lines if not line.startswith(" ")] == [
        "deep/zf: 1 change of the case; 5 of 9 ratios, 4 of 7 steps, 5 of 9 efficiencies differ",
        "only-new: added",
        "only-old: gone",
        "1 same, 1 changed, 1 added, 1 gone",
    ]
    (two[0] / "only-new.json").unlink()
    (two[0] / "deep/zf.json").unlink()
    (two[1] / "deep/zf.json").unlink()
    assert vstatics("compare", *two).status == 1
    (two[1] / "only-old.json").unlink()
    said = vstatics("compare", *two)
    assert (said.status, said.out) == (0, "1 same, 0 changed, 0 added, 0 gone\n")
    (two[0] / "same.json").write_text("{", "utf-8")
    said = vstatics("compare", *two)
    assert said.fails("the file is not JSON")


def test_formats_of_results_are_mixed_by_their_stems(two: tuple[Path, Path]) -> None:
    case = two[0] / "same.yaml"
    case.write_text(ZF, "utf-8")
    (two[0] / "same.json").unlink()
    vstatics("run", case, "-o", two[0] / "same.csv", "-q")
    assert "1 same, 1 changed, 1 added, 1 gone" in vstatics("compare", *two).out


def test_junit_has_a_failure_for_each_that_is_not_the_same(two: tuple[Path, Path]) -> None:
    root = ET.fromstring(vstatics("compare", *two, "-f", "junit").out.encode())  # noqa: S314
    assert root.tag == "testsuites"
    [suite] = root
    assert suite.get("name") == "vstatics compare"
    failures = {one.get("name"): one.find("failure") for one in suite.iter("testcase")}
    assert list(failures) == ["deep/zf", "only-new", "only-old", "same"]
    assert failures["same"] is None
    changed, added = failures["deep/zf"], failures["only-new"]
    assert changed is not None
    assert added is not None
    assert str(changed.get("message")).startswith("deep/zf: 1 change of the case; 5 of 9 ratios")
    assert "P4.teeth.ring  85 -> 86" in str(changed.text)
    assert (added.get("type"), added.get("message")) == ("added", "only-new: added")


def test_json_tells_every_case(two: tuple[Path, Path]) -> None:
    made = json_answer("compare", *two)
    states = {one["name"]: one["state"] for one in made["cases"]}
    assert states == {
        "deep/zf": "changed", "only-new": "added", "only-old": "gone", "same": "same",
    }  # fmt: skip


def test_markdown_is_a_table(two: tuple[Path, Path]) -> None:
    lines = vstatics("compare", *two, "-f", "markdown").out.splitlines()
    assert "| case | P4.teeth.ring | 85 | 86 |  |" in lines
    assert "| ratio | R | -3.297 | -3.343 | -1.41 % |" in lines


def test_a_file_and_a_directory_are_wrong_use(two: tuple[Path, Path]) -> None:
    assert vstatics("compare", two[0], two[1] / "same.json").status == 2
