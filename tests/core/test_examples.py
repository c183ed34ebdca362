"""What is shipped, by its names."""

from pathlib import Path

import vstatics
from tests.commands import CASES, ROOT
from tests.rejects import rejects


def test_every_shipped_file_has_a_name_and_yaml_comes_before_a_deck() -> None:
    files = {path.relative_to(CASES).with_suffix("") for path in CASES.rglob("*.*")}
    assert {Path(name) for name in vstatics.example()} == files
    assert vstatics.example("mzkt7922") == vstatics.load(CASES / "mzkt7922.yaml")
    assert vstatics.example("mzkt7922") != vstatics.load(CASES / "mzkt7922.dat")


def test_another_name_is_reported_with_the_nearest() -> None:
    with rejects(vstatics.CaseError, "did you mean `zf-8hp70`? [E800]"):
        vstatics.example("zf-8hp7")


def test_the_citation_is_of_this_version() -> None:
    text = (ROOT / "CITATION.cff").read_text("utf-8")
    assert f"\nversion: {vstatics.__version__}\n" in text
