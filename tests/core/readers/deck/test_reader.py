"""The deck reader: the published example, the rules of reading, and broken decks."""

import time
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.chance import count
from tests.commands import BAD_FILES, MZKT
from vstatics.core.errors import Problem, ReadError
from vstatics.core.model.transmission import Gear, Mechanism, ShiftElement, Transmission
from vstatics.core.readers.deck import reader as deck
from vstatics.core.readers.deck.text import head, holds_deck

PUBLISHED = MZKT.read_bytes()
SMALL = (BAD_FILES / "no-fault.dat").read_bytes()

OPENING = """\
KJG — число основных подвижных звеньев механизма;
KL — число муфт и тормозов;
KG — число преобразующих механизмов;
KNM — число нестандартных преобразующих механизмов (из числа KG).
"""

MZKT7922 = Transmission(
    links=6,
    shift_elements=[ShiftElement(*ends) for ends in ((2, 0), (2, 3), (3, 0), (5, 0), (4, 6))],
    mechanisms=[
        Mechanism(1, 2, 4, ratio=-0.8, efficiency=0.94, planet_ratio=0.9),
        Mechanism(1, 3, 4, ratio=2.6, efficiency=0.95, planet_ratio=2.6),
        Mechanism(4, 5, 6, ratio=-2.461, efficiency=0.97),
    ],
    gears=[Gear(pair) for pair in ([1, 4], [2, 4], [5, 1], [5, 2], [3, 4], [3, 5])],
    idle="published",
)
"""The published deck, typed from its print."""


def case_of(text: str) -> Transmission:
    return deck.read(text.encode(), "case.dat").case


def errors_of(text: str) -> list[str]:
    with pytest.raises(ReadError) as raised:
        deck.read(text.encode(), "case.dat")
    return [str(problem) for problem in raised.value.problems if problem.severity == "error"]


def published(old: str, new: str) -> str:
    """The published deck with one change."""
    text = PUBLISHED.decode()
    assert text.count(old) == 1
    return text.replace(old, new)


@pytest.mark.parametrize("opening", ["", OPENING])
@pytest.mark.parametrize("ends", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "cp1251", "cp866", "koi8-r"])
def test_published_deck(encoding: str, ends: str, opening: str) -> None:
    if encoding in ("cp866", "koi8-r"):
        opening = opening.replace("—", "-")  # they lack the long dash
    text = opening + PUBLISHED.decode()
    data = text.replace("\n", ends).encode(encoding)
    reading = deck.read(data, "mzkt7922.dat")
    assert reading.case == MZKT7922
    assert reading.warnings == []


def test_a_dos_file_ends_at_its_mark() -> None:
    assert deck.read(PUBLISHED + b"\x1a\0KG: 7\r\n\xff", "old.dat").case == MZKT7922


def test_same_deck_written_otherwise() -> None:
    for old, new in (
        ("KJG= 6 KL= 5 KG= 3 KNM = 2", "KJG=6,KL=5,KG=3,KNM=2"),
        ("KJG= 6 KL= 5 KG= 3 KNM = 2", "  kjg = 6\nKL=\n5\n\tKG=3 (three) K N M=2 NP=6"),
        ("KJG= 6 KL= 5", "К J G= 6 links, К L= 5"),
        ("NZF(I,1),I=1,KL: 2 2 3 5 4", "NZF(I,1) , I = 1 , KL :\n2, 2,\t3\n5,4"),
        ("NZF(I,2),I=1,KL: 0 3 0 0 6", "NZF(I,2) 0 3 2*0 6"),
        ("NZF(I,2),I=1,KL: 0 3 0 0 6", "NZF(I,2)= 0 3 2*0 6"),
        ("NZF(I,2),I=1,KL: 0 3 0 0 6", "(NZF(I,2),I=1,KL): 0 3 0 0 6 (3 brakes)"),
        ("IAB(I),I=1,KG:\n-.8000Е+00 .2600Е+01", "IAB(I),I=1,KG -8D-1 26-1"),
        ("IAB(I),I=1,KG:\n-.8000Е+00", "IАВ= -.8"),
        ("IAB(I),I=1,KG:\n-.8000Е+00", "IAB(I),I=1,3: -.8\n\n"),
        (".9400Е+00 .9500Е+00 .9700Е+00", ".94 , .95,.97,"),
        (".9400Е+00 .9500Е+00 .9700Е+00", "+9.4e-1 .95Q0 .97\nProse 2.5\n3"),
        ("K FRI(I),I=1,N P:\n2 2 2 2 2 2", "KFRI(I),I=1,NP: 6*2"),
        ("1 4\n2 4\n5 1\n5 2\n3 4\n3 5", "1 4 2 4 5 1 5 2 3 4 3 5"),
        ("1 4\n2 4\n5 1\n5 2\n3 4\n3 5", "1 4\n\n2,4\n5 1\n5 2\n3 4\n3 5\n2 lines"),
        ("KM Z(I),I=1,N P:\n0 0 0 0 0 0", "KMZ(I),I=1,NP: 6*0\nName of a thing: A\nName A: B"),
    ):
        text = published(old, new)
        if "NP=6" in new:
            text = text.replace("N P=  6\n", "")
        assert case_of(text) == MZKT7922


