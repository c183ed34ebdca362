"""Cases in YAML and JSON: what is read, and what is said about what cannot be."""

import codecs

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.chance import count
from vstatics import loads
from vstatics.core import readers
from vstatics.core.errors import Problem, ReadError
from vstatics.core.model.shape import COUNT, TEXT, ByKey, KeyShape, ListOf
from vstatics.core.model.transmission import Gear, Mechanism, ShiftElement, SpeedOf, Transmission
from vstatics.core.readers.named.reader import read_document
from vstatics.core.writers.named import write_yaml

DIFFERENTIAL = """\
links: 3
shift_elements:
  T1: [2, housing]
  F2: [1, 2]
mechanisms:
  D1: {first: 1, second: 2, third: 3, ratio: -2.5}
gears:
  "1": {engaged: [T1]}
  "2": {engaged: [F2]}
"""


def errors(data: bytes | str, file: str = "case.yaml") -> list[Problem]:
    with pytest.raises(ReadError) as caught:
        readers.read(data.encode() if isinstance(data, str) else data, file)
    return [problem for problem in caught.value.problems if problem.severity == "error"]


def test_every_key() -> None:
    tow = Gear(input=4, output=3, name="tow")
    assert loads("""
name: 7922
description: |
  Two
  lines
source: here
links: [on, 1e3, "5", ящик]
input: 1e3
output: on
idle: published
coast: true
shift_elements: {no: [0, on], 1: [5, ящик]}
mechanisms:
  6R: {first: on, second: 1e3, third: 5, ratio: -96/39, efficiency: .97, planet_ratio: "-2."}
  Л: {first: ящик, second: housing, ratio: +1}
gears:
  on: {engaged: [1, no], speeds: {5: 0.5}, torques: {1e3: -2e-1, ящик: 3}}
  tow: {input: ящик, output: 5}
""") == Transmission(
        name="7922",
        description="Two\nlines\n",
        source="here",
        links=4,
        link_names=["on", "1e3", "5", "ящик"],
        input=2,
        output=1,
        idle="published",
        coast=True,
        shift_elements=[ShiftElement(0, 1, "no"), ShiftElement(3, 4, "1")],
        mechanisms=[
            Mechanism(1, 2, 3, -96 / 39, 0.97, -2.0, "6R"),
            Mechanism(4, 0, 0, 1, name="Л"),
        ],
        gears=[Gear([2, 1], {3: 0.5}, {2: -0.2, 4: 3.0}, name="on"), tow],
    )


@pytest.mark.parametrize("nothing", ["", "shift_elements:", "shift_elements: {}", "name: null"])
def test_keys_without_a_value_count_as_not_given(nothing: str) -> None:
    text = "links: 2\nmechanisms: {P: {first: 1, second: 2, third: ~, ratio: 2}}\ngears: {N: }\n"
    pair = Transmission(2, [], [Mechanism(1, 2, 0, 2, name="P")], [Gear(name="N")])
    assert loads(text + nothing) == pair


def test_a_gear_can_be_a_list_of_engaged_elements_or_an_alias() -> None:
    text = DIFFERENTIAL.partition("gears:")[0]
    text += "gears: {direct: [F2], low: &low {engaged: [T1]}, none: [], nothing: , again: *low}"
    assert [gear.engaged for gear in loads(text).gears] == [(2,), (1,), (), (), (1,)]
    [problem] = errors(text.replace("[F2],", "[F2, D],"))
    assert "gears.direct[2]: read 'D', expected the name of a shift element" in problem.message


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-32"])
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_encodings_and_ends_of_lines(encoding: str, end: str) -> None:
    text = "name: Коробка\n" + DIFFERENTIAL
    data = text.replace("\n", end).encode(encoding)
    assert readers.read(data, "case.yaml").case == loads(text)
    problem = errors(text.replace("-2.5", "x").replace("\n", end).encode(encoding))[0]
    assert problem.place is not None
    assert problem.place[1:] == (7, 46, "  D1: {first: 1, second: 2, third: 3, ratio: x}")


