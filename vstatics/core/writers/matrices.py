"""Structure of a case with planetary gear sets as matrices of rigid and variable connections."""

from __future__ import annotations

from vstatics.core.errors import CaseError, listed
from vstatics.core.model.parts import HOUSING, OwnDevice
from vstatics.core.model.transmission import ShiftElement, Transmission
from vstatics.core.tables import csv

MEMBERS = {"sun": "a", "carrier": "h", "ring": "b", "first": "a", "third": "h", "second": "b"}
"""Letter of each member of a gear set or mechanism, in the order of the columns."""


def write(case: Transmission) -> str:
    """Return both matrices as CSV tables, with a row for each link and a blank line between.

    The matrix of rigid connections has a column for each member of a gear set that is not fixed to
    the housing. The column contains 1 in the row of the member's link, or -1 if the link is the
    input. The matrix of variable connections has a column for each shift element. It contains -1 in
    the row of the first or braked link, and 1 in the row of the second link.

    Raises
    ------
    CaseError
        If the members of a mechanism or gear set are not sun, carrier and ring.
    """
    rigid = {}
    for device in case.own_devices:
        for letter, link in _links(case, device).items():
            rigid[f"{device.name}.{letter}"] = {link: -1 if link == case.input else 1}
    variable = {element.name: _ends(element) for element in case.shift_elements}
    return f"{_table(case, rigid)}\n{_table(case, variable)}"


def _links(case: Transmission, device: OwnDevice) -> dict[str, int]:
    links = {member.name: member.link for member in device.members}
    if case.mechanisms[device.mechanisms[0]].is_set and "first" in links:
        links["third"] = HOUSING  # the matrix has no row for the housing
    if not links.keys() <= MEMBERS.keys() or len(links) != 3:
        message = f"{device.name} has the members {listed(list(links))}"
        raise CaseError("E871", f"{message}; expected a set of sun, carrier and ring")
    return {letter: links[name] for name, letter in MEMBERS.items() if name in links}


def _ends(element: ShiftElement) -> dict[int, int]:
    first, second = element.first, element.second
    return {first: -1, second: 1} if first and second else {first or second: -1}


def _table(case: Transmission, columns: dict[str, dict[int, int]]) -> str:
    names = case.link_names[: case.own_links]
    rows = [
        [name, *(str(column.get(link, 0)) for column in columns.values())]
        for link, name in enumerate(names, 1)
    ]
    return csv.lines([["link", *columns], *rows])
