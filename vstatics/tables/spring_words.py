"""Headings of tables in which springs have rows or columns."""

from __future__ import annotations

from vstatics.tables.quantity import Phrase, Quantity

WORDS = {
    "KLG = KL + KG": "KLG = KL + KG + KSPR",
    "mechanisms and output": "mechanisms, springs and output",
    "механизмов и выходного": "механизмов, пружин и выходного",
    "the elements and of the output": "the elements, of springs and of the output",
    "звеньев элементов и выходного": "звеньев элементов, пружин и выходного",
    "mechanisms and the output": "mechanisms, springs and the output",
}
"""Words of headings, and what stands there where a case has springs."""


def among_springs(quantity: Quantity) -> Quantity:
    """A quantity of a case with springs, which its headings name.

    >>> from vstatics.tables.quantities import BY_NAME
    >>> among_springs(BY_NAME["torques"]).title
    'Torques of shift elements, mechanisms, springs and the output (Mx), without losses'
    """
    members = quantity.members
    return quantity._replace(
        heading=_phrase(quantity.heading),
        own_title=_worded(quantity.own_title),
        members=None if members is None else (_phrase(members[0]), _phrase(members[1])),
    )


def _phrase(phrase: Phrase) -> Phrase:
    return Phrase(_worded(phrase.en), _worded(phrase.ru))


def _worded(heading: str) -> str:
    for words, others in WORDS.items():
        heading = heading.replace(words, others)
    return heading
