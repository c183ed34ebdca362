"""What is varied of what is elastic or heavy: its names, and what is said of wrong ones."""

from itertools import permutations

import pytest

from tests.installed import needs
from tests.sweep.sweeps import DIFFERENTIAL
from vstatics import Damping, Gear, Mechanism, ReadError, ShiftElement, Spring, Transmission, loads
from vstatics.sweep import sweep
from vstatics.sweep.variants.path_numbers import case_path, known_paths
from vstatics.sweep.variants.targets import target

CASE = Transmission(
    4,
    [ShiftElement(2, 3, name="C", stiffness=5e4), ShiftElement(3, 0, name="B")],
    [Mechanism(2, 3, 4, -2.5, name="P"), Mechanism(1, 2, 0, -2.0, name="1", stiffness=9e4)],
    [Gear([1])],
    springs=[
        Spring({1: 1, 4: -1}, compliance=84e-5, damping=3.2, name="input shaft"),
        Spring({4: 1}, stiffness=474.0, damping=Damping(loss_factor=0.1), name="tyre"),
    ],
    inertias={1: 0.15},
    link_names=("engine", "sun", "ring", "P.x"),
)
"""Devices: C, B, P, 1, input shaft, tyre."""
ELASTIC = "C, 1, input shaft, tyre"


def test_a_number_is_named_as_the_case_names_it() -> None:
    for text, name, owner, quantity in (
        ("C.stiffness", "C.stiffness", 0, "stiffness"),
        ("tyre.compliance", "tyre.compliance", 5, "compliance"),
        (' "input shaft".damping ', "input shaft.damping", 4, "damping"),
        ("input shaft.damping", "input shaft.damping", 4, "damping"),
        ("1.stiffness", "1.stiffness", 3, "stiffness"),  # a name first, then a number
        ("#1.stiffness", "C.stiffness", 0, "stiffness"),
        ("#5.stiffness", "input shaft.stiffness", 4, "stiffness"),
        ("#1.ratio", "P.ratio", 0, "ratio"),
        ("engine.inertia", "engine.inertia", 0, "inertia"),
        ("P.x.inertia", "P.x.inertia", 3, "inertia"),
        ("2.inertia", "sun.inertia", 1, "inertia"),
        ("#4.inertia", "P.x.inertia", 3, "inertia"),
    ):
        assert target(text, CASE) == (name, owner, quantity)


@pytest.mark.parametrize("number", ["damping", "stiffness", "points", "friction"])
def test_a_spring_with_points_is_found_although_it_cannot_vary(number: str) -> None:
    arc = Spring({1: 1, 4: -1}, points=((-1.0, -9.0), (1.0, 9.0)), damping=4.0, name="arc")
    case = CASE.replace(springs=[*CASE.springs, arc])
    with pytest.raises(ReadError, match="`arc` has no constant `stiffness`, so its numbers cannot"):
        target(f"arc.{number}", case)


def assert_told(column: int, words: str, vary: str, out: str) -> None:
    """Check the one problem of a sweep: its place in `vary`, or else in `out`, and its words."""
    with pytest.raises(ReadError) as caught:
        sweep(CASE, vary, out=out)
    [problem] = caught.value.problems
    assert words in problem.message
    assert problem.place is not None
    text = vary if problem.place.file == "vary" else out
    assert (problem.place.column, problem.place.text) == (column, text)


