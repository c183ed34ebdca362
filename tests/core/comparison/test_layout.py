"""What `vstatics compare` tells first: the changes of the case, and the largest that follow."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import pytest

from tests.commands import CASES, NEUTRAL, json_answer, json_file, vstatics

ZF = (CASES / "zf-8hp70.yaml").read_text("utf-8")
TEETH = 86
"""Of the ring of P4, instead of 85."""
HEADLINE = "1 change of the case; 5 of 9 ratios, 4 of 7 steps, 5 of 9 efficiencies differ"


def run(text: str, folder: Path, name: str = "zf.json") -> Path:
    """Write the result of a case into a folder."""
    folder.mkdir(exist_ok=True)
    (folder / "zf-8hp70.yaml").write_text(text, "utf-8")
    assert vstatics("run", folder / "zf-8hp70.yaml", "-o", folder / name, "-q").status == 0
    return folder / name


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """Results of the box with another ring, and of the box as it is."""
    folder = tmp_path_factory.mktemp("compared")
    new = run(ZF.replace("ring: 85", f"ring: {TEETH}"), folder / "new")
    return new, run(ZF, folder / "old")


def told(files: tuple[Path, Path], *options: str) -> list[str]:
    said = vstatics("compare", *files, *options)
    assert said.status == 1
    return said.out.splitlines()


def numbers_in(document: dict[str, Any]) -> Iterator[float | None]:
    """All numbers of the tables of a result."""
    for key, value in document.items():
        if key not in ("case", "rows", "gears", "messages", "conventions"):
            for row in value if isinstance(value, list) else []:
                yield from row if isinstance(row, list) else [row]


def test_the_case_comes_first_then_the_largest_of_each_kind(files: tuple[Path, Path]) -> None:
    lines = told(files)
    assert lines[:3] == [
        f"zf-8hp70: {HEADLINE}",
        "  case        P4.teeth.ring  85 -> 86",
        "  ratio       R              -3.297 -> -3.343    -1.41 %",
    ]
    assert "  step        2-3            1.488 -> 1.498      +0.65 %" in lines
    assert lines[-1] == "  ... 164 more numbers: --all"
    assert len(lines) == 1 + 1 + 5 + 4 + 5 + 1
    assert told(files, "--summary") == lines[:1]
    assert len(told(files, "--all")) == len(lines) - 1 + 164


def test_json_has_every_number_that_differs(files: tuple[Path, Path]) -> None:
    """Gear 1 holds the ring of P4, so its ratio is 1 + ring/sun; steps are quotients of ratios."""
    made = json.loads("\n".join(told(files, "-f", "json")))
    assert [made[key] for key in ("same", "changed", "added", "gone")] == [0, 1, 0, 0]
    [case] = made["cases"]
    assert (case["name"], case["state"]) == ("zf-8hp70", "changed")
    assert case["case"] == [{"path": "P4.teeth.ring", "expected": 85, "actual": TEETH}]
    new, old = (json_file(file) for file in files)
    pairs = zip(numbers_in(new), numbers_in(old), strict=True)
    different = [pair for pair in pairs if pair[0] != pytest.approx(pair[1], rel=1e-9, abs=1e-12)]
    steps = [one for one in case["numbers"] if one["table"] == "step"]
    assert len(case["numbers"]) == len(different) + len(steps)
    tables = [*dict.fromkeys(one["table"] for one in case["numbers"])]
    assert tables[:3] == ["ratio", "step", "efficiency"]
    [first] = [one for one in case["numbers"] if (one["table"], one["gear"]) == ("ratio", "1")]
    ratios = 1 + 85 / 23, 1 + TEETH / 23
    deviation = pytest.approx(ratios[1] / ratios[0] - 1)
    assert [*first.values()] == ["ratio", None, "1", *map(pytest.approx, ratios), deviation]
    for side, document in {"expected": old, "actual": new}.items():
        ratio = dict(zip(document["gears"], document["ratio"], strict=True))
        for step in steps:
            quotient = ratio[step["gear"]] / ratio[str(int(step["gear"]) + 1)]
            assert step[side] == pytest.approx(quotient)


def test_a_case_has_at_most_twenty_lines(files: tuple[Path, Path], tmp_path: Path) -> None:
    other = ZF.replace("efficiency: 0.98", "efficiency: 0.97").replace("ring: 96", "ring: 97")
    assert other.count("0.97") > 2
    lines = told((run(other, tmp_path), files[1]))
    assert len(lines) == 20
    assert {line.split()[0] for line in lines[1:-1]} == {"case", "ratio", "step", "efficiency"}
    assert "more changes" in lines[-1] or "more numbers" in lines[-1]


def test_a_change_without_effect_is_reported_and_no_failure(tmp_path: Path) -> None:
    old = run(NEUTRAL, tmp_path, "old.json")
    new = run(f"{NEUTRAL}inertias: {{1: 0.2}}\n", tmp_path, "new.json")
    said = vstatics("compare", new, old)
    headline = "zf-8hp70: 1 change of the case; no number differs\n"
    assert (said.status, said.out) == (0, f"{headline}  case        1.inertia  not there -> 0.2\n")


def test_no_line_about_a_change_is_wider_than_a_terminal(tmp_path: Path) -> None:
    """A renamed gear set has two long values: the old one under its old name, and the new one."""
    old = run(ZF, tmp_path, "old.json")
    new = run(ZF.replace("P4:", "a gear set with a long name:"), tmp_path, "new.json")
    said = vstatics("compare", new, old).out.splitlines()
    assert max(map(len, said)) <= 80
    assert said[1].startswith('  case        P4  {"kind": "planetary", ')
    assert said[2] == "      -> not there"


# directories


@pytest.fixture
def two(files: tuple[Path, Path], tmp_path: Path) -> tuple[Path, Path]:
    """Two directories: one result is same, one changed, one added, one gone."""
    sides = tmp_path / "new", tmp_path / "old"
    for side, file in zip(sides, files, strict=True):
        (side / "deep").mkdir(parents=True)
        (side / "README.md").write_text(str(side), "utf-8")
        (side / "deep/zf.json").write_bytes(file.read_bytes())
        for name in ("same", f"only-{side.name}"):
            (side / f"{name}.json").write_bytes(files[1].read_bytes())
    return sides


def test_directories_are_compared_file_by_file(two: tuple[Path, Path]) -> None:
    assert [line for line in told(two) if not line.startswith(" ")] == [
        f"deep/zf: {HEADLINE}",
        "only-new: added (no expected result)",
        "only-old: gone (no actual result)",
        "1 same, 1 changed, 1 added, 1 gone",
    ]
    states = [(case["name"], case["state"]) for case in json_answer("compare", *two)["cases"]]
    assert states[:2] == [("deep/zf", "changed"), ("only-new", "added")]
    assert states[2:] == [("only-old", "gone"), ("same", "same")]
    for gone in (two[0] / "only-new.json", two[0] / "deep/zf.json", two[1] / "deep/zf.json"):
        gone.unlink()
    assert vstatics("compare", *two).status == 1
    (two[1] / "only-old.json").unlink()
    said = vstatics("compare", *two)
    assert (said.status, said.out) == (0, "1 same, 0 changed, 0 added, 0 gone\n")


def test_formats_of_results_are_mixed_by_their_stems(two: tuple[Path, Path]) -> None:
    (two[0] / "same.json").unlink()
    run(ZF, two[0], "same.csv")
    assert told(two)[-1] == "1 same, 1 changed, 1 added, 1 gone"


def test_junit_has_a_failure_for_each_that_is_not_the_same(two: tuple[Path, Path]) -> None:
    root = ET.fromstring("\n".join(told(two, "-f", "junit")).encode())  # noqa: S314
    [suite] = root
    assert (root.tag, suite.get("name")) == ("testsuites", "vstatics compare")
    assert [case.get("name") for case in suite] == ["deep/zf", "only-new", "only-old", "same"]
    assert [len(case) for case in suite] == [1, 1, 1, 0]
    changed, added = suite[0][0], suite[1][0]
    assert changed.get("message") == f"deep/zf: {HEADLINE}"
    assert "P4.teeth.ring  85 -> 86" in str(changed.text)
    assert added.get("type") == "added"
    assert added.get("message") == "only-new: added (no expected result)"


def test_markdown_is_a_table(two: tuple[Path, Path]) -> None:
    lines = told(two, "-f", "markdown")
    assert "| case | P4.teeth.ring | 85 | 86 |  |" in lines
    assert "| ratio | R | -3.297 | -3.343 | -1.41 % |" in lines
