"""Cases in YAML and JSON: what is read, and what is said about what cannot be."""

from __future__ import annotations

import codecs
import json
import random
import time
from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.commands import BAD_FILES, CASES
from tests.core.readers.named.friction_faults import FAULTS as FRICTION_FAULTS
from tests.core.readers.named.spring_faults import FAULTS as SPRING_FAULTS
from tests.core.readers.named.straight_faults import FAULTS as STRAIGHT_FAULTS
from vstatics.core.errors import Problem, ReadError
from vstatics.core.model.shape import COUNT, TEXT, ByKey, KeyShape, ListOf
from vstatics.core.model.transmission import Gear, Mechanism, ShiftElement, SpeedOf, Transmission
from vstatics.core.readers.named.reader import read_document, read_json, read_yaml
from vstatics.core.readers.reading import Reading
from vstatics.core.writers.named import mapping, write_json, write_yaml

# file, line, column, words of the message: the place of the one fault in the file
FAULTS = [
    ("alias-of-itself.yaml", 9, 24, "alias *gear is inside the part that it repeats"),
    ("alias-unknown.yaml", 9, 18, "alias *elements of no anchor before it"),
    ("coast-quoted.yaml", 2, 8, "coast: read 'true', expected `true` or `false` without quotes"),
    ("coast-yes.yaml", 2, 8, "coast: read 'yes', expected `true` or `false`"),
    ("control-character.yaml", 6, 50, "U+0007, a character that YAML does not allow"),
    (
        "efficiency-above-1.yaml",
        6,
        64,
        "mechanisms.D1.efficiency: read 97, expected an efficiency above 0 and up to 1",
    ),
    ("element-joins-itself.yaml", 4, 11, "shift_elements.F2[2]: joins link 2 to itself"),
    (
        "element-of-one-link.yaml",
        3,
        7,
        "shift_elements.T1: read a list of 1, expected two links: [first, second]",
    ),
    ("element-twice.yaml", 9, 27, "gears.2.engaged[3]: shift element F2 is engaged twice"),
    (
        "element-unknown.yaml",
        9,
        19,
        "gears.2.engaged[1]: read 'F3', expected the name of a shift element: T1, F2",
    ),
    (
        "engaged-not-a-list.yaml",
        9,
        18,
        "gears.2.engaged: read 'F2', expected a list of shift elements",
    ),
    (
        "gear-not-a-mapping.yaml",
        9,
        8,
        "gears.2: read 'F2', expected a list of shift elements, or a mapping with `engaged`, `speeds`, ",
    ),
    ("gears-empty.yaml", 4, 8, "gears: `gears` is missing or empty"),
    ("gears-missing.yaml", 1, 1, 'such as `gears: {"1": [T1]}`'),
    (
        "housing-speed.yaml",
        9,
        33,
        "gears.2.speeds.housing: read 0 (the housing), expected a link number from 1 to 3",
    ),
    (
        "idle-unknown.yaml",
        2,
        7,
        "idle: read 'publish', expected `exact` or `published`; did you mean `published`?",
    ),
    ("input-is-output.yaml", 2, 9, "output: input and output are both link 1"),
    ("key-empty.yaml", 9, 3, "gears: read an empty key, expected a name"),
    ("key-is-a-list.yaml", 9, 3, "a key that is a list or a mapping, expected text"),
    ("key-twice.yaml", 11, 1, "key `name` is given twice, the first is on line 2, column 1"),
    ("key-unknown.yaml", 7, 1, "unknown key `gaers`; did you mean `gears`?"),
    ("link-fraction.yaml", 6, 36, "mechanisms.D1.third: read '3.5', expected a link number"),
    (
        "link-name-twice.yaml",
        1,
        20,
        "links[3]: link 3 has the name of link 1, expected another name",
    ),
    (
        "link-named-housing.yaml",
        1,
        20,
        "links[3]: `housing` is the housing, expected another name for link 3",
    ),
    (
        "link-octal.yaml",
        6,
        36,
        "mechanisms.D1.third: read '03', expected a link number from 1 to 3 or `housing`",
    ),
    (
        "link-of-10000-digits.yaml",
        6,
        36,
        "mechanisms.D1.third: read '9999999999999999999999999999999999999999...', expected a number of at most 9 digits",
    ),
    (
        "link-out-of-range.yaml",
        6,
        36,
        "mechanisms.D1.third: read '4', expected a link number from 1 to 3",
    ),
    (
        "link-unknown-name.yaml",
        6,
        41,
        "mechanisms.D1.third: read 'carier', expected the name of a link or `housing`; did you mean `carrier`?",
    ),
    (
        "links-too-many.yaml",
        1,
        8,
        "links: read 100000000 links, but 2 shift elements and 1 mechanisms can connect at most 7",
    ),
    ("links-missing.yaml", 1, 1, "`links` is missing"),
    (
        "links-not-a-number.yaml",
        1,
        8,
        "links: read 'three', expected the number of links or a list of their names",
    ),
    ("mechanism-without-ratio.yaml", 6, 3, "mechanisms.D1: `ratio` is missing"),
    ("merge-key.yaml", 9, 9, "gears.2: the merge key `<<` is not accepted"),
    ("name-of-two-lines.yaml", 2, 7, "name: read 'two\\nlines', expected one line of text"),
    ("nested-without-end.yaml", 1, 17, "nested deeper than 16 levels"),
    (
        "no-mapping.yaml",
        1,
        1,
        "read a list, expected a case: a mapping with `elements`, `mechanisms`, `springs`",
    ),
    (
        "number-hexadecimal.yaml",
        6,
        46,
        "mechanisms.D1.ratio: read '0x10', expected a number or a calculation such as -96/39",
    ),
    ("number-infinite.yaml", 6, 46, "mechanisms.D1.ratio: read '-.inf', expected a number"),
    ("number-nan.yaml", 6, 46, "mechanisms.D1.ratio: read '.nan', expected a number"),
    ("number-sexagesimal.yaml", 6, 46, "mechanisms.D1.ratio: read '1:30:15', expected a number"),
    (
        "number-too-large.yaml",
        6,
        46,
        "mechanisms.D1.ratio: read '1e999999999', expected a smaller number",
    ),
    (
        "number-with-comma.yaml",
        6,
        46,
        "mechanisms.D1.ratio: read '-2,5', expected a number or a calculation such as -96/39 (with a decimal point)",
    ),
    ("number-with-underscore.yaml", 6, 46, "mechanisms.D1.ratio: read '1_000', expected a number"),
    (
        "number-with-word.yaml",
        6,
        46,
        "mechanisms.D1.ratio: read 'abc', expected a number or a calculation such as -96/39",
    ),
    (
        "ratio-by-zero.yaml",
        6,
        46,
        "mechanisms.D1.ratio: read '-96/0', expected a denominator other than 0",
    ),
    ("ratio-zero.yaml", 6, 46, "mechanisms.D1.ratio: read 0, expected a ratio other than 0"),
    (
        "speed-no-number.yaml",
        9,
        36,
        "gears.2.speeds.2: read 'fast', expected a speed with its unit",
    ),
    ("speed-of-input.yaml", 9, 33, "gears.2.speeds.1: link 1 is the input"),
    ("tab.yaml", 3, 1, "not YAML: read a tab, expected blanks"),
    ("tag.yaml", 6, 46, "tag !!python/name:os.system is not accepted"),
    ("two-documents.yaml", 10, 1, "a second document starts here"),
    ("unclosed.yaml", 8, 21, "not YAML"),
    ("gears-null.json", 1, 1, "gears: `gears` is missing or empty"),
    ("comment.json", 2, 15, "not JSON: read '//', expected a key in double quotes"),
    ("cut-off.json", 1, 13, "not JSON: read the end of the file, expected a key in double quotes"),
    ("data-after-the-end.json", 7, 1, "not JSON: read '{', expected the end of the file"),
    ("half-a-character.json", 2, 11, "half a character"),
    ("infinity.json", 4, 71, "not JSON: read '-Infinity', expected a value"),
    ("key-twice.json", 2, 15, "key `links` is given twice, the first is on line 2, column 3"),
    ("key-unknown.json", 4, 62, "mechanisms.D1: unknown key `ratoi`; did you mean `ratio`?"),
    ("nan.json", 4, 71, "not JSON: read 'NaN', expected a value"),
    ("nested-without-end.json", 1, 17, "nested deeper than 16 levels"),
    (
        "number-too-large.json",
        4,
        71,
        "mechanisms.D1.ratio: read '1e999', expected a smaller number",
    ),
    ("octal.json", 2, 12, "not JSON: read '03', expected a value"),
    ("single-quotes.json", 2, 3, "not JSON: read ''links'', expected a key in double quotes"),
    ("tab-in-text.json", 2, 13, "not JSON: Invalid control character"),
    ("trailing-comma.json", 5, 37, "not JSON: read ']', expected a value"),
    *SPRING_FAULTS,
    *FRICTION_FAULTS,
    *STRAIGHT_FAULTS,
]

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


