"""The listing in the words of its source; the text of that is `tests/published/mzkt7922.lst`."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from tests.commands import CASES, MZKT, NEUTRAL, SHIPPED, vstatics

PRINTED = Path(__file__).parents[1] / "published" / "mzkt7922.lst"
MISPRINTS = {
    "here: 4 other numbers differ",
    "  WSAT        D1, 5  1.086 -> 1.806   +66.30 %",
    "  WSAT        D1, 6  1.086 -> 1.806   +66.30 %",
    "  AMLGP       T4, 1  4.182 -> -4.182  -200.00 %",
    "  IX          D1, 6  -1.000 -> 1.000  +200.00 %",
}
"""The four cells that are wrong in print; `mzkt7922.json` there says why."""
AS_TEXT = {"1.806 1.806": "1.086 1.086", "-4.182 -2": "4.182 -2", "-1 1 -1 1 1": "-1 1 -1 1 -1"}
"""The same, as texts."""


def source_listing(*arguments: object, stdin: str = "") -> str:
    said = vstatics("run", "--lang", "source", *arguments, stdin=stdin.encode())
    assert (said.status, said.err) == (0, "")
    return said.out


def with_single_blanks(text: str) -> list[str]:
    """The lines that say anything."""
    return [" ".join(line.split()) for line in text.splitlines() if line.strip()]


@pytest.mark.parametrize("name", ["mzkt7922.dat", "mzkt7922.yaml"])
def test_every_line_is_the_printed_one_but_for_four_cells(name: str) -> None:
    text = "\n".join(with_single_blanks(source_listing(CASES / name)))
    for right, misprint in AS_TEXT.items():
        assert text.count(right) == 1
        text = text.replace(right, misprint)
    assert text.splitlines() == with_single_blanks(PRINTED.read_text(encoding="utf-8"))[1:]


def test_compare_finds_the_four_cells(tmp_path: Path) -> None:
    (tmp_path / "here.lst").write_text(source_listing(MZKT), encoding="utf-8")
    said = vstatics("compare", tmp_path / "here.lst", PRINTED)
    assert (said.status, set(said.out.splitlines())) == (1, MISPRINTS)


def test_fields_are_f8_3_and_i3() -> None:
    """As Fortran writes them: a number ends at each eighth, each third column."""
    lines = source_listing(MZKT).splitlines()
    speeds = lines.index("(W(I,J),J=1,NP),I=1,KJG:")
    assert lines[speeds + 5] == "    .000    .000    .556   1.000    .000   -.625"
    assert lines[-3:] == ["  1 -1  1 -1  1  1", *["  1  1  1  1  1  1"] * 2]


def test_one_listing_is_the_next_deck() -> None:
    first = source_listing(MZKT)
    assert source_listing("-", stdin=first) == first


def test_own_tables_follow_the_last_row() -> None:
    alone, more = source_listing(MZKT), source_listing(MZKT, "--own-tables")
    assert more.startswith(alone)
    assert re.findall(r"(?m)^\(?([A-Z]+)\(", more[len(alone) :])[:2] == ["RATIO", "IDLING"]
    assert "  6.230   3.461   1.800   1.000  -5.538  -1.600" in more[len(alone) :]


def test_what_a_deck_of_plain_sets_lacks_is_left_out() -> None:
    """No planet ratios, no names, no conventions, no messages of the neutral gear."""
    text = vstatics("run", "--lang", "source", "-", stdin=NEUTRAL.encode()).out
    for absent in ("UAQ", "NNM", "Дополнительные данные", "NAME", "IDLE", "warning", "|"):
        assert absent not in text
    assert "KJG= 3 KL= 2 KG= 1 KNM= 0" in text


def test_given_speeds_keep_their_own_fields() -> None:
    """The source has no words for them: theirs are those of the listing in Russian."""
    given = NEUTRAL.replace("low: {engaged: [B]}", "low: {speeds: {2: 0}}")
    text = vstatics("run", "--lang", "source", "-", stdin=given.encode()).out
    lines = text.splitlines()
    at = lines.index("(NWZ(K,I),K=1,KWZ(I)),I=1,NP:")
    assert lines[at - 3 : at + 5] == [
        "KWZ(I),I=1,NP:",
        "0 1",
        "Их звенья:",
        "(NWZ(K,I),K=1,KWZ(I)),I=1,NP:",
        "2",
        "Их значения:",
        "(WZ(K,I),K=1,KWZ(I)),I=1,NP:",
        ".0000E+00",
    ]


def test_without_shift_elements_their_lists_are_left_out_and_titles_stay() -> None:
    pair = "links: 2\nmechanisms: {D: {first: 1, second: 2, ratio: -2.5}}\ngears: {'1': {}}\n"
    text = source_listing("-", stdin=pair)
    assert not re.search(r"NZF|NFRI|WFRI|I=1,KL:|Устройства управления", text)
    assert [title for title in ("А. ", "Б. ", "В. ") if f"\n{title}" not in text] == []


@pytest.mark.parametrize("case", [one for one in SHIPPED if one.suffix == ".yaml"][::4], ids=str)
def test_rows_are_as_many_as_the_echo_says(case: Path) -> None:
    """Of drawn cases, too, whose planets are links there."""
    said = vstatics("run", "--lang", "source", case)
    if said.status:
        assert "E870" not in said.err, said.err
        assert "no fields for" in said.err
        return
    given, results = said.out.split("РЕЗУЛЬТАТЫ")
    sizes = {key: int(n) for key, n in re.findall(r"\b(KJG|KL|KG|NP)= (\d+)", given)}
    sizes |= {"KLG1": sizes["KG"] + 1}
    tables = re.findall(r",NP\),I=.*,(\w+):\n((?:[ \d.*-]+\n)+)", results)
    assert len(tables) == 8 - 3 * (not sizes["KL"])
    for size, body in tables:
        rows = body.splitlines()
        assert len(rows) == sizes[size]
        assert {len(row.split()) for row in rows} == {sizes["NP"]}


def test_a_drawn_case_has_the_ratios_of_the_case_itself() -> None:
    """Its output torque without losses is its ratio (virtual work)."""
    ratios = json.loads(vstatics("run", CASES / "umdm.yaml", "-f", "json").out)["ratio"]
    block = source_listing(CASES / "umdm.yaml").split("KLG1:\n")[1].splitlines()
    assert [float(n) for n in block[6].split()] == pytest.approx(ratios, abs=5e-4)


@pytest.mark.parametrize(
    ("options", "why"),
    [
        ("--lang source -f json", "--lang source is for a listing, not for json"),
        ("--lang source -o x.csv", "--lang source is for a listing, not for csv"),
        ("--lang source --pretty", "--lang source"),
        ("--own-tables", "--own-tables is for --lang source"),
        ("--own-tables --lang ru", "--own-tables is for --lang source"),
    ],
)
def test_it_is_a_listing_only(options: str, why: str) -> None:
    said = vstatics("run", MZKT, *options.split())
    assert (said.status, why in said.err) == (2, True)


def test_springs_have_no_fields_there() -> None:
    said = vstatics("run", CASES / "moskvich412.yaml", "--lang", "source")
    assert (said.status, said.out) == (1, "")
    assert "moskvich412.yaml: error: the source's listing has no fields for first shaft" in said.err
