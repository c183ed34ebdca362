"""Hostile and enormous input: told in words, soon, and without much memory.

Broken input is the business of `tests/fuzz.py`.
"""

import re
import resource
import subprocess
import sys
from pathlib import Path
from random import Random

import pytest

from tests.commands import CASES, MZKT, environment, vstatics
from tests.core.readers.named.test_springs import ISSUE

SECONDS = 2
MEMORY = 500 * 2**20
"""Address space; numpy and its threads reserve most of it."""


def shared(number: int) -> str:
    """As many gears as shift elements, each of which engages all of them by an alias."""
    elements = "".join(f"  e{n}: [1, 0]\n" for n in range(number))
    gears = "".join(f"  g{n}: {{engaged: *all}}\n" for n in range(number))
    engaged = ", ".join(f"e{n}" for n in range(number))
    return f"links: 2\nshift_elements:\n{elements}all: &all [{engaged}]\ngears:\n{gears}"


MANY = ", ".join(f"e{n}" for n in range(20_000))
DECK = MZKT.read_text("utf-8")
YAML = (CASES / "differential.yaml").read_text("utf-8")
HOSTILE: dict[str, tuple[str, str | bytes]] = {
    "huge count of links": ("deck", DECK.replace("KJG= 6", "KJG=1000000000")),
    "huge count of gears": ("deck", DECK.replace("N P=  6", "NP=1000000000")),
    "huge repeat count": ("deck", DECK.replace("2 2 2 2 2 2", "1000000000*2")),
    "number of a million digits": ("deck", DECK.replace("-.8000Е+00", "9" * 10**6)),
    "many words": ("deck", "KJG= " + "1 " * 200_000),
    "many wrong values": ("deck", "KJG= 9 KL= 5000 KG= 0 NP= 1\nNZF(I,1): " + "1x " * 5000),
    "many faults": ("deck", "KJG= 9 KL= 9000 KG= 9000 NP= 9000\nIAB: 9000*0\nNFRI: 9000*77\n"),
    "brackets": ("deck", f"KJG= 9 KL= {'=' * 30000}\nIAB({'(' * 300_000}" + "\n" * 30000),
    "indices without end": ("deck", "IAB(I)" + " " * 100_000 + "x\nNZF(I,1)" + ",I=1,KL" * 30000),
    "names given again": ("deck", "NAME J1: a\n" * 20_000 + "KJG= 5\n" + "ABC= 1\n" * 20_000),
    "blanks without end": ("deck", "N" + " " * 10**6 + "P= 1"),
    "fraction of huge numbers": ("yaml", YAML.replace("-2.5", "9" * 10**5 + "/3")),
    "a spring of many links": ("yaml", ISSUE.replace("[wheel, vehicle]", f"[{'a, ' * 10**5}]")),
    "a unit of a spring without end": ("yaml", ISSUE.replace("474", f"8 {'N*' * 10**5}m")),
    "a unit without end": ("yaml", f"load: {{speed: 1 {'N*' * 10**6}m}}\n{YAML}"),
    "a link without end": ("yaml", YAML.replace("[F]", f"[F], speeds: {{2: {'1*' * 10**6}x}}")),
    "a long line in YAML": ("yaml", "description: " + "x" * 9_900_000),
    "a long line in JSON": ("json", '{"description": "' + "x" * 9_900_000),
    "a long line in a deck": ("deck", "KJG= " + "9" * 9_900_000),
    "engaged by all gears": ("yaml", shared(5_000)),
    "unknown keys": ("yaml", "".join(f"key{n}: 1\n" for n in range(20_000))),
    "huge count of links with strengths": (
        "yaml",
        "links: 1000000000\nmechanisms: {D: {first: 1, second: 2, ratio: 2}}\ngears: {1: []}\n"
        "fatigue: {D: {diameter: 50 mm, endurance: 100 MPa, exponent: 6, cycles: 4e6}}",
    ),
    "unknown elements": ("yaml", f"links: 2\nmechanisms: {{}}\ngears: {{1: [{MANY}]}}"),
    "the same key": ("yaml", "links: 3\n" * 20_000),
    "no mechanisms": ("yaml", "mechanisms:\n" + "".join(f"  m{n}: 1\n" for n in range(5_000))),
    "a long key": ("yaml", "? " + "k" * 1_000_000 + "\n: 1\n"),
    "the same key in JSON": ("json", '{"a": ' + '{"b": 1, ' * 10 + '"c": 1, ' * 20_000),
    "random bytes": ("deck", Random(1).randbytes(10**6)),  # noqa: S311
    "zeros": ("yaml", bytes(10**6)),
    "empty": ("deck", ""),
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
    form, text = HOSTILE[name]
    data = text.encode() if isinstance(text, str) else text
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
def test_what_is_no_file_is_reported(command: str, tmp_path: Path) -> None:
    more = {"convert": [tmp_path / "new.yaml"], "compare": [MZKT]}.get(command, [])
    for path in ("nowhere.dat", "/dev/null", "x/y.yaml"):
        said = vstatics(command, path, *more)
        assert said.gives_nothing(" error: ")
        assert said.err.startswith(f"{path}:")