def reader(file: str) -> Callable[[bytes, str], Reading]:
    return read_json if file.endswith(".json") else read_yaml


def yaml_case(text: str) -> Transmission:
    return read_yaml(text.encode(), "case.yaml").case


def errors(data: bytes | str, file: str = "case.yaml") -> list[Problem]:
    with pytest.raises(ReadError) as caught:
        reader(file)(data.encode() if isinstance(data, str) else data, file)
    return caught.value.problems


@pytest.mark.parametrize(("file", "line", "column", "words"), FAULTS)
def test_a_fault_is_told_with_its_place(file: str, line: int, column: int, words: str) -> None:
    problem, *others = errors((BAD_FILES / file).read_bytes(), file)
    assert problem.place is not None
    assert (problem.place[:3], others) == ((file, line, column), [])
    assert words in problem.message
    assert len(problem.message) < 250


def test_every_bad_yaml_file_is_in_the_table() -> None:
    assert {file.name for file in BAD_FILES.glob("*.yaml")} == {
        file for file, *_ in FAULTS if file.endswith(".yaml")
    }


def test_the_shipped_case() -> None:
    # the published input of MZKT 7922, field by field
    assert read_yaml((CASES / "mzkt7922.yaml").read_bytes(), "").case == Transmission(
        name="MZKT 7922",
        source="Algin V.B. Schematization and calculation of mobile machine presented as "
        "multibody system. Kinematics and quasistatics (MZKT 7922 gearbox)",
        links=6,
        shift_elements=[
            ShiftElement(2, 0, "T1"),
            ShiftElement(2, 3, "F2"),
            ShiftElement(3, 0, "T3"),
            ShiftElement(5, 0, "T4"),
            ShiftElement(4, 6, "F5"),
        ],
        mechanisms=[
            Mechanism(1, 2, 4, -0.8, 0.94, 0.9),
            Mechanism(1, 3, 4, 2.6, 0.95, 2.6),
            Mechanism(4, 5, 6, -2.461, 0.97),
        ],
        gears=[Gear(engaged) for engaged in ([1, 4], [2, 4], [5, 1], [5, 2], [3, 4], [3, 5])],
        idle="published",
    )


