"""The published report of the MZKT 7922 gearbox, number by number.

The 264 numbers are those that the source prints (published/mzkt7922.json tells of two
misprints put right and of one idle sign). Each way into the program has to print them
all to the digit: other encodings, YAML, JSON, and its own report as a deck.
"""

import re
from collections.abc import Callable
from typing import Any

import pytest

from tests.commands import CASES, MZKT, vstatics
from tests.shipped import PRINTED
from vstatics.core.tables.names import plain_name

COUNTS = {
    "AJK": 48,
    "W": 36,
    "WSAT": 18,
    "WFRI": 30,
    "AMLG": 54,
    "AMLGP": 54,
    "ETA": 6,
    "IX": 18,
}
HALF_A_UNIT = 0.5e-3 + 1e-12
SIZES = """\
KJG - число основных подвижных звеньев механизма;
KL - число устройств управления;
KG - число преобразующих механизмов;
KNM - число нестандартных преобразующих механизмов.
"""

Rows = list[list[Any]]


def rows_of(document: dict[str, Any], table: str) -> Rows:
    """A table of a report as rows; a list over the gears is one row."""
    found: Rows = document[table] if isinstance(document[table][0], list) else [document[table]]
    return found


def as_printed(table: str, number: float) -> str:
    """A number as the source prints it: three decimals, no zero before the point."""
    if table == "IX":
        return str(number)
    return re.sub(r"^(-?)0\.", r"\1.", f"{number:.3f}")


def printed(listing: str) -> dict[str, Rows]:
    """The tables of a report, their numbers as they stand there."""
    found: dict[str, Rows] = {}
    table = ""
    for line in listing.splitlines():
        head = re.match(r"\(?([A-Z]+)\([IJ](,[A-Z])?\)", line)
        if head:
            table = head[1]
            found.setdefault(table, [])
        elif table and re.fullmatch(r"[ \d.*-]+", line):
            found[table].append(line.split())
        else:
            table = ""
    return found


def converted(suffix: str) -> bytes:
    """The deck, converted to another format by the program itself."""
    said = vstatics("convert", MZKT, "-", "--to", suffix)
    assert said.status == 0
    return said.out.encode()


def report(*options: str) -> bytes:
    return vstatics("run", MZKT, *options).out.encode()


def deck() -> str:
    return MZKT.read_text("utf-8")


WAYS: dict[str, Callable[[], bytes]] = {
    "deck as published": MZKT.read_bytes,
    "KOI8-R": lambda: deck().encode("koi8-r"),
    "CP866": lambda: deck().encode("cp866"),
    "CP1251": lambda: deck().encode("cp1251"),
    "UTF-8 with BOM": lambda: deck().encode("utf-8-sig"),
    "CRLF": lambda: deck().replace("\n", "\r\n").encode(),
    "CP866 and CRLF": lambda: deck().replace("\n", "\r\n").encode("cp866"),
    "with the list of sizes": (SIZES + deck()).encode,
    "with the list of sizes in KOI8-R": lambda: (SIZES + deck()).encode("koi8-r"),
    "YAML": (CASES / "mzkt7922.yaml").read_bytes,
    "converted to YAML": lambda: converted("yaml"),
    "converted to JSON": lambda: converted("json"),
    "converted to a deck": lambda: converted("deck"),
    "report": report,
    "report in Russian": lambda: report("--lang", "ru"),
    "report in Russian in CP1251": lambda: report("--lang", "ru").decode().encode("cp1251"),
    "report in CRLF": lambda: report().replace(b"\n", b"\r\n"),
}


def test_there_are_264_numbers() -> None:
    counts = {table: sum(map(len, rows_of(PRINTED, table))) for table in COUNTS}
    assert counts == COUNTS
    assert sum(counts.values()) == 264


@pytest.mark.parametrize("lang", ["en", "ru"])
@pytest.mark.parametrize("way", WAYS)
def test_every_digit_is_the_published_one(way: str, lang: str) -> None:
    said = vstatics("run", "-", "--lang", lang, stdin=WAYS[way]())
    assert said.is_without_messages()
    tables = printed(said.out)
    for table in COUNTS:
        expected = [[as_printed(table, n) for n in row] for row in rows_of(PRINTED, table)]
        assert tables[table] == expected, table


@pytest.mark.parametrize("way", WAYS)
def test_double_precision_is_within_half_a_unit(way: str) -> None:
    said = vstatics("run", "-", "-f", "json", stdin=WAYS[way]())
    document = said.json
    for table in COUNTS:
        pairs = zip(rows_of(document, plain_name(table)), rows_of(PRINTED, table), strict=True)
        for got, expected in pairs:
            assert got == pytest.approx(expected, rel=0, abs=HALF_A_UNIT), table


def test_a_report_of_a_report_is_the_same_report() -> None:
    assert vstatics("run", "-", stdin=report()).out.encode() == report()
    assert vstatics("run", "-", stdin=report("--lang", "ru")).out.encode() == report()


def test_the_idle_sign_differs_from_print_in_one_place_only() -> None:
    """D1 moves in gears 5 and 6 alike and carries nothing, yet -1 is printed in gear 6."""
    sign = PRINTED["idle"]
    assert [sign[key] for key in ("table", "row", "gears", "printed")] == ["IX", 1, [6], -1]
    assert PRINTED["IX"][0][4:] == [1, 1]
    assert PRINTED["AMLG"][5][4:] == [0, 0]
