"""The language of sweeps: what it means, what it refuses and where, columns of --out.

Numbers come from the closed form of one planetary set, from the published report of the
MZKT 7922 (published/mzkt7922.json), or from arithmetic that is written out beside them.
"""

from __future__ import annotations

import json
import math
import pickle
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.commands import MZKT
from tests.strategies import transmissions
from vstatics import Gear, Mechanism, ReadError, Results, ShiftElement, Transmission, load, solve
from vstatics.errors import Problem
from vstatics.numerics.arrays import Floats
from vstatics.statics.arrays import ARRAYS
from vstatics.sweep.expressions import Expression, read_expression
from vstatics.sweep.expressions.columns import read_columns
from vstatics.sweep.selection import read_where
from vstatics.sweep.targets import Target, target
from vstatics.tables.rows import table_rows, written

SET = Transmission(
    3,
    [ShiftElement(1, 2, "F"), ShiftElement(2, 0, "4-5")],
    [Mechanism(1, 2, 3, -2.5, 0.96)],
    [Gear([1], name="2"), Gear([2], name="1R"), Gear(name="N")],
    link_names=("вал", "ring 1", "in"),
)
"""A set with sun, ring and carrier: locked in `2`, the ring held in `1R`, free in `N`."""
RATIOS = np.array([-2.0, -2.5, -3.0])
VALUES = RATIOS[:, None]
HELD = 1 - RATIOS
"""Ratio sun to carrier with the ring held, from (w1 - w3)/(0 - w3) = u."""
VARIED = [target("D1.ratio", SET)]
RESULTS = solve(SET, ratios=VALUES)

PUBLISHED = json.loads(
    (Path(__file__).parents[1] / "published" / "mzkt7922.json").read_text(encoding="utf-8")
)
HALF_A_UNIT = 0.5e-3 + 1e-12


def expression(text: str) -> Expression:
    return read_expression(text, SET, VARIED, "--out")


def value(text: str) -> Any:
    """The value of an expression for the three variants."""
    return expression(text)(RESULTS, VALUES)


def number(text: str) -> float:
    """The value of an expression that is the same for all variants."""
    values = value(text)
    assert values.shape == (3,)
    assert len(set(values.tolist())) == 1 or np.isnan(values).all()
    return float(values[0])


def problem(text: str, option: str = "--where") -> Problem:
    """The one problem of a text."""
    reader = read_columns if option == "--out" else partial(read_expression, option=option)
    with pytest.raises(ReadError) as caught:
        reader(text, SET, VARIED)
    (told,) = caught.value.problems
    return told


def marked(text: str, option: str = "--where") -> str:
    """The text from where its problem is marked."""
    place = problem(text, option).place
    assert place is not None
    assert (place.file, place.line, place.text) == (option, 1, text)
    return text[place.column - 1 :]


# What selections mean


def test_every_table_of_the_results_can_be_asked_for() -> None:
    arrays = [name for name in Results._fields if name not in ("case", "messages")]
    assert list(ARRAYS) == arrays
    for name, (rows, _) in ARRAYS.items():
        names = table_rows(name, SET)
        shape = (3, 3) if rows == "one" else (3, 3, len(names))
        assert getattr(RESULTS, name).shape == shape
        if 0 not in shape:  # a set without teeth has no meshes
            assert expression(name)(RESULTS, VALUES).shape == shape


def test_a_row_and_a_gear_give_one_number_per_variant() -> None:
    assert value('speeds[in, "1R"]') == pytest.approx(1 / HELD)
    assert value('ratio["1R"]') == pytest.approx(HELD)
    assert value('lossy_torques[Mx, "1R"]') == pytest.approx(1 - 0.96 * RATIOS)  # M2 = -u*eta*M1


def test_a_row_alone_gives_all_gears() -> None:
    speeds = expression("speeds[in]")
    assert (speeds.gears, speeds.rows) == (("2", "1R", "N"), None)
    assert speeds(RESULTS, VALUES)[:, :2] == pytest.approx(np.column_stack([[1] * 3, 1 / HELD]))


def test_a_gear_alone_gives_all_rows() -> None:
    speeds = expression('speeds[:, "1R"]')
    assert (speeds.gears, speeds.rows) == (None, ("вал", "ring 1", "in"))
    expected = np.column_stack([[1] * 3, [0] * 3, 1 / HELD])
    assert speeds(RESULTS, VALUES) == pytest.approx(expected)


