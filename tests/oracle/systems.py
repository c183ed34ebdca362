"""The speed system and the torque system of one gear, as matrix and right-hand side.

Source: Algin V.B., "Schematization and calculation of mobile machine presented
as multibody system. Kinematics and quasistatics".
"""

from collections.abc import Mapping, Sequence
from fractions import Fraction
from types import MappingProxyType

from tests.oracle.linear import ONE, ZERO, Linear, Row, exact, times
from vstatics.core.model.transmission import Gear, Mechanism, SpeedOf, Transmission

Values = tuple[Fraction | None, ...]


def ratios(case: Transmission) -> list[Fraction]:
    """Internal ratios of the mechanisms; a variator is a pair of wheels of ratio 1/x."""
    return [
        1 / exact(one.ratio) if one.kind == "variator" else exact(one.ratio)
        for one in case.mechanisms
    ]


def element_column(case: Transmission, number: int) -> Row:
    """Shift element `number` (from 1): +1 at its first link, -1 at its second."""
    element = case.shift_elements[number - 1]
    return _column(case.links, [(element.first, ONE), (element.second, -ONE)])


def mechanism_column(links: int, mechanism: Mechanism, ratio: Fraction) -> Row:
    """Torques of a mechanism: 1 at the first link, -u at the second, u - 1 at the third."""
    values = (ONE, -ratio, ratio - 1)
    return _column(links, list(zip(mechanism.links, values, strict=True)))


def _column(links: int, entries: Sequence[tuple[int, Fraction]]) -> Row:
    """A column over the links; the housing (0) has no row."""
    column = [ZERO] * links
    for link, value in entries:
        if link:
            column[link - 1] += value
    return column


class Speeds:
    """Link speeds: each device holds its equation, the input has 1, given speeds hold."""

    def __init__(self, case: Transmission, gear: Gear) -> None:
        """Write the rows in the order of the source and eliminate."""
        pairs = zip(case.mechanisms, ratios(case), strict=True)
        rows = [mechanism_column(case.links, mechanism, u) for mechanism, u in pairs]
        rows += [element_column(case, number) for number in gear.engaged]
        right = [ZERO] * len(rows)
        given = {case.gear_input(gear): 1.0, **gear.speeds}
        for link, speed in given.items():
            if isinstance(speed, SpeedOf):
                follows = [(link, ONE), (speed.link, -exact(speed.factor))]
                rows.append(_column(case.links, follows))
                right.append(ZERO)
            else:
                rows.append(_column(case.links, [(link, ONE)]))
                right.append(exact(speed))
        self.system = Linear(rows, right, case.links)

    def link(self, link: int) -> Fraction | None:
        """Speed of a link; 0 for the housing."""
        return self.difference(link, 0)

    def difference(self, first: int, second: int) -> Fraction | None:
        """Speed of one link against another, also where neither alone is known."""
        if not self.system.consistent:
            return None
        row = self.system.unit(first - 1, second - 1)
        return self.system.functional(row)


class Torques:
    """Torques of all devices, Mx, and the torques that hold the given speeds."""

    def __init__(
        self,
        case: Transmission,
        gear: Gear,
        ratio: Sequence[Fraction],
        drag: Mapping[int, Fraction] = MappingProxyType({}),
    ) -> None:
        """Equilibrium of each link with these internal ratios, then M = 0 where not engaged.

        Unknowns: elements, mechanisms, Mx, one holding torque for each given
        speed that is not the output's. Drag acts on links like other external torques.
        """
        self.case, self.gear = case, gear
        self.elements, self.mechanisms = len(case.shift_elements), len(case.mechanisms)
        self.output = self.elements + self.mechanisms
        held = [link for link in gear.speeds if link != case.gear_output(gear)]
        self.holding = {link: self.output + 1 + i for i, link in enumerate(held)}
        self.external = {case.gear_input(gear): ONE}
        for link, torque in gear.torques.items():
            self.external[link] = self.external.get(link, ZERO) + exact(torque)
        self.drag = dict(drag)
        self.system = self._solved(self._matrix(ratio), self._right())

    def _solved(self, matrix: list[Row], right: Row) -> Linear:
        return Linear(matrix, right, self.output + 1 + len(self.holding))

    def _matrix(self, ratio: Sequence[Fraction]) -> list[Row]:
        case = self.case
        columns = [element_column(case, n) for n in range(1, self.elements + 1)]
        pairs = zip(case.mechanisms, ratio, strict=True)
        columns += [mechanism_column(case.links, mechanism, u) for mechanism, u in pairs]
        columns.append(_column(case.links, [(case.gear_output(self.gear), ONE)]))
        columns += [_column(case.links, [(link, -ONE)]) for link in self.holding]
        rows = [list(row) for row in zip(*columns, strict=True)]
        rows += [
            [ONE if j == number else ZERO for j in range(len(columns))]
            for number in range(self.elements)
            if number + 1 not in self.gear.engaged
        ]
        return rows

    def _right(self) -> Row:
        open_elements = self.elements - len(self.gear.engaged)
        links = range(1, self.case.links + 1)
        on_links = [self.external.get(link, ZERO) + self.drag.get(link, ZERO) for link in links]
        return on_links + [ZERO] * open_elements

    def element(self, number: int) -> Fraction | None:
        """Torque on the first link of shift element `number`, from 1."""
        return self.system.unknown(number - 1)

    def mechanism(self, index: int) -> Fraction | None:
        """Torque on the first link of a mechanism, from 0."""
        return self.system.unknown(self.elements + index)

    def mx(self) -> Fraction | None:
        """The output torque."""
        return self.system.unknown(self.output)

    def mx_slope(self, index: int, ratio: Sequence[Fraction]) -> Fraction | None:
        """Exact derivative of Mx by the internal ratio of a mechanism, from 0.

        A(u) m = b gives A dm/du = -(dA/du) m, and dA/du has -1 at the second
        link and +1 at the third in the column of the mechanism.
        """
        moment = self.mechanism(index)
        if moment is None:
            return None
        mechanism = self.case.mechanisms[index]
        right = _column(self.case.links, [(mechanism.second, moment), (mechanism.third, -moment)])
        right += [ZERO] * (self.elements - len(self.gear.engaged))
        return self._solved(self._matrix(ratio), right).unknown(self.output)

    def power(self, speeds: Speeds, ports: Sequence[int]) -> Fraction | None:
        """Power that enters by these links: sum of external torque times speed."""
        row, constant = self.system.unit(), ZERO
        for link in ports:
            index, factor = self._unknown_at(link)
            speed = speeds.link(link)
            torque = self.external.get(link, ZERO)
            if index is not None:
                moment = self.system.unknown(index)
                if speed is None and moment != 0:
                    return None
                row[index] += factor * (speed or ZERO)
            fixed = times(torque, speed)
            if fixed is None:
                return None
            constant += fixed
        return self.system.functional(row, constant)

    def _unknown_at(self, link: int) -> tuple[int | None, Fraction]:
        """Index and factor of the unknown external torque on a link."""
        if link == self.case.gear_output(self.gear):
            return self.output, -ONE
        return self.holding.get(link), ONE

    def ports(self) -> list[int]:
        """All links with external torque."""
        return sorted({*self.external, *self.holding, self.case.gear_output(self.gear)})
