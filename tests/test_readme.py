"""Every example of README.md and docs/ is run; what it prints is compared exactly.

A block in ``text``, ``yaml`` or the like has the name of its file in a comment on the
line before, ``<!-- file: box.yaml -->``, and is written to a temporary folder. In a
``console`` block lines with ``$ `` are commands (``> `` continues them), the others
are their output, both streams together; a line ``...`` stands for any lines. Blocks in
``python`` are doctests. The blocks of a document share a folder and run in order;
``<!-- files of: ../README.md -->`` puts the files of another document there first.
"""

import ast
import doctest
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import NamedTuple

import click
import pytest

from tests.commands import ROOT
from tests.installed import HERE, missing, needs, skip_without, used_in
from vstatics.core.cli import main
from vstatics.core.messages.catalogue import known_ids

DOCUMENTS = [ROOT / "README.md", ROOT / "CHANGELOG.md", *sorted((ROOT / "docs").glob("**/*.md"))]
NAMES = [str(document.relative_to(ROOT)) for document in DOCUMENTS]
FENCE = re.compile(
    r"^(?:<!-- file: (?P<file>\S+) -->\n)?```(?P<kind>\w*)\n(?P<text>.*?)^```$",
    re.MULTILINE | re.DOTALL,
)
FILES_OF = re.compile(r"^<!-- files of: (\S+) -->$", re.MULTILINE)
SPAN = re.compile(r"(?<!`)`(vstatics [^`\n]+)`")
LINK = re.compile(r"\]\(([^)\s]+)\)")
NOT_RUN = ("make", "pip ", ".venv/bin/", "git ", "cd ")
"""How commands start that need another machine than this folder."""
DONE = "--- end of a command ---"


class Block(NamedTuple):
    """A fenced block of a document."""

    kind: str
    file: str | None
    text: str
    line: int


def blocks(document: Path) -> Iterator[Block]:
    text = document.read_text("utf-8")
    for match in FENCE.finditer(text):
        line = text.count("\n", 0, match.start("text")) + 1
        yield Block(match["kind"], match["file"], match["text"], line)


def commands(block: Block) -> Iterator[tuple[str, str]]:
    """The commands of a console block, each with the output that it shows."""
    for part in re.split(r"^\$ ", block.text, flags=re.MULTILINE)[1:]:
        lines = part.splitlines(keepends=True)
        count = next((n for n, line in enumerate(lines) if n and line[:2] != "> "), len(lines))
        command = "".join(line.removeprefix("> ") for line in lines[:count])
        yield command, "".join(lines[count:])


def is_run(command: str) -> bool:
    return not command.startswith(NOT_RUN)


def matches(actual: str, shown: str) -> bool:
    """Whether an output is as shown; blanks at the ends of lines do not count."""
    actual, shown = (
        "".join(f"{line.rstrip()}\n" for line in text.splitlines()) for text in (actual, shown)
    )
    parts = re.split(r"^\.\.\.\n", shown, flags=re.MULTILINE)
    return re.fullmatch(r"(?:.*\n)*?".join(map(re.escape, parts)), actual) is not None


def run_all(asked: list[str], folder: Path, seconds: float = 60) -> list[str]:
    """The output of each command; they share one shell."""
    script = "".join(
        f"{command}\nlast=$?; printf '%s\\n' '{DONE}'; (exit $last)\n" for command in asked
    )
    environment = {
        **os.environ,
        "PATH": f"{folder / '.bin'}{os.pathsep}{os.environ['PATH']}",
        "PYTHONPATH": str(ROOT),
        "LC_ALL": "C.UTF-8",
        "COLUMNS": "80",
    }
    done = subprocess.run(
        ["bash", "-c", f"exec 2>&1\n{script}"],
        cwd=folder,
        env=environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        check=False,
        timeout=seconds,
    )
    return done.stdout.decode().split(f"{DONE}\n")[:-1]


