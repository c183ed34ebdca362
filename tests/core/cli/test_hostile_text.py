"""Text of anybody never reaches a terminal as it is: escape sequences, marks of direction."""

from __future__ import annotations

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
FORBIDDEN = re.compile("[\0-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069]")
"""All controls but ends of lines and tabs, and what turns the direction of writing."""
CASE = f"{ATTACK}.yaml"


@pytest.fixture(autouse=True)
def _files(folder: Path) -> None:
    """A case with a name of that kind, a good one, a result of it, and a folder."""
    Path(CASE).write_text(NEUTRAL, encoding="utf-8")
    (folder / "box.yaml").write_text(NEUTRAL, encoding="utf-8")
    (folder / "box.json").write_text(
        vstatics("run", "box.yaml", "-f", "json").out, encoding="utf-8"
    )
    (folder / f"{ATTACK}.d").mkdir()


def is_safe(*arguments: str, stdin: str = "") -> str:
    """Call a command that has something to say of the attack, escaped; what it says."""
    said = vstatics(*arguments, stdin=stdin.encode())
    assert not FORBIDDEN.search(said.all), arguments
    return said.all


NAMES_A_FILE = (
    ("run", CASE, "box.yaml"),
    ("run", CASE, "-f", "json", "nowhere.yaml"),
    ("run", CASE, "-f", "jsonl"),
    ("run", CASE, "--gear", ATTACK),
    ("run", CASE, CASE, "-o", "out/"),
    ("run", f"{ATTACK}.d", "-o", "out/"),
    ("run", "box.yaml", "-o", f"{ATTACK}.d/no/box.lst"),
    ("run", "box.yaml", "-o", f"{ATTACK}.d", "--jobs", "2", "nowhere.yaml", "--resume"),
    ("run", "--files-from", ATTACK),
    ("check", CASE),
    ("check", f"nowhere{ATTACK}"),
    ("summary", CASE),
    ("summary", CASE, "box.yaml"),
    ("summary", CASE, "-f", "markdown"),
    ("summary", CASE, "-f", "latex"),
    ("summary", "box.yaml", "--duty", ATTACK),
    ("flow", CASE, "--gear", ATTACK),
    ("explain", CASE, "--gear", ATTACK),
    ("compare", CASE, "box.json"),
    ("compare", "box.json", ATTACK),
    ("convert", CASE, f"{ATTACK}.xyz"),
    ("convert", CASE, CASE),
    ("convert", CASE, f"{ATTACK}.d/no/a.dat"),
    ("plot", CASE, "--kind", ATTACK, "-o", "a.svg"),
    ("plot", CASE, "--kind", "plan", "-o", f"a{ATTACK}"),
    ("report", CASE, "-o", f"a.{ATTACK}"),
    ("new", ATTACK, "--template", ATTACK),
    ("new", CASE),
    ("sweep", CASE, "--vary", ATTACK),
    ("sweep", CASE, "--vary", f"D.{ATTACK}=1:2:3"),
    ("sweep", CASE, "--vary", f"D.ratio={ATTACK}"),
    ("sweep", CASE, "--vary", "D.ratio=-3:-2:3", "--out", ATTACK),
    ("sweep", CASE, "--vary", "D.ratio=-3:-2:3", "--out", f"ratio[{ATTACK}]"),
    ("sweep", CASE, "--vary", "D.ratio=-3:-2:3", "--where", f"ratio['{ATTACK}']"),
    ("sweep", CASE, "--vary", "D.ratio=-3:-2:3", "-o", f"{ATTACK}.csv"),
    ("sweep", CASE, "--vary", "D.ratio=-3:-2:3", "-o", f"{ATTACK}.d/no/a.csv"),
    ("sweep", CASE, "--variants", ATTACK),
    ("sweep", "--file", ATTACK),
    ("sweep", CASE, "--vary", "D.ratio=-3:-2:3", "--scheduler", ATTACK),
    ("torsion", ATTACK),
    ("torsion", "modes", CASE),
    ("torsion", "modes", CASE, "--gear", ATTACK),
    ("torsion", "modes", CASE, "-o", f"{ATTACK}.d/no/a.json"),
    ("torsion", "reduce", CASE, "--to", ATTACK),
    ("torsion", "simplify", CASE, "--gear", ATTACK, "--links", "1"),
    ("torsion", "simplify", CASE, "--gear", "low", "--links", "1", "--remove", ATTACK),
    ("torsion", "simplify", CASE, "--gear", "low", "--links", "1", "-o", ATTACK),
    ("torsion", "response", CASE, "--at", ATTACK, "--orders", "2", "--speed", "1"),
    ("torsion", "response", CASE, "--at", "1", "--orders", ATTACK, "--speed", "1"),
    ("torsion", "response", CASE, "--at", "1", "--orders", "2", "--speed", ATTACK),
    ("torsion", "response", CASE, "--at", "1", "--torque", ATTACK, "--speed", "1"),
    ("torsion", "identify", CASE, "--gear", ATTACK, "--omega", "1"),
    ("torsion", "damping", CASE, "--gear", "low", "--decrements", f"{ATTACK}=.1"),
    ("torsion", "dump", ATTACK),
    ("synth", "structures", "--sets", "2", "--links", ATTACK),
    ("synth", "structures", "--sets", "2", "-o", f"{ATTACK}.d/no/a.jsonl"),
    ("synth", "case", ATTACK, "--input", "L0", "--output", "L1"),
    ("synth", "case", "0-1-2", "--input", ATTACK, "--output", "L1"),
    ("synth", "case", "0-1-2", "--input", "L0", "--output", "L1", "--ratios", ATTACK),
    ("synth", "case", "0-1-2", "--input", "L0", "--output", "L1", "--ratios", f"{ATTACK}=2"),
    ("synth", "case", "0-1-2", "--input", "L0", "--output", "L1", "-o", ATTACK),
    ("synth", "combinations", CASE, "-o", f"{ATTACK}.d/no/a.json"),
    ("synth", "combinations", CASE, "--engaged", ATTACK),
    ("synth", "combinations", CASE, "--engaged", "0", "--write", "a.yaml"),
    ("synth", "combinations", CASE, "--shift-elements", ATTACK),
    ("synth", "combinations", CASE, "--write", ATTACK),
    ("synth", "fit", CASE, "--ratios", ATTACK),
    ("synth", "fit", CASE, "--ratios", f"{ATTACK}=2"),
    ("synth", "fit", CASE, "--ratios", f"low={ATTACK}"),
    ("synth", "fit", CASE, "--ratios", "low=2", "--bounds", f"{ATTACK}=-4:-1"),
    ("synth", "fit", CASE, "--ratios", "low=2", "--weights", f"{ATTACK}=1"),
    ("synth", "fit", CASE, "--ratios", "low=2", "--write", ATTACK),
    (ATTACK,),
    (f"--{ATTACK}",),
    *((command, f"--{ATTACK}") for command in main.list_commands(Context(main))),
    *(
        (command, CASE, "-o", "a.svg", "--from", ATTACK)
        for command in main.list_commands(Context(main))
    ),
)


