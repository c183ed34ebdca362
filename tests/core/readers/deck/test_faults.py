"""Decks with one fault each: the place and the words of what is reported.

The places were counted in the files, not taken from the program.
"""

import pytest

from tests.commands import BAD_FILES
from vstatics.core.errors import Problem, ReadError
from vstatics.core.readers.deck import reader as deck

# file:line:column: words of the message, with `...` between parts of it; a line that is set in
# goes on with the one above
FAULTS = r"""
size-missing:24:34: KL is missing ... number of shift elements
size-empty:2:11: KL: read 0 values ... 'KG= 2 KNM= 1' ... expected one
size-two-values:2:14: KL: read 2 values ... expected one
size-real:2:12: KL: read '3.0' ... whole number
size-huge:2:6: KJG: read 1000000000 ... cannot hold
size-huge-gears:14:5: NP: read 1000000000 ... cannot hold
size-of-many-digits:2:18: KG: read '999 ... overflows
size-negative:2:18: KG: read -2 ... expected 0 or more
links-1:2:6: KJG: read 1 ... expected 2 or more links
links-more-than-joined:2:6: KJG: read 13 links ... at most 12
gears-0:14:5: NP: read 0 ... expected 1 or more gears
field-missing:22:34: IAB is missing ... 2 values (KG)
field-mistyped:24:34: ETAI is missing ... line 10 ... `ETAA`
field-twice:15:1: IAB: given again ... line 8, column 1
field-without-index:4:1: NZF: read 'NZF(I)' ... NZF(I,1) or NZF(I,2)
field-of-wrong-index:7:1: NZD: read 'NZD(I,4)' ... NZD(I,1) or NZD(I,2) or NZD(I,3)
values-too-few:9:5: IAB(2): read 1 value ... 'ETAI(I),I=1,KG:' in line 10 ... expected 2 (KG)
values-too-few-before-prose:9:5: IAB(2): read 1 value ... 'Efficiencies 3:' in line 10 ...
    expected 2 (KG)
values-none:10:16: ETAI(1): read 0 values ... 'NNM(K),K=1,KNM: 2' in line 11 ... expected 2 (KG)
values-too-many:9:10: IAB: read 3 values ... expected 2 (KG)
values-too-many-on-the-next-line:10:1: IAB: read 3 values ... expected 2 (KG)
number-of-two-points:9:6: IAB(2): read '2.6.1' ... a number such as -.8 or .26E+01
number-with-underscore:9:6: IAB(2): read '2_6' ... a number
number-nan:9:1: IAB(1): read 'nan' ... a number
number-inf:11:5: ETAI(2): read 'inf' ... a number
number-of-other-digits:9:6: IAB(2): read '٢' ... a number
number-overflows:9:6: IAB(2): read '1e999999999', which overflows
number-word:11:5: ETAI(2): read 'good' ... a number
decimal-comma-first:8:15: IAB(1): read 0 values before ... write a decimal point
decimal-comma:9:6: IAB: read 4 values ... expected 2 ... decimal point
two-commas:9:6: IAB(2): two commas with nothing between
comma-first:3:18: NZF(1,1): nothing before the comma
repeat-huge:9:1: IAB: read 1000000000 values ... expected 2 (KG)
repeat-0:9:6: IAB(2): read '0*2.6' ... repeat count above 0
repeat-of-nothing:9:6: IAB(2): read '2*' ... a number
link-out-of-range:3:20: NZF(2,1): read 5 ... a link number from 1 to 4
element-joins-itself:4:22: NZF(3,2): connects link 1 to itself
member-out-of-range:7:20: NZD(2,3): read 7 ... a link number from 1 to 4
members-equal:5:20: NZD(2,1): two members are on the same link, expected different links
ratio-0:9:6: IAB(2): read 0 ... other than 0
efficiency-0:11:5: ETAI(2): read 0 ... above 0
efficiency-above-1:11:1: ETAI(1): read 97 ... up to 1
planet-ratio-0:13:17: UAQ(1): read 0 ... other than 0
planets-too-many:2:25: KNM: read 3 ... 0 to 2 (KG)
planet-of-no-mechanism:12:17: NNM(1): read 3 ... from 1 to 2
planet-twice:12:19: NNM(2): mechanism 2 is given twice
engaged-out-of-range:17:3: NFRI(2,1): read 4 ... from 1 to 3
engaged-twice:17:3: NFRI(2,1): shift element 1 is engaged twice
engaged-run-together:17:3: NFRI(2,1): read 1 value ... the end of the line ... expected 2
    (KFRI(1))
engaged-too-many:18:3: NFRI(1,2): read 2 values ... expected 1 (KFRI(2))
engaged-line-too-many:19:1: NFRI: read 3 lines of numbers ... expected 2
engaged-line-missing:17:4: NFRI(1,2): read 2 values ... 'KWZ(I),I=1,NP: 0 1' in line 18 ...
    expected 3 (KFRI)
engaged-negative-count:15:19: KFRI(2): read -1 ... 0 or more
engaged-huge-count:15:19: KFRI(2): read 1000000002 ... cannot hold
speed-of-input:20:31: NWZ(1,2): link 1 is the input
speed-missing:23:34: NWZ is missing ... 1 value (KWZ)
torque-on-output:23:31: NMZ(1,1): link 4 is the output
torque-twice:23:33: NMZ(2,1): link 3 is given twice in gear 1
input-is-output:14:6: INP: input and output are both link 4
input-out-of-range:14:6: INP: read 5 ... a link number from 1 to 4
output-0:14:7: IOUT: read 0 ... a link number from 1
gear-output-out-of-range:14:19: IOUT(2): read 5 ... a link number from 1 to 4
idle-unknown:14:7: IDLE: read 2 ... 0 (published) or 1 (exact)
coast-unknown:14:8: COAST: read -1 ... 0 (driving) or 1 (coasting)
name-of-unknown-kind:14:1: NAME X1: `X` is not a kind of name ... F (shift element)
name-out-of-range:14:1: NAME F4: read 4 ... shift element, from 1 to 3
name-given-again:15:1: NAME F2: given again ... line 14, column 1
name-of-another:15:1: NAME F3: shift element 3 has the name of
name-empty:14:1: NAME P1: read nothing
title-with-number:14:1: NAME T1: the title has no number
empty:1:1: the file is empty ... KJG=
blank:1:1: the file is empty ... KJG=
prose:1:1: no field of a deck found ... `KJG=` first, or `--from yaml`
utf-16:1:1: UTF-16 ... save it as UTF-8
utf-32:1:1: UTF-32 ... save it as UTF-8
binary:1:1: binary ... UTF-8
half-a-character:1:3: byte 0xD0 is not UTF-8
"""
NO_FAULT = (BAD_FILES / "no-fault.dat").read_text("utf-8")
TABLE = dict(line.split(":", 1) for line in FAULTS.replace("\n    ", " ").strip().splitlines())