def prepared(folder: Path) -> Path:
    """Put the cases, the schemas, the documents and this program, as `vstatics`, into a folder."""
    for name in ("cases", "schemas", "docs"):
        (folder / name).symlink_to(ROOT / name)
    program = folder / ".bin" / "vstatics"
    program.parent.mkdir()
    program.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m vstatics "$@"\n')
    program.chmod(0o755)
    return folder


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the shipped cases, in which `vstatics` is this program."""
    monkeypatch.chdir(tmp_path)
    return prepared(tmp_path)


def write_file(block: Block, folder: Path) -> None:
    if block.file:
        target = folder / block.file
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(block.text, "utf-8")


def made(block: Block) -> set[str]:
    """Return the files and the variables that a block makes."""
    if block.kind != "python":
        return {*re.findall(r"(?:-o|--output|--write|>) (\S+)", block.text)}
    source = "".join(one.source for one in doctest.DocTestParser().get_examples(block.text))
    return {
        node.id
        for node in ast.walk(ast.parse(source))
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)
    }


def installed(blocks: Iterable[Block]) -> Iterator[Block]:
    """Return the blocks but those that use an annex that is missing, or what such blocks make."""
    gone: set[str] = set()
    for block in blocks:
        words = {*re.findall(r"[\w./-]+", block.text)}
        if not block.file and (missing(used_in(block.text)) or words & gone):
            gone |= made(block)
        else:
            yield block


def check_console(block: Block, folder: Path) -> Iterator[str]:
    """What differs from the outputs shown."""
    asked = [(command, shown) for command, shown in commands(block) if is_run(command)]
    printed = run_all([command for command, _ in asked], folder)
    for (command, shown), actual in zip(asked, printed, strict=True):
        if not matches(actual, shown):
            yield f"$ {command}printed:\n{actual}expected:\n{shown}"


def check_python(block: Block, name: str, variables: dict[str, object]) -> Iterator[str]:
    """What differs from the values shown."""
    test = doctest.DocTestParser().get_doctest(block.text, variables, name, name, block.line)
    report: list[str] = []
    runner = doctest.DocTestRunner(verbose=False, optionflags=doctest.ELLIPSIS)
    runner.run(test, out=report.append, clear_globs=False)
    variables.update(test.globs)
    if runner.failures:
        yield "".join(report)


@pytest.mark.skipif(shutil.which("bash") is None, reason="the examples are for a shell")
@pytest.mark.parametrize(
    "name",
    [pytest.param(name, marks=[pytest.mark.slow] * (name != "README.md")) for name in NAMES],
)
def test_examples_print_what_they_show(name: str, folder: Path) -> None:
    if "synthesis" in HERE and "$ vstatics synth box" in (ROOT / name).read_text("utf-8"):
        from vstatics.synthesis.boxes.batches.found import prepare
        from vstatics.synthesis.boxes.box import BoxSearch

        prepare(BoxSearch(1, 2, 1, (3.0, 1.0)))  # to compile it takes longer than a command may
    wrong: list[str] = []
    variables: dict[str, object] = {}
    for other in FILES_OF.findall((ROOT / name).read_text("utf-8")):
        skip_without(*used_in(os.path.normpath(Path(name).parent / other)))
        for block in blocks((ROOT / name).parent / other):
            write_file(block, folder)
    for block in installed(blocks(ROOT / name)):
        if block.file:
            write_file(block, folder)
            continue
        found: Iterator[str] = iter(())
        if block.kind == "console" and (shutil.which("jq") or not re.search(r"\bjq\b", block.text)):
            found = check_console(block, folder)
        elif block.kind == "python":
            found = check_python(block, name, variables)
        wrong += [f"{name}:{block.line}: {message}" for message in found]
    assert not wrong, "\n".join(wrong)


def test_every_block_is_of_a_kind_that_is_run() -> None:
    """Blocks without a kind hold equations and pictures; files may be of any kind."""
    found = [(name, block) for name in NAMES for block in blocks(ROOT / name) if not block.file]
    kinds = ("", "console", "python")
    assert [f"{name}:{block.line}" for name, block in found if block.kind not in kinds] == []


def test_targets_of_make_exist() -> None:
    made = set(re.findall(r"^([a-z-]+):", (ROOT / "Makefile").read_text("utf-8"), re.MULTILINE))
    for name in NAMES:
        text = (ROOT / name).read_text("utf-8")
        named = set(re.findall(r"(?:`|^\$ )make ([a-z-]+)", text, re.MULTILINE))
        assert named <= made, name


def anchors(document: Path) -> set[str]:
    """What `#...` of a link to this document may be: its headings as GitHub writes them.

    The site adds a heading for each id to the page of messages.
    """
    prose = FENCE.sub("", document.read_text("utf-8"))
    titles = re.findall(r"^#+ (.*)$", prose, re.MULTILINE)
    found = {re.sub(r"[^\w -]", "", title.lower()).replace(" ", "-") for title in titles}
    return found | {identity.lower() for identity in known_ids() if document.name == "messages.md"}


def broken_links(document: Path) -> Iterator[str]:
    """Links to files and headings that are not there."""
    for link in LINK.findall(FENCE.sub("", document.read_text("utf-8"))):
        path, _, heading = link.partition("#")
        if "://" in link or missing(used_in(os.path.relpath(document.parent / path, ROOT))):
            continue
        target = document.parent / path if path else document
        if not target.exists() or (heading and heading not in anchors(target)):
            yield link


def test_links_lead_somewhere() -> None:
    assert [(name, link) for name in NAMES for link in broken_links(ROOT / name)] == []


def test_broken_links_are_found(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text(
        "# A Title, with *marks*\n"
        "[a](page.md) [b](#a-title-with-marks) [c](https://example.org/none)\n"
        "[d](none.md) [e](page.md#none) [f](#comment)\n"
        "```text\n# comment\n[g](none)\n```\n",
        "utf-8",
    )
    assert list(broken_links(page)) == ["none.md", "page.md#none", "#comment"]


MENU = ROOT / "docs/README.md"
LISTS = (
    "README.md",
    "docs/README.md",
    "docs/cookbook/README.md",
    "docs/how-to/README.md",
    "docs/sources.md",
)
"""Pages that list others; the last three have the cookbook, how to and the sources."""


def test_every_document_is_listed_in_the_readme_or_the_menu() -> None:
    linked: set[str] = set()
    for name in LISTS:
        folder, text = name.rpartition("/")[0], (ROOT / name).read_text("utf-8")
        linked |= {os.path.normpath(f"{folder or '.'}/{page}") for page in LINK.findall(text)}
    assert {*NAMES} - {link.partition("#")[0] for link in linked} == set()


def test_the_menu_orders_pages_by_need() -> None:
    needs_of_readers = re.findall(r"^## (.*)$", MENU.read_text("utf-8"), re.MULTILINE)
    assert needs_of_readers == ["Learn", "Do a task", "Look up", "Understand", "Contribute"]


def test_deck_reference_names_every_field() -> None:
    from vstatics.core.readers.deck.text import LISTS, SCALARS
    from vstatics.core.tables.quantities import PRINTED

    text = (ROOT / "docs" / "deck.md").read_text("utf-8")
    named = set(re.findall(r"[A-Z]+", "".join(re.findall(r"`[^`]*`", text))))
    assert (SCALARS | LISTS | PRINTED.keys()) - named == set()


def named_keys(document: str) -> set[str]:
    """Return the words in code of the prose of a document."""
    text = FENCE.sub("", (ROOT / document).read_text("utf-8"))
    return set(re.findall(r"\w+", "".join(re.findall(r"`[^`]*`", text))))


def test_references_name_every_key() -> None:
    from vstatics.core.elements.keys import with_elements
    from vstatics.core.model.keys import CASE, ELEMENT, GEAR, LOAD, MECHANISM
    from vstatics.core.model.torsional_keys import SPRING, STRUT

    pages = {"cases": [with_elements(CASE), ELEMENT, GEAR, LOAD, MECHANISM]}
    pages["springs"] = [SPRING, STRUT]
    if "vehicle" in HERE:
        from vstatics.vehicle.case.fatigue_key import FATIGUE
        from vstatics.vehicle.case.vehicle_key import VEHICLE

        pages |= {"springs vehicle/life": [FATIGUE], "vehicle/README": [VEHICLE]}
    for names, shapes in pages.items():
        named = set[str]().union(*(named_keys(f"docs/{name}.md") for name in names.split()))
        for shape in shapes:
            assert {key.name for key in shape.keys} - named == set(), shape.title


def test_units_of_the_reference_are_understood() -> None:
    from vstatics.core.readers.named.units import unit

    text = (ROOT / "docs" / "units.md").read_text("utf-8")
    for quantity, units in re.findall(
        r"^\| (speed|torque|power) \| (`.*`) \|$", text, re.MULTILINE
    ):
        assert {unit(one)[0] for one in re.findall(r"`(.*?)`", units)} == {quantity}


def test_readme_starts_with_the_two_commands() -> None:
    first = next(blocks(ROOT / "README.md"))
    assert [command.split("#")[0].strip() for command, _ in commands(first)] == [
        "make run",
        "make test",
    ]


MOST_WORDS_OF_README = 900


def test_readme_is_short_and_comes_to_the_point() -> None:
    """The first screen says what the program is, for whom, how it differs, and how it starts."""
    text = (ROOT / "README.md").read_text("utf-8")
    assert len(text.split()) <= MOST_WORDS_OF_README
    head = "\n".join(text.splitlines()[:60])
    for wanted in ("engineers", "does not", "Simscape", "KISSsys", "spreadsheet", "zf-8hp70-flow"):
        assert wanted in head
    for wanted in ("make run", "make test", "vstatics new", "--pretty", "pip install ."):
        assert wanted in head


def test_make_run_prints_the_first_table_of_the_readme() -> None:
    makefile = (ROOT / "Makefile").read_text("utf-8")
    [case] = re.findall(r"^CASE \?= (.*)$", makefile, re.MULTILINE)
    [options] = re.findall(r'^\t@\$\(BIN\)/vstatics run "\$\(CASE\)" (.*)$', makefile, re.MULTILINE)
    text = (ROOT / "README.md").read_text("utf-8")
    assert f"$ vstatics run {case} {options}\n" in "\n".join(text.splitlines()[:60])


OF_SOURCES = ["docs/sources.md", *(name for name in NAMES if name.startswith("docs/sources/"))]


COMMANDS_OF_SOURCES = dict.fromkeys(
    command
    for name in OF_SOURCES
    for command in SPAN.findall(FENCE.sub("", (ROOT / name).read_text("utf-8")))
)


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("bash") is None, reason="the examples are for a shell")
@pytest.mark.parametrize(
    "command",
    [pytest.param(command, marks=needs(*used_in(command))) for command in COMMANDS_OF_SOURCES],
)
def test_a_command_of_the_sources_runs_as_printed(command: str, folder: Path) -> None:
    """Within sentences and tables; those in blocks are examples, see above."""
    [said] = run_all([f"{command} > /dev/null && echo done"], folder)
    assert said.splitlines()[-1:] == ["done"], said


def test_commands_of_the_sources_are_whole() -> None:
    """A command without its program is not one that runs as printed."""
    names = "|".join(main.list_commands(click.Context(main)))
    for name in OF_SOURCES:
        text = FENCE.sub("", (ROOT / name).read_text("utf-8"))
        bare = re.findall(rf"`(?:{names}) [^`]*(?:CASE|cases/|--)[^`]*`", text)
        assert bare == [], name


def options_of(words: list[str]) -> set[str]:
    """The options of the command that words call."""
    command: click.Command = main
    while isinstance(command, click.Group) and words:
        inner = command.get_command(click.Context(command), words.pop(0))
        if inner is None:
            break
        command = inner
    own = {name for one in command.params for name in (*one.opts, *one.secondary_opts)}
    return own | {"--help", "--version"}


def test_a_command_within_a_sentence_has_its_options() -> None:
    """Those are not run; the list of changes tells of what was."""
    documents = [ROOT / name for name in NAMES if name != "CHANGELOG.md"]
    for command in {c for path in documents for c in SPAN.findall(path.read_text("utf-8"))}:
        if not missing(used_in(command)):
            words = command.split()[1:]
            asked = {word.split("=")[0] for word in words if re.match("--[a-z]", word)}
            assert asked <= options_of(words), command
