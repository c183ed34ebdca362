"""Listing in the Russian wording of the published report, with its fields and tables only.

The published report has fields for links, shift elements, mechanisms and gears. The input is the
first link, the output the last link, and idle mechanisms have a sign. `published_results` solves
the case within these limits, so that the listing gives the same results when run as a deck.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from vstatics.core.errors import CaseError, Problem, not_allowed
from vstatics.core.model.parts import HOUSING
from vstatics.core.model.transmission import Gear, Mechanism, ShiftElement, SpeedOf, Transmission
from vstatics.core.numerics.tolerances import SAME_RATIO
from vstatics.core.statics.results import Results
from vstatics.core.statics.solve import solve
from vstatics.core.tables.numbers import fixed_rows
from vstatics.core.tables.quantities import Table
from vstatics.core.tables.values import tables
from vstatics.core.texts import speaking, translated
from vstatics.core.writers import deck, listing
from vstatics.core.writers.deck_limits import check_published_listing

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
"""Russian headings by deck heading. Values of prescribed speeds have no heading."""
BELOW = ("NNM(", "KFRI(", "KWZ(", "KMZ(")
"""Lists whose numbers are below the name of the list (in a deck after the name)."""

SECTIONS = {
    "W": "А. Скоростной расчет",
    "AMLG": "Б. Силовой расчет",
    "AMLGP": "В. Силовой расчет с учетом потерь в преобразующих механизмах",
}
"""Title of each section, by the name of the section's first table."""
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
"""Russian headings of tables, or parts of tables, by index list."""


NO_FOLLOWING = (
    "the published listing has no field for the speed of another link, and with a number instead "
    "the gear is indeterminate; expected another format, such as `-f listing`"
)


def published_results(results: Results) -> Results:
    """Solve the case with only the data for which the published listing has fields.

    The links are renumbered with the input first and the output last. Freewheels become shift
    elements, which are engaged if the freewheel holds. Prescribed speeds become numbers.

    Raises
    ------
    CaseError
        If the results depend on a part of the case for which the listing has no field.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission
    >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear(speeds={1: 0})], 3, 2)
    >>> published = published_results(solve(case))
    >>> published.case.mechanisms[0].links, published.case.gears[0].speeds
    ((2, 3, 1), {2: 0.0})
    """
    check_published_listing(results)
    published = solve(_published_case(results))
    same = np.isclose(results.ratio, published.ratio, rtol=SAME_RATIO, atol=0, equal_nan=True)
    lost = [
        Problem("E870", NO_FOLLOWING, ("gears", number, "speeds"))
        for number, gear in enumerate(results.case.gears, 1)
        if not same[number - 1]
        and any(isinstance(speed, SpeedOf) for speed in gear.speeds.values())
    ]
    if lost:
        raise CaseError(lost)
    return published


def changed_efficiencies(results: Results, published: Results) -> list[Problem]:
    """Return warnings about gears whose efficiency depends on conventional signs of power."""
    before, after = results.efficiency, published.efficiency
    same = np.isclose(before, after, rtol=SAME_RATIO, atol=0, equal_nan=True)
    problems = []
    for index in np.flatnonzero(~same).tolist():
        message = (
            "the signs of unloaded mechanisms in the published listing change the efficiency of "
            f"gear {results.case.gears[index].name} from {before[index]:.4g} to {after[index]:.4g}"
        )
        problems.append(Problem("W895", message, ("gears", index + 1)))
    return not_allowed(problems, results.case.untold)


def _published_case(results: Results) -> Transmission:
    """Return the case with only the data of the listing, and with renumbered links."""
    case = results.with_numbers_only
    ends = case.gear_input(case.gears[0]), case.gear_output(case.gears[0])
    between = (link for link in range(1, case.links + 1) if link not in ends)
    order = [ends[0], *between, ends[1]]
    new = {HOUSING: HOUSING} | {link: number for number, link in enumerate(order, 1)}
    return Transmission(
        case.links,
        [
            ShiftElement(new[part.first], new[part.second], part.name)
            for part in case.shift_elements
        ],
        [
            Mechanism(
                new[part.first],
                new[part.second],
                new[part.third],
                part.ratio,
                part.efficiency,
                part.planet_ratio,
                part.name,
            )
            for part in case.mechanisms
        ],
        [
            Gear(
                gear.engaged,
                {new[link]: speed for link, speed in gear.speeds.items()},
                {new[link]: torque for link, torque in gear.torques.items()},
                name=gear.name,
                load=gear.load,
            )
            for gear in case.gears
        ],
        idle="published",
        name=case.name,
        link_names=[case.link_name(link) for link in order],
        load=case.load,
        allow=case.allow,
        hushed=case.hushed,
    )


def write(
    results: Results, digits: int = listing.LISTING_DECIMALS, *, own_tables: bool = False
) -> str:
    """Return the published listing of a case, with numbers in the Fortran formats F8.3 and I3.

    Parameters
    ----------
    results : Results
        Results of `published_results`.
    digits : int
        Number of decimals.
    own_tables : bool
        True to append the tables that are not in the published report, and the messages, in
        Russian.
    """
    shown = tables(results)
    lines = [*_given(results.case), RESULTS]
    for table in shown:
        if table.quantity.published:
            lines += _printed(table, results.case, digits)
    if own_tables:
        unpublished = [table for table in shown if not table.quantity.published]
        with speaking("ru"):
            lines += listing.table_lines(results, unpublished, digits)
            lines += listing.messages(results)
    return "\n".join(lines) + "\n"


def _given(case: Transmission) -> Iterator[str]:
    """Yield the fields of the deck, each below a Russian heading."""
    for line in deck.template(case):
        name, colon, numbers = line.partition(": ")
        if line.startswith(BELOW):
            yield from (f"{name}{colon.strip()}", numbers)
        else:
            yield GIVEN.get(line) or translated(line, "ru")


def _printed(table: Table, case: Transmission, digits: int) -> Iterator[str]:
    quantity = table.quantity
    if quantity.printed in SECTIONS:
        yield f"\n{SECTIONS[quantity.printed]}"
    decimals, width = (digits, digits + 4) if quantity.kind is float else (0, 2)
    for _, indices, part in listing.parts(table, case):
        yield from (HEADINGS[indices], indices)
        yield from (f" {row}" for row in fixed_rows(part.values.tolist(), width, decimals))
