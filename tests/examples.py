"""Rewrite the outputs that documents show: python -m tests.examples docs/results.md ...

An output with lines ``...`` keeps them: each of its parts is replaced by the most similar lines of
the new output. Read what was written; a wrong output becomes a wrong example.
"""

import contextlib
import difflib
import doctest
import io
import os
import sys
import tempfile
from pathlib import Path

from tests.commands import ROOT
from tests.test_readme import (
    FENCE,
    FILES_OF,
    Block,
    blocks,
    commands,
    is_run,
    matches,
    prepared,
    run_all,
    write_file,
)


def shortened(actual: str, shown: str) -> str:
    """Return an output with the ellipses of the output shown before.

    Examples
    --------
    >>> shortened("head\\na  2\\nb\\nc\\n", "head\\n...\\nc\\n")
    'head\\n...\\nc\\n'
    >>> shortened("speed 2.5\\nmore\\n", "speed 2.4\\n...\\n")
    'speed 2.5\\n...\\n'
    """
    if matches(actual, shown):
        return shown
    lines, shown_lines = actual.splitlines(), shown.splitlines()
    ellipses = [place for place, line in enumerate(shown_lines) if line == "..."]
    begins, ends = [0, *(place + 1 for place in ellipses)], [*ellipses, len(shown_lines)]
    parts = [shown_lines[begin:end] for begin, end in zip(begins, ends, strict=True)]
    if not ellipses:
        parts = [lines]
    written: list[list[str]] = []
    after = 0
    for number, part in enumerate(parts):
        last = max(len(lines) - len(part), after)
        first = last if part and number == len(parts) - 1 else after
        starts = range(first, after + 1 if number == 0 else last + 1)
        start = max(starts, key=lambda place: _likeness(lines[place:], part))
        after = start + len(part)
        written += [["..."]] * bool(number) + [lines[start:after]]
    return "".join(f"{line.rstrip()}\n" for part in written for line in part)


def _likeness(lines: list[str], part: list[str]) -> float:
    pairs = zip(lines, part, strict=False)
    return sum(difflib.SequenceMatcher(None, *pair).ratio() for pair in pairs)


def _console(block: Block, folder: Path) -> str:
    examples = [*commands(block)]
    run = [command for command, _ in examples if is_run(command)]
    outputs = iter(run_all(run, folder, seconds=3600))  # a search for gearboxes also compiles
    text = block.text[: block.text.index("$ ")]
    for command, shown in examples:
        asked = "$ " + command.replace("\n", "\n> ").removesuffix("> ")
        text += asked + (shortened(next(outputs), shown) if is_run(command) else shown)
    return text


def _python(block: Block, variables: dict[str, object]) -> str:
    lines = block.text.splitlines(keepends=True)
    text, at = "", 0
    for example in doctest.DocTestParser().get_examples(block.text):
        count = example.source.count("\n")
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            if example.exc_msg is None:
                exec(compile(example.source, "example", "single"), variables)  # noqa: S102
        wanted = example.want.count("\n")
        begin = example.lineno + count
        text += "".join(lines[at:begin])
        is_right = example.exc_msg is not None or doctest.OutputChecker().check_output(
            example.want, printed.getvalue(), doctest.ELLIPSIS
        )
        text += "".join(lines[begin : begin + wanted]) if is_right else printed.getvalue()
        at = begin + wanted
    return text + "".join(lines[at:])


def rewritten(document: Path, folder: Path) -> str:
    """Return the text of a document with the outputs that its examples have now."""
    text = document.read_text("utf-8")
    for other in FILES_OF.findall(text):
        for block in blocks(document.parent / other):
            write_file(block, folder)
    variables: dict[str, object] = {}
    parts: list[str] = []
    at = 0
    for match, block in zip(FENCE.finditer(text), blocks(document), strict=True):
        new = block.text
        if block.file:
            write_file(block, folder)
        elif block.kind == "console":
            new = _console(block, folder)
        elif block.kind == "python":
            new = _python(block, variables)
        parts += [text[at : match.start("text")], new]
        at = match.end("text")
    return "".join([*parts, text[at:]])


if __name__ == "__main__":
    for page in map(Path.absolute, map(Path, sys.argv[1:])):
        with tempfile.TemporaryDirectory() as name:
            place = prepared(Path(name))
            with contextlib.chdir(place):
                new = rewritten(page, place)
        if new != page.read_text("utf-8"):
            page.write_text(new, "utf-8")
            sys.stdout.write(f"rewrote {os.path.relpath(page, ROOT)}\n")