def test_own_fields() -> None:
    assert case_of(SMALL.decode()).idle == "published"
    assert case_of(SMALL.decode() + "IDLE= 1\n").idle == "exact"
    case = case_of(
        SMALL.decode() + "INP= 3 IOUT= 2\nCOAST= 1\nINP(I),I=1,NP: 1 0\nIOUT(I),I=1,NP: 2*4\n"
        "NAME T: Коробка: 2\nname f3 :  Сцепление  \nNAME J2: ring\nNAME D1: ряд\nNAME P2: R\n"
    )
    assert (case.input, case.output, case.coast, case.name) == (3, 2, True, "Коробка: 2")
    assert [(gear.input, gear.output) for gear in case.gears] == [(1, 4), (None, 4)]
    assert [element.name for element in case.shift_elements] == ["T1", "T2", "Сцепление"]
    assert case.link_names == ("1", "ring", "3", "4")
    assert [mechanism.name for mechanism in case.mechanisms] == ["ряд", "D2"]
    assert [gear.name for gear in case.gears] == ["1", "R"]


def test_what_may_be_left_out() -> None:
    text = "KJG=2\nKL=0\nKG=1\nNZD(I,1): 1\nNZD(I,2)= 2\nNZD(I,3): 0\nIAB= -2\nETAI= 1\n"
    pair = Transmission(2, [], [Mechanism(1, 2, 0, -2.0)], [Gear()], idle="published")
    assert case_of(f"{text}NP= 1\nKFRI= 0\nKWZ= 0\nKMZ= 0\n") == pair


def test_missing_kwz_and_kmz_are_warned_of_at_the_end() -> None:
    text = PUBLISHED.decode().partition("KWZ")[0]
    reading = deck.read(text.encode(), "cut.dat")
    assert reading.case == MZKT7922
    assert [problem.severity for problem in reading.warnings] == ["warning"] * 2
    for problem, field in zip(reading.warnings, ("KWZ", "KMZ"), strict=True):
        assert problem.message.startswith(f"{field} is missing and read as 0; a file that was cut")
        assert problem.place is not None
        assert problem.place.line == text.count("\n")


def test_results_end_the_input() -> None:
    """Another case behind them is an error."""
    tables = "\nResults\n(AJK(I,J),J=1,KL+KG),I=1,KJG:\n.000 1.000\nNP= 3\n"
    tables += "NZF(I,1),I=1,KL: 9\nW(I,J): ***\n"
    assert case_of(PUBLISHED.decode() + tables) == MZKT7922
    text = published("Число передач:", "W (угловые скорости), ETA (КПД):\nW = 3")
    assert case_of(text) == MZKT7922
    (error,) = errors_of(PUBLISHED.decode() + tables + "KJG= 3\n")
    assert "KJG: another case begins here, expected a single case in a file" in error


def test_all_errors_are_reported_in_the_order_of_the_text() -> None:
    text = published("2 2 3 5 4", "2 2 3 7 4").replace("-.2461Е+01", "x")
    text = text.replace(".9400Е+00", ".9x").replace(".9700Е+00", "1.97")
    text = text.replace("3 4\n3 5", "3 4\n3 3")
    assert [error.partition(": read")[0].partition(": shift")[0] for error in errors_of(text)] == [
        "case.dat:5:24: error: NZF(4,1)",
        "case.dat:17:22: error: IAB(3)",
        "case.dat:20:1: error: ETAI(1)",
        "case.dat:20:15: error: ETAI(3)",
        "case.dat:41:3: error: NFRI(2,6)",
    ]


