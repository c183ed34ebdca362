"""`vstatics run`: conventions, and what is printed of good cases and bad ones."""

from __future__ import annotations

import pytest

from tests.commands import CASES, LOCKED, MZKT, json_answer, vstatics
from tests.shipped import PRINTED


@pytest.mark.usefixtures("files")
def test_many_listings_follow_one_another_without_the_bad_one() -> None:
    said = vstatics("run", "neutral.yaml", "bad.yaml", MZKT)
    apart = [f"==> {name} <==\n{vstatics('run', name).out}" for name in ("neutral.yaml", MZKT)]
    assert (said.status, said.out) == (1, "\n".join(apart))
    assert said.err.count("bad.yaml:3:") == 1


@pytest.mark.usefixtures("files")
@pytest.mark.parametrize("form", ["listing", "json", "csv"])
def test_a_bad_case_alone_prints_nothing_on_stdout(form: str) -> None:
    said = vstatics("run", "bad.yaml", "-f", form)
    assert said.gives_nothing()
    said = vstatics("run", "bad.yaml", "nowhere.dat", "-f", form)
    assert said.status == 1
    assert bool(said.out) == (form != "listing")


def test_coasting_turns_the_reverse_gears_of_the_published_train() -> None:
    """.9014 and .9212, and locked where 1/6 of the power would have to pass: the method."""
    driven = json_answer("run", MZKT, "--coast")
    assert driven["efficiency"][4:] == pytest.approx([0.9014, 0.9212], abs=5e-5)
    assert driven["case"]["coast"] is True
    said = vstatics("run", CASES / "self-locking.yaml", "--coast", "-f", "json")
    assert said.json["locked"][0] is True
    case = LOCKED.replace("links: 3", "links: 3\ncoast: true").encode()
    assert json_answer("run", "-", stdin=case)["locked"] == [False]
    said = vstatics("run", "-", "--drive", "-f", "json", stdin=case)
    assert said.json["locked"] == [True]


@pytest.mark.parametrize(("idle", "signs"), [("published", PRINTED["IX"][2]), ("exact", None)])
def test_idle_convention_is_overridden(idle: str, signs: list[int] | None) -> None:
    """D3 turns as one piece in gears 3, 4 and 6; `exact` has 0 there."""
    said = vstatics("run", MZKT, "--unloaded", idle, "-f", "json")
    assert said.json["power_sign"][2] == (signs or [1, 1, 0, 0, 1, 0])
