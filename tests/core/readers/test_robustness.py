"""Broken, hostile and enormous input: told in words, soon, and without much memory."""

from __future__ import annotations

import os
import re
import resource
import subprocess
import sys
from pathlib import Path
from random import Random

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from tests.chance import count
from tests.commands import CASES, MZKT, ROOT, environment, vstatics
from tests.core.cli.test_springs import BOX, DRAWN, FOUR

SECONDS = 2
MEMORY = 500 * 2**20
"""Address space; numpy and its threads reserve most of it."""

DECKS = [MZKT.read_bytes(), vstatics("run", CASES / "power-split.yaml").out.encode()]
YAMLS = [
    (CASES / name).read_bytes()
    for name in ("differential.yaml", "power-split.yaml", "mzkt7922.yaml")
] + [text.encode() for text in (BOX, DRAWN, FOUR)]
JSONS = [vstatics("convert", MZKT, "-", "--to", "json").out.encode()]

PIECES = (
    *(b"0", b"-1", b"1", b"7", b"1e308", b"1e-308", b"1e999999999", b"999999999", b"nan", b"1/0"),
    *(b"9" * 400, b"6*0", b"1000000000*0", b".", b",", b" ", b"\n", b"\t", b"\r", b"\0", b"\xff"),
    *(b"\xd0", b"(", b")", b"=", b":", b"[", b"]", b"{", b"}", b"- ", b"&a ", b"*a", b"'", b'"'),
    *(b"#", b"housing", b"KJG= 3", b"NAME P1: x", b"!!int ", b"<<: ", b"---", b"null", b"true"),
)
TOKEN = re.compile(rb"[A-Za-z_]+|[-+.0-9eE]+|\s+|.", re.DOTALL)


@st.composite
def mutated(draw: st.DrawFn, good: list[bytes]) -> bytes:
    """A good text, of which some words are cut out, doubled, moved or replaced."""
    tokens = TOKEN.findall(draw(st.sampled_from(good)))
    for _ in range(draw(st.integers(1, 4))):
        place = draw(st.integers(0, max(len(tokens) - 1, 0)))
        match draw(st.sampled_from(("replace", "insert", "delete", "double", "swap", "cut"))):
            case "replace":
                tokens[place : place + 1] = [draw(st.sampled_from(PIECES))]
            case "insert":
                tokens.insert(place, draw(st.sampled_from(PIECES)))
            case "delete":
                del tokens[place : place + draw(st.integers(1, 12))]
            case "double":
                tokens[place:place] = tokens[place : place + draw(st.integers(1, 40))]
            case "swap":
                other = draw(st.integers(0, max(len(tokens) - 1, 0)))
                if tokens:
                    tokens[place], tokens[other] = tokens[other], tokens[place]
            case _:
                del tokens[place:]
    return b"".join(tokens)


def assert_read_or_refused(data: bytes, form: str) -> None:
    """Both commands end in a status and words; an exception would pass through."""
    checked = vstatics("check", "-", "--from", form, stdin=data)
    assert checked.status in (0, 1)
    for output in ("listing", "json", "csv"):
        run = vstatics("run", "-", "--from", form, "-f", output, stdin=data)
        assert run.status == checked.status
        if b"nan" not in data:  # a name may be that
            assert "nan" not in run.out.lower()
        assert run.status == 0 or re.search(r"(?m)^<stdin>:\d+:\d+: error: ", run.err)


@pytest.mark.slow
@settings(max_examples=count(20, 150))
@given(mutated(DECKS))
@example(b"")
@example(b"KJG=")
@example(b"KJG=1000000000 KL=1000000000 KG=1000000000\nNP=1000000000")
def test_no_deck_ends_in_a_traceback(data: bytes) -> None:
    assert_read_or_refused(data, "deck")


@pytest.mark.slow
@settings(max_examples=count(20, 150))
@given(mutated(YAMLS))
@example(b"")
@example(b"links: 1000000000\nmechanisms: {}\ngears: {a: {}}")
def test_no_yaml_ends_in_a_traceback(data: bytes) -> None:
    assert_read_or_refused(data, "yaml")


@pytest.mark.slow
@given(mutated(JSONS))
def test_no_json_ends_in_a_traceback(data: bytes) -> None:
    assert_read_or_refused(data, "json")


@pytest.mark.slow
@settings(max_examples=count(20, 150))
@given(st.binary(max_size=200) | mutated([*DECKS, *YAMLS, *JSONS]))
def test_nothing_at_all_ends_in_a_traceback(data: bytes) -> None:
    assert vstatics("check", "-", stdin=data).status in (0, 1)
    assert vstatics("compare", "-", MZKT, stdin=data).status == 1


def laughs(levels: int) -> str:
    """Aliases that would make 9**levels values."""
    lines = ["links: 3", "a0: &a0 [x, x]"]
    lines += [f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 9)}]" for n in range(1, levels)]
    return "\n".join(lines)