def test_a_name_comes_before_a_number() -> None:
    """The gear that is called 2 is the first; #2 is the second."""
    assert value("ratio[2]") == pytest.approx(1)
    assert value("ratio[#2]") == pytest.approx(HELD)
    assert value("ratio[1]") == pytest.approx(1)
    assert value("speeds[3, #2]") == pytest.approx(1 / HELD)


def test_names_are_taken_letter_by_letter() -> None:
    """A Python parser would take ﬁ for fi, and `in` for no name."""
    names = ("ﬁ", "fi", "in")
    case = Transmission(
        3, [], [Mechanism(1, 2, 3, -2.0)], [Gear(speeds={2: 0.5})], link_names=names
    )
    ends = read_columns("speeds[ﬁ,1],speeds[fi,1],speeds[in,1]", case, [])
    results = solve(case, ratios=np.array([[-2.0]]))
    # w3 = (w1 - u*w2)/(1 - u) = (1 + 2*0.5)/3
    assert ends(results, np.zeros((1, 0))) == pytest.approx(np.array([[1, 0.5, 2 / 3]]))


@pytest.mark.parametrize("text", ['"вал"', "'вал'", " вал ", "1", "#1", "01"])
def test_a_row_can_be_written_in_several_ways(text: str) -> None:
    assert value(f"speeds[{text},2]") == pytest.approx(1)


def test_varied_numbers_and_those_of_the_case() -> None:
    assert value("D1.ratio").tolist() == RATIOS.tolist()
    assert value("#1.ratio").tolist() == RATIOS.tolist()
    assert value("'D1'.ratio").tolist() == RATIOS.tolist()
    assert number("D1.efficiency") == 0.96


def test_marks_count_as_1_and_0() -> None:
    assert value("tied_up + missing").tolist() == [[0, 0, 1]] * 3  # nothing is engaged in N
    assert number("sum(tied_up == 0) * 2") == 6
    assert number("idle[D1, 2]") == 1


# What operators mean


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("2 + 3*4**2", 50),  # 2 + 3*16
        ("-2**2", -4),  # -(2**2)
        ("2**-1", 0.5),
        ("2**3**2", 512),  # 2**9
        ("1 - 2 - 3", -4),
        ("8/4/2", 1),
        ("(1 - 2)*-3", 3),
        ("+.5e1", 5),
        ("1 < 2 < 3", 1),
        ("3 > 2 > 2", 0),
        ("1 < 2 == 1", 0),  # a chain: 1 < 2 and 2 == 1
        ("(1 < 2) == 1", 1),
        ("1 or 0 and 0", 1),  # 1 or (0 and 0)
        ("not 1 > 2", 1),
        ("not not 3", 1),
        ("(1)and(0)", 0),
        ("1 != 2", 1),
        ("1 >= 1", 1),
        ("1 <= 0", 0),
        ("(2 > 1) + (3 > 1)", 2),
        ("-(2 > 1)", -1),
        ("min(3, 1, 2)", 1),
        ("max(3, 1 + 3, 2)", 4),
        ("abs(-3)", 3),
        ("sum(3)", 3),
        ("min\n( 3,\t2)", 2),
    ],
)
def test_arithmetic_is_that_of_python(text: str, expected: float) -> None:
    assert number(text) == expected


def test_overflow_and_division_by_zero_are_no_errors() -> None:
    assert number("9**9**9") == math.inf
    assert number("1/0") == math.inf
    assert math.isnan(number("0/0"))
    assert math.isnan(number("(-8)**(1/3)"))


@pytest.mark.parametrize("sign", ["<", "<=", ">", ">=", "==", "!="])
def test_a_comparison_with_what_does_not_exist_is_false(sign: str) -> None:
    assert number(f"0/0 {sign} 1") == 0
    assert number(f"0/0 {sign} 0/0") == 0


def test_what_does_not_exist_is_no_true_condition() -> None:
    assert number("0/0 and 1") == 0
    assert number("0/0 or 0") == 0
    assert number("not 0/0") == 1
    for text in ("0/0", "1/0", "-1/0", "0 or 1/0"):
        where = read_where(text, SET, VARIED)
        assert where(RESULTS, VALUES).tolist() == [0, 0, 0]
    assert number("1/0 > 3") == 1


