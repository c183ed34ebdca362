"""Fatigue strengths of devices: what a case may say of them, read, checked, written again."""

import math
import pickle

import pytest

from vstatics import CaseError, ReadError, Transmission, loads
from vstatics.core.model.checks import doubts
from vstatics.core.model.springs import Spring, between
from vstatics.core.writers.deck_limits import check_deck
from vstatics.core.writers.named import write_json, write_yaml
from vstatics.vehicle.case.fatigue import Fatigue

SHAFT = Fatigue(100e6, 3, 4e6, section_modulus=4e-6)
CASE = """\
inertias: {engine: .15, vehicle: 9}
springs: {shaft: {links: [engine, vehicle], stiffness: 9e4}}
fatigue: {shaft: {%s}}
"""
BARE = "diameter: .04, cycles: 1"
GIVEN = "endurance: 100 MPa, exponent: 3, cycles: 4e6"


def read(keys: str) -> Transmission:
    return loads(CASE % keys, format="yaml")


def test_units_and_defaults() -> None:
    """1 MPa is 1 N/mm^2; a shaft of 42 mm has pi 42^3/16 mm^3 (strength of materials)."""
    shaft = read(f"diameter: 42 mm, {GIVEN}").fatigue["shaft"]
    assert shaft == Fatigue(1e8, 3.0, 4e6, diameter=0.042)
    assert shaft.modulus == pytest.approx(math.pi * 42**3 / 16 * 1e-9)
    assert (shaft.asymmetry, shaft.threshold, shaft.sum) == (0.0, 0.6, 1.0)
    other = "section_modulus: 4 cm^3, endurance: 100 N/mm^2, exponent: 3, cycles: 4e6"
    assert Fatigue.of(read(other))["shaft"].modulus == pytest.approx(4e-6)


def test_an_endurance_without_its_unit_is_noted() -> None:
    """Source: a limit of 1000 for 1000 MPa in github.com/boschresearch/pylife/issues/21."""
    for endurance, noted in (("1000", ["N205"]), ("1000 MPa", [])):
        case = read(f"{BARE}, exponent: 5, endurance: {endurance}")
        assert [doubt.id for doubt in doubts(case)] == noted


def test_written_and_read_it_is_the_same() -> None:
    case = read(f"section_modulus: 4e-6, {GIVEN}, asymmetry: .1, threshold: 0, sum: .7")
    assert loads(write_yaml(case), format="yaml") == case
    assert loads(write_json(case), format="json") == case
    assert pickle.loads(pickle.dumps(case)) == case  # noqa: S301 - our own
    with pytest.raises(CaseError, match="the fatigue strength of shaft"):
        check_deck(case)


def test_what_is_wrong_is_reported_where_it_stands() -> None:
    for keys, identity, at in (
        (f"diameter: .04, section_modulus: 4e-6, {GIVEN}", "E881", "shaft"),
        (GIVEN, "E881", "shaft"),
        (f"{BARE}, endurance: 0, exponent: 3", "E255", "0, exp"),
        (f"{BARE}, endurance: 1, exponent: -3", "E255", "-3"),
        (f"{GIVEN[:-3]}0, diameter: .04", "E255", "0, dia"),
        (f"diameter: .04, {GIVEN}, asymmetry: -1", "E216", "-1"),
        (f"diameter: .04, {GIVEN}, threshold: .inf", "E125", ".inf"),
        (f"diameter: 4 cm^2, {GIVEN}", "E124", "4 cm"),
        (f"{BARE}, endurance: 1e8", "E191", "shaft"),
    ):
        with pytest.raises(ReadError) as caught:
            read(keys)
        [problem] = caught.value.problems
        assert problem.id == identity
        assert problem.place
        line = (CASE % keys).splitlines()[2]
        assert problem.place[1:3] == (3, line.index(at) + 1)


def test_a_device_that_there_is_not() -> None:
    """A spring without a name has the one that it gets."""
    case = CASE.replace("fatigue: {shaft", "fatigue: {shafd") % f"diameter: .04, {GIVEN}"
    with pytest.raises(ReadError, match=r"no component `shafd`; did you mean `shaft`\?") as caught:
        loads(case, format="yaml")
    assert [one.id for one in caught.value.problems] == ["E880"]
    set_ = (
        "elements: {P: {kind: planetary, sun: 1, ring: 2, carrier: 3, teeth: {sun: 30, ring: 78}}}"
    )
    strength = "{diameter: 20 mm, endurance: 200 MPa, exponent: 6, cycles: 1e6}"
    with pytest.raises(ReadError, match="a member of a gear set needs `torque` instead of"):
        loads(f"links: 3\n{set_}\ngears: {{1: []}}\nfatigue: {{P.sun: {strength}}}\n")
    spring = Transmission(1, [], [], [], springs=[Spring(between(1), stiffness=1.0)])
    assert [*spring.replace(fatigue={"S1": SHAFT}).fatigue] == ["S1"]
    with pytest.raises(CaseError, match="no component `S2`"):
        spring.replace(fatigue={"S2": SHAFT})