DECK = MZKT.read_text(encoding="utf-8")
YAML = (CASES / "differential.yaml").read_text(encoding="utf-8")
HOSTILE: dict[str, tuple[str, bytes]] = {
    "huge count of links": ("deck", DECK.replace("KJG= 6", "KJG=1000000000").encode()),
    "huge count of elements": ("deck", DECK.replace("KL= 5", "KL=1000000000").encode()),
    "huge count of gears": ("deck", DECK.replace("N P=  6", "NP=1000000000").encode()),
    "huge repeat count": ("deck", DECK.replace("2 2 2 2 2 2", "1000000000*2").encode()),
    "huge count engaged": ("deck", DECK.replace("2 2 2 2 2 2", "2 2 2 2 2 1000000000").encode()),
    "huge ratio in a deck": ("deck", DECK.replace("-.8000Е+00", "1e999999999").encode()),
    "number of a million digits": ("deck", DECK.replace("-.8000Е+00", "9" * 10**6).encode()),
    "many words": ("deck", b"KJG= " + b"1 " * 200_000),
    "many fields": ("deck", b"IAB(I),I=1,KG: 1\n" * 10_000),
    "blanks without end": ("deck", b"N" + b" " * 10**6 + b"P= 1"),
    "brackets in a deck": ("deck", b"NZD(" * 200_000),
    "huge links in YAML": ("yaml", YAML.replace("[1, 2]", "[1, 1000000000]").encode()),
    "many links in YAML": ("yaml", b"links: 1000000000\nmechanisms: {}\ngears: {a: {}}"),
    "huge ratio in YAML": ("yaml", YAML.replace("-2.5", "1e999999999").encode()),
    "fraction of huge numbers": ("yaml", YAML.replace("-2.5", "9" * 10**5 + "/3").encode()),
    "a huge twist": ("yaml", FOUR.replace("b: 2", "b: 1e999").encode()),
    "a spring of many links": ("yaml", FOUR.replace("[a, b]", f"[{'a, ' * 10**5}]").encode()),
    "a stiffness of huge numbers": ("yaml", FOUR.replace("8}", "9" * 10**5 + "/3}").encode()),
    "a unit of a spring without end": (
        "yaml",
        FOUR.replace("stiffness: 8", f"stiffness: 8 {'N*' * 10**5}m").encode(),
    ),
    "brackets in a unit": (
        "yaml",
        FOUR.replace("stiffness: 8", f"stiffness: 8 {'(' * 39}").encode(),
    ),
    "powers of powers": ("yaml", f'load: {{torque: "1 N*m^3^3^3^3"}}\n{YAML}'.encode()),
    "powers of numbers": ("yaml", YAML.replace("-2.5", "10**10**10").encode()),
    "a unit without end": ("yaml", f"load: {{speed: 1 {'N*' * 10**6}m}}\n{YAML}".encode()),
    "brackets in a number": ("yaml", YAML.replace("-2.5", f"'{'(' * 10**6}1'").encode()),
    "a sum without end": ("yaml", YAML.replace("-2.5", "1+" * 10**6 + "1").encode()),
    "a link without end": (
        "yaml",
        YAML.replace("[F]", f"[F], speeds: {{2: {'1*' * 10**6}x}}").encode(),
    ),
    "a long line in YAML": ("yaml", b"description: " + b"x" * 10**7),
    "a long line in JSON": ("json", b'{"description": "' + b"x" * 10**7),
    "a long line in a deck": ("deck", b"KJG= " + b"9" * 10**7),
    "aliases that blow up": ("yaml", laughs(40).encode()),
    "brackets in YAML": ("yaml", b"[" * 200_000),
    "braces in YAML": ("yaml", b"{a: " * 200_000),
    "dashes in YAML": ("yaml", b"- " * 200_000),
    "brackets in JSON": ("json", b"[" * 200_000 + b"]" * 200_000),
    "objects in JSON": ("json", b'{"a":' * 200_000),
    "huge ratio in JSON": ("json", b'{"links": 1e999999999, "mechanisms": {}, "gears": {}}'),
    "random bytes": ("deck", Random(1).randbytes(10**6)),  # noqa: S311
    "zeros": ("yaml", bytes(10**6)),
    "empty": ("deck", b""),
}


def of_children() -> float:
    """Seconds of the processor that all processes waited for have had; a busy machine adds none."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def limited() -> None:
    """For the process that is tried only: no more memory than this."""
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


@pytest.mark.slow
@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_input_is_refused_soon_and_in_little_memory(name: str, tmp_path: Path) -> None:
    form, data = HOSTILE[name]
    (tmp_path / "case").write_bytes(data)
    begin = of_children()
    done = subprocess.run(
        [sys.executable, "-m", "vstatics", "run", "case", "--from", form],
        capture_output=True,
        check=False,
        cwd=tmp_path,
        env=environment(OPENBLAS_NUM_THREADS="1"),
        preexec_fn=limited,
        timeout=60,
    )
    seconds = of_children() - begin
    assert (done.returncode, done.stdout) == (1, b"")
    assert re.match(rb"case:\d+:\d+: error: ", done.stderr), done.stderr[-2000:]
    assert b"Traceback" not in done.stderr
    assert len(done.stderr) < 10_000 + 10 * len(data)
    assert seconds < SECONDS


@pytest.mark.slow
@pytest.mark.parametrize("command", ["run", "check", "convert", "compare"])
@pytest.mark.parametrize("path", [".", "nowhere.dat", "/dev/null", "x/y.yaml"])
def test_what_is_no_file_is_told(command: str, path: str, tmp_path: Path) -> None:
    more = {"convert": [tmp_path / "new.yaml"], "compare": [MZKT]}.get(command, [])
    said = vstatics(command, path, *more)
    is_mixed = command == "compare" and path == "."  # a directory beside a file is wrong use
    if is_mixed:
        assert said.is_wrong_use()
        return
    assert said.gives_nothing()
    assert said.err.startswith(f"{path}:")
    assert " error: " in said.err


@pytest.mark.slow
def test_a_pipe_that_closes_in_the_middle_of_a_case_is_a_case_cut_off() -> None:
    read, write = os.pipe()
    with subprocess.Popen(
        [sys.executable, "-m", "vstatics", "run", "-"],
        stdin=read,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        cwd=ROOT,
        env=environment(),
    ) as running:
        os.close(read)
        os.write(write, MZKT.read_bytes()[:1500])
        os.close(write)
        out, err = running.communicate(timeout=30)
    assert (running.returncode, out) == (1, b"")
    assert err.startswith(b"<stdin>:")
    assert b"Traceback" not in err