def test_marks_of_a_gear_without_solution_do_not_exist() -> None:
    """As in the JSON of `run`; nothing can be said of the losses of a neutral gear."""
    for text in ("locked[N]", "consistent[N]", "idle[D1,N]"):
        assert np.isnan(value(text)).all()
    assert number("locked[N] == 0") == 0
    assert number("sum(locked)") == 0
    assert number("tied_up[N]") == 0


def test_what_does_not_exist_is_left_out_of_min_max_and_sum() -> None:
    """The output of the set stands still nowhere, but in N it has no ratio."""
    assert np.isnan(value("ratio[N]")).all()
    assert value("min(ratio)") == pytest.approx(1)
    assert value("max(ratio)") == pytest.approx(HELD)
    assert value("sum(ratio)") == pytest.approx(1 + HELD)
    assert value('max(ratio[N], ratio["1R"])') == pytest.approx(HELD)
    assert np.isnan(value("min(ratio[N])")).all()
    assert np.isnan(value("max(ratio[N])")).all()
    assert np.isnan(value("sum(ratio[N])")).all()
    assert np.isnan(value("ratio[N] + 1")).all()


def test_min_max_and_sum_go_over_gears_and_rows() -> None:
    assert value("sum(abs(speeds[:,2]))") == pytest.approx(3)  # locked: all turn with the input
    assert value("max(speeds)") == pytest.approx(1)
    assert value('sum(speeds[:,"1R"])') == pytest.approx(1 + 1 / HELD)
    assert value("max(slip_speeds['4-5'])") == pytest.approx(1)  # the ring's own speed in 2


def test_one_value_per_gear_is_spread_over_rows() -> None:
    product = expression("speeds*ratio")
    assert (product.gears, product.rows) == (("2", "1R", "N"), ("вал", "ring 1", "in"))
    made = product(RESULTS, VALUES)
    assert made.shape == (3, 3, 3)
    assert made[:, 1] == pytest.approx(np.column_stack([HELD, [0] * 3, [1] * 3]))
    assert value('ratio - ratio["1R"]')[:, 1].tolist() == [0, 0, 0]
    assert value("speeds - speeds[:,2]")[:, 0].tolist() == [[0] * 3] * 3


def test_a_number_goes_with_everything() -> None:
    assert value("2*speeds").shape == (3, 3, 3)
    assert value("speeds + D1.ratio")[:, 0, 0] == pytest.approx(1 + RATIOS)


def test_tables_of_equal_rows_go_together() -> None:
    power = expression("lossy_torques*torques")
    assert power.rows == ("F", "4-5", "D1", "Mx")
    assert expression("losses*power_sign").rows == ("D1",)


# Arrays as they come


def reversed_in_memory(results: Results) -> Results:
    """The same results with the variants last in memory, every other one left out."""
    arrays: dict[str, Any] = {}
    for name in ARRAYS:
        array = np.moveaxis(getattr(results, name), 0, -1)
        arrays[name] = np.moveaxis(np.repeat(array, 2, axis=-1)[..., ::2], -1, 0)
    return results._replace(**arrays)


@pytest.mark.parametrize(
    "text", ["speeds", "speeds[in]", "max(abs(torques))", "sum(ratio)", "missing*ratio"]
)
def test_strides_do_not_matter(text: str) -> None:
    made = expression(text)
    np.testing.assert_array_equal(made(reversed_in_memory(RESULTS), VALUES), made(RESULTS, VALUES))


def test_a_selection_is_a_view() -> None:
    assert np.shares_memory(value("speeds[in]"), RESULTS.speeds)
    assert np.shares_memory(value("ratio"), RESULTS.ratio)


def test_no_variants_have_no_values() -> None:
    results = solve(SET, ratios=np.zeros((0, 1)))
    values = np.zeros((0, 1))
    assert expression("max(ratio) < 3")(results, values).shape == (0,)
    assert read_columns("ratio,1", SET, VARIED)(results, values).shape == (0, 4)


def test_one_case_is_calculated_like_variants() -> None:
    own = read_expression("max(ratio)", SET, [], "--out")
    assert own(solve(SET), np.zeros(0)) == pytest.approx(3.5)  # 1 - (-2.5)


def test_an_expression_goes_to_other_processes() -> None:
    made = expression("max(abs(speeds)) < 3 and D1.ratio > -3")
    again = pickle.loads(pickle.dumps(made))  # noqa: S301
    assert again == made
    assert again(RESULTS, VALUES).tolist() == [1, 1, 0]
    columns = read_columns("ratio,speeds[in]", SET, VARIED)
    assert pickle.loads(pickle.dumps(columns)) == columns  # noqa: S301


