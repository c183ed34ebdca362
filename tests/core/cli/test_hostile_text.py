"""Text of anybody never reaches a terminal as it is: escape sequences, marks of direction."""

import json
import re
from pathlib import Path

import pytest
import yaml
from click import Context

from tests.commands import MZKT, NEUTRAL, json_answer, on_terminal, vstatics
from vstatics.core.cli import main

ATTACK = "\x1b[2J\x1b]0;title\x07\x9b31m\x7f\u202e\u2066\u2028"
"""Clears the screen, names the window, turns red, in 7 and in 8 bits; turns the direction."""
HOSTILE = '"s\\e[2J\\u202E"'
"""A name as YAML writes it."""
FORBIDDEN = re.compile("[\0-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069]")
"""All controls but ends of lines and tabs, and what turns the direction of writing."""
CASE = f"{ATTACK}.yaml"
NOWHERE = f"{ATTACK}.d/no/a.json"
COMMANDS = main.list_commands(Context(main))


@pytest.fixture(autouse=True)
def _files(folder: Path) -> None:
    """A case with a name of that kind, a good one, a result of it, and a folder."""
    for name in (CASE, "box.yaml"):
        Path(name).write_text(NEUTRAL, "utf-8")
    vstatics("run", "box.yaml", "-f", "json", "-o", "box.json")
    (folder / f"{ATTACK}.d").mkdir()


def told(*arguments: str, stdin: str = "") -> str:
    """What a command says of the attack, which is escaped."""
    said = vstatics(*arguments, stdin=stdin.encode())
    assert not FORBIDDEN.search(said.all), arguments
    return said.all


SWEEP = ("sweep", CASE, "--vary")
RESPONSE = ("torsion", "response", CASE, "--at", "1", "--orders", "2", "--speed", "1")
LINES = (
    ("run", CASE, "-f", "json", "nowhere.yaml"),
    ("run", CASE, CASE, "-o", "out/"),
    ("run", f"{ATTACK}.d", "-o", "out/"),
    ("run", "box.yaml", "-o", f"{ATTACK}.d", "--jobs", "2", "nowhere.yaml", "--resume"),
    ("run", "--files-from", ATTACK),
    ("check", f"nowhere{ATTACK}"),
    *(("summary", CASE, "box.yaml", "-f", form) for form in ("text", "markdown", "latex")),
    ("compare", CASE, "box.json"),
    ("convert", CASE, f"{ATTACK}.xyz"),
    ("plot", CASE, "--kind", ATTACK, "-o", "a.svg"),
    ("report", CASE, "-o", f"a.{ATTACK}"),
    ("new", ATTACK, "--template", ATTACK),
    *((*SWEEP, asked) for asked in (ATTACK, f"D.{ATTACK}=1:2:3", f"D.ratio={ATTACK}")),
    *((*SWEEP, "D.ratio=-3:-2:3", "--out", asked) for asked in (ATTACK, f"ratio[{ATTACK}]")),
    ("sweep", CASE, "--variants", ATTACK),
    ("torsion", "modes", CASE, "--gear", ATTACK),
    *((*RESPONSE, option, ATTACK) for option in ("--at", "--orders", "--speed", "--torque")),
    ("torsion", "dump", ATTACK),
    ("synth", "case", ATTACK, "--input", "L0", "--output", "L1"),
    ("synth", "combinations", CASE, "--engaged", ATTACK),
    ("synth", "fit", CASE, "--ratios", f"{ATTACK}=2"),
    ("synth", "structures", "--sets", "2", "-o", NOWHERE),
    *((command, CASE, "-o", NOWHERE) for command in ("run", "flow", "convert", "plot", "report")),
    *((*group, ATTACK) for group in ((), ("torsion",), ("synth",))),
    *((command, f"--{ATTACK}") for command in COMMANDS),
    *((command, CASE, "--gear", ATTACK) for command in COMMANDS),
)


@pytest.mark.parametrize("arguments", LINES, ids=" ".join)
def test_the_command_line_is_shown_escaped(arguments: tuple[str, ...]) -> None:
    told(*arguments)


def test_a_name_of_two_lines_forges_no_message() -> None:
    said = vstatics("run", "a\nb.dat:1:1: error: no\n.dat")
    assert len(said.err.splitlines()) == 1


TEXTS = {
    "yaml": (
        f'links: 3\n"{ATTACK}": 1\n',
        f"links: 3\n{HOSTILE}: 1\n",
        f"name: {HOSTILE}\n{NEUTRAL}",
        NEUTRAL.replace("low:", f"{HOSTILE}:"),
        NEUTRAL.replace("engaged: [B]", f"engaged: [{HOSTILE}]"),
        NEUTRAL.replace("-2.5", HOSTILE),
        NEUTRAL.replace("-2.5", "\u202e"),
        f"load: {{speed: '1 {ATTACK}', torque: 1 N*m}}\n{NEUTRAL}",
        f"&{ATTACK} *{ATTACK}\n",
        f"!{ATTACK} 1\n",
    ),
    "json": (
        json.dumps({ATTACK: 1}),
        json.dumps({"links": ATTACK, "gears": {ATTACK: {"engaged": [ATTACK]}}}),
        f'{{"links": {ATTACK}}}',
    ),
    "deck": (f"KJG = {ATTACK}\n", f"{ATTACK} = 1\n", f"KJG = 3 {ATTACK}\nNAME = {ATTACK}\n"),
}


