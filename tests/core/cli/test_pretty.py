"""`vstatics run --pretty`: whole words in the width that there is, also in a file."""

import re
from pathlib import Path

import pytest
from rich.cells import cell_len

from tests.chance import some
from tests.commands import CASES, MZKT, NEUTRAL, SHIPPED, vstatics

pytestmark = pytest.mark.usefixtures("files")


def shown(monkeypatch: pytest.MonkeyPatch, width: int, *cases: object) -> str:
    monkeypatch.setenv("COLUMNS", str(width))
    assert vstatics("run", "--pretty", *cases, "-o", "out.txt", "-q").status == 0
    return Path("out.txt").read_text("utf-8")


def words(text: str) -> set[str]:
    """Words with a letter; names head columns, or stand in a list of their numbers."""
    text = text.replace("shift elements: ", "")
    return {word.strip(",;") for word in text.split() if re.search(r"[^\W\d]", word)}


@pytest.mark.slow
@pytest.mark.parametrize("case", some(SHIPPED), ids=lambda case: case.name)
def test_words_are_whole_at_every_width(case: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    whole = words(shown(monkeypatch, 500, case))
    for width in (60, 80, 120, 200):
        text = shown(monkeypatch, width, case)
        assert words(text) == whole, width
        assert max(map(cell_len, text.splitlines())) <= width
        assert re.search(r"[ \n]\n\Z|[ \x1b]$", text, re.MULTILINE) is None


def test_columns_can_be_0_and_also_apply_to_dumb_terminals(monkeypatch: pytest.MonkeyPatch) -> None:
    """Sources: github.com/aws/aws-cdk/issues/2253 (width 0), patonlab/GoodVibes/pull/107 (dumb)."""
    case = CASES / "simpson-th400.yaml"
    assert shown(monkeypatch, 0, case) == shown(monkeypatch, 80, case)
    wide = shown(monkeypatch, 200, case)
    monkeypatch.setenv("TERM", "dumb")
    monkeypatch.setenv("FORCE_COLOR", "1")
    said = vstatics("run", "--pretty", case, "-q").out
    assert re.sub(r"\x1b\[[0-9;]*m", "", said) == wide


def test_a_large_width_is_used_for_names_of_elements(monkeypatch: pytest.MonkeyPatch) -> None:
    case = CASES / "simpson-th400.yaml"
    narrow = shown(monkeypatch, 80, case)
    assert "gear  12345  " in narrow
    assert "shift elements: 1 forward clutch, 2 direct clutch," in narrow.split("gear  12345  ")[0]
    wide = shown(monkeypatch, 200, case)
    assert "gear  forward clutch direct clutch intermediate clutch rear band" in wide
    assert "1 forward clutch" not in wide


def test_several_cases_have_their_names_above(monkeypatch: pytest.MonkeyPatch) -> None:
    lines = shown(monkeypatch, 80, MZKT, "neutral.yaml").splitlines()
    heads = [line for line in lines if line.startswith("==> ")]
    assert heads == [f"==> {MZKT} <==", "==> neutral.yaml <=="]
    alone = shown(monkeypatch, 80, MZKT)
    assert ("==>" in alone, "next smaller ratio" in alone) == (False, True)
    # a single gear has no next gear
    Path("one.yaml").write_text(NEUTRAL.replace("N: {}, ", ""), "utf-8")
    assert "next smaller ratio" not in shown(monkeypatch, 80, "one.yaml")


def test_it_is_one_text_and_of_a_case_in_error_nothing() -> None:
    for options in ("-f json", "-o x.json", "-o new/", "-j 2", "--resume"):
        assert vstatics("run", "--pretty", "neutral.yaml", *options.split()).status == 2, options
    assert vstatics("run", "--pretty", "bad.yaml", "-o", "x.txt").status == 1
    assert not Path("x.txt").exists()
