"""`vstatics synth fit`: what it shows, what it writes, what it is asked for wrongly."""

from pathlib import Path
from typing import Any

import pytest

from tests.commands import CASES, Said, vstatics
from tests.core.cli.test_schemas import validator
from vstatics import load, solve
from vstatics.core.explain.bodies import on_own_links
from vstatics.core.writers.saving import case_data

BELAZ = CASES / "belaz7516.yaml"
GOLDEN = ("--ratios", "2=4.00,4=2.01,R2=-5.12,5=1.4925")


def said(*options: str, case: Path = BELAZ) -> Said:
    return vstatics("synth", "fit", case, *options)


def document(*options: str, case: Path = BELAZ) -> dict[str, Any]:
    made: dict[str, Any] = said(*options, "-f", "json", case=case).json
    assert list(validator("fit").iter_errors(made)) == []
    return made


def test_the_document_has_the_best_solution_and_all(tmp_path: Path) -> None:
    """The ratios by their closed form are those of tests/synthesis/ratios/test_fitting.py."""
    made = document(*GOLDEN)
    assert list(made) == ["ratios", "gears", "residual", "unmet", "solutions"]
    assert made["ratios"]["P3"] == pytest.approx(-3.0, rel=1e-12)
    assert made["residual"] < 1e-12
    assert made["solutions"] == [{key: made[key] for key in list(made)[:4]}]
    assert list(made["gears"]) == ["1", "2", "3", "4", "5", "6", "R1", "R2"]
    apart = ("--ratios", "2=4", "--ratios", "4=201/100, R2=-5.12", "--ratios=5=1.4925")
    assert document(*apart) == made
    file = tmp_path / "box.yaml"
    file.write_text((CASES / "simpson.yaml").read_text("utf-8") + "  N: []\n")
    assert document("--ratios", "1=2.8", case=file)["gears"]["N"] is None


def test_bounds_weights_and_tolerance() -> None:
    options = ("--ratios", "2=4,R2=-5.12", "--bounds", "P3=-2.9:-2,P4=-2.1")
    answer = said(*options, "-f", "json")
    made = answer.json
    assert (answer.status, made["unmet"]) == (1, ["2", "R2"])
    assert (made["ratios"]["P3"], made["ratios"]["P4"]) == (-2.9, -2.1)
    assert made["gears"]["R2"] == pytest.approx(1 - 2.9 * 2.1)
    assert "error: not met: 2 and R2, off by up to 2.53 %" in answer.err
    assert said(*options, "--tolerance", ".03").status == 0
    answer = said("--ratios", "2=4", "--bounds", "P3=-4")
    assert answer.fails("error: not met: 2, off by up to 22.3 %", "the bounds its ratio is 5")
    answer = said("--ratios", "R2=-8")
    assert "the wanted ratios do not determine P1, P2, P3, P4" in answer.err
    assert answer.status == 0
    heavy = document("--ratios", "2=4,4=2.01,3=2.9", "--weights", "3=1000")
    assert abs(heavy["gears"]["3"] - 2.9) < 1e-3


@pytest.mark.parametrize("suffix", ["yaml", "json", "dat"])
def test_the_case_that_is_written_has_the_ratios(suffix: str, tmp_path: Path) -> None:
    file = tmp_path / f"fitted.{suffix}"
    answer = said(*GOLDEN, "--write", str(file))
    assert answer.is_without_messages()
    ratios = dict(zip("123456", solve(load(file)).ratio.tolist(), strict=False))
    assert [ratios["2"], ratios["4"], ratios["5"]] == pytest.approx([4.0, 2.01, 1.4925])


def test_shared_planets_are_written_as_mechanisms(tmp_path: Path) -> None:
    file = tmp_path / "fitted.yaml"
    wanted = "1=4.17,2=2.34,3=1.52,4=1.14,5=0.87,6=0.69,R=-3.40"
    answer = said("--ratios", wanted, "--write", str(file), case=CASES / "ford-6r80.yaml")
    left_out = "planet speeds of rear.small_sun-ring: with these ratios no planet ratio is known"
    assert (answer.status, answer.err) == (0, f"{file}: left out: {left_out}\n")
    targets = [float(one.partition("=")[2]) for one in wanted.split(",")]
    assert solve(load(file)).ratio.tolist() == pytest.approx(targets, rel=5e-3)