def test_an_unknown_size_or_list_gives_no_further_errors() -> None:
    for old in ("KJG= 6", "KL= 5", "KG= 3", "N P=  6"):
        name = old.split("=")[0].replace(" ", "")
        (error,) = errors_of(published(old, ""))
        assert f"error: {name} is missing" in error
    (error,) = errors_of(published("NZF(I,1),I=1,KL: 2", "NZF(I,1),I=1,KL: two"))
    assert error == "case.dat:5:18: error: NZF(1,1): read 'two', expected a whole number [E102]"


def test_locate_gives_problems_of_the_model_their_place() -> None:
    locate = deck.read(SMALL, "small.dat").locate
    for path, start in (
        (("mechanisms", 2, "ratio"), "small.dat:9:6: error: IAB(2): "),
        (("mechanisms", 2, "efficiency"), "small.dat:11:5: error: ETAI(2): "),
        (("mechanisms", 2, "planet_ratio"), "small.dat:13:17: error: UAQ(1): "),
        (("mechanisms", 1, "third"), "small.dat:7:18: error: NZD(1,3): "),
        (("shift_elements", 3, "second"), "small.dat:4:22: error: NZF(3,2): "),
        (("gears", 1, "engaged", 2), "small.dat:17:3: error: NFRI(2,1): "),
        (("gears", 2, "speeds", 2), "small.dat:20:31: error: NWZ(1,2): "),
        (("gears", 1, "torques", 3), "small.dat:23:31: error: NMZ(1,1): "),
        (("gears",), "small.dat:14:5: error: NP: "),
        (("links",), "small.dat:2:6: error: KJG: "),
        (("output",), "small.dat:2:6: error: KJG: "),
    ):
        assert str(locate(Problem("E234", "wrong", path))) == f"{start}wrong [E234]"
    assert locate(Problem("E234", "wrong")) == Problem("E234", "wrong")


def test_text_of_decks() -> None:
    lines = ("(NFRI(K,I)", "  WSAT(K,I)", "KJG - links", "IAB")
    assert [head(line) for line in lines] == ["NFRI", "WSAT", "", ""]
    assert holds_deck(PUBLISHED)
    assert not holds_deck(b"links: 6\noutput: 3\n")
    assert not holds_deck(b"\0")


DECKS = st.sampled_from([PUBLISHED, SMALL, PUBLISHED.decode().encode("cp866")])
TOKENS = st.sampled_from(
    b"-.8|0|-1|7|1000000000|1000000000*0|3*2|1e999|nan|,|KJG=|KL= 2|NP=|IAB(I):|NZF(I,1):"
    b"|NAME J1: 2|AJK(I,J):|(|INP(I)=|IOUT=|KWZ= 2|NWZ= 1|\xd0|\0|\n|x|KNM= 3|=".split(b"|")
)


@given(DECKS, st.data(), st.integers(0, 6000), st.randoms(use_true_random=False))
@settings(max_examples=count(80, 900))
def test_decks_with_words_replaced_dropped_or_doubled_end_in_a_case_or_located_errors(
    data: bytes, draws: st.DataObject, length: int, rng: Random
) -> None:
    """Cut off, too, and with their lines in any order; `tests/fuzz.py` tries much more."""
    lines = [line.split(b" ") for line in data[:length].split(b"\n")]
    for _ in range(draws.draw(st.integers(1, 4))):
        line = draws.draw(st.sampled_from(lines))
        at = draws.draw(st.integers(0, len(line) - 1)) if line else 0
        line[at : at + 1] = draws.draw(st.lists(TOKENS, max_size=2)) or line[at : at + 1] * 2
    if length % 4 == 0:
        rng.shuffle(lines)
    start = time.process_time()
    try:
        problems = deck.read(b"\n".join(b" ".join(line) for line in lines), "case.dat").warnings
        severity = "warning"
    except ReadError as error:
        problems, severity = error.problems, "error"
    assert time.process_time() - start < 1
    assert severity == "warning" or any(problem.severity == "error" for problem in problems)
    for problem in problems:
        assert problem.place is not None
        assert problem.place.file == "case.dat"
        assert min(problem.place.line, problem.place.column) >= 1
