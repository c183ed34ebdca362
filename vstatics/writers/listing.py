"""Results as the printed report of the source: the input, then the tables.

Rows and columns are as printed there, under the same names and index lists; the
program's own tables follow. The report starts with the deck of its case, so it is
itself a deck that can be run again.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from vstatics.statics.results import NAME, Language, Results
from vstatics.tables.numbers import fixed
from vstatics.tables.table import Table
from vstatics.tables.values import tables
from vstatics.writers import deck


class Heading(NamedTuple):
    """What stands over a table: a short label, and the name with its index list."""

    index_list: str
    en: str
    ru: str


class Words(NamedTuple):
    """The lines of a report that are neither table nor deck."""

    results: str
    conventions: tuple[str, ...]
    coasting: str
    messages: str


WORDS: dict[str, Words] = {
    "en": Words(
        "RESULTS",
        (
            "Conventions: speeds relative to the input speed, torques to the input torque;",
            "a torque is that on the first link of its device, the last one (KLG1) is the",
            "output torque, given to the load; ratio is w_input/w_output.",
        ),
        "Coasting: the power enters at the output; in this scaling losses are below 0.",
        "Messages:",
    ),
    "ru": Words(
        "РЕЗУЛЬТАТЫ РАСЧЕТОВ",
        (
            "Условности: скорости отнесены к скорости входа, моменты - к моменту входа;",
            "момент устройства - на его первом звене, последний (KLG1) - на выходном",
            "звене, отдаваемый нагрузке; передаточное отношение - w_вход/w_выход.",
        ),
        "Торможение двигателем: мощность входит с выхода, потери при этом меньше 0.",
        "Сообщения:",
    ),
}

REST = " of mechanisms and output"
"""The second part of a table of torques, which the source prints by itself."""

HEADINGS: dict[str, Heading] = {
    "AJK": Heading(
        "(AJK(I,K),K=1,KLG),I=1,KJG:",
        "Structural-distribution matrix, KLG = KL + KG:",
        "Структурно-распределительная матрица, KLG = KL + KG:",
    ),
    "W": Heading(
        "(W(I,J),J=1,NP),I=1,KJG:",
        "A. Speeds of the links in each gear:",
        "А. Угловые скорости звеньев на передачах:",
    ),
    "WSAT": Heading(
        "(WSAT(I,J),J=1,NP),I=1,KG:",
        "Speeds of the planets against the carrier:",
        "Скорости сателлитов относительно водила:",
    ),
    "WFRI": Heading(
        "(WFRI(I,J),J=1,NP),I=1,KL:",
        "Slip speeds of clutches and brakes:",
        "Скорости скольжения муфт и тормозов:",
    ),
    "AMLG": Heading(
        "(AMLG(I,J),J=1,NP),I=1,KL:",
        "B. Torques of clutches and brakes, without losses:",
        "Б. Моменты муфт и тормозов без потерь:",
    ),
    "AMLG" + REST: Heading(
        "(AMLG(I,J),J=1,NP),I=(KL+1),KLG1:",
        "Torques of mechanisms and output, KLG1 = KLG + 1, without losses:",
        "Моменты механизмов и выходного звена, KLG1 = KLG + 1, без потерь:",
    ),
    "AMLGP": Heading(
        "(AMLGP(I,J),J=1,NP),I=1,KL:",
        "C. Torques of clutches and brakes, with losses:",
        "В. Моменты муфт и тормозов с учетом потерь:",
    ),
    "AMLGP" + REST: Heading(
        "(AMLGP(I,J),J=1,NP),I=(KL+1),KLG1:",
        "Torques of mechanisms and output, with losses:",
        "Моменты механизмов и выходного звена с учетом потерь:",
    ),
    "ETA": Heading(
        "ETA(J),J=1,NP:",
        "Efficiency of the gears:",
        "КПД на передачах:",
    ),
    "IX": Heading(
        "(IX(I,J),J=1,NP),I=1,KG:",
        "Sign of the power flow, first link drives (+1) or is driven (-1):",
        "Признак ведущего (+1) или ведомого (-1) первого звена механизма:",
    ),
    "ratio": Heading(
        "RATIO(J),J=1,NP:",
        "Ratio of the gears, input speed to output speed:",
        "Передаточные отношения на передачах:",
    ),
    "idle": Heading(
        "(IDLING(I,J),J=1,NP),I=1,KG:",
        "Mechanisms that idle (1):",
        "Механизмы без потока мощности (1):",
    ),
    "losses": Heading(
        "(LOSS(I,J),J=1,NP),I=1,KG:",
        "Power lost in the mechanisms:",
        "Потери мощности в механизмах:",
    ),
    "power_balance": Heading(
        "BALANCE(J),J=1,NP:",
        "Balance of power, external power less losses:",
        "Баланс мощностей:",
    ),
    "consistent": Heading(
        "CONSISTENT(J),J=1,NP:",
        "Directions of power agree with the losses (1):",
        "Направления потоков согласованы с потерями (1):",
    ),
    "locked": Heading(
        "LOCKED(J),J=1,NP:",
        "Locked by friction (1):",
        "Самоторможение (1):",
    ),
    "AMWZ": Heading(
        "(AMWZ(I,J),J=1,NP),I=1,KJG:",
        "Torques that hold the given speeds, without losses:",
        "Моменты, удерживающие заданные скорости, без потерь:",
    ),
    "AMWZP": Heading(
        "(AMWZP(I,J),J=1,NP),I=1,KJG:",
        "Torques that hold the given speeds, with losses:",
        "Моменты, удерживающие заданные скорости, с учетом потерь:",
    ),
    "drag_losses": Heading(
        "DRAG(J),J=1,NP:",
        "Power that drag of bearings, oil and open elements takes:",
        "Потери мощности от трения подшипников, масла и открытых муфт:",
    ),
    "mesh_torques": Heading(
        "(MESH(I,J),J=1,NP),I=1,KM:",
        "Torques of the meshes, on the first wheel or planet, without losses:",
        "Моменты зацеплений на первом колесе или сателлите без потерь:",
    ),
    "lossy_mesh_torques": Heading(
        "(MESHP(I,J),J=1,NP),I=1,KM:",
        "Torques of the meshes, with losses:",
        "Моменты зацеплений с учетом потерь:",
    ),
    "holds": Heading(
        "(HOLDS(I,J),J=1,NP),I=1,KL:",
        "Elements that are engaged, and freewheels that hold (1):",
        "Включенные элементы и замкнутые муфты свободного хода (1):",
    ),
}

UNITS: dict[str, Heading] = {
    "W_rpm": Heading(
        "(WRPM(I,J),J=1,NP),I=1,KJG:", "Speeds of the links, rpm:", "Скорости звеньев, об/мин:"
    ),
    "WSAT_rpm": Heading(
        "(WSATRPM(I,J),J=1,NP),I=1,KG:",
        "Speeds of the planets against the carrier, rpm:",
        "Скорости сателлитов относительно водила, об/мин:",
    ),
    "WFRI_rpm": Heading(
        "(WFRIRPM(I,J),J=1,NP),I=1,KL:",
        "Slip speeds of clutches and brakes, rpm:",
        "Скорости скольжения муфт и тормозов, об/мин:",
    ),
    "AMLG_Nm": Heading(
        "(AMLGNM(I,J),J=1,NP),I=1,KLG1:",
        "Torques without losses, N*m:",
        "Моменты без потерь, Н*м:",
    ),
    "AMLGP_Nm": Heading(
        "(AMLGPNM(I,J),J=1,NP),I=1,KLG1:",
        "Torques with losses, N*m:",
        "Моменты с учетом потерь, Н*м:",
    ),
    "mesh_torques_Nm": Heading(
        "(MESHNM(I,J),J=1,NP),I=1,KM:",
        "Torques of the meshes without losses, N*m:",
        "Моменты зацеплений без потерь, Н*м:",
    ),
    "lossy_mesh_torques_Nm": Heading(
        "(MESHPNM(I,J),J=1,NP),I=1,KM:",
        "Torques of the meshes with losses, N*m:",
        "Моменты зацеплений с учетом потерь, Н*м:",
    ),
    "losses_kW": Heading(
        "(LOSSKW(I,J),J=1,NP),I=1,KG:", "Power lost, kW:", "Потери мощности, кВт:"
    ),
    "AMWZ_Nm": Heading(
        "(AMWZNM(I,J),J=1,NP),I=1,KJG:",
        "Torques that hold the given speeds, without losses, N*m:",
        "Моменты, удерживающие заданные скорости, без потерь, Н*м:",
    ),
    "AMWZP_Nm": Heading(
        "(AMWZPNM(I,J),J=1,NP),I=1,KJG:",
        "Torques that hold the given speeds, with losses, N*m:",
        "Моменты, удерживающие заданные скорости, с учетом потерь, Н*м:",
    ),
    "drag_losses_kW": Heading(
        "DRAGKW(J),J=1,NP:",
        "Power that drag takes, kW:",
        "Потери мощности от сопротивлений вращению, кВт:",
    ),
    "input_power_kW": Heading("PINKW(J),J=1,NP:", "Input power, kW:", "Мощность на входе, кВт:"),
    "output_power_kW": Heading(
        "POUTKW(J),J=1,NP:",
        "Output power with losses, kW:",
        "Мощность на выходе с учетом потерь, кВт:",
    ),
}
"""Of the tables with units, where a case has a load."""

DRAWN: dict[str, Heading] = {
    "AMLG" + REST: Heading(
        "(AMLG(I,J),J=1,NP),I=(KL+1),KLG1:",
        "Torques of the members of the elements and of the output, without losses:",
        "Моменты звеньев элементов и выходного звена без потерь:",
    ),
    "AMLGP" + REST: Heading(
        "(AMLGP(I,J),J=1,NP),I=(KL+1),KLG1:",
        "Torques of the members of the elements and of the output, with losses:",
        "Моменты звеньев элементов и выходного звена с учетом потерь:",
    ),
}
"""In place of the torques of mechanisms, where a case is drawn."""


def write(results: Results, lang: Language = "en") -> str:
    """The report of one case; numbers in Fortran style with three decimals.

    Parameters
    ----------
    lang : {"en", "ru"}
        Language of the headings.
    """
    words = WORDS[lang]
    lines = [deck.write(results.with_freewheels_engaged, lang), words.results, *words.conventions]
    if results.case.coast:
        lines.append(words.coasting)
    drawn = results.case.drawing is not None
    headings = HEADINGS | UNITS | (DRAWN if drawn else {})
    for name, table in _parts(results):
        heading = headings[name]
        lines += ["", heading.ru if lang == "ru" else heading.en, heading.index_list]
        lines += _rows(table, named=drawn and table.shape.rows != "one")
    if results.messages:
        lines += ["", words.messages, *map(str, results.messages)]
    return "\n".join(lines) + "\n"


def _parts(results: Results) -> Iterator[tuple[str, Table]]:
    """The tables that have rows, by heading; torques in two parts."""
    elements = len(results.case.shift_elements)
    for table in tables(results):
        name, values = table.shape.name, table.values
        if table.shape.rows == "torques" and not table.shape.unit:
            if elements:
                yield name, table._replace(rows=table.rows[:elements], values=values[:elements])
            yield name + REST, table._replace(rows=table.rows[elements:], values=values[elements:])
        elif values.size:
            yield name, table


def _rows(table: Table, *, named: bool) -> list[str]:
    """Rows of equal fields: 7 wide with three decimals, 3 wide for whole numbers.

    Where the case is drawn each row ends with its name.
    """
    decimals, width = (3, 7) if table.shape.kind is float else (0, 3)
    longest = max(len(fixed(value, decimals=decimals)) for value in table.values.flat)
    width = max(width, longest)
    rows = [
        " ".join(fixed(value, width=width, decimals=decimals) for value in row)
        for row in table.values
    ]
    if not named:
        return rows
    return [f"{row}  {NAME} {name}" for row, name in zip(rows, table.rows, strict=True)]