def test_the_deepest_expression_can_be_calculated_and_sent() -> None:
    made = expression("1" + " + 1" * 99)
    assert made(RESULTS, VALUES).tolist() == [100] * 3
    assert pickle.loads(pickle.dumps(made)) == made  # noqa: S301
    assert "more than 100 operations" in problem("1" + " + 1" * 100).message


# What is refused, and where


@pytest.mark.parametrize(
    ("text", "rest", "message"),
    [
        ("", "", "read nothing"),
        ("ratio + ", "", "the text ends behind `+`"),
        ("rato[2]", "rato[2]", "there is no table `rato`; did you mean `ratio`?"),
        ("1 < Ratio[2]", "Ratio[2]", "did you mean `ratio`?"),
        ("speeds[inn]", "inn]", "there is no link `inn`, expected one of вал, ring 1, in; did you"),
        ("speeds[вол,2]", "вол,2]", "did you mean `вал`?"),
        ("speeds[in,3R]", "3R]", 'goes in quotes: "3R"'),
        ("torques[4-5]", "4-5]", 'goes in quotes: "4-5"'),
        ("speeds[ring 1]", "ring 1]", 'goes in quotes: "ring 1"'),
        ("speeds[in,'1r']", "'1r']", "there is no gear `1r`, expected one of 2, 1R, N"),
        ("ratio[#4]", "#4]", "the number of a gear, #1 to #3"),
        ("ratio[0]", "0]", "there is no gear `0`"),
        ("ratio[99999999999999999999]", "99999999999999999999]", "there is no gear"),
        ("speeds[N]", "N]", "a gear goes in the second place: [:,N]"),
        ("ratio[2,1]", "1]", "one part too many, expected ratio[gear]"),
        ("losses[D1,2,1]", "1]", "expected losses[mechanism, gear]"),
        ("speeds[1:2]", "1:2]", "`:` for all"),
        ("speeds[]", "]", "read nothing"),
        ("speeds[in", "[in", "is not closed"),
        ("speeds['in]", "'in]", "the quote ' is not closed"),
        ("speeds['in'2]", "2]", "expected `,` or `]`"),
        ("D1.ratoi > 1", "ratoi > 1", "did you mean `ratio`?"),
        ("1 > D2.ratio", "D2.ratio", "there is no mechanism `D2`, expected one of D1"),
        ("D1 .ratio > 1", ".ratio > 1", "read `.` behind `D1`"),
        ("D1.ratio.real", ".real", "read `.` behind `D1.ratio`"),
        ("ratio[2].real", ".real", "read `.` behind `ratio`"),
        ("D1", "D1", "`D1` is a mechanism: D1.ratio"),
        ("вал", "вал", "`вал` is a link: in brackets, as in speeds[вал]"),
        ("F", "F", "`F` is a shift element"),
        ("#1", "#1", "between the brackets of a table"),
        ("'D1'", "'D1'", "between the brackets of a table"),
        ("ratio[2] # two", "# two", "read `#`"),
        ("#x.ratio", "#x.ratio", "expected `#` and a number"),
        ("1R > 2", "1R > 2", 'goes in quotes: "1R"'),
        ("1_000 + 1", "1_000 + 1", "expected a number without `_`: 1000"),
        ("0x10", "0x10", "expected a number"),
        ("1e999", "1e999", "expected a number below 1.8e308"),
        ("1 + 2j", "2j", "expected a number"),
        ("speeds(in)", "speeds(in)", "there is no function `speeds`, expected min, max, abs, sum"),
        ("2(3)", "(3)", "expected an operator"),
        ("maxi(ratio)", "maxi(ratio)", "did you mean `max`?"),
        ("max + 1", "+ 1", "`max` is a function, expected `(`"),
        ("max()", ")", "read `)` behind `(`"),
        ("max(1,)", ")", "read `)` behind `,`"),
        ("abs(1, 2)", "abs(1, 2)", "abs of 2 parts, expected one"),
        ("sum(1, 2)", "sum(1, 2)", "sum of 2 parts, expected one"),
        ("max(ratio, key=1)", "=1)", "read `=`, expected `==`"),
        ("max(*ratio)", "*ratio)", "read `*` behind `(`"),
        ("max(x for x in ratio)", "for x in ratio)", "read `for`, which this language does not"),
        ("lambda: 1", "lambda: 1", "read `lambda`, which this language does not have"),
        ("1 if 2 else 3", "if 2 else 3", "read `if`, which this language does not have"),
        ("[1]", "[1]", "expected a table before it"),
        ("(ratio)[2]", "[2]", "rows and gears belong to a table"),
        ("{1}", "{1}", "read `{`"),
        ("f'1'", "'1'", "behind `f`"),
        ("(1, 2)", ", 2)", "read `,`"),
        ("1, 2", ", 2", "read `,`"),
        ("1; 2", "; 2", "read `;`"),
        ("1 2", "2", "read `2` behind `1`"),
        ("x := 1", ":= 1", "read `:`"),
        ("1 + * 2", "* 2", "read `*` behind `+`"),
        ("1 < not 2", "not 2", "put `not ...` behind `<` in brackets"),
        ("1 and.5", ".5", "expected a blank behind `and`"),
        ("1)", ")", "no bracket is open"),
        ("(1", "", "`(` is not closed"),
        ("1 & 2", "& 2", "read `&`, expected `and`"),
        ("1 || 2", "|| 2", "read `||`, expected `or`"),
        ("2^3", "^3", "read `^`, expected `**`"),
        ("!ratio[2]", "!ratio[2]", "read `!`, expected `not`"),
        ("ratio[2] = 1", "= 1", "read `=`, expected `==`"),
        ("ratio[2] ≤ 1", "≤ 1", "read `≤`, expected `<=`"),
        ("ratio[2] − 1", "− 1", "read `−`, expected `-`"),
        ("−1", "−1", "read `−`, expected `-`"),
        ("7 % 2", "% 2", "read `%`"),
        ("7 // 2", "// 2", "read `//`, expected `/`"),
        ("ratio²", "ratio²", "did you mean `ratio`?"),
        ("вал + rato", "вал + rato", "`вал` is a link"),
        ("'вал'.ratio + 1", "'вал'.ratio + 1", "there is no mechanism `'вал'`"),
        ("speeds['вал',1] + rato", "rato", "did you mean `ratio`?"),
        ("__import__('os')", "__import__('os')", "there is no function `__import__`"),
        ("speeds - torques", "- torques", "one value per link and `torques` one per device"),
        (
            "min(1, (slip_speeds) < losses)",
            "< losses)",
            "one per mechanism, so `<` can't pair them",
        ),
        ("(" * 51 + "1" + ")" * 51, "(1" + ")" * 51, "more than 50 brackets"),
        ("1" * 2001, "1" * 2001, "read 2001 characters, expected 2000 at most"),
    ],
)
def test_a_mistake_is_told_at_its_place(text: str, rest: str, message: str) -> None:
    assert message in problem(text).message
    assert marked(text) == rest


