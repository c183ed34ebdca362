"""Which problems a command tells, and which make it fail: -q and --strict."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from vstatics.core.errors import Problem, listed, of_file, plural


class Telling(NamedTuple):
    """What becomes of warnings and notes; an error is printed and makes the command fail."""

    allow: Sequence[str] = ()
    """Ids of messages that are not told, besides those that the case allows."""
    quiet: bool = False
    """Whether errors alone are printed, and no progress."""
    strict: bool = False
    """Whether warnings make the command fail."""
    notes: bool = False
    """Whether notes are told, as `vstatics check` does."""
    on_page: bool = False
    """Whether a page tells them alone, and nothing is printed."""
    each_gear: bool = False
    """Whether one text about several gears is told of each, at its place."""

    def told(self, problems: Iterable[Problem]) -> list[Problem]:
        """The problems that the command speaks of, notes behind the others."""
        notes: list[Problem] = []
        others: list[Problem] = []
        for one in dict.fromkeys(problems):
            (notes if one.severity == "note" else others).append(one)
        return others + notes * self.notes

    def printed(self, problems: Iterable[Problem]) -> list[Problem]:
        """Those of them that -q and a page of their own do not hold back."""
        found = self.told(problems)
        if self.quiet:
            return [one for one in found if one.severity == "error"]
        return [one for one in found if not self.on_page or one.severity != "note"]

    def quiet_failure(self, problems: Iterable[Problem], file: str) -> Iterator[Problem]:
        """That a case fails by warnings, where these are not printed."""
        found = list(problems)
        if self.quiet and self.fails(found) and not self.printed(found):
            ids = [one.id for one in found if one.severity == "warning"]
            count, names = len(ids), listed(sorted(set(ids)))
            told = f"{count} {plural('warning', count)} ({names}), which --strict makes fail"
            yield of_file(
                "E013", file, f"{told}; without -q {'it is' if count == 1 else 'they are'} told"
            )

    def fails(self, problems: Iterable[Problem]) -> bool:
        """Whether the command fails, though there is no error."""
        return self.strict and any(one.severity == "warning" for one in problems)
