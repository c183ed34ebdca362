"""The options of a sweep: which go together, and which win where several doors say something."""

from pathlib import Path

import pytest

from tests.commands import vstatics
from tests.sweep.sweeps import CASE_TEXT, DIFFERENTIAL
from tests.sweep.test_file import read
from vstatics import sweep
from vstatics.sweep.options import SweepOptions, Text


def test_the_command_line_wins() -> None:
    file = read("vary: [D.ratio=1]\nsample: 5\nout: ratio\nmax: ratio\nbest: 3\ncase: a.yaml")
    vary, table = (Text("D.ratio=2"),), "own.csv"
    assert SweepOptions().over(file) == file
    assert SweepOptions(vary=vary).over(file).vary == vary
    assert SweepOptions(vary=vary).over(file).sample == 5
    merged = SweepOptions(variants=table).over(file)
    assert (merged.case, merged.vary, merged.zip, merged.sample) == ("a.yaml", (), None, None)
    assert SweepOptions(vary=vary).over(read("variants: x.csv")).variants is None
    sampled = read("vary: [D.ratio=1:2]\nsample: 5\nmethod: random\nseed: 3")
    assert SweepOptions(variants=table).over(sampled) == SweepOptions(variants=table)
    merged = SweepOptions(zip=True).over(sampled)
    assert (merged.vary, merged.zip) == (sampled.vary, True)
    assert (merged.sample, merged.method, merged.seed) == (None, None, None)
    assert SweepOptions(sample=2).over(read("vary: [D.ratio=1:2]\nzip: true")).zip is None
    assert SweepOptions(min=vary).over(file).max == ()
    assert SweepOptions(best=4, coast=False).over(file).best == 4


def test_what_excludes_one_another_is_named_as_where_it_was_given(folder: Path) -> None:
    """With quotes as a key of the file, with dashes as an option of the command line."""
    (folder / "box.yaml").write_text(CASE_TEXT, "utf-8")
    text = "case: box.yaml\nvary: [D.ratio=-4:-2]\nzip: true\nsample: 3\n"
    (folder / "sweep.yaml").write_text(text, "utf-8")
    said = vstatics("sweep", "--file", "sweep.yaml")
    assert said.is_wrong_use("`zip` and `sample` exclude one another.")
    (folder / "best.yaml").write_text("case: box.yaml\nvary: [D.ratio=2]\n", "utf-8")
    said = vstatics("sweep", "--file", "best.yaml", "--best", "3")
    assert "--best needs --min or --max: the best by what?" in said.err
    said = vstatics("sweep", "box.yaml", "--vary", "D.ratio=1:2", "--zip", "--sample", "3")
    assert "--zip and --sample exclude one another." in said.err


def test_the_call_names_its_own_arguments() -> None:
    with pytest.raises(ValueError, match=r"^zip and sample exclude one another$"):
        sweep(DIFFERENTIAL, "D.ratio=1:2", zip=True, sample=3)
    with pytest.raises(ValueError, match=r"^variants is a table of all .* vary, zip and sample$"):
        sweep(DIFFERENTIAL, sample=3, variants={"D.ratio": [-2]})
