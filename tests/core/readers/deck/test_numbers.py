"""Numbers of decks as Fortran reads them; ratios and percentages mean the same as in YAML."""

from fractions import Fraction
from random import Random

import pytest

from tests.chance import count, seeded
from tests.rejects import rejects
from vstatics.core import readers
from vstatics.core.errors import ReadError
from vstatics.core.model.transmission import Mechanism
from vstatics.core.readers.deck import reader as deck
from vstatics.core.readers.deck.numbers import NotANumberError, integer, real


def test_numbers_are_those_of_list_directed_input() -> None:
    """The exponent may be E, D, Q, a Cyrillic letter of the same look, or a sign alone."""
    numbers = {"-.8": -0.8, "+2.": 2.0, "2.6D0": 2.6, "2.6q-1": 0.26, ".26+1": 2.6, "26-1": 2.6}
    numbers |= {".26E+01": 2.6, ".2600Е+01": 2.6, ".2600е+01": 2.6}
    assert {text: real(text) for text in numbers} == numbers
    assert [integer(text) for text in ("6", "+6", "-6", "006")] == [6, 6, -6, 6]
    no_numbers = ["1E400-400", "1_0", "nan", "inf", "1e999", "٢", "0x10", "", ".", "+", "1e", "1 2"]
    no_integers = ["2.", "1e0", "1_0", "٢", "", "-", "9" * 30]
    for read, texts in ((real, [*no_numbers, "1" * 2000]), (integer, no_integers)):
        for text in texts:
            with pytest.raises(NotANumberError):
                read(text)


DECK = """\
KJG= 2 KL= 0 KG= {count}
NZD(I,1),I=1,KG: {count}*1
NZD(I,2),I=1,KG: {count}*2
NZD(I,3),I=1,KG: {count}*0
IAB(I),I=1,KG:{ratios}
ETAI(I),I=1,KG:{efficiencies}
NP= 1
KFRI(I),I=1,NP: 0
"""


def read(ratios: str, efficiencies: str = " .95", count: int = 1) -> list[Mechanism]:
    text = DECK.format(ratios=ratios, efficiencies=efficiencies, count=count)
    return list(deck.read(text.encode(), "case.dat").case.mechanisms)


def written_ratio(rng: Random) -> tuple[str, Fraction]:
    """A ratio of whole numbers in any layout, or a decimal number, and its exact value."""
    first, second = rng.choice([-1, 1]) * rng.randint(1, 99), rng.randint(1, 99)
    blanks = " " * rng.randint(0, 2), " " * rng.randint(0, 2)
    if rng.random() < 0.3:
        return f"{first}.5", Fraction(2 * abs(first) + 1, 2) * (1 if first > 0 else -1)
    return f"{first}{blanks[0]}:{blanks[1]}{second}", Fraction(first, second)


def written_percentage(rng: Random) -> tuple[str, Fraction]:
    percent = rng.randint(1, 100)
    if rng.random() < 0.3:
        return f"{percent / 100:.2f}", Fraction(percent, 100)
    return f"{percent}{' ' * rng.randint(0, 2)}%", Fraction(percent, 100)


def test_ratios_and_percentages_are_exact_fractions() -> None:
    for seed in range(count(40, 400)):
        rng = seeded(9100 + seed)
        number = rng.randint(1, 4)
        ratios, shares = (
            [written(rng) for _ in range(number)] for written in (written_ratio, written_percentage)
        )
        fields = [
            rng.choice([" ", "\n"])
            + rng.choice([" ", ", ", " , ", "\n"]).join(text for text, _ in one)
            for one in (ratios, shares)
        ]
        sets = read(fields[0], fields[1], number)
        assert [one.ratio for one in sets] == [float(value) for _, value in ratios]
        assert [one.efficiency for one in sets] == [float(value) for _, value in shares]


@pytest.mark.parametrize(("ratio", "share"), [("-5 : 2", "96 %"), ("7:3", "1%")])
def test_a_deck_reads_them_as_yaml_does(ratio: str, share: str) -> None:
    text = f"{{first: a, second: b, ratio: {ratio!r}, efficiency: {share}}}"
    yaml = f"links: [a, b]\nmechanisms:\n  p: {text}\ngears: {{'1': []}}\n"
    expected = readers.read(yaml.encode(), "case.yaml").case.mechanisms[0]
    (mechanism,) = read(f" {ratio}", f" {share}")
    assert (mechanism.ratio, mechanism.efficiency) == (expected.ratio, expected.efficiency)


NOT_A_NUMBER = {
    (" -5 : 2 sets", " 1"): ":5:16: error: IAB(1): read '-5 : 2', expected a number: write -2.5",
    (" -5 /2 as drawn", " 1"): "IAB(1): read '-5 / 2', expected a number: write -2.5",
    (" 5 * 2", " 1"): "IAB(1): read '5 * 2', expected a number: write 10",
    (" 5 - 2 sets", " 1"): "IAB(1): read '5 - 2', expected a number: write 3",
    (" 5 x 2", " 1"): "IAB(1): read '5 x 2', expected a number: write 10",
    (" 5 ÷ 2", " 1"): "IAB(1): read '5 ÷ 2', expected a number: write 2.5",
    (" 5 : 2!", " 1"): "IAB(1): read '5 : 2!', expected a number [E102]",
    (" 5 / 0", " 1"): "IAB(1): read '5 / 0', expected a number [E102]",
    (" 5:0", " 1"): "IAB(1): read '5:0', expected a denominator other than 0",
    (" 5 : 2 : 3", " 1"): "IAB(1): read '5 :",
    (" 5%:2", " 1"): "IAB(1): read '5%:2', expected a number such as",
    ("\n5:2\n3:2", " 1"): "IAB: read 2 values, expected 1 (KG)",
    (" 2", " .94 %, as measured"): "ETAI(1): read '.94 %', expected a number: write 0.0094",
    (" 2", " .94 % 3rd gear"): "ETAI(1): read '.94 %', expected a number: write 0.0094",
}


def test_calculations_are_refused_where_they_stand() -> None:
    for fields, said in NOT_A_NUMBER.items():
        with rejects(ReadError, said):
            read(*fields)


def test_words_behind_the_last_value_are_no_calculation() -> None:
    for words in (": as drawn", "- as drawn", "/", "(set 1)"):
        assert read(f" 2.5 {words}")[0].ratio == 2.5
    assert read(" 2", " .94 %")[0].efficiency == pytest.approx(0.0094, rel=1e-15)
