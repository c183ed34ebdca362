"""Summaries in every format, and of two cases side by side."""

import re
from pathlib import Path

from tests.commands import CASES, NEUTRAL, TIED_UP, json_answer, vstatics

ODD = NEUTRAL.replace("{C: [1, 2]", '{"a|b_$%&#{}~^\\\\": [1, 2]').replace(
    "N: {}", '"[1]": {engaged: ["a|b_$%&#{}~^\\\\"]}'
)
"""A clutch whose name has every sign that means something elsewhere, and a gear in brackets."""


def numbers(text: str) -> list[str]:
    return re.findall(r"-?[0-9]*\.[0-9]{3}\b", text)


def test_all_formats_show_the_same_numbers() -> None:
    case = CASES / "ravigneaux-aod.yaml"
    plain, markdown, latex = (
        vstatics("summary", case, "-f", form).out for form in ("text", "markdown", "latex")
    )
    assert len(numbers(plain)) > 50
    assert numbers(plain) == numbers(markdown) == numbers(latex)


def test_rows_of_markdown_have_as_many_cells_as_their_heading() -> None:
    said = vstatics("summary", "-", "-f", "markdown", stdin=ODD.encode())
    tables = re.findall(r"(?:^\|.*\|\n)+", said.out, re.MULTILINE)
    assert (said.status, len(tables) > 3) == (0, True)
    for table in tables:
        assert len({len(re.split(r"(?<!\\)\|", line)) for line in table.splitlines()}) == 1
    assert r"a\|b\_\$%\&\#\{\}\~^\\" in said.out


def test_latex_has_no_sign_that_it_would_take_for_a_command() -> None:
    """As many cells as columns, and rows that do not start with a bracket."""
    said = vstatics("summary", "-", "-f", "latex", stdin=ODD.encode()).out
    clutch = r"a\textbar{}b\_\$\%\&\#\{\}\textasciitilde{}\textasciicircum{}\textbackslash{}"
    assert clutch in said
    assert "{[}1{]}" in said
    tables = re.findall(r"\\begin\{tabular\}\{(\w+)\}\n(.*?)\\end\{tabular\}", said, re.DOTALL)
    assert len(tables) > 3
    for columns, body in tables:
        rows = [line for line in body.splitlines() if line != r"\hline"]
        assert all(line.endswith(r" \\") and not line.startswith("[") for line in rows)
        assert all(len(re.findall(r"(?<!\\)&", line)) == len(columns) - 1 for line in rows)


def test_json_has_the_digits_of_the_result_and_a_document_of_each_case() -> None:
    case = CASES / "zf-9hp48.yaml"
    made, result = json_answer("summary", case), json_answer("run", case)
    for key in ("ratio", "efficiency"):
        assert [line[key] for line in made["gears"]] == result[key]
    assert json_answer("summary", case, case) == [made, made]


def test_a_case_in_error_gives_no_tables_and_a_gear_tied_up_fails() -> None:
    assert vstatics("summary", "none.yaml").gives_nothing("none.yaml")
    said = vstatics("summary", "-", stdin=TIED_UP.encode())
    assert said.fails("tied up")
    assert "tied up" in said.out


def test_tables_are_80_columns_wide_with_many_gears() -> None:
    """The ten gears of the 10R80; a table of numbers goes on below."""
    said = vstatics("summary", CASES / "ford-10r80.yaml").out
    assert max(map(len, said.splitlines())) <= 80
    assert said.count("mechanism ") == 4


# two cases


def line(table: str, *cells: str) -> bool:
    return bool(re.search(rf"(?m)^{' +'.join(map(re.escape, cells))}", table))


def test_two_cases_are_side_by_side() -> None:
    """ZF 8HP70 and Ford 10R80; spreads as the makers round them, 7.0 and 7.4."""
    said = vstatics("summary", CASES / "zf-8hp70.yaml", CASES / "ford-10r80.yaml").out
    assert re.search(r"^spread +7\.04\d +7\.3\d\d$", said, re.MULTILINE)
    assert re.search(r"^1 +4\.696 +4\.69\d ", said, re.MULTILINE)
    assert re.search(r"^10 +- +0\.6\d\d ", said, re.MULTILINE)
    assert max(map(len, said.splitlines())) <= 80


def test_shifts_and_needed_capacities_are_side_by_side(folder: Path) -> None:
    """Ring held: 2.5 n on the brake, which slips by 1 in direct; 1.2 times 2.5 without n."""
    text = """\
links: [sun, ring, carrier]
shift_elements: {C: [sun, ring], B: [ring, housing]}
mechanisms: {set: {first: sun, second: ring, third: carrier, ratio: -2.5, efficiency: 0.9}}
gears: {low: [B], direct: [C]}
"""
    (folder / "a.yaml").write_text(text)
    (folder / "b.yaml").write_text(text.replace("0.9", "0.8"))
    said = vstatics("summary", "a.yaml", "b.yaml", "--reserve", "1.2").out
    # of low (1 + 2.5 n)/3.5, of direct 1
    assert line(said, "mean forward efficiency", "0.964", "0.929\n")
    slip = "2.250", "B, low-direct", "2.000", "B, low-direct\n"
    assert line(said, "largest slip power", *slip)
    assert line(said, "largest required torque capacity", "3.000", "B, low", "3.000", "B, low\n")
