"""What those who do the work give, and the simplest of them: this process itself.

All of them give `each(function, items)`: `function(state, item)` for every item, with a
state that every worker got once. However many items there are, only a few are under way.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Any, Protocol, Self, TypeVar

from vstatics.errors import CaseError, Problem

Item = TypeVar("Item")
Result = TypeVar("Result")
Describe = Callable[[Any], str]


class Workers(Protocol):
    """Those who do the work, as long as the context lasts."""

    remote: bool
    """Whether they may be on other machines, so that they see no files of this one."""

    def __enter__(self) -> Self:
        """Call them together."""

    def __exit__(self, *error: object) -> None:
        """Send them home."""

    def each(
        self,
        function: Callable[[Any, Item], Result],
        items: Iterable[Item],
        *,
        ordered: bool = False,
    ) -> Iterator[tuple[Item, Result]]:
        """Give each item with its result, in order if that is asked for.

        Raises
        ------
        CaseError
            If an item cannot be done; it names the item.
        OSError
            As the function raised it.
        """


def failure(describe: Describe, item: object, error: BaseException) -> CaseError:
    """The error that an item could not be done."""
    return CaseError([Problem(f"{describe(item)}: {type(error).__name__}: {error}")])


class Alone:
    """The process itself does everything."""

    remote = False

    def __init__(self, state: object, describe: Describe) -> None:
        """Keep the state."""
        self.state = state
        self.describe = describe

    def __enter__(self) -> Self:
        """Nobody is to be called."""
        return self

    def __exit__(self, *error: object) -> None:
        """Nobody is to be sent home."""

    def each(
        self,
        function: Callable[[Any, Item], Result],
        items: Iterable[Item],
        *,
        ordered: bool = False,  # noqa: ARG002
    ) -> Iterator[tuple[Item, Result]]:
        """See `Workers`."""
        for item in items:
            try:
                result = function(self.state, item)
            except (OSError, CaseError):
                raise
            except Exception as error:
                raise failure(self.describe, item, error) from error
            yield item, result