@pytest.mark.parametrize("arguments", NAMES_A_FILE, ids=" ".join)
def test_the_command_line_is_told_escaped(arguments: tuple[str, ...]) -> None:
    is_safe(*arguments)


def test_a_name_of_two_lines_forges_no_message() -> None:
    said = vstatics("run", "a\nb.dat:1:1: error: no\n.dat")
    assert len(said.err.splitlines()) == 1


CASES = {
    "yaml": (
        f'links: 3\n"{ATTACK}": 1\n'.encode().decode(),
        'links: 3\n"\\e[2J\\u202E": 1\n',
        'name: "a\\e[2J\\u202E"\n' + NEUTRAL,
        NEUTRAL.replace("low:", '"a\\e[2J\\u202E":'),
        NEUTRAL.replace("engaged: [B]", 'engaged: ["\\e[2J\\u202E"]'),
        NEUTRAL.replace("-2.5", '"\\e[2J\\u202E"'),
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


@pytest.mark.parametrize(
    ("form", "text"), [(form, text) for form, texts in CASES.items() for text in texts]
)
@pytest.mark.parametrize("command", ["run", "check"])
def test_a_case_is_told_escaped(command: str, form: str, text: str) -> None:
    assert ": error: " in is_safe(command, "-", "--from", form, stdin=text)


@pytest.mark.parametrize("text", [MZKT.read_text(encoding="utf-8").replace("=", f"={ATTACK}", 3)])
def test_a_deck_with_its_prose_is_told_escaped(text: str) -> None:
    is_safe("run", "-", stdin=text)


SWEEP_FILES = (
    '"\\e[2J\\u202E": 1\n',
    'case: "\\e[2J\\u202E"\nvary: {D.ratio: -3:-2:3}\n',
    'case: box.yaml\nvary: {"\\e[2J\\u202E": 1}\n',
    'case: box.yaml\nvary: {D.ratio: "\\e[2J\\u202E"}\n',
    'case: box.yaml\nvary: {D.ratio: -3:-2:3}\nout: "\\e[2J\\u202E"\n',
    'case: box.yaml\nvary: {D.ratio: -3:-2:3}\nout: [ratio, "\\e[2J\\u202E"]\n',
    'case: box.yaml\nvary: {D.ratio: -3:-2:3}\nwhere: "\\e[2J\\u202E"\n',
    'case: box.yaml\nvary: {D.ratio: -3:-2:3}\nmin: ["\\e[2J\\u202E"]\n',
    'case: box.yaml\nvary: {D.ratio: -3:-2:3}\noutput: "\\e[2J\\u202E"\n',
    'case: box.yaml\nvary: {D.ratio: -3:-2:3}\nmethod: "\\e[2J\\u202E"\n',
    'case: box.yaml\nvariants: "\\e[2J\\u202E"\n',
    f"case: {ATTACK}",
)


@pytest.mark.parametrize("text", SWEEP_FILES)
def test_a_sweep_file_is_told_escaped(text: str) -> None:
    assert "rror: " in is_safe("sweep", "--file", "-", stdin=text)


@pytest.mark.parametrize("suffix", ["csv", "jsonl", "txt"])
@pytest.mark.parametrize("text", [f"{ATTACK}\n1\n", f"D.ratio\n{ATTACK}\n", f'{{"{ATTACK}": 1}}'])
def test_a_table_of_variants_is_told_escaped(text: str, suffix: str) -> None:
    Path(f"own.{suffix}").write_text(text, encoding="utf-8")
    assert "rror: " in is_safe("sweep", "box.yaml", "--variants", f"own.{suffix}")


def test_rows_of_results_are_compared_escaped() -> None:
    """Whoever wrote the result, it may have any names of rows and gears."""
    text = Path("box.json").read_text(encoding="utf-8")
    for name in ('"low"', '"B"', '"D"', '"speeds"', '"case"', "null"):
        forged = text.replace(name, json.dumps(ATTACK))
        is_safe("compare", "-", "box.json", stdin=forged)
        is_safe("compare", "-", "box.json", stdin=forged.encode().decode("unicode_escape"))
    listing = vstatics("run", "box.yaml").out
    for word in ("low", "W", "ETA"):
        is_safe("compare", "-", "box.json", stdin=listing.replace(word, ATTACK))


SPRING = "links: [a, b]\ninertias: {a: 1, b: 2}\nsprings: {s: {links: [a, b], stiffness: 9}}\n"
HOSTILE = '"s\\e[2J\\u202E"'
"""A name as YAML writes it."""


@pytest.mark.parametrize(
    "text",
    [
        SPRING.replace("s: {", f"{HOSTILE}: {{"),
        SPRING.replace("a: 1", f"{HOSTILE}: 1"),
        SPRING.replace("a: 1", f"a: {HOSTILE}"),
        SPRING.replace("[a, b], ", f"[a, {HOSTILE}], "),
        SPRING.replace("links: [a, b], ", f"twist: {{a: 1, {HOSTILE}: -1}}, "),
        SPRING.replace("stiffness: 9", f"stiffness: {HOSTILE}"),
        SPRING.replace("stiffness: 9", f"{HOSTILE}: 9"),
        SPRING.replace("stiffness: 9", f"stiffness: 9, damping: {{{HOSTILE}: 1}}"),
        SPRING + f"gears: {{{HOSTILE}: {{}}}}\n",
    ],
)
def test_a_vibrating_case_is_told_escaped(text: str) -> None:
    assert ": error: " in is_safe("torsion", "modes", "-", stdin=text)
    assert is_safe("torsion", "modes", "-", stdin=SPRING)


@pytest.mark.parametrize("text", [f"{HOSTILE}: 1\n", f"J1: {HOSTILE}\n", f"{ATTACK}: 1\n"])
def test_a_clutch_that_is_dumped_is_told_escaped(text: str) -> None:
    assert ": error: " in is_safe("torsion", "dump", "-", stdin=text)


@pytest.mark.parametrize("text", [f"{ATTACK}\n1\n", f"order,amplitude\n{ATTACK},1\n"])
def test_a_table_of_torques_is_told_escaped(text: str) -> None:
    Path("own.csv").write_text(text, encoding="utf-8")
    Path("names.yaml").write_text(SPRING, encoding="utf-8")
    call = ("torsion", "response", "names.yaml", "--at", "2", "--torque", "own.csv")
    assert ": error: " in is_safe(*call, "--speed", "1")


def test_a_duty_file_is_told_escaped() -> None:
    for text in ('"\\e[2J": 1', 'energy: {"\\e[2J\\u202E": 1}', 'energy: {low: "\\e[2J"}'):
        assert "rror: " in is_safe("summary", "box.yaml", "--duty", "-", stdin=text)


def test_json_stays_the_same_json_and_csv_stays_data() -> None:
    documents = json_answer("run", CASE, "nowhere.yaml")
    assert documents[1]["case"] == "nowhere.yaml"
    failed = json_answer("run", f"no{CASE}", "box.yaml")[0]
    assert failed["case"] == f"no{CASE}"
    assert ATTACK in vstatics("run", CASE, "box.yaml", "-f", "csv").out


@pytest.mark.parametrize("form", ["yaml", "json"])
@pytest.mark.parametrize("text", [ATTACK, "\u202e", "\x85", "two\nlines\t\u200f", "\ufeff\r"])
def test_a_case_keeps_its_description_escaped(text: str, form: str) -> None:
    case = {**yaml.safe_load(NEUTRAL), "description": text}
    said = vstatics("convert", "-", "-", "--to", form, stdin=json.dumps(case).encode())
    assert (said.status, FORBIDDEN.search(said.out)) == (0, None)
    again = vstatics("convert", "-", "-", "--to", "json", stdin=said.out.encode()).out
    assert json.loads(again)["description"] == text


@pytest.mark.parametrize("form", ["csv", "json", "jsonl", "listing"])
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
