"""Tsitovich, Algin, Vehicle dynamics (1981): tables 3.7 (given) and 3.8 (largest torques).

On the propshaft, for a friction of 0.7 between tyres and road, with M_C = 0.8 M_C0. Where print
and data differ: the column M_phi of 3.7 is lost, these are from 3.8 and 3.15; M_C0 of ГАЗ-53А
III is 992 (986 printed), of МАЗ-500А III 1970 (1976), as M_cp1 of 3.8 has it. Letters of cases
that print has alike (В of Б and В) are told apart by the torques. ГАЗ-53А II and III have no
legible torques, others lack single ones: None.
"""

from collections.abc import Iterator
from typing import Any, NamedTuple

from vstatics.torsion.clutch.dumped import DumpCase
from vstatics.torsion.clutch.given import Dump


class Line(NamedTuple):
    """A line of table 3.8."""

    vehicle: str
    gear: int
    given: Dump
    case: DumpCase
    torques: tuple[float | None, ...]
    """In kN*m: largest, at the input shaft; both by the simplified forms."""
    integrated: float
    """By an integration in time, apart from this project. [kN*m]"""


_PRINTED = """\
ВАЗ-2101    1 1.913 0.0619 0.0239 0.091 5.68 0.00429 532 335 156 A3 0.683 - - 0.571 0.6821
ВАЗ-2101    2 0.719 0.0233 0.0169 0.091 5.68 0.00429 327 335 254 A3 0.498 0.398 0.482 0.389 0.498
ВАЗ-2101    3 0.302 0.0098 0.0135 0.091 5.68 0.00429 212 335 393 A2 0.338 0.24 0.339 - 0.3378
ВАЗ-2101    4 0.136 0.0044 0.0128 0.091 5.68 0.00429 142 335 586 A2 0.227 0.143 0.227 0.143 0.2265
Москвич-412 1 1.55 0.04 0.0183 0.086 6.63 0.00291 635 366 174 A3 0.836 0.733 0.777 0.693 0.8357
Москвич-412 2 0.529 0.0133 0.0133 0.086 6.63 0.00291 371 366 298 A3 0.571 0.433 0.563 0.43 0.5701
Москвич-412 3 0.225 0.0057 0.0122 0.086 6.63 0.00291 242 366 456 A3 0.386 0.255 0.476 0.283 0.386
Москвич-412 4 0.127 0.0032 0.0116 0.086 6.63 0.00291 182 366 607 A2 0.291 0.177 0.291 0.177 0.2906
ГАЗ-24      1 4.29 0.1 0.0674 0.147 10.8 0.0026 1344 508 135 V3 1.481 1.426 1.564 1.475 1.433
ГАЗ-24      2 1.79 0.0419 0.0485 0.147 10.8 0.0026 868 508 208 A3 1.161 0.911 1.171 0.915 1.161
ГАЗ-24      3 0.736 0.0172 0.0305 0.147 10.8 0.0026 557 508 324 A3 - 0.59 0.893 0.607 0.846
ГАЗ-24      4 0.35 0.0082 0.0265 0.147 10.8 0.0026 384 508 471 A3 0.609 0.379 0.757 0.414 0.6091
ГАЗ-53А     1 21.4 0.897 0.313 0.748 34.1 0.00118 3799 2630 51 B3 3.657 3.606 3.472 - 3.578
ГАЗ-53А     2 4.76 0.2 0.163 0.748 34.1 0.00118 1792 2630 108 V2 - - - - 2.834
ГАЗ-53А     3 1.44 0.0604 0.136 0.748 34.1 0.00118 992 2630 197 A2 - - - - 1.578
ГАЗ-53А     4 0.499 0.0209 0.0541 0.748 34.1 0.00118 580 2630 335 A2 0.928 - - - 0.926
ЗИЛ-130     1 54.3 1.77 1.79 1.36 58.3 0.000713 6101 3760 45 B3 5.441 5.27 5.051 - 5.308
ЗИЛ-130     2 16.6 0.538 0.716 1.36 58.3 0.000713 3362 3760 81.7 V2 5.879 4.442 5.213 4.156 5.025
ЗИЛ-130     3 5.18 0.168 0.404 1.36 58.3 0.000713 1878 3760 146 A2 2.976 1.935 3.005 1.944 2.976
ЗИЛ-130     4 2.13 0.0692 0.315 1.36 58.3 0.000713 1205 3760 228 A2 1.916 1.135 - - 1.916
ЗИЛ-130     5 0.987 0.032 0.284 1.36 58.3 0.000713 820 3760 335 A2 1.305 0.721 - - 1.305
МАЗ-500А    1 102 2.41 2.85 2.18 80.6 0.00032 6838 5104 41.8 V3 8.175 7.451 7.904 7.326 7.88
МАЗ-500А    2 31.3 0.737 1.14 2.18 80.6 0.00032 3783 5104 75.8 A3 5.865 4.141 6.603 4.431 5.864
МАЗ-500А    3 8.55 0.201 0.58 2.18 80.6 0.00032 1970 5104 145 A2 3.123 1.974 - - 3.123
МАЗ-500А    4 3.7 0.087 0.454 2.18 80.6 0.00032 1300 5104 220 A2 2.066 1.205 - - 2.066
МАЗ-500А    5 1.63 0.0384 0.354 2.18 80.6 0.00032 863 5104 333 A2 1.374 0.757 - - 1.374
"""
"""Vehicle, gear; J1 to J5, E, M_C0, M_phi, omega1; case, torques; by integration."""


def _lines() -> Iterator[Line]:
    for row in _PRINTED.splitlines():
        vehicle, gear, *cells = row.split()
        case, *torques, integrated = cells[9:]
        given = Dump._make(float(one) for one in cells[:9])
        printed = tuple(None if one == "-" else float(one) for one in torques)
        of_line: Any = case, printed, float(integrated)
        yield Line(vehicle, int(gear), given, *of_line)


TABLE_3_8 = [*_lines()]
