"""Mistakes in expressions: told in words, at their place."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.chance import count
from tests.sweep.asked import RESULTS, SET, VALUES, VARIED, marked, number, problem, value
from vstatics import Gear, Mechanism, ReadError, ShiftElement, Transmission
from vstatics.sweep.results.columns import read_columns
from vstatics.sweep.results.expressions import read_expression
from vstatics.sweep.variants.targets import target

MISTAKES = (
    ("", "", "read nothing"),
    ("ratio + ", "", "the text ends after `+`"),
    ("rato[2]", "rato[2]", "there is no table `rato`; did you mean `ratio`?"),
    ("speeds[inn]", "inn]", "there is no link `inn`, expected one of вал, ring 1, in; did you"),
    ("speeds[вол,2]", "вол,2]", "did you mean `вал`?"),
    ("speeds[in,3R]", "3R]", 'with other characters in quotes: "3R"'),
    ("speeds[in,'1r']", "'1r']", "there is no gear `1r`, expected one of 2, 1R, N"),
    ("ratio[#4]", "#4]", "the number of a gear, #1 to #3"),
    ("ratio[99999999999999999999]", "99999999999999999999]", "there is no gear"),
    ("speeds[N]", "N]", "a gear goes in the second place: [:,N]"),
    ("losses[D1,2,1]", "1]", "expected losses[mechanism, gear]"),
    ("speeds[1:2]", "1:2]", "`:` for all"),
    ("speeds[]", "]", "read nothing"),
    ("speeds[in", "[in", "is not closed"),
    ("speeds['in]", "'in]", "the quote ' is not closed"),
    ("speeds['in'2]", "2]", "expected `,` or `]`"),
    ("D1.ratoi > 1", "ratoi > 1", "did you mean `ratio`?"),
    ("1 > D2.ratio", "D2.ratio", "there is no mechanism `D2`, expected one of D1"),
    ("D1.ratio.real", "D1.ratio.real", "there is no number `D1.ratio.real`"),
    ("D1", "D1", "`D1` is a mechanism: D1.ratio"),
    ("вал", "вал", "`вал` is a link: in brackets, as in speeds[вал]"),
    ("F", "F", "`F` is a shift element"),
    ("#1", "#1", "between the brackets of a table"),
    ("status == 'ok'", "'ok'", "`ok` is true where `status` is ok"),
    ("'ok' != status", "'ok' != status", "numbers are compared, not texts"),
    ("ratio[2] # two", "# two", "read `#`"),
    ("#x.ratio", "#x.ratio", "expected `#` and a number"),
    ("1R > 2", "1R > 2", 'write `1*R`, or a name in quotes: "1R"'),
    ("1_000 + 1", "1_000 + 1", "expected a number without `_`: 1000"),
    ("1e999", "1e999", "expected a number below 1.8e308"),
    ("speeds(in)", "speeds(in)", "there is no function `speeds`, expected abs, min, max, sqrt"),
    ("2(3)", "(3)", "expected an operator"),
    ("maxi(ratio)", "maxi(ratio)", "did you mean `max`?"),
    ("max + 1", "max + 1", "`max` is a function, expected `(`"),
    ("max()", ")", "read `)` after `(`"),
    ("abs(1, 2)", "abs(1, 2)", "abs of 2 values, expected one"),
    ("max(ratio, key=1)", "=1)", "read `=`, expected `==`"),
    ("max(*ratio)", "*ratio)", "read `*` after `(`"),
    ("lambda: 1", "lambda: 1", "read `lambda`, which this language does not have"),
    ("[1]", "[1]", "expected a table before it"),
    ("(ratio)[2]", "[2]", "rows and gears belong to a table"),
    ("1 2", "2", "read `2` after `1`"),
    ("1 < not 2", "not 2", "put `not ...` after `<` in brackets"),
    ("1 and.5", ".5", "expected a blank after `and`"),
    ("1)", ")", "without an opening bracket"),
    ("(1", "", "`(` is not closed"),
    ("1 & 2", "& 2", "read `&`, expected `and`"),
    ("1 || 2", "|| 2", "read `||`, expected `or`"),
    ("2^3", "^3", "read `^`, expected `**`"),
    ("7 // 2", "// 2", "read `//`, expected `/`"),
    ("!ratio[2]", "!ratio[2]", "read `!`, expected `not`"),
    ("ratio[2] = 1", "= 1", "read `=`, expected `==`"),
    ("ratio[2] ≤ 1", "≤ 1", "read `≤`, expected `<=`"),
    ("−1", "−1", "read `−`, expected `-`"),
    ("'вал'.ratio + 1", "'вал'.ratio + 1", "there is no mechanism `'вал'`"),
    ("speeds - torques", "- torques", "one value per link and `torques` one per component"),
    ("min(1, (slip_speeds) < losses)", "< losses)", "one per mechanism, so `<` cannot pair them"),
    ("(" * 51 + "1" + ")" * 51, "(1" + ")" * 51, "more than 50 brackets"),
    ("1" * 2001, "1" * 2001, "read 2001 characters, expected 2000 at most"),
)
"""Texts, the rest of each from where its fault is marked, and what is told."""


def test_a_mistake_is_reported_at_its_place() -> None:
    for text, rest, message in MISTAKES:
        assert message in problem(text).message, text
        assert marked(text) == rest
    for text in ("9**" * 600 + "9", "-" * 1900 + "1", "not " * 400 + "1", "1+" * 900 + "1"):
        assert "more than 100 nested operations" in problem(text).message
    assert number("1<=" * 600 + "1") == 1


def test_a_row_whose_name_two_devices_have_is_named_by_its_number() -> None:
    sets = [Mechanism(1, 2, 3, -2.0, name="A")]
    case = Transmission(3, [ShiftElement(2, 0, "A")], sets, [Gear([1])])
    with pytest.raises(ReadError, match="two rows `A`, expected #1 or #2"):
        read_expression("torques[A]", case, [], "--min")
    headings = ("torques[#1,1]", "torques[#2,1]", "torques[Mx,1]")
    assert read_columns("torques", case, []).headings == headings
    assert read_expression("losses[A]", case, [], "--min").gears == ("1",)
    case = Transmission(2, [ShiftElement(1, 2)], [], [Gear([1])])
    with pytest.raises(ReadError, match="the case has no mechanisms, so `losses` is empty"):
        read_expression("sum(losses)", case, [], "--min")


WORDS = """ratio speeds torques[ in вал ] ( ) , : #1 # ' " 1 2.5 . e 1e3 _ D1 .ratio + - * ** / < =
! and or not min( max( abs( sum( lambda if [ ² ratio[2] speeds[in] D1.ratio losses[D1,2] \\ ﬁ { @ ≤"""
PIECES = st.sampled_from([*WORDS.split(), " ", "\n", "\x00"])


@settings(max_examples=count(72, 540))
@given(st.one_of(st.lists(PIECES, max_size=12).map("".join), st.text(max_size=30)))
def test_any_text_is_read_or_refused_at_a_place(text: str) -> None:
    for read in (value, lambda text: read_columns(text, SET, VARIED)(RESULTS, VALUES)):
        try:
            read(text)
        except ReadError as error:
            for told in error.problems:
                assert told.place is not None
                assert 1 <= told.place.column <= len(text) + 1


def test_quotes_are_reported_where_they_belong() -> None:
    case = Transmission(2, [], [Mechanism(1, 2, 0, -2.0, name="1")], [Gear()])
    with pytest.raises(ReadError, match=r'in quotes: "1"\.ratio \[E105\]$'):
        read_expression("1.ratio < -5", case, [], "--where")
    assert read_expression('"1".ratio < -5', case, [], "--where").gears is None
    assert target("1 . ratio", case).name == "1.ratio"