def test_each_fault_is_reported_alone_with_its_place_and_words() -> None:
    wrong = {}
    for name, expected in TABLE.items():
        file = f"{name}.dat"
        with pytest.raises(ReadError) as raised:
            deck.read((BAD_FILES / file).read_bytes(), file)
        errors = [problem for problem in raised.value.problems if problem.severity == "error"]
        place, _, words = expected.partition(": ")
        located = str(errors[0]).startswith(f"{file}:{place}: error: ")
        said = all(part in errors[0].message for part in words.split(" ... "))
        if len(errors) != 1 or not located or not said:
            wrong[f"{name}:{expected}"] = str(raised.value)
    assert wrong == {}


@pytest.mark.parametrize(("field", "counts"), [("KFRI", "2 1"), ("KWZ", "0 1")])
def test_too_many_counts_are_the_only_fault(field: str, counts: str) -> None:
    more = NO_FAULT.replace(f"{field}(I),I=1,NP: {counts}", f"{field}(I),I=1,NP: 1 {counts}")
    with pytest.raises(ReadError) as raised:
        deck.read(more.encode(), "counts.dat")
    [problem] = raised.value.problems
    assert problem.message == f"{field}: read 3 values, expected 2 (NP)"
    assert deck.read(NO_FAULT.encode(), "no-fault.dat").warnings == []


def test_a_field_with_an_unknown_name_causes_a_warning() -> None:
    place = f"case.dat:{len(NO_FAULT.splitlines()) + 2}:1: "
    for line, words in (
        ("MODE= 2", ["read `MODE`, expected the name of a field; the line is ignored"]),
        ("IDEL = 1", ["did you mean `IDLE`?"]),
        ("INQ(I),I=1,NP: 1 1", ["did you mean `INP`?"]),
        ("Where n = 3", []),
        ("Number of gears (NP=3):", []),
    ):
        warnings = deck.read(f"{NO_FAULT}\n{line}\n".encode(), "case.dat").warnings
        for told, word in zip(map(str, warnings), words, strict=True):
            assert (told.startswith(place), word in told) == (True, True), line


def test_a_field_that_looks_like_a_result_ends_the_deck() -> None:
    """Users of decks look for the missing field below that line, where it is."""
    early = NO_FAULT.replace("ETAI(I),", "ETA(I),")
    line = early[: early.index("ETA(")].count("\n") + 1
    with pytest.raises(ReadError, match="NP is missing") as raised:
        deck.read(early.encode(), "early.dat")
    hint = f"; the deck ends where results begin, at line {line}"
    assert raised.value.problems[0].message.endswith(hint)


def test_words_of_yaml_lead_users_of_decks_to_their_own_words() -> None:
    reading = deck.read(NO_FAULT.encode(), "no-fault.dat")
    moved = reading.locate(Problem("E514", "expected `inertias` of links", ("inertias",)))
    assert moved.message.endswith("; a deck cannot contain `inertias`: convert the deck to YAML")
    with pytest.raises(ReadError, match=r"read '-78/36', .*; write the quotient as `-78:36`"):
        deck.read(NO_FAULT.replace("-2.5 2.6", "-78/36 2.6").encode(), "quotient.dat")


def test_every_deck_with_a_fault_is_tested() -> None:
    files = {file.stem for file in BAD_FILES.glob("*.dat")}
    assert files == TABLE.keys() | {"no-fault"}
