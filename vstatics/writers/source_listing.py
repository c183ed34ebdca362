"""Results word for word as the source prints them, in its Russian: only its fields and tables."""

from __future__ import annotations

from collections.abc import Iterator

from vstatics.errors import CaseError, listed
from vstatics.model.transmission import Transmission
from vstatics.statics.results import Results
from vstatics.tables.numbers import fixed_rows
from vstatics.tables.quantities import Table
from vstatics.tables.values import tables
from vstatics.texts import speaking, translated
from vstatics.writers import deck, listing

STRUCTURE = """\
ИСХОДНЫЕ ДАННЫЕ О СТРУКТУРЕ МЕХАНИЗМА
KJG — число основных подвижных звеньев механизма;
KL — число муфт и тормозов;
KG — число преобразующих механизмов (в общем случае число механизмов с постоянной структурой);
KNM — число нестандартных преобразующих механизмов:"""
RESULTS = """\
По умолчанию принято, что обязательно задается при скоростном расчете единичная скорость \
входному звену, а при силовом — единичный момент на входном валу.

РЕЗУЛЬТАТЫ РАСЧЕТОВ
KLG=KL+KG."""

GIVEN = {
    "STRUCTURE": STRUCTURE,
    "Shift elements, first links:": (
        "Устройства управления\n"
        "Номера звеньев, соответствующих первым (ведущим) частям муфт и тормозов:"
    ),
    "Shift elements, second links (0 is the housing):": (
        "Номера звеньев, соответствующих вторым (ведомым) частям муфт и тормозов:"
    ),
    "Mechanisms, first links (suns):": (
        "Устройства передачи мощности с постоянной структурой\n"
        "Номера звеньев, соответствующих первым (ведущим) звеньям (солнечным колесам) "
        "преобразующих механизмов:"
    ),
    "Mechanisms, second links (rings):": (
        "Номера звеньев, соответствующих вторым (ведомым) звеньям преобразующих механизмов "
        "(для планетарных механизмов — эпициклам):"
    ),
    "Mechanisms, third links (carriers; 0 if there is none):": (
        "Номера звеньев, соответствующих водилам (третьим звеньям) планетарных преобразующих "
        "механизмов (для непланетарных — нули):"
    ),
    "Ratios, third link held:": (
        "Передаточные числа преобразующих механизмов (для планетарных при остановленном водиле):"
    ),
    "Efficiencies, third link held:": (
        "КПД преобразующих механизмов (для планетарных при остановленном водиле):"
    ),
    "Mechanisms with a planet ratio of their own:": (
        "Дополнительные данные по нестандартным преобразующим механизмам\n"
        "Номера нестандартных механизмов:"
    ),
    "Ratios from the first link to the planet:": (
        "Передаточные отношения от первого звена к сателлиту нестандартного механизма:"
    ),
    "GEARS": "БЛОК НАЧАЛЬНЫХ УСЛОВИЙ\nЧисло передач:",
    "Engaged elements in each gear:": "Число включенных муфт и тормозов на каждой передаче:",
    "Their numbers, a line for each gear:": (
        "Номера включенных муфт и тормозов на каждой передаче:"
    ),
    "Further given speeds in each gear:": (
        "Число дополнительно заданных угловых скоростей звеньев на каждой передаче:"
    ),
    "Further external torques in each gear:": (
        "Число дополнительных внешних моментов на каждой передаче:"
    ),
}
"""The source's words by the headings of a deck; it has none for values of given speeds."""
BELOW = ("NNM(", "KFRI(", "KWZ(", "KMZ(")
"""Lists whose numbers stand below their name, where a deck has them beside it."""

