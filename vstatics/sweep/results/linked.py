"""Linked numbers: numbers that a formula calculates for each variant from other numbers."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import Place, ReadError
from vstatics.core.numerics.arrays import Floats
from vstatics.core.readers.expressions.evaluation import evaluate
from vstatics.core.readers.expressions.excerpt import Excerpt
from vstatics.core.readers.expressions.grammar import Applied
from vstatics.sweep.options import Text, located
from vstatics.sweep.results.documents import Subject
from vstatics.sweep.results.expressions import Expression, Node, read_expression
from vstatics.sweep.results.meanings import VariedNumber
from vstatics.sweep.variants.numbered import Variants, VariantTable, empty_block
from vstatics.sweep.variants.targets import Varied, refusal
from vstatics.sweep.variants.variation import read_linked

OPTION = "--with"


class LinkedVariants:
    """Variants with linked numbers, each calculated from the preceding numbers.

    Parameters
    ----------
    base : Variants
        Variants with the numbers that vary independently.
    targets : sequence of Varied
        Linked numbers, in the order of their columns.
    formulas : sequence of Expression
        Formula of each linked number.
    """

    def __init__(
        self, base: Variants, targets: Sequence[Varied], formulas: Sequence[Expression]
    ) -> None:
        self.base, self.formulas = base, tuple(formulas)
        self.targets = (*base.targets, *targets)
        self.count = base.count

    def block(self, start: int, stop: int) -> Floats:
        """Return the values of a block of variants, with linked numbers; see `Variants`."""
        block = empty_block(self, start, stop)
        first = len(self.base.targets)
        block[:, :first] = self.base.block(start, stop)
        for column, formula in enumerate(self.formulas, first):
            values = _values(formula, block)
            block[:, column] = np.where(np.isfinite(values), values, np.nan)
        return block


def table_of(variants: Variants) -> VariantTable | None:
    """Return the table given by the user from which variants are read, if any."""
    base = variants.base if isinstance(variants, LinkedVariants) else variants
    return base if isinstance(base, VariantTable) else None


def _values(formula: Expression, block: Floats) -> Floats:
    def value_of(name: VariedNumber) -> Floats:
        return block[:, name.column, None, None]

    values = evaluate(formula.node, value_of)
    return np.broadcast_to(values, (len(block), 1, 1))[:, 0, 0]


class LinkText(NamedTuple):
    """Linked number and formula, with the text that contains both."""

    target: Varied
    formula: Excerpt
    text: Text
    place: Place


def linked_variants(
    subject: Subject, base: Variants, places: Sequence[Place | None], texts: Sequence[Text]
) -> tuple[Variants, Sequence[Place | None]]:
    """Return variants with linked numbers, and the place of the text that names each number.

    Parameters
    ----------
    subject : Transmission or VariedScenario
    base : Variants
    places : sequence of Place or None
        Place of the text that names each varied number of `base`.
    texts : sequence of Text
        Formulas of linked numbers, in their order, such as
        `P1.teeth.planet=(P1.teeth.ring - P1.teeth.sun)/2`.

    Raises
    ------
    ReadError
        If a text is invalid, a number already varies, or a formula uses its own or a later linked
        number.
    """
    if not texts:
        return base, places
    links = [_read(text, subject) for text in texts]
    seen: set[Hashable] = set().union(*(target.numbers for target in base.targets))
    for link in links:
        if link.target.numbers & seen:
            message = f"{link.target.name} is varied twice, expected each number once"
            raise ReadError("E706", message, place=link.place)
        seen |= link.target.numbers
    targets = [*base.targets, *(link.target for link in links)]
    formulas = []
    for link in links:
        with located(link.text):
            formulas.append(read_expression(link.formula, subject, targets))
            _check_values(formulas[-1], link)
    _check_order(links, formulas, len(base.targets))
    variants = LinkedVariants(base, [link.target for link in links], formulas)
    return variants, [*places, *(link.place for link in links)]


def _read(text: Text, subject: Subject) -> LinkText:
    with located(text):
        place = Place(OPTION, 1, 1, text.text)
        target, end = read_linked(text.text, subject, place)
        if not text.text[end + 1 :].strip():
            raise refusal("read no formula, expected a formula of other numbers", place, end + 1)
        return LinkText(target, Excerpt(text.text, OPTION, end + 1), text, text.place(1) or place)


def _check_values(formula: Expression, link: LinkText) -> None:
    """Refuse a formula that uses results, because results depend on the linked number.

    Raises
    ------
    ReadError
    """
    used = next(formula.selections, None)
    if used is not None or formula.gears is not None or formula.rows is not None:
        message = (
            f"{link.target.name} is linked to results{f', {used.table}' if used else ''}: expected "
            "numbers of the case, such as P1.teeth.sun"
        )
        raise link.formula.error(message, link.formula.start)


def _check_order(links: Sequence[LinkText], formulas: Sequence[Expression], first: int) -> None:
    """Refuse links in a circle, and formulas that use a later linked number.

    Raises
    ------
    ReadError
    """
    columns = map(used_numbers, formulas)
    needs = [{column - first for column in used if column >= first} for used in columns]
    for number, link in enumerate(links):
        circle = path_back(number, needs)
        late = [other for other in sorted(needs[number]) if other > number]
        if circle:
            names = " -> ".join(links[place].target.name for place in circle)
            message = f"numbers are linked in a circle: {names}; expected formulas of other numbers"
        elif late:
            message = (
                f"{link.target.name} is linked to {links[late[0]].target.name}, which is linked "
                "later: expected the links in the order of their calculation"
            )
        else:
            continue
        raise ReadError("E721", message, place=link.place)


def used_numbers(formula: Expression) -> set[int]:
    """Return the indices of the varied numbers that a formula uses."""
    nodes: list[Node] = [formula.node]
    used = set()
    while nodes:
        node = nodes.pop()
        if isinstance(node, VariedNumber):
            used.add(node.column)
        elif isinstance(node, Applied):
            nodes += node.operands
    return used


def path_back(start: int, needs: Sequence[set[int]]) -> list[int]:
    """Return the shortest circle of dependences through a linked number; empty without a circle.

    >>> path_back(0, [{1}, {0}]), path_back(0, [{1}, {1}])
    ([0, 1, 0], [])
    """
    paths = [[start]]
    seen: set[int] = set()
    for path in paths:
        for other in sorted(needs[path[-1]] - seen):
            if other == start:
                return [*path, start]
            seen.add(other)
            paths.append([*path, other])
    return []