def test_a_row_whose_name_two_devices_have_is_told_by_its_number() -> None:
    case = Transmission(
        3, [ShiftElement(2, 0, "A")], [Mechanism(1, 2, 3, -2.0, name="A")], [Gear([1])]
    )
    with pytest.raises(ReadError, match="two rows `A`, expected #1 or #2"):
        read_expression("torques[A]", case, [], "--min")
    assert read_columns("torques", case, []).headings == (
        "torques[#1,1]",
        "torques[#2,1]",
        "torques[Mx,1]",
    )
    assert read_expression("losses[A]", case, [], "--min").gears == ("1",)


def test_an_empty_table_is_told() -> None:
    case = Transmission(2, [ShiftElement(1, 2)], [], [Gear([1])])
    with pytest.raises(ReadError, match="the case has no mechanisms, so `losses` is empty"):
        read_expression("sum(losses)", case, [], "--min")


def test_a_long_power_or_a_row_of_signs_is_no_danger() -> None:
    for text in ("9**" * 600 + "9", "-" * 1900 + "1", "not " * 400 + "1", "1+" * 900 + "1"):
        assert "more than 100 operations" in problem(text).message
    assert number("1<=" * 600 + "1") == 1


PIECES = st.sampled_from(
    [
        *("ratio", "speeds", "torques[", "in", "вал", "]", "(", ")", ",", ":", "#1", "#", "'", '"'),
        *(
            "1",
            "2.5",
            ".",
            "e",
            "1e3",
            "_",
            "D1",
            ".ratio",
            "+",
            "-",
            "*",
            "**",
            "/",
            "<",
            "=",
            "!",
        ),
        *("and", "or", "not", "min(", "max(", "abs(", "sum(", " ", "\n", "lambda", "if", "[", "²"),
        *("ratio[2]", "speeds[in]", "D1.ratio", "losses[D1,2]", "\\", "\x00", "ﬁ", "{", "@", "≤"),
    ]
)


