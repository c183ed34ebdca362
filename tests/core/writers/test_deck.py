"""The written deck: the published template, and whole when read back."""

from dataclasses import replace
from pathlib import Path
from typing import Literal

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.chance import count
from tests.strategies import ANY_NUMBER, transmissions
from vstatics.core.model.transmission import Gear, Mechanism, ShiftElement, Transmission
from vstatics.core.readers.deck import reader
from vstatics.core.writers import deck as writer

PUBLISHED = Path(__file__).parents[3] / "cases" / "mzkt7922.dat"

DIFFERENTIAL = Transmission(
    links=3,
    shift_elements=[ShiftElement(1, 2), ShiftElement(2, 0)],
    mechanisms=[Mechanism(1, 2, 3, ratio=-2.5)],
    gears=[Gear([1]), Gear([2])],
    idle="published",
)


def read_back(case: Transmission, lang: Literal["en", "ru"] = "en") -> Transmission:
    reading = reader.read(writer.write(case, lang).encode(), "written.dat")
    return reading.case


@pytest.mark.parametrize("lang", ["en", "ru"])
def test_published_deck_comes_back_in_its_own_order(lang: Literal["en", "ru"]) -> None:
    data = PUBLISHED.read_bytes()
    case = reader.read(data, "mzkt7922.dat").case
    text = writer.write(case, lang)
    latin = data.decode().replace("Е", "E").replace("N P=  6", "NP= 6").replace(" M :", "M :")
    for number in (".9000E+00 .2600E+01", "-.8000E+00 .2600E+01 -.2461E+01"):
        assert number in latin
        assert number in text
    names = "KJG NZF NZF NZD NZD NZD IAB ETAI NNM UAQ NP KFRI NFRI KWZ KMZ"
    heads = [line.strip(" (").replace("=", "(").split("(")[0] for line in text.splitlines()]
    assert [head for head in heads if head in names.split()] == names.split()
    assert "KJG= 6 KL= 5 KG= 3 KNM= 2" in text
    assert reader.read(text.encode(), "again.dat").case == case


def test_template_of_a_differential() -> None:
    lines = writer.write(DIFFERENTIAL).splitlines()
    fields = [line for line in lines if not line or line[0] in "KN(.-0123456789I" or "=" in line]
    assert "|".join(fields) == (
        "KJG= 3 KL= 2 KG= 1 KNM= 0|NZF(I,1),I=1,KL: 1 2|NZF(I,2),I=1,KL: 2 0|NZD(I,1),I=1,KG: 1"
        "|NZD(I,2),I=1,KG: 2|NZD(I,3),I=1,KG: 3|IAB(I),I=1,KG:|-.2500E+01|ETAI(I),I=1,KG:|.1000E+01"
        "|NP= 2|KFRI(I),I=1,NP: 1 1|(NFRI(K,I),K=1,KFRI(I)),I=1,NP:|1|2|KWZ(I),I=1,NP: 0 0"
        "|KMZ(I),I=1,NP: 0 0"
    )


def test_own_fields_only_where_they_are_not_the_default() -> None:
    case = replace(
        DIFFERENTIAL,
        name="Дифференциал",
        input=2,
        output=1,
        idle="exact",
        coast=True,
        link_names=("in", "2", "вых"),
        gears=[Gear([1], {1: 0.1}, name="D: 1", input=3, output=2), Gear([2], torques={3: 1 / 3})],
    )
    lines = writer.write(case).splitlines()
    for line in (
        *("(NWZ(K,I),K=1,KWZ(I)),I=1,NP:", ".1000E+00", "(AMZ(K,I),K=1,KMZ(I)),I=1,NP:"),
        *(".3333333333333333E+00", "INP= 2", "IOUT= 1", "IDLE= 1", "COAST= 1"),
        *("INP(I),I=1,NP: 3 0", "IOUT(I),I=1,NP: 2 0"),
        *("NAME T: Дифференциал", "NAME J1: in", "NAME J3: вых", "NAME P1: D: 1"),
    ):
        assert line in lines
    assert not any(line.startswith(("NAME J2", "NAME F", "NAME D", "NAME P2")) for line in lines)
    assert read_back(case) == case


@settings(max_examples=count(10, 75))
@given(transmissions(ANY_NUMBER, follow=False), st.sampled_from(["en", "ru"]))
def test_any_case_reads_back_the_same(case: Transmission, lang: Literal["en", "ru"]) -> None:
    assert read_back(case, lang) == replace(case, description="", source="")