@needs("torsion")
def test_what_is_wrong_is_reported_with_its_column() -> None:
    for text, column, words in (
        ("P.stiffness=1", 1, "`P` has no `stiffness` in the case: give it one, so that it can"),
        ("#2.damping=1", 1, "`#2` has no `stiffness`"),
        ("#7.stiffness=1", 1, "read `#7`, expected the number of a component, #1 to #6"),
        ("tire.stiffness=1", 1, f"no elastic component `tire`, expected one of {ELASTIC}; did you"),
        ("engin.inertia=1", 1, "there is no link `engin`, expected one of engine, sun, ring, P.x;"),
        ("#9.inertia=1", 1, "expected the number of a link, #1 to #4"),
        ("tyre.stifness=1", 6, "expected `stiffness`, `compliance` or `damping`; did you mean `st"),
        ("sun.inerta=1", 5, "read `inerta`, expected `inertia`; did you mean `inertia`?"),
        ("P.stifness=1", 3, "read `stifness`, expected `ratio` or `efficiency`"),
        ("tyre.damping=1", 1, "`tyre` is damped by a ratio or loss factor: give N*m*s/rad to vary"),
        ("tyre=1", 1, "or an elastic component, then `.stiffness`, `.compliance` or `.damping`; o"),
        ("tyre=1", 1, "link, then `.inertia`; did you mean `tyre"),
        ("tyre.stiffness=0:x:3", 18, "read `x`, expected a number"),
        ("tyre.stiffness [kN*m/rad]=4", 6, "expected `stiffness`, `compliance` or `damping` in SI"),
    ):
        assert_told(column, words, text, "omega[1,1]")
    for out, column, words in (
        ("omega[0,1]", 7, "read `0`, expected the number of a mode, 1 to 4"),
        ("omega[tyre,1]", 7, "read `tyre`, expected the number of a mode"),
        ("omega[5]", 7, "read `5`, expected the number of a mode, 1 to 4"),
        ("omega[1,9]", 9, "there is no gear `9`"),
        ("omega[1,1,1]", 11, "read too many parts, expected omega[mode, gear]"),
        ("omga[1]", 1, "there is no table `omga`; did you mean `omega`?"),
        ("omega*speeds", 6, "`omega` has one value per mode and `speeds` one per link"),
    ):
        assert_told(column, words, "tyre.stiffness=1", out)
    with pytest.raises(ReadError, match="`omega > 1` has one value per mode and gear: pick a mode"):
        sweep(CASE, "tyre.stiffness=1", where="omega > 1")


@needs("torsion")
def test_a_case_without_vibration_has_no_such_numbers() -> None:
    for text, words in (
        ("D.stiffness", "the case has nothing that is elastic, so there is no stiffness to vary"),
        ("1.inertia", "the case has no inertias, and nothing that is elastic, so there is no"),
    ):
        with pytest.raises(ReadError, match=words):
            target(text, DIFFERENTIAL)
    with pytest.raises(ReadError, match="no natural mode in any gear, so `omega` does not exist"):
        sweep(DIFFERENTIAL, "D.ratio=-2,-3", out="omega[1,1]")
    text = "links: 2\ninertias: {1: 0.2}\nsprings: {s: {links: [1, 2], stiffness: 5}}\n"
    with pytest.raises(ReadError, match="give inertias, and springs or a stiffness"):
        sweep(loads(text), "s.stiffness=1", out="omega")


def test_a_stiffness_and_its_compliance_are_one_number() -> None:
    with pytest.raises(ReadError, match=r"tyre\.compliance is varied twice"):
        sweep(CASE, ["tyre.stiffness=1", "tyre.compliance=1"])
    with pytest.raises(ReadError, match="expected each number once"):
        sweep(CASE, {"#6.stiffness": [1.0], "tyre.stiffness": [2.0]})
    out = 'tyre.compliance, C.compliance*5e4, "input shaft".compliance, "input shaft".stiffness'
    (made,) = sweep(CASE, {"tyre.stiffness": [4.0]}, out=out)
    assert made.columns.tolist() == [[0.25, 1.0, 84e-5, 1 / 84e-5]]


def test_each_path_of_a_case_is_its_number_whatever_its_names_are() -> None:
    """Quotes, brackets and dots in names are no signs of a path."""
    names = ['"P"', "top's", "C'1", "out [rpm]", '"q" <b>']
    for one, other, third in permutations(names, 3):
        gear = Gear([1], name=one, speeds={2: 0.5}, open_drag={1: 3.0})
        element = ShiftElement(2, 0, name=other)
        mechanism = Mechanism(1, 2, 3, -2.5, name=third)
        case = Transmission(3, [element], [mechanism], [gear], link_names=["in", one, "x"])
        for path in known_paths(case):
            found = case_path(path, case)
            assert found is not None
            assert found.path == path