def test_planet_ratios_that_are_left_out_are_listed(tmp_path: Path) -> None:
    """That of P1 stays with its ratio; P2 has -1.4, not (K + 1)/2 as a plain set; P3 just that."""
    file, fitted = tmp_path / "box.yaml", tmp_path / "fitted.yaml"
    case = on_own_links(load(BELAZ)).case
    given = {"P1": -0.7, "P2": -1.4, "P3": -1.0}
    mechanisms = [one._replace(planet_ratio=given.get(one.name)) for one in case.mechanisms]
    file.write_bytes(case_data(case.replace(mechanisms=mechanisms), "yaml")[0])
    bounds = ("--bounds", "P4=1.5:4")
    wanted = ("--ratios", "2=4.2,4=2.1,R2=12", *bounds, "--write", str(fitted))
    answer = said(*wanted, case=file)
    assert f"{fitted}: left out: planet_ratio of P2: with these ratios planets turn" in answer.err
    assert f"{fitted}: left out: planet speeds of P4: with these ratios no pl" in answer.err
    assert [one.planet_ratio for one in load(fitted).mechanisms] == [-0.7, None, None, None]
    assert "left out" not in said(*wanted, "-q", case=file).err


def test_the_dry_run_says_what_gears_can_have() -> None:
    """1 - K3 and 1 - K3 K4 with K from -4 to -1.5."""
    made = said("--ratios", "2=4,R2=-5", "--bounds", "all=-4:-1.5", "--dry-run", "-f", "json").json
    assert made["varied"] == {"P3": {"from": -4, "to": -1.5}, "P4": {"from": -4, "to": -1.5}}
    ranges = {name: [*gear.values()] for name, gear in made["gears"].items()}
    assert ranges == {"2": [4, 2.5, 5], "R2": [-5, -15, -1.25]}
    assert "What the gears can have" in said("--ratios", "2=4", "--dry-run").out
    for more in ((), ("--dry-run",)):
        assert "1e-300 " in said("--ratios", "2=1e-300", *more).out


def test_wrong_use_is_reported() -> None:
    for options, message in (
        ((), "Missing option '--ratios'"),
        (("--ratios", "4.70,3.13"), "expected GEAR=RATIO with commas between"),
        (("--ratios", "1=4,70"), "with commas between (and with decimal points)"),
        (("--ratios", "2=four"), "2: read `four`, expected a number or a calculation"),
        (("--ratios", "2=1/0"), "expected a denominator other than 0"),
        (("--ratios", "2=4,2=5"), "2 is given twice"),
        (("--ratios", "2=4", "--ratios", "2=5"), "2 is given twice"),
        (("--ratios", "2=4,02=5"), "no gear `02`; did you mean `2`?; gears are 1, 2, 3, 4"),
        (("--ratios", ""), "expected GEAR=RATIO"),
        (("--ratios", "2=4,9=1"), "Invalid value for --ratios: no gear `9`; gears are 1, 2, 3"),
        (("--ratios", "2=4", "--weights", "8=2"), "Invalid value for --weights: no gear `8`"),
        (("--ratios", "2=4", "--bounds", "P3=-1.5:-4"), "did you mean -4:-1.5?"),
        (("--ratios", "2=4", "--bounds", "P3=-4..-1"), "expected LOW:HIGH, such as -4:-1.5"),
        (("--ratios", "2=4", "--bounds", "-4:-1"), "expected MECHANISM=LOW:HIGH"),
        (("--ratios", "2=4", "--bounds", "P8=-4:-1"), "no mechanism `P8`"),
        (("--ratios", "2=4", "--tolerance", "0"), "--tolerance: read 0, expected a number above 0"),
        (("--ratios", "2=4", "--write", "x.txt"), "cannot determine the format of x.txt"),
        (("--ratios", "2=4", "--write", "x.yaml", "-o", "x.yaml"), "x.yaml"),
        (("--ratios", "2=4", "--write", str(BELAZ)), "would be overwritten"),
        (("--ratios", "2=4", "-o", "x/"), "one case has one output"),
    ):
        answer = said(*options)
        assert answer.is_wrong_use()
        assert message in " ".join(answer.err.split())