@settings(max_examples=180)
@given(st.one_of(st.lists(PIECES, max_size=12).map("".join), st.text(max_size=30)))
def test_any_text_is_read_or_refused_at_a_place(text: str) -> None:
    for option in ("--where", "--out"):
        try:
            if option == "--out":
                read_columns(text, SET, VARIED)(RESULTS, VALUES)
            else:
                value(text)
        except ReadError as error:
            for told in error.problems:
                assert told.place is not None
                assert 1 <= told.place.column <= len(text) + 1


# Columns


def headings(text: str, targets: list[Target] = VARIED) -> tuple[str, ...]:
    return read_columns(text, SET, targets).headings


def test_columns_have_the_names_of_rows_and_gears() -> None:
    assert headings("ratio") == ("ratio[2]", 'ratio["1R"]', "ratio[N]")
    assert headings("speeds[in]") == ("speeds[in,2]", 'speeds[in,"1R"]', "speeds[in,N]")
    assert headings("speeds[:,2]") == ("speeds[вал,2]", 'speeds["ring 1",2]', "speeds[in,2]")
    assert headings("speeds")[:4] == (
        *("speeds[вал,2]", 'speeds[вал,"1R"]', "speeds[вал,N]"),
        'speeds["ring 1",2]',
    )
    assert headings("torques[#2,#2]") == ('torques["4-5","1R"]',)


def test_expressions_are_columns_with_their_text() -> None:
    assert headings(" ratio[2]\n+ 1 ,max(ratio, 3)") == (
        "ratio[2] + 1",
        *("max(ratio, 3)[2]", 'max(ratio, 3)["1R"]', "max(ratio, 3)[N]"),
    )
    assert headings("ratio - 1")[0] == "(ratio - 1)[2]"
    assert headings("abs(losses)")[1] == 'abs(losses)[D1,"1R"]'


def test_what_is_asked_for_twice_is_written_once() -> None:
    assert headings("ratio[N],ratio,ratio[#1]") == ("ratio[N]", "ratio[2]", 'ratio["1R"]')
    assert headings("max(ratio),max(ratio)") == ("max(ratio)",)


def test_varied_numbers_have_columns_already() -> None:
    assert headings("D1.ratio,'D1'.ratio,#1.ratio,max(ratio)") == ("max(ratio)",)
    assert headings("D1.efficiency") == ("D1.efficiency",)
    assert headings("D1.ratio", []) == ("D1.ratio",)


def test_all_problems_of_the_columns_are_told() -> None:
    text = "ratio, rato, speeds[in,'x,y'], max(1,efficency)"
    with pytest.raises(ReadError) as caught:
        read_columns(text, SET, VARIED)
    places = [told.place for told in caught.value.problems]
    assert [text[place.column - 1 :] for place in places if place] == [
        "rato, speeds[in,'x,y'], max(1,efficency)",
        "'x,y'], max(1,efficency)",
        "efficency)",
    ]
    assert marked("ratio,", "--out") == ""


def test_columns_hold_what_their_headings_say() -> None:
    columns = read_columns("speeds,max(ratio),ratio[2],torques[Mx],D1.ratio", SET, VARIED)
    made = columns(RESULTS, VALUES)
    assert made.shape == (3, len(columns.headings))
    for heading, column in zip(columns.headings, made.T, strict=True):
        np.testing.assert_array_equal(column, value(heading))


@settings(max_examples=45)
@given(transmissions(), st.sampled_from(list(ARRAYS)))
def test_each_heading_reads_back_as_its_column_whatever_the_names(
    case: Transmission, table: str
) -> None:
    rows = table_rows(table, case)
    if ARRAYS[table].rows != "one" and not rows:
        return
    columns = read_columns(table, case, [])
    assert len(set(columns.headings)) == len(columns.headings) == len(case.gears) * (len(rows) or 1)
    cells = columns.parts[0].cells
    for heading, (gear, row) in zip(columns.headings, cells, strict=True):
        (again,) = read_columns(heading, case, []).parts
        assert again.expression.node == (table, gear, row if rows else None, bool(rows))


