"""The sweep file: what it says, and where it is wrong."""

from pathlib import Path

import pytest

from tests.commands import vstatics
from tests.sweep.sweeps import CASE_TEXT
from vstatics.core.errors import ReadError
from vstatics.sweep.file import read_sweep_file
from vstatics.sweep.options import SweepOptions

WHOLE = """\
case: box.yaml
vary:
  D.ratio: -4:-2:5
  D.efficiency: [.9, 0.95, 96/100]
zip: false
out: [ratio, "efficiency[low]"]
where: ratio[low] > 3.2
max: efficiency[low]
min: ["ratio[low]", abs(D.ratio)]
best: 7
output: out.csv
format: jsonl
coast: true
idle: published
"""


def read(text: str, file: str = "sweep.yaml") -> SweepOptions:
    return read_sweep_file(text.encode(), file)


def test_every_key_is_read() -> None:
    made = read(WHOLE, "jobs/sweep.yaml")
    assert made.case == "jobs/box.yaml"
    assert made.output == "jobs/out.csv"
    assert [text.text for text in made.vary] == ["D.ratio=-4:-2:5", "D.efficiency=.9,0.95,96/100"]
    told = [text.text for text in (made.out, made.where, *made.min, *made.max) if text]
    expected = ["ratio, efficiency[low]", "ratio[low] > 3.2", "ratio[low]", "abs(D.ratio)"]
    assert told == [*expected, "efficiency[low]"]
    assert (made.zip, made.best, made.format) == (False, 7, "jsonl")
    assert (made.coast, made.idle) == (True, "published")
    other = read("variants: own.csv\nsample: 1_000\nmethod: lhs\nseed: 0\ncase: /a/box.dat\n")
    assert (other.variants, other.case) == ("own.csv", "/a/box.dat")
    assert (other.sample, other.method, other.seed) == (1000, "lhs", 0)
    assert read("vary: [D.ratio=1, D.efficiency=.9]").vary[1].text == "D.efficiency=.9"


def test_what_is_wrong_is_reported_with_its_place() -> None:
    for text, place, words in (
        ("vray: [D.ratio=1]", "1:1", "unknown key `vray`; did you mean `vary`?"),
        ("nothing: 1", "1:1", "unknown key `nothing`, expected `case`"),
        ("out: ratio\nout: ratio", "2:1", "key `out` is given twice"),
        ("zip: yes", "1:6", "read 'yes', expected `true` or `false`"),
        ("sample: 0", "1:9", "read '0', expected a whole number from 1 on"),
        ("best: " + "9" * 5000, "1:7", "of at most 1000 digits"),
        ("seed: -1", "1:7", "a whole number from 0 on"),
        ("method: sobl", "1:9", "did you mean `sobol`?"),
        ("format: xml", "1:9", "expected `csv`, `jsonl`, `npz`, `parquet`, `markdown`, `latex` or"),
        ("best: []", "1:7", "read a list, expected a whole number"),
        ("case: [a]", "1:7", "expected the name of a file"),
        ("where: {a: b}", "1:8", "read a mapping, expected text"),
        ("vary:\n  D.ratio: {a: b}", "2:12", "read a mapping, expected text, a number or a list"),
        ("- a", "1:1", "read a list, expected a sweep"),
        ("", "1:1", "the file is empty, expected a sweep"),
        ("a: [", "1:5", "not YAML"),
        ("{case: a, duration: 6}", "1:1", "this is a scenario, expected a sweep file: `vstatics s"),
        ("{gears: {}}", "1:1", "this is a case, expected a sweep file: `vstatics sweep CASE"),
        ("out: [ratio[1]]", "1:12", "in quotes within a list, such as 'ratio[1]'"),
    ):
        with pytest.raises(ReadError) as caught:
            read(text)
        told = str(caught.value.problems[0])
        assert told.startswith(f"sweep.yaml:{place}: error: ")
        assert words in told


def test_what_is_wrong_in_a_text_is_reported_with_its_place_in_the_file(folder: Path) -> None:
    (folder / "box.yaml").write_text(CASE_TEXT, "utf-8")
    for text, place in {
        "vary: [D.ratio=1, D.ratoi=2]": (2, 21),
        "vary: [D.ratio=1, 'D.ratio=-4:-2:x']": (2, 34),
        "vary:\n  D.ratio: 1\n  X.ratio: 2": (4, 3),
        "vary:\n  D.ratio: -4:-2:x": (3, 18),
        "vary:\n  D.ratio: [1, x]": (3, 16),
        "vary: [D.ratio=2]\nout: [ratio, 'efficiency[lwo]']": (3, 26),
        'vary: [D.ratio=2]\nwhere: "ratio[lwo] > 3"': (3, 15),
        "vary: [D.ratio=2]\nmax:\n  - ratoi": (4, 5),
        "vary:\n  D.ratio: 1\n  '#1.ratio': 2": (4, 4),
        "vary: [D.ratio=2]\nout: |\n  ratio[low],\n  ratio[lwo]": (3, 6),
        "vary: [D.ratio=2]\nout: ratio[low],\n  ratio[lwo]": (3, 6),
        "vary: {D.ratio: 1:30}": (2, 8),
        "vary: [D.ratio=2]\nwhere: >-\n  ratio[low] > 3 and\n  ratio[lwo] > 3": (3, 8),
    }.items():
        (folder / "sweep.yaml").write_text(f"case: box.yaml\n{text}\n", "utf-8")
        said = vstatics("sweep", "--file", "sweep.yaml")
        line, column = place
        first, shown, caret = said.err.splitlines()[:3]
        assert first.startswith(f"sweep.yaml:{line}:{column}: error: ")
        assert shown.strip() == text.splitlines()[line - 2].strip()
        assert (said.status, caret.index("^") - 1) == (1, column)


def test_a_sweep_file_gives_what_the_options_give(folder: Path) -> None:
    (folder / "box.yaml").write_text(CASE_TEXT, "utf-8")
    file = folder / "sub/sweep.yaml"
    file.parent.mkdir()
    text = "case: ../box.yaml\nvary: {D.ratio: '-4:-2:5'}\nout: ratio\noutput: out.csv\n"
    file.write_text(text, "utf-8")
    assert vstatics("sweep", "--file", "sub/sweep.yaml").status == 0
    said = vstatics("sweep", "box.yaml", "--vary", "D.ratio=-4:-2:5", "--out", "ratio")
    assert (folder / "sub/out.csv").read_text("utf-8") == said.out
    said = vstatics("sweep", "--file", "sub/sweep.yaml", "--vary", "D.ratio=-3", "-o", "-")
    assert said.out == "variant,D.ratio,status,ratio[direct],ratio[low]\n0,-3,ok,1,4\n"
    for command in ("check", "run", "explain"):
        said = vstatics(command, file)
        assert (said.status, said.err.count("\n")) == (1, 1)
        assert "this is a sweep file, expected a case; `vstatics sweep --file`" in said.err
    assert "a sweep file by --file" in vstatics("sweep", file).err
