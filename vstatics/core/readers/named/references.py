"""Numbers of links, shift elements and other components, by their names in a document."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Sequence
from itertools import islice

from vstatics.core.model.transmission import HOUSING, SpeedOf
from vstatics.core.readers.named import scalars
from vstatics.core.readers.named.arithmetic import calculated
from vstatics.core.readers.named.nodes import DocumentText, shown
from vstatics.core.readers.named.units import unit

NO_LINK = -1
"""Number of an unknown link, which no other link has."""

NO_ELEMENT = 0
_FEW_LINKS = 8
_MOST_FACTORS = 100
_HOUSING = ("0", "housing")


class UnknownNameError(ValueError):
    """Error for the name or number of a link or component that does not exist in the document."""


class References:
    """Numbers of links and components, by name in a document.

    Attributes
    ----------
    link_names : list of str
        Names of the links; empty if the links have only numbers. links_known, elements_known : bool
        True if the names could be read; otherwise errors about names are suppressed.
    """

    def __init__(self, document: DocumentText) -> None:
        self.link_names: list[str] = []
        self.links_known = False
        self.elements_known = True
        self._document = document
        self._links = 0
        self._link_numbers: dict[str, int] = {}
        self._numbers: dict[str, dict[str, int]] = {
            "shift element": {},
            "mechanism": {},
            "spring": {},
            "elastic component": {},
        }

    def set_links(self, links: int) -> None:
        """Set the number of links, which have no names."""
        self._links, self.links_known = links, True

    def set_link_names(self, names: Sequence[str]) -> None:
        """Set the names of the links."""
        self.link_names = list(names)
        self._link_numbers = _numbered(names)
        self.links_known = True

    def set_numbers(self, kind: str, names: Iterable[str]) -> None:
        """Set the names of the components of a kind, in order."""
        self._numbers[kind] = _numbered(names)

    def add_converters(self, names: Iterable[str]) -> None:
        """Append converters to the mechanisms, because both can have speed ratios in gears."""
        self.set_numbers("mechanism", [*self._numbers["mechanism"], *names])

    def other(self, kind: str, text: str) -> int:
        """Return the number of a mechanism, a spring or an elastic component, by name.

        Raises
        ------
        ValueError
            The message states the expected name.
        """
        numbers = self._numbers[kind]
        if text in numbers:
            return numbers[text]
        article = "an" if kind == "elastic component" else "a"
        raise UnknownNameError(f"expected the name of {article} {kind}{self._known(text, numbers)}")

    def link(self, text: str) -> int:
        """Return the number of a link; 0 for the housing, `NO_LINK` if the links could not be read.

        Raises
        ------
        ValueError
            The message states the expected name or number.
        """
        if text in _HOUSING:
            return HOUSING
        if self.link_names:
            if text in self._link_numbers:
                return self._link_numbers[text]
            known = self._known(text, [*self.link_names, "housing"])
            raise UnknownNameError(f"expected the name of a link or `housing`{known}")
        number = scalars.link_number(text)
        if number is not None and (number <= self._links or not self.links_known):
            return number
        if not self.links_known:
            return NO_LINK
        hint = self._document.hint(text, ["housing"])
        raise UnknownNameError(f"expected a link number from 1 to {self._links} or `housing`{hint}")

    def speed_of(self, text: str) -> SpeedOf | None:
        """Return the speed for a text such as `FL`, `1.05*FL` or `1.05*link 3`, else None.

        Raises
        ------
        ValueError
            If the link is unknown, or the factor is after the link.
        """
        for factor, link in ((1.0, text), (-1.0, text.removeprefix("-").strip())):
            number = self._number(link)
            if number is not None:
                return SpeedOf(number, factor)
        for times in islice(re.finditer(r"\*", text), _MOST_FACTORS):
            number = self._number(text[times.end() :].strip())
            if number is not None:
                return SpeedOf(number, scalars.number(text[: times.start()].strip()))
        ends = re.fullmatch(r"([^*/]+)([*/])(.+)", text)
        if ends and self._number(ends[1].strip()) is not None:
            link, given = ends[1].strip(), ends[3].strip()
            first = given if ends[2] == "*" else f"1/{given}"
            raise ValueError(f"expected the factor before the link: `{first}*{link}`")
        behind = _behind(text)
        if self.links_known and behind.startswith("*") and not unit(behind)[0]:
            link = "the name of a link" if self.link_names else "`link` and its number"
            known = self._known(behind[1:].strip(), self.link_names) if self.link_names else ""
            raise UnknownNameError(f"expected {link} after the `*`{known}")
        return None

    def _number(self, link: str) -> int | None:
        """Return the number of a link, named alone or after the word `link`; None if unknown."""
        name = link.removeprefix("link ").strip()
        if self.link_names:
            return self._link_numbers.get(name if name in self._link_numbers else link)
        number = scalars.link_number(name) if name != link else None
        return number if number and number <= self._links else None

    def element(self, text: str) -> int:
        """Return the number of a shift element; `NO_ELEMENT` if the names could not be read.

        Raises
        ------
        ValueError
            The message states the expected name.
        """
        numbers = self._numbers["shift element"]
        if text in numbers:
            return numbers[text]
        if not self.elements_known:
            return NO_ELEMENT
        if not numbers:
            raise UnknownNameError("but the case has no shift elements")
        known = self._known(text, numbers)
        raise UnknownNameError(f"expected the name of a shift element{known}")

    def _known(self, text: str, names: Collection[str]) -> str:
        """Return a hint to a missing comma or to the nearest name, or a short list of all names."""
        several = text.split()
        if len(several) > 1 and all(name in names for name in several):
            return f"; write a comma between the names: `{', '.join(several)}`"
        few = ": " + ", ".join(map(shown, names)) if 0 < len(names) <= _FEW_LINKS else ""
        return self._document.hint(text, names) or few


def _behind(text: str) -> str:
    """Return the text after a number; empty without a number."""
    try:
        return calculated(text).behind
    except ValueError:
        return ""


def _numbered(names: Iterable[str]) -> dict[str, int]:
    numbers: dict[str, int] = {}
    for number, name in enumerate(names, 1):
        numbers.setdefault(name, number)
    return numbers