@settings(max_examples=30)
@given(transmissions())
def test_every_mechanism_can_be_named(case: Transmission) -> None:
    names = [mechanism.name for mechanism in case.mechanisms]
    for index, mechanism in enumerate(case.mechanisms):
        name = written(index, names)
        if name.isdigit():
            name = f"'{name}'"  # 1.ratio begins like a number
        own = read_expression(f"{name}.ratio", case, [], "--min")
        assert own(solve(case), np.zeros(0)) == mechanism.ratio


# Published numbers


def test_columns_of_the_published_gearbox_are_the_published_numbers() -> None:
    """Every table of the source by name, at the source's own ratios."""
    case = load(MZKT)
    results = solve(case, ratios=np.array([[m.ratio for m in case.mechanisms]]))
    names = {
        "speeds": "W",
        "planet_speeds": "WSAT",
        "slip_speeds": "WFRI",
        "torques": "AMLG",
        "lossy_torques": "AMLGP",
        "efficiency": "ETA",
        "power_sign": "IX",
    }
    for name, printed in names.items():
        made: Floats = read_columns(name, case, [])(results, np.zeros((1, 0)))[0]
        expected = np.array(PUBLISHED[printed], dtype=np.float64).ravel()
        assert made == pytest.approx(expected, rel=0, abs=HALF_A_UNIT), name


def test_an_objective_of_the_published_gearbox() -> None:
    """ETA = .953 .979 .973 1.000 .899 .919 and AMLGP(Mx) of gear 1 = 5.934 are published."""
    case = load(MZKT)
    results = solve(case, ratios=np.array([[m.ratio for m in case.mechanisms]]))
    for text, expected in {
        "min(efficiency)": 0.899,
        "efficiency[1] - efficiency[6]": 0.953 - 0.919,
        "lossy_torques[Mx,1]": 5.934,
        "max(abs(speeds))": 2.656,
    }.items():
        made = read_expression(text, case, [], "--min")(results, np.zeros((1, 0)))
        assert made == pytest.approx(expected, abs=1e-3), text


def test_a_product_is_no_varied_number_of_the_same_letters() -> None:
    """`2*B.ratio` is twice the ratio of B, though a mechanism `2*B` is varied."""
    pairs = [Mechanism(1, 2, 0, -2.0, name="2*B"), Mechanism(2, 3, 0, -5.0, name="B")]
    case = Transmission(3, [], pairs, [Gear()])
    varied = [target("2*B.ratio", case)]
    columns = read_columns('2*B.ratio, "2*B".ratio', case, varied)
    assert columns.headings == ("(2*B.ratio)",)
    ratios = np.array([[-3.0, -5.0], [-4.0, -5.0]])
    made = columns(solve(case, ratios=ratios), ratios[:, :1])
    assert made.tolist() == [[-10.0], [-10.0]]


def test_quotes_are_told_where_they_belong() -> None:
    case = Transmission(2, [], [Mechanism(1, 2, 0, -2.0, name="1")], [Gear()])
    with pytest.raises(ReadError, match=r'in quotes: "1"\.ratio$'):
        read_expression("1.ratio < -5", case, [], "--where")
    assert read_expression('"1".ratio < -5', case, [], "--where").gears is None
    assert target("1 . ratio", case).name == "1.ratio"


# Names of the deck


def test_the_names_of_the_deck_are_the_tables_of_the_library() -> None:
    """W, WSAT, WFRI, AMLG, AMLGP, ETA, IX as in the report of the source."""
    for deck, library in {
        "W[in, 2]": "speeds[in, 2]",
        "WSAT": "planet_speeds",
        "WFRI": "slip_speeds",
        "AMLG[Mx]": "torques[Mx]",
        "AMLGP": "lossy_torques",
        "AMWZ": "holding_torques",
        "AMWZP": "lossy_holding_torques",
        'ETA["1R"]': 'efficiency["1R"]',
        "max(abs(IX))": "max(abs(power_sign))",
    }.items():
        np.testing.assert_array_equal(value(deck), value(library))
        assert expression(deck).node == expression(library).node or "(" in deck


def test_headings_have_the_names_of_tables_as_they_were_written() -> None:
    assert headings("ETA[2], W[in], (efficiency)") == (
        "ETA[2]",
        *("W[in,2]", 'W[in,"1R"]', "W[in,N]"),
        *("efficiency[2]", 'efficiency["1R"]', "efficiency[N]"),
    )
    assert "expected ETA[gear]" in problem("ETA[2,1]").message
