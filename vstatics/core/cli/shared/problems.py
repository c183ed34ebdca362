"""Selection of the problems that are printed, and that make a command fail, by -q and --strict."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from vstatics.core.errors import Problem, count_of, listed, not_allowed, of_file
from vstatics.core.start import NamedTuple


class Telling(NamedTuple):
    """Treatment of warnings and notes. Errors are always printed, and make the command fail."""

    allow: Sequence[str] = ()
    """Ids of messages to suppress, in addition to the key `allow` of the case."""
    quiet: bool = False
    """True to print only errors, and no progress."""
    strict: bool = False
    """True if warnings make the command fail."""
    notes: bool = False
    """True to report notes, as in `vstatics check`."""
    on_page: bool = False
    """True if notes are only on a page, and not printed."""
    each_gear: bool = False
    """True to repeat a message about several gears for each gear."""

    def told(self, problems: Iterable[Problem]) -> list[Problem]:
        """Return the problems to report, notes last."""
        notes: list[Problem] = []
        warnings_and_errors: list[Problem] = []
        for problem in dict.fromkeys(not_allowed(problems, self.allow)):
            (notes if problem.severity == "note" else warnings_and_errors).append(problem)
        return warnings_and_errors + notes * self.notes

    def printed(self, problems: Iterable[Problem]) -> list[Problem]:
        """Return the problems to print, without messages that -q suppresses or a page contains."""
        reported = self.told(problems)
        if self.quiet:
            return [problem for problem in reported if problem.severity == "error"]
        return [problem for problem in reported if not self.on_page or problem.severity != "note"]

    def quiet_failure(self, problems: Iterable[Problem], file: str) -> Iterator[Problem]:
        """Yield a problem if a case fails only because of warnings that are not printed."""
        all_problems = list(problems)
        if self.quiet and self.fails(all_problems) and not self.printed(all_problems):
            ids = [problem.id for problem in all_problems if problem.severity == "warning"]
            count, names = len(ids), listed(sorted(set(ids)))
            message = f"{count_of('warning', count)} ({names}), so --strict fails"
            yield of_file(
                "E013", file, f"{message}; run without -q to see {'it' if count == 1 else 'them'}"
            )

    def fails(self, problems: Iterable[Problem]) -> bool:
        """Return whether warnings make the command fail."""
        return self.strict and any(problem.severity == "warning" for problem in problems)
