"""Files of spectra, and the command that takes them."""

from pathlib import Path

import pytest

from tests.commands import vstatics
from tests.rejects import rejects
from vstatics.core.errors import ReadError
from vstatics.torsion.random.spectra import Correlation, SpectrumPoints
from vstatics.torsion.random.spectrum_file import read_spectrum

CASE = """links: [road, mass]
inertias: {mass: 400}
springs: {strut: {links: [road, mass], stiffness: 20e3, damping: 1500}}
"""
ROAD = "{variance: 1e-4, correlation: [[1, .3, .8]], speed: 36 km/h}"


@pytest.fixture(autouse=True)
def _files(folder: Path) -> None:
    (folder / "case.yaml").write_text(CASE, "utf-8")
    (folder / "road.yaml").write_text(ROAD, "utf-8")


def test_numbers_may_have_units() -> None:
    assert read_spectrum(ROAD.encode(), "road.yaml") == Correlation(1e-4, ((1, 0.3, 0.8),), 10)
    points = read_spectrum(b"points: [[0, 1], [2 rad/s, 3]]", "input.yaml")
    assert points == SpectrumPoints(((0.0, 1.0), (2.0, 3.0)))


def test_a_fault_is_reported_at_its_place() -> None:
    for text, place, message in (
        ("{}", "1:1", "read none of them, expected one of"),
        ("{white: 1, points: [[0, 1], [1, 2]]}", "1:1", "read `white` and `points`"),
        ("{white: 1, speed: 3}", "1:1", "read `speed` with `white`"),
        ("{correlation: [[1, 2, 3]]}", "1:1", "`variance` is missing"),
        ("{white: -1}", "1:9", "read -1, expected a spectrum of 0 or more"),
        ("{white: x}", "1:9", "expected a number"),
        ("{variance: -1, correlation: [[1, 2, 3]]}", "1:12", "a variance of 0 or more"),
        ("{variance: 1, correlation: [[.5, 2, 3]]}", "1:28", "shares add up to 0.5, expected 1"),
        ("{variance: 1, correlation: [[2, 1, 0], [-1, 2, 0]]}", "1:41", "a share of 0 or more"),
        ("{variance: 1, correlation: [[1, 0, 3]]}", "1:33", "an alpha above 0"),
        ("{variance: 1, correlation: [[1, 2, 3]], speed: 0}", "1:48", "a speed above 0"),
        ("{variance: 1, correlation: [[1, 2, 3]], speed: 3 N}", "1:48", "expected a velocity"),
        ("{points: [[0, 1]]}", "1:10", "at least two points"),
        ("{points: [[0, 1], [1, -2]]}", "1:23", "a spectrum of 0 or more at a point"),
        ("{points: [[-1, 1], [1, 2]]}", "1:12", "an omega of 0 or more"),
        ("{points: [[1, 1], [1, 2]]}", "1:20", "an omega above 1"),
    ):
        with rejects(ReadError, f"input.yaml:{place}: ", message):
            read_spectrum(text.encode(), "input.yaml")


def test_a_road_in_numbers() -> None:
    """Rms of the twist .013981935 m; its rate has no variance, as the damper passes jumps.

    The road itself has the root of its variance, 0.01 m.
    """
    asked = ("torsion", "random", "case.yaml", "--at", "road", "--by", "motion")
    said = vstatics(*asked, "--input", "road.yaml", "--omega", "1:5:2", "-f", "json")
    [gear] = said.json["gears"]
    assert gear["devices"]["strut"]["twist_rms"] == pytest.approx(0.013981935, rel=1e-7)
    assert gear["devices"]["strut"]["twist_rate_rms"] is None
    assert gear["spectrum"]["omega"] == [1, 5]
    assert [*gear["links"]] == ["road", "mass"]
    assert gear["links"]["road"]["rms"] == pytest.approx(0.01, rel=1e-12)
    for form in ("text", "csv", "markdown"):
        assert vstatics(*asked, "--input", "road.yaml", "-f", form).status == 0


def test_wrong_use() -> None:
    for options, why in (
        (("--at", "rod"), "no link 'rod'; did you mean `road`"),
        (("--at", "road", "--by", "angle"), "'angle' is not one of"),
        (("--at", "mass", "--speed-ratio", "TC=.6"), "no converter 'TC'"),
        (("--at", "mass", "--speed-ratio", "TC"), "the name of a converter and a number"),
        (("--at", "mass", "--omega", "x"), "Invalid value for --omega"),
    ):
        said = vstatics("torsion", "random", "case.yaml", "--input", "road.yaml", *options)
        assert said.is_wrong_use(why), options
