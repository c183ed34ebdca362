"""Results as listing: the order, widths and headings of the source."""

import re
from typing import Any

import pytest

from tests.core.writers.result_cases import NAMED, table
from vstatics import Gear, Mechanism, Results, Transmission, loads, solve
from vstatics.core.readers import read
from vstatics.core.writers import listing

LOSSY = """\
links: [a, b]
load: {speed: 1000 rpm, torque: 50 N*m}
mechanisms: {P: {first: a, second: b, ratio: -2, efficiency: {over: torque, points: [[0, 0.9]]}}}
gears: {G: []}
"""
SOURCE_ORDER = ["AJK", "W", "WSAT", "WFRI", "AMLG", "AMLG", "AMLGP", "AMLGP", "ETA", "IX"]


def test_tables_stand_in_the_order_of_the_source(published: Results) -> None:
    text = listing.write(published)
    heads = re.findall(r"^\(?([A-Z]+)\([IJ][,)].*:$", text.partition("RESULTS")[2], re.MULTILINE)
    assert heads[: len(SOURCE_ORDER)] == SOURCE_ORDER
    indices = "AJK(I,K),K=1,KLG),I=1,KJG|W(I,J),J=1,NP),I=1,KJG|WSAT(I,J),J=1,NP),I=1,KG"
    indices += "|WFRI(I,J),J=1,NP),I=1,KL|AMLG(I,J),J=1,NP),I=1,KL|AMLG(I,J),J=1,NP),I=(KL+1),KLG1"
    indices += "|AMLGP(I,J),J=1,NP),I=1,KL|AMLGP(I,J),J=1,NP),I=(KL+1),KLG1|IX(I,J),J=1,NP),I=1,KG"
    for index_list in (*(f"({one}" for one in indices.split("|")), "ETA(J),J=1,NP"):
        assert f"\n{index_list}:\n" in text


def test_what_does_not_exist_is_asterisks_of_the_width(several: Results) -> None:
    """Nothing is engaged in the last gear: only the input's speed, 1, is known."""
    text = listing.write(several)
    column = [line.split()[-1] for line in table(text, "(W(I,J),J=1,NP),I=1,KJG:")]
    assert "ETAI(I),I=1,KG:\n**********\n" in listing.write(solve(loads(LOSSY)))
    assert column == ["1.000", "*******", "*******", "*******"]
    assert table(text, "(IX(I,J),J=1,NP),I=1,KG:")[0].split()[-1] == "***"


@pytest.mark.parametrize("ratio", [3.5, -1e6, 12345678.9])
def test_columns_stay_aligned_when_numbers_are_wide(ratio: float) -> None:
    gears = [Gear(), Gear(torques={1: -0.5}), Gear(input=2, output=1)]
    case = Transmission(2, [], [Mechanism(1, 2, 0, ratio)], gears)
    text = listing.write(solve(case))
    for part in re.findall(r":\n((?:[ \d.*-]+\n)+)", text.partition("RESULTS")[2]):
        lines = part.splitlines()
        assert len({len(line) for line in lines}) == 1
        ends = [[found.end() for found in re.finditer(r"\S+", line)] for line in lines]
        assert all(one == ends[0] for one in ends)
    assert f"{ratio:.3f}" in text


def test_a_small_negative_number_is_printed_without_its_sign() -> None:
    """A pair of ratio -1e5 turns its second link at -.00001."""
    text = listing.write(solve(Transmission(2, [], [Mechanism(1, 2, 0, -1e5)], [Gear()])))
    assert table(text, "(W(I,J),J=1,NP),I=1,KJG:") == ["  1.000", "   .000"]
    assert "-.000" not in text
    assert "-0" not in text


def test_headings_are_english_or_russian_and_the_numbers_the_same(several: Results) -> None:
    english, russian = listing.write(several), listing.write(several, "ru")
    assert not re.search("[а-яА-Я]", english)
    assert "КПД на передачах:\nETA(J),J=1,NP:" in russian
    assert "Efficiency" not in russian
    numbers = [re.findall(r"(?m)^[ \d.*-]+$", text) for text in (english, russian)]
    assert numbers[0] == numbers[1]


def test_messages_stand_at_the_end(several: Results, published: Results) -> None:
    text = listing.write(several)
    told = text.partition("\nMessages:\n")[2].splitlines()
    assert told == [str(message) for message in several.messages]
    assert any(line.startswith("warning: gear N: ") for line in told)
    assert "Messages" not in listing.write(published)
    assert "\nСообщения:\n" in listing.write(several, "ru")


@pytest.mark.parametrize("lang", ["en", "ru"])
def test_a_report_is_a_deck_that_gives_the_same_report(lang: Any, several: Results) -> None:
    text = listing.write(several, lang)
    reading = read(text.encode(), "report.lst")
    assert reading.case == NAMED
    assert listing.write(solve(reading.case), lang) == text