@pytest.mark.parametrize("form", TEXTS)
def test_a_case_is_shown_escaped(form: str) -> None:
    for text in TEXTS[form]:
        for command in ("run", "check"):
            assert ": error: " in told(command, "-", "--from", form, stdin=text), text
    told("run", "-", stdin=MZKT.read_text("utf-8").replace("=", f"={ATTACK}", 3))


SWEEP_FILES = (
    f"{HOSTILE}: 1\n",
    f"case: {ATTACK}",
    f"case: {HOSTILE}\nvary: {{D.ratio: -3:-2:3}}\n",
    f"case: box.yaml\nvary: {{{HOSTILE}: 1}}\n",
    *(
        f"case: box.yaml\nvary: {{D.ratio: -3:-2:3}}\n{key}: {HOSTILE}\n"
        for key in ("out", "where", "min", "output", "method")
    ),
)
SPRING = "links: [a, b]\ninertias: {a: 1, b: 2}\nsprings: {s: {links: [a, b], stiffness: 9}}\n"
VIBRATING = (
    SPRING.replace("s: {", f"{HOSTILE}: {{"),
    SPRING.replace("a: 1", f"a: {HOSTILE}"),
    SPRING.replace("links: [a, b], ", f"twist: {{a: 1, {HOSTILE}: -1}}, "),
    SPRING.replace("stiffness: 9", f"{HOSTILE}: 9"),
    f"{SPRING}gears: {{{HOSTILE}: {{}}}}\n",
)
READ = {
    ("sweep", "--file", "-"): SWEEP_FILES,
    ("torsion", "modes", "-"): VIBRATING,
    ("torsion", "dump", "-"): (f"{HOSTILE}: 1\n", f"J1: {HOSTILE}\n", f"{ATTACK}: 1\n"),
    ("summary", "box.yaml", "--duty", "-"): (
        *(f"{HOSTILE}: 1", f"energy: {{{HOSTILE}: 1}}", f"energy: {{low: {HOSTILE}}}"),
    ),
}


@pytest.mark.parametrize("command", READ, ids=" ".join)
def test_another_document_is_shown_escaped(command: tuple[str, ...]) -> None:
    for text in READ[command]:
        assert "rror: " in told(*command, stdin=text), text


@pytest.mark.parametrize("suffix", ["csv", "jsonl", "txt"])
def test_a_table_is_shown_escaped(suffix: str) -> None:
    variants = ("sweep", "box.yaml", "--variants", f"own.{suffix}")
    for text in (f"{ATTACK}\n1\n", f"D.ratio\n{ATTACK}\n", f'{{"{ATTACK}": 1}}'):
        Path(f"own.{suffix}").write_text(text, "utf-8")
        assert "rror: " in told(*variants), text


def test_rows_of_results_are_compared_escaped() -> None:
    """Whoever wrote the result, it may have any names of rows and gears."""
    text = Path("box.json").read_text("utf-8")
    for name in ('"low"', '"B"', '"D"', '"speeds"', '"case"', "null"):
        forged = text.replace(name, json.dumps(ATTACK))
        told("compare", "-", "box.json", stdin=forged)
        told("compare", "-", "box.json", stdin=forged.encode().decode("unicode_escape"))
    listing = vstatics("run", "box.yaml").out
    for word in ("low", "W", "ETA"):
        told("compare", "-", "box.json", stdin=listing.replace(word, ATTACK))


def test_json_stays_the_same_json_and_csv_stays_data() -> None:
    assert json_answer("run", f"no{CASE}", "box.yaml")[0]["case"] == f"no{CASE}"
    assert ATTACK in vstatics("run", CASE, "box.yaml", "-f", "csv").out


@pytest.mark.parametrize("form", ["yaml", "json"])
@pytest.mark.parametrize("text", [ATTACK, "\u202e", "\x85", "two\nlines\t\u200f", "\ufeff\r"])
def test_a_case_keeps_its_description_escaped(text: str, form: str) -> None:
    case = {**yaml.safe_load(NEUTRAL), "description": text}
    said = vstatics("convert", "-", "-", "--to", form, stdin=json.dumps(case).encode())
    assert (said.status, FORBIDDEN.search(said.out)) == (0, None)
    again = vstatics("convert", "-", "-", "--to", "json", stdin=said.out.encode()).out
    assert json.loads(again)["description"] == text


@pytest.mark.parametrize("form", ["csv", "json", "listing"])
def test_a_terminal_gets_no_format_as_it_is(form: str) -> None:
    shown = on_terminal("run", CASE, "box.yaml", "nowhere.yaml", "-f", form, cwd=Path.cwd())
    assert "low" in shown
    assert not FORBIDDEN.search(shown.replace("\r", ""))


def test_a_terminal_gets_colours_of_ours_only() -> None:
    """Messages above the bar, names in the coloured table."""
    shown = on_terminal("run", "--pretty", CASE, f"no{CASE}", cwd=Path.cwd())
    assert "\x1b[1mgear" in shown
    assert not FORBIDDEN.search(re.sub("\x1b\\[[0-9;]*m|\r", "", shown))
    shown = on_terminal("run", CASE, f"no{CASE}", "-o", "out", "-j", "2", cwd=Path.cwd())
    assert "\x1b[2J" not in shown
    assert not FORBIDDEN.search(re.sub("\x1b\\[\\??[0-9;]*[A-Za-z]|\r", "", shown))
