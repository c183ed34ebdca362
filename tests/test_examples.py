"""The tool that rewrites the outputs shown in documents."""

from pathlib import Path

from tests.examples import rewritten, shortened
from tests.test_readme import prepared


def test_outputs_are_replaced_and_their_ellipses_kept() -> None:
    for actual, shown, written in (
        ("a 2\n", "a 1\n", "a 2\n"),
        ("head\na 2\nb\nc 9\n", "head\n...\nc 8\n", "head\n...\nc 9\n"),
        ("speed 2.5\nmore\n", "speed 2.4\n...\n", "speed 2.5\n...\n"),
        ("x\ny\nratio 3\nz\n", "...\nratio 2\n...\n", "...\nratio 3\n...\n"),
        ("a\nb\nc\n", "a\n...\nc\n", "a\n...\nc\n"),
    ):
        assert shortened(actual, shown) == written


def test_a_page_has_the_outputs_of_the_program(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    text = "```console\n$ echo one; echo two\nTWO\n$ cd elsewhere\nleft\n```\n"
    page.write_text(f"{text}```python\n>>> 1 + 1\n3\n```\n", "utf-8")
    right = text.replace("TWO\n", "one\ntwo\n")
    assert rewritten(page, prepared(tmp_path)) == f"{right}```python\n>>> 1 + 1\n2\n```\n"