SECTIONS = {
    "W": "А. Скоростной расчет",
    "AMLG": "Б. Силовой расчет",
    "AMLGP": "В. Силовой расчет с учетом потерь в преобразующих механизмах",
}
"""Titles by the table that they stand above."""
_OF_ELEMENTS = "Крутящие моменты на звеньях муфт и тормозов на каждой передаче"
_OF_MECHANISMS = (
    "Крутящие моменты на первых звеньях (обычно солнечных шестернях дифференциалов) "
    "преобразующих механизмов и выходном звене (с номером KLG1 = KLG+1) на каждой передаче"
)
_LOSSY = "с учетом КПД механизмов"
HEADINGS = {
    "(AJK(I,K),K=1,KLG),I=1,KJG:": "Структурно-распределительная матрица:",
    "(W(I,J),J=1,NP),I=1,KJG:": "Угловые скорости звеньев на каждой передаче:",
    "(WSAT(I,J),J=1,NP),I=1,KG:": (
        "Угловые скорости вращения сателлитов относительно водила на каждой передаче:"
    ),
    "(WFRI(I,J),J=1,NP),I=1,KL:": (
        "Угловые скорости скольжения звеньев муфт и тормозов на каждой передаче:"
    ),
    "(AMLG(I,J),J=1,NP),I=1,KL:": f"{_OF_ELEMENTS}:",
    "(AMLG(I,J),J=1,NP),I=(KL+1),KLG1:": f"{_OF_MECHANISMS}:",
    "(AMLGP(I,J),J=1,NP),I=1,KL:": f"{_OF_ELEMENTS} {_LOSSY}:",
    "(AMLGP(I,J),J=1,NP),I=(KL+1),KLG1:": f"{_OF_MECHANISMS} {_LOSSY}:",
    "ETA(J),J=1,NP:": "КПД на передачах:",
    "(IX(I,J),J=1,NP),I=1,KG:": (
        "Признак ведущего (+1) и ведомого (—1) первого звена механизма "
        "(указывает направление мощностного потока):"
    ),
}
"""By the index lists of tables, or of their parts."""


def write(
    results: Results, digits: int = listing.LISTING_DECIMALS, *, own_tables: bool = False
) -> str:
    """The printed listing of one case that is not drawn, its rows in F8.3 and I3.

    Parameters
    ----------
    digits : int
        After the point.
    own_tables : bool
        Whether the tables that the source does not have follow, in Russian, with the messages.

    Raises
    ------
    CaseError
        If the case has springs or speed ratios, for which the source has no fields.
    """
    _check(results.case)
    shown = tables(results)
    lines = [*_given(results.with_numbers_only), RESULTS]
    for table in shown:
        if table.quantity.published:
            lines += _printed(table, results.case, digits)
    if own_tables:
        own = [table for table in shown if not table.quantity.published]
        with speaking("ru"):
            lines += listing.table_lines(results, own, digits)
            lines += listing.messages(results)
    return "\n".join(lines) + "\n"


def _check(case: Transmission) -> None:
    """Refuse what would be rows and columns that no heading of the source names."""
    springs = [spring.name for spring in case.springs]
    foreign = [*springs, *(one.name for one in case.mechanisms if one.kind)]
    if foreign:
        message = f"the source's listing has no fields for {listed(foreign)}"
        raise CaseError("E870", f"{message}; expected --lang en, de or ru")


def _given(case: Transmission) -> Iterator[str]:
    """The fields of the deck that the source has, under its headings."""
    for line in deck.template(case):
        name, colon, numbers = line.partition(": ")
        if line.startswith(BELOW):
            yield from (f"{name}{colon.strip()}", numbers)
        else:
            yield GIVEN.get(line) or translated(line, "ru")


def _printed(table: Table, case: Transmission, digits: int) -> Iterator[str]:
    """A table of the source, in one or two parts."""
    quantity = table.quantity
    if quantity.printed in SECTIONS:
        yield f"\n{SECTIONS[quantity.printed]}"
    decimals, width = (digits, digits + 4) if quantity.kind is float else (0, 2)
    for _, indices, part in listing.parts(table, case):
        yield from (HEADINGS[indices], indices)
        yield from (f" {row}" for row in fixed_rows(part.values.tolist(), width, decimals))