def test_every_key() -> None:
    assert yaml_case("""
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
            Mechanism(4, 0, 0, 1.0, name="Л"),
        ],
        gears=[
            Gear([2, 1], {3: 0.5}, {2: -0.2, 4: 3.0}, name="on"),
            Gear(input=4, output=3, name="tow"),
        ],
    )


@pytest.mark.parametrize("nothing", ["", "shift_elements:", "shift_elements: {}", "name: null"])
def test_keys_without_a_value_count_as_not_given(nothing: str) -> None:
    text = "links: 2\nmechanisms: {P: {first: 1, second: 2, third: ~, ratio: 2}}\ngears: {N: }\n"
    assert yaml_case(text + nothing) == Transmission(
        2, [], [Mechanism(1, 2, 0, 2, name="P")], [Gear(name="N")]
    )


def test_json_is_read_like_yaml() -> None:
    text = """{"name": "a\\/b \\ud83d\\ude9c",\t"links": 2, "shift_elements": null, "coast": false,
        "mechanisms": {"P": {"first": 1, "second": "2", "ratio": "3/2"}},
        "gears": {"1": {"engaged": [], "speeds": {}, "torques": {"1": 1e-05}}}}"""
    assert read_json(text.encode(), "case.json").case == Transmission(
        name="a/b \U0001f69c",
        links=2,
        shift_elements=[],
        mechanisms=[Mechanism(1, 2, 0, 1.5, name="P")],
        gears=[Gear(torques={1: 1e-05})],
        coast=False,
    )


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-32"])
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_encodings_and_ends_of_lines(encoding: str, end: str) -> None:
    text = "name: Коробка\n" + DIFFERENTIAL
    data = text.replace("\n", end).encode(encoding)
    assert read_yaml(data, "case.yaml").case == yaml_case(text)
    problem = errors(text.replace("-2.5", "x").replace("\n", end).encode(encoding))[0]
    assert problem.place is not None
    assert problem.place[1:] == (7, 46, "  D1: {first: 1, second: 2, third: 3, ratio: x}")


@pytest.mark.parametrize(
    ("data", "line", "column", "words"),
    [
        (b"", 1, 1, "the file is empty"),
        (b" \r\n\n", 1, 1, "the file is empty"),
        (b"links: 3\nname: \xcf\xe5", 2, 7, "not valid UTF-8"),
        ("ю: Ж".encode() + b"\xd0", 1, 5, "not valid UTF-8"),
        (codecs.BOM_UTF16_LE + b"a\0\n\0b\0\x00\xd8", 2, 2, "not valid UTF-16"),
        (b"links: 3\n\x7fELF\0\0", 2, 5, "a zero byte"),
        ("links: 3".encode("utf-16-le"), 1, 2, "a zero byte"),
    ],
)
@pytest.mark.parametrize("file", ["case.yaml", "case.json"])
def test_what_is_no_text(data: bytes, line: int, column: int, words: str, file: str) -> None:
    (problem,) = errors(data, file)
    assert problem.place is not None
    assert (problem.place[:3], words in problem.message) == ((file, line, column), True)


@pytest.mark.parametrize("text", ["# nothing\n", "---\n", "null", "text", "[1, 2]"])
def test_what_is_no_mapping(text: str) -> None:
    (problem,) = errors(text)
    assert "expected a case" in problem.message


def test_all_faults_are_told_in_one_run() -> None:
    text = DIFFERENTIAL.replace("-2.5", "x").replace("[F2]", "[F9]").replace("[1, 2]", "[1, 8]")
    assert [str(problem) for problem in errors("idle: x\n" + text)] == [
        "case.yaml:1:7: error: idle: read 'x', expected `exact` or `published` [E126]",
        "case.yaml:5:11: error: shift_elements.F2[2]: read '8', "
        "expected a link number from 1 to 3 or `housing` [E126]",
        "case.yaml:7:46: error: mechanisms.D1.ratio: read 'x', "
        "expected a number or a calculation such as -96/39 [E125]",
        "case.yaml:10:19: error: gears.2.engaged[1]: read 'F9', "
        "expected the name of a shift element: T1, F2 [E126]",
    ]


def test_a_mistyped_key_is_read_as_what_was_meant() -> None:
    text = DIFFERENTIAL.replace("gears:", "gaers:").replace("[F2]", "[X]")
    assert [problem.message for problem in errors(text)] == [
        "unknown key `gaers`; did you mean `gears`?",
        "gears.2.engaged[1]: read 'X', expected the name of a shift element: T1, F2",
    ]


def test_a_fault_brings_no_others_with_it() -> None:
    for part, broken in [
        ("links: 3", "links: x"),
        ("links: 3", "links: {}"),
        ("links: 3\n", ""),
        ("{first: 1, second: 2, third: 3, ratio: -2.5}", "x"),
        ("  T1: [2, housing]\n  F2: [1, 2]\n", "  - x\n"),
        ("  D1: {first: 1, second: 2, third: 3, ratio: -2.5}", "  []"),
    ]:
        assert len(errors(DIFFERENTIAL.replace(part, broken))) == 1


def test_problems_of_the_model_are_located() -> None:
    text = DIFFERENTIAL.replace("ratio: -2.5", "ratio: 2.5")
    text += "  tow: {engaged: [T1, F2], speeds: {3: 1}}\n"
    reading = read_yaml(text.encode(), "case.yaml")
    (warning,) = reading.warnings  # no planet speed
    assert str(warning).startswith("case.yaml:6:3: warning: mechanisms.D1: ratio 2.5")
    places = {
        ("links",): "1:8: error: links: m",
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


def test_names_of_links_are_located() -> None:
    text = "links:\n- a\n- b\nmechanisms: {P: {first: a, second: b, ratio: 2}}\ngears: {1: }"
    located = read_yaml(text.encode(), "f").locate(Problem("E234", "m", ("link_names", 2)))
    assert str(located) == "f:3:3: error: links[2]: m [E234]"


def test_aliases_share_what_they_repeat() -> None:
    text = DIFFERENTIAL.replace('"1": {engaged: [T1]}', '"1": &first {engaged: [T1]}')
    case = yaml_case(text + "  again: *first\n")
    assert case.gears[2].engaged == (1,)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        *(("2", 2.0), ("-.8", -0.8), ("5.", 5.0), (".26E+01", 2.6), ("+1e-05", 1e-05)),
        *(("-96/39", -96 / 39), ("1.5/-2e1", -0.075), ("96 / 39", 96 / 39), ("'1'", 1.0)),
    ],
)
def test_numbers(text: str, value: float) -> None:
    case = yaml_case(DIFFERENTIAL.replace("ratio: -2.5}", f"ratio: -2.5, planet_ratio: {text}}}"))
    assert case.mechanisms[0].planet_ratio == value


@pytest.mark.parametrize(
    "text",
    [
        *(
            [
                "1_0",
                ".",
                "e5",
                "1e",
                "1e1.5",
                "--1",
                "0x10",
                "0b1",
                "1:30:15",
                "inf",
                "nan",
                "1d5",
                ".inf",
                "-.INF",
                ".nan",
                "١",
            ]
        ),
        *(
            [
                "1 2 3",
                "1/",
                "/2",
                "true",
                "1e400",
                "1/0",
                "1/0e9",
                "1/1e-999",
                "-.",
                "1e+",
                "1e+-2",
                "{}",
                "[]",
                "~",
                "''",
            ]
        ),
        *("1" + "0" * 400, "1e99999999999999999999", "9" * 100_000),
    ],
)
def test_no_numbers(text: str) -> None:
    (problem,) = errors(DIFFERENTIAL.replace("-2.5", text))
    assert problem.message.startswith("mechanisms.D1.ratio: read ")


def heavy_documents() -> dict[str, str]:
    """Documents that would keep a careless reader busy, and their file names."""
    many = range(20_000)
    gears = "".join(f"  g{n}: {{engaged: *all}}\n" for n in many)
    elements = "".join(f"  e{n}: [1, 0]\n" for n in many)
    engaged = ", ".join(f"e{n}" for n in many)
    laughs = "".join(f"l{n}: &l{n} [{', '.join([f'*l{n - 1}'] * 9)}]\n" for n in range(1, 30))
    return {
        "brackets.yaml": "[" * 200_000,
        "braces.yaml": "{" * 200_000,
        "brackets.json": "[" * 200_000,
        "braces.json": '{"a":' * 200_000,
        "dashes.yaml": "- " * 200_000,
        "question-marks.yaml": "? " * 200_000,
        "laughs.yaml": "l0: &l0 [x]\n" + laughs,
        "shared.yaml": f"links: 2\nshift_elements:\n{elements}all: &all [{engaged}]\ngears:\n{gears}",
        "unknown-keys.yaml": "".join(f"key{n}: 1\n" for n in many),
        "unknown-elements.yaml": f"links: 2\nmechanisms: {{}}\ngears: {{1: {{engaged: [{engaged}]}}}}",
        "key-twice.json": '{"a": ' + '{"b": 1, ' * 10 + '"c": 1, ' * 20_000,
        "same-key.yaml": "links: 3\n" * 20_000,
        "bad-mechanisms.yaml": "mechanisms:\n" + "".join(f"  m{n}: 1\n" for n in many),
        "long-key.yaml": "? " + "k" * 1_000_000 + "\n: 1\n",
        "digits.json": '{"links": ' + "9" * 1_000_000 + "}",
    }


@pytest.mark.parametrize("file", heavy_documents())
def test_heavy_documents_end_quickly(file: str) -> None:
    text = heavy_documents()[file]
    start = time.process_time()
    problems = errors(text, file)
    assert time.process_time() - start < 5
    assert len(problems) <= 101


def test_a_person_gets_no_more_errors_than_can_be_read() -> None:
    problems = errors("".join(f"key{n}: 1\n" for n in range(1000)))
    assert len(problems) == 101
    assert str(problems[-1]) == "case.yaml: error: too many errors, the rest is not read [E108]"


MUTATIONS = ["", "[", "]", "{", "}", ":", ",", "-", "?", "&a ", "*a ", "!x ", "|\n", "'", '"', "#"]
MUTATIONS += [
    "\n",
    "\t",
    "  ",
    "0",
    "1e9",
    "~",
    "\x07",
    "\\",
    "<<: ",
    "---\n",
    "%YAML 9\n",
    "ж",
    ".",
]


@given(st.randoms(use_true_random=False), st.sampled_from(["yaml", "json"]))
def test_broken_documents_end_in_a_reading_or_a_read_error(dice: random.Random, kind: str) -> None:
    if kind == "yaml":
        text = (CASES / "mzkt7922.yaml").read_text(encoding="utf-8")
    else:
        text = json.dumps(
            {
                "links": 2,
                "mechanisms": {"P": {"first": 1, "second": 2, "ratio": 2}},
                "gears": {"1": {"engaged": [], "torques": {"1": "1/2"}}},
            },
            indent=1,
        )
    for _ in range(dice.randint(1, 4)):
        start = dice.randrange(len(text))
        text = text[:start] + dice.choice(MUTATIONS) + text[start + dice.randint(0, 6) :]
    check_survival(text.encode(), f"case.{kind}")


@given(st.binary(max_size=200), st.sampled_from(["case.yaml", "case.json"]))
def test_any_bytes_end_in_a_read_error(data: bytes, file: str) -> None:
    check_survival(data, file)


@given(st.text("{}[]:,-?&*!|>'\"#%@`\n\t <~.0a\\", max_size=60))
def test_any_punctuation_ends_in_a_read_error(text: str) -> None:
    check_survival(text.encode(), "case.yaml")
    check_survival(text.encode(), "case.json")


def check_survival(data: bytes, file: str) -> None:
    try:
        reading = reader(file)(data, file)
    except ReadError as error:
        assert all(problem.place and problem.place.file == file for problem in error.problems)  # noqa: PT017
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


def _speeds(given: str, links: str = "[engine, FL, FR]") -> Reading:
    text = f"""
links: {links}
mechanisms: {{axle: {{first: 2, second: 3, third: 1, ratio: -1}}}}
gears: {{curve: {{output: 2, speeds: {{3: {given}}}}}}}
"""
    if links != "3":
        text = text.replace("first: 2, second: 3, third: 1", "first: FL, second: FR, third: engine")
        text = text.replace("output: 2", "output: FL").replace("{3:", "{FR:")
    return read_yaml(text.encode(), "curve.yaml")


@pytest.mark.parametrize(
    ("given", "factor"),
    [
        ("FL", 1),
        ("1.05*FL", 1.05),
        ("-FL", -1),
        ("21/20 * FL", 1.05),
        ("-1.05*link FL", -1.05),
        ("(1 + .05)*FL", 1.05),
    ],
)
def test_a_speed_may_be_given_by_that_of_another_link(given: str, factor: float) -> None:
    assert _speeds(given).case.gears[0].speeds == {3: SpeedOf(2, factor)}


@pytest.mark.parametrize(
    "name", ["*a", "2*3", "a*b", "1e3", "link 2", "-x", "2", "(a)", "x*link x"]
)
def test_a_link_of_any_name_may_give_a_speed(name: str) -> None:
    case = Transmission(
        links=3,
        shift_elements=[],
        mechanisms=[Mechanism(1, 2, 3, -2.5)],
        gears=[Gear(speeds={1: SpeedOf(2, 1.05), 3: SpeedOf(2)}, input=2, output=1)],
        link_names=["engine", name, "axle"],
    )
    assert read_yaml(write_yaml(case).encode(), "case.yaml").case == case


def test_a_link_that_has_a_number_is_told_from_a_speed_by_the_word_link() -> None:
    assert _speeds("1.05*link 2", "3").case.gears[0].speeds == {3: SpeedOf(2, 1.05)}
    assert _speeds("2", "3").case.gears[0].speeds == {3: 2.0}


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ("1.05*FI", "expected the name of a link after the `*`: engine, FL, FR"),
        ("FL*1.05", "expected the factor before the link: `1.05*FL`"),
        ("FL / 1.02", "expected the factor before the link: `1/1.02*FL`"),
        ("0*FL", "read a factor of 0"),
        ("2*FR", "is a multiple of itself"),
        ("2*300 Nm", "or a number relative to the input speed; this is a torque"),
        ("2**FL", "expected a number or a calculation"),
    ],
)
def test_a_speed_of_a_link_that_is_not_there_is_refused(given: str, said: str) -> None:
    with pytest.raises(ReadError) as caught:
        _speeds(given)
    [problem] = [one for one in caught.value.problems if one.severity == "error"]
    assert said in problem.message
    assert problem.place is not None
    assert problem.place.line == 4


def test_a_gear_may_be_a_list_of_what_is_engaged() -> None:
    text = b"""
links: 3
shift_elements: {C: [1, 2], B: [2, housing]}
mechanisms: {set: {first: 1, second: 2, third: 3, ratio: -2.5}}
gears: {direct: [C], low: {engaged: [B]}, none: [], nothing: }
"""
    case = read_yaml(text, "case.yaml").case
    assert [gear.engaged for gear in case.gears] == [(1,), (2,), (), ()]
    [problem] = [
        one for one in errors(text.replace(b"[C],", b"[C, D],"), "") if one.severity == "error"
    ]
    assert "gears.direct[2]: read 'D', expected the name of a shift element" in problem.message


def test_several_outputs_are_written_as_they_are_read() -> None:
    text = b"""
links: [a, b, c]
outputs: [b, c]
mechanisms: {set: {first: a, second: b, third: c, ratio: -2.5}}
gears: {one: {speeds: {c: b}}}
"""
    case = read_yaml(text, "case.yaml").case
    assert (case.output, case.outputs) == (2, (2, 3))
    assert mapping(case)["outputs"] == ["b", "c"]
    assert "output" not in mapping(case)
    assert read_json(write_json(case).encode(), "case.json").case == case
