"""Summaries in Markdown and LaTeX, and two of them side by side."""

from __future__ import annotations

import re

import pytest

from tests.commands import CASES, NEUTRAL, vstatics

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
    assert said.status == 0
    assert len(tables) > 3
    for table in tables:
        cells = {len(re.split(r"(?<!\\)\|", line)) for line in table.splitlines()}
        assert len(cells) == 1
    assert r"a\|b\_\$%\&\#\{\}\~^\\" in said.out


def test_latex_has_no_sign_that_it_would_take_for_a_command() -> None:
    """As many cells as columns, and rows that do not start with a bracket."""
    said = vstatics("summary", "-", "-f", "latex", stdin=ODD.encode())
    assert r"a\textbar{}b\_\$\%\&\#\{\}\textasciitilde{}\textasciicircum{}\textbackslash{}" in (
        said.out
    )
    assert "{[}1{]}" in said.out
    tables = re.findall(r"\\begin\{tabular\}\{(\w+)\}\n(.*?)\\end\{tabular\}", said.out, re.DOTALL)
    assert len(tables) > 3
    for columns, body in tables:
        rows = [line for line in body.splitlines() if line != r"\hline"]
        assert all(line.endswith(r" \\") and not line.startswith("[") for line in rows)
        assert all(len(re.findall(r"(?<!\\)&", line)) == len(columns) - 1 for line in rows)


def test_standard_input_is_one_case_only() -> None:
    said = vstatics("summary", "-", "-", stdin=NEUTRAL.encode())
    assert said.is_wrong_use("standard input")


def test_a_case_in_error_gives_no_tables(tmp_path: object) -> None:
    said = vstatics("summary", f"{tmp_path}/none.yaml")
    assert said.gives_nothing("none.yaml")


@pytest.mark.parametrize("form", ["text", "markdown", "latex", "json"])
def test_output_goes_to_a_file(form: str, tmp_path: object) -> None:
    file = f"{tmp_path}/made"
    said = vstatics("summary", CASES / "simpson.yaml", "-f", form, "-o", file)
    assert (said.status, said.out) == (0, "")
    with open(file, encoding="utf-8") as opened:  # noqa: PTH123
        assert opened.read() == vstatics("summary", CASES / "simpson.yaml", "-f", form).out