@pytest.mark.parametrize("file", ["case.yaml", "case.json"])
def test_files_that_are_not_texts_or_mappings_are_rejected(file: str) -> None:
    for data, line, column, words in (
        (b"", 1, 1, "the file is empty"),
        (b" \r\n\n", 1, 1, "the file is empty"),
        (b"links: 3\nname: \xcf\xe5", 2, 7, "not valid UTF-8"),
        ("ю: Ж".encode() + b"\xd0", 1, 5, "not valid UTF-8"),
        (codecs.BOM_UTF16_LE + b"a\0\n\0b\0\x00\xd8", 2, 2, "not valid UTF-16"),
        (b"links: 3\n\x7fELF\0\0", 2, 5, "a zero byte"),
        ("links: 3".encode("utf-16-le"), 1, 2, "a zero byte"),
        # github.com/opensafely-core/opencodelists/issues/1474: a workbook instead of a text
        (b"PK\3\4\x14\0\6\0", 1, 1, "read a workbook or archive, not a text, expected a case"),
        (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1\0", 1, 1, "save a table as CSV"),
    ):
        (problem,) = errors(data, file)
        assert problem.place is not None
        assert (problem.place[:3], words in problem.message) == ((file, line, column), True)
    for text in ("# nothing\n", "---\n", "null", "text", "[1, 2]"):
        (problem,) = errors(text)
        assert "expected a case" in problem.message


def test_all_faults_are_reported_in_one_run() -> None:
    """A mistyped key is read as what was meant, so that no other fault hides behind it."""
    text = DIFFERENTIAL.replace("-2.5", "x").replace("[F2]", "[F9]").replace("[1, 2]", "[1, 8]")
    text = text.replace("gears:", "gaers:")
    assert [str(problem) for problem in errors("idle: x\n" + text)] == [
        "case.yaml:1:7: error: idle: read 'x', expected `exact` or `published` [E126]",
        "case.yaml:5:11: error: shift_elements.F2[2]: read '8', "
        "expected a link number from 1 to 3 or `housing` [E126]",
        "case.yaml:7:46: error: mechanisms.D1.ratio: read 'x', "
        "expected a number or a calculation such as -96/39 [E125]",
        "case.yaml:8:1: error: unknown key `gaers`; did you mean `gears`? [E190]",
        "case.yaml:10:19: error: gears.2.engaged[1]: read 'F9', "
        "expected the name of a shift element: T1, F2 [E126]",
    ]


def test_problems_of_the_model_are_located() -> None:
    text = DIFFERENTIAL.replace("ratio: -2.5", "ratio: 2.5").replace("links: 3", "links: [a, 2, 3]")
    text = text.replace("first: 1", "first: a").replace("[1, 2]", "[a, 2]")
    text += "  tow: {engaged: [T1, F2], speeds: {3: 1}}\n"
    reading = readers.read(text.encode(), "case.yaml")
    (warning,) = reading.warnings  # no planet speed
    assert str(warning).startswith("case.yaml:6:3: warning: mechanisms.D1: ratio 2.5")
    places = {
        ("links",): "1:8: error: links: m",
        ("link_names", 2): "1:12: error: links[2]: m",
        ("output",): "1:1: error: output: m",
        ("mechanisms", 1): "6:3: error: mechanisms.D1: m",
        ("mechanisms", 1, "ratio"): "6:46: error: mechanisms.D1.ratio: m",
        ("mechanisms", 1, "efficiency"): "6:3: error: mechanisms.D1.efficiency: m",
        ("shift_elements", 2, "second"): "4:11: error: shift_elements.F2[2]: m",
        ("gears", 3): "10:3: error: gears.tow: m",
        ("gears", 3, "engaged", 2): "10:23: error: gears.tow.engaged[2]: m",
        ("gears", 3, "engaged", 7): "10:18: error: gears.tow.engaged[7]: m",
        ("gears", 3, "speeds", 3): "10:37: error: gears.tow.speeds.3: m",
        (): "1:1: error: m",
    }
    for path, told in places.items():
        assert str(reading.locate(Problem("E234", "m", path))) == f"case.yaml:{told} [E234]"


def test_a_number_is_decimal_or_a_calculation() -> None:
    numbers = {"2": 2.0, "-.8": -0.8, "5.": 5.0, ".26E+01": 2.6, "+1e-05": 1e-05, "'1'": 1.0}
    for text, value in {**numbers, "1.5/-2e1": -0.075, "96 / 39": 96 / 39}.items():
        case = loads(DIFFERENTIAL.replace("-2.5}", f"-2.5, planet_ratio: {text}}}"))
        assert case.mechanisms[0].planet_ratio == value
    other = "1_0 . e5 1e 1e1.5 --1 0x10 0b1 1:30:15 inf nan 1d5 .inf -.INF .nan ١ 1/ /2 true 1e400"
    other += " 1/0 1/0e9 1/1e-999 -. 1e+ 1e+-2 {} [] ~ '' 1e99999999999999999999 " + "9" * 100_000
    for text in ["1 2 3", *other.split()]:
        (problem,) = errors(DIFFERENTIAL.replace("-2.5", text))
        assert problem.message.startswith("mechanisms.D1.ratio: read "), text


def test_no_more_errors_are_reported_than_can_be_read() -> None:
    problems = errors("".join(f"key{n}: 1\n" for n in range(1000)))
    assert len(problems) == 101
    assert str(problems[-1]) == "case.yaml: error: too many errors, the rest is not read [E108]"


PUNCTUATION = st.text("{}[]:,-?&*!|>'\"#%@`\n\t <~.0a\\", max_size=60)


@settings(max_examples=count(32, 240))
@given(st.binary(max_size=200) | PUNCTUATION.map(str.encode))
def test_any_bytes_and_punctuation_end_in_a_read_error(data: bytes) -> None:
    for file in ("case.yaml", "case.json"):
        try:
            reading = readers.read(data, file)
        except ReadError as error:
            files = {problem.place and problem.place.file for problem in error.problems}
            assert files == {file}
        else:
            assert isinstance(reading.case, Transmission)


def test_a_document_of_another_shape_is_read_the_same_way() -> None:
    keys = (KeyShape("count", COUNT, "How many."), KeyShape("names", ListOf(TEXT), "Of what."))
    shape = ByKey("Sample", "Another document.", keys)
    values, spots = read_document(b"names: [a, b]\ncount: 3", "it.yaml", shape, "a sample")
    assert values == {"names": ["a", "b"], "count": 3}
    assert spots.place(("names", 2))[1:3] == (1, 12)
    with pytest.raises(ReadError) as caught:
        read_document(b"names: a\ncount: 0", "it.yaml", shape, "a sample")
    assert [str(problem).splitlines()[0] for problem in caught.value.problems] == [
        "it.yaml:1:8: error: names: read 'a', expected a list [E127]",
        "it.yaml:2:8: error: count: read '0', expected a whole number from 1 [E125]",
    ]


AXLE = """links: [engine, FL, FR]
mechanisms: {axle: {first: FL, second: FR, third: engine, ratio: -1}}
gears: {curve: {output: FL, speeds: {FR: %s}}}
"""


def test_a_speed_may_be_given_by_that_of_another_link() -> None:
    """The word `link` tells a link that has a number from a speed."""
    factors = {"FL": 1, "1.05*FL": 1.05, "-FL": -1, "21/20 * FL": 1.05, "-1.05*link FL": -1.05}
    for given_speed, factor in {**factors, "(1 + .05)*FL": 1.05}.items():
        assert loads(AXLE % given_speed).gears[0].speeds == {3: SpeedOf(2, factor)}
    numbered = AXLE.replace("[engine, FL, FR]", "3").replace("FL", "2").replace("FR", "3")
    numbered = numbered.replace("engine", "1")
    assert loads(numbered % "1.05*link 2").gears[0].speeds == {3: SpeedOf(2, 1.05)}
    assert loads(numbered % "2").gears[0].speeds == {3: 2.0}


def test_a_link_of_any_name_can_give_a_speed() -> None:
    gear = Gear(speeds={1: SpeedOf(2, 1.05), 3: SpeedOf(2)}, input=2, output=1)
    for name in ("*a", "2*3", "a*b", "1e3", "link 2", "-x", "2", "(a)", "x*link x"):
        links = ["engine", name, "axle"]
        case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [gear], link_names=links)
        assert loads(write_yaml(case)) == case, name


def test_a_speed_of_a_link_that_is_not_there_is_refused() -> None:
    for speed, said in {
        "1.05*FI": "expected the name of a link after the `*`: engine, FL, FR",
        "FL*1.05": "expected the factor before the link: `1.05*FL`",
        "FL / 1.02": "expected the factor before the link: `1/1.02*FL`",
        "0*FL": "read a factor of 0",
        "2*FR": "is a multiple of itself",
        "2*300 Nm": "or a number relative to the input speed; this is a torque",
        "2**FL": "expected a number or a calculation",
    }.items():
        [problem] = errors(AXLE % speed)
        assert said in problem.message
        assert problem.place is not None
        assert problem.place.line == 3
