"""What is varied and over which values: the texts of --vary."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.sweep.sweeps import CASE
from vstatics.core.errors import Place, ReadError
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.readers.named.nodes import MOST_PROBLEMS
from vstatics.sweep.variants.targets import target
from vstatics.sweep.variants.variation import DrawnNumbers, Span, read_variation


def read(text: str) -> Floats:
    """The values of a text for D1.ratio."""
    values = read_variation(f"D1.ratio={text}", CASE).values
    assert not isinstance(values, Span | DrawnNumbers)
    return values[np.arange(len(values))]


def refusal(text: str) -> tuple[int, str]:
    """The column of the first problem, and all messages."""
    with pytest.raises(ReadError) as caught:
        read_variation(text, CASE)
    problems = caught.value.problems
    place = problems[0].place
    assert place is not None
    assert (place.file, place.line, place.text) == ("--vary", 1, text)
    return place.column, "\n".join(problem.message for problem in problems)


def test_a_number_is_named_as_the_case_names_it() -> None:
    for text, name, index, quantity in (
        ("D1.ratio", "D1.ratio", 0, "ratio"),
        (" #1.efficiency ", "D1.efficiency", 0, "efficiency"),
        ("2.ratio", "D.2=x.ratio", 1, "ratio"),
        ("1.ratio", "1.ratio", 2, "ratio"),  # a name first, then a number
        ("#3.ratio", "1.ratio", 2, "ratio"),
        ("D.2=x.ratio", "D.2=x.ratio", 1, "ratio"),
        ('"D.2=x".ratio', "D.2=x.ratio", 1, "ratio"),
    ):
        assert target(text, CASE) == (name, index, quantity)
        assert read_variation(f"{text}=1,2", CASE).target == target(text, CASE)
    with pytest.raises(ReadError, match="has no mechanisms"):
        target("D1.ratio", Transmission(2, [], [], [Gear()]))


def test_values() -> None:
    for text, values in {
        ".95,.97,.98": [0.95, 0.97, 0.98],
        " .95 , -96/39 ": [0.95, -96 / 39],
        "-96/39*1.02,(2+3)*-1": [-96 / 39 * 1.02, -5.0],
        "-2.5": [-2.5],
        "1:2:3": [1, 1.5, 2],
        "2:1:3": [2, 1.5, 1],
        " 1 : 2 : 3 ": [1, 1.5, 2],
        "1:1:1": [1],
        "1:1:3": [1, 1, 1],
        "0:1/3:2": [0, 1 / 3],
        "1:2:step=.25": [1, 1.25, 1.5, 1.75, 2],
        "1:2:step=0.3": [1, 1.3, 1.6, 1.9],
        "2:1: step = -0.5": [2, 1.5, 1],
        "1:1:step=0.5": [1],
        "0:1:step=1/3": [0, 1 / 3, 2 / 3, 1],  # 1/3 is not a double; the end is hit
        "0:1:step=5": [0],
        "-6/2:-4/2:step=1/4": [-3, -2.75, -2.5, -2.25, -2],
        "0,1,-inf,+INF": [0, 1, -math.inf, math.inf],  # no ratio: left to the result
    }.items():
        assert read(text).tolist() == values, text
    assert np.isnan(read("nan,-nan")).all()
    for text in ("-0.9:-0.7", "-0.7:-0.9"):  # for samples
        assert read_variation(f"D1.ratio={text}", CASE).values == Span(-0.9, -0.7)


def test_what_is_wrong_is_reported_with_its_column() -> None:
    for text, column, words in (
        ("D9.ratio=1", 1, "no mechanism `D9`, expected one of D1, D.2=x, 1"),
        ("  #4.ratio=1", 3, "expected the number of a mechanism, #1 to #3"),
        ("D1.ratoi=1", 4, "expected `ratio` or `efficiency`; did you mean `ratio`?"),
        ("D1ratio=1", 1, "did you mean `D1.ratio`?"),
        (".ratio=1", 1, "expected a mechanism"),
        ("=1", 1, "read nothing, expected a mechanism, then `.ratio`"),
        ("D1.ratio", 9, "read `D1.ratio` without values, expected D1.ratio= and then START:STOP"),
        ("D1.ratio=", 10, "read no values"),
        ("D1.ratio=1,x,3", 12, "read `x`, expected a number or a calculation"),
        ("D1.ratio=1, 1_0,3", 13, "read `1_0`"),
        ("D1.ratio=1,,3", 12, "read nothing, expected a number"),
        ("D1.ratio=+-nan", 10, "read `+-nan`"),
        ("D1.ratio=1/0", 10, "a denominator other than 0"),
        ("D1.ratio=0,7:0,9:3", 10, "with a decimal point"),
        ("D1.ratio=1:nan:3", 12, "read `nan`, expected a number"),
        ("D1.ratio= 1..2", 11, "read `1..2`, expected START:STOP:COUNT"),
        ("D1.ratio=1:2:0.1", 14, "read `0.1`, expected how many values, such as 201, or a step"),
        ("D1.ratio=1:2:9999999999999999999", 14, "expected how many values"),
        ("D1.ratio=1:2:", 14, "read nothing, expected how many values"),
        ("D1.ratio=1:2:1", 14, "read 1, expected at least 2 values: both ends are included"),
        ("D1.ratio=1:2:3:4", 16, "read a fourth part"),
        ("D1.ratio=1:2:step=0", 19, "expected a step other than 0"),
        ("D1.ratio=2:1:step=.5", 19, "does not lead from 2 to 1, expected step=-0.5"),
        ("D1.ratio=1:2:step= x", 20, "read `x`, expected a number"),
        ("D1.ratio=0:1e300:step=1e-300", 23, "expected a larger step"),
    ):
        found, messages = refusal(text)
        assert words in messages, text
        assert found == column, text


def test_every_wrong_number_of_a_list_is_reported_up_to_a_limit() -> None:
    _, messages = refusal("D1.ratio=a,1,b")
    assert [line.partition(",")[0] for line in messages.split("\n")] == ["read `a`", "read `b`"]
    assert len(refusal("D1.ratio=" + "x" * 1000)[1]) < 200
    with pytest.raises(ReadError) as caught:
        read("a," * 10**6)
    assert len(caught.value.problems) == MOST_PROBLEMS


def test_a_text_may_stand_elsewhere() -> None:
    with pytest.raises(ReadError) as caught:
        read_variation("D1.ratio=1,x", CASE, Place("sweep.yaml", 7, 5, "  - D1.ratio=1,x"))
    assert caught.value.problems[0].place == Place("sweep.yaml", 7, 16, "  - D1.ratio=1,x")


@given(st.integers(-2000, 2000), st.integers(1, 50), st.integers(1, 300))
def test_steps_of_short_decimals_are_as_if_written_by_hand(
    start: int, step: int, number: int
) -> None:
    """Thousandths, whose doubles are those of their texts: no 5e-17 in place of 0."""
    written = [float(f"{start + step * index}e-3") for index in range(number)]
    text = f"{start}e-3:{start + step * (number - 1)}e-3"
    assert read(f"{text}:step={step}e-3").tolist() == written
    assert number == 1 or read(f"{text}:{number}").tolist() == written
