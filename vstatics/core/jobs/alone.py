"""What workers of every kind give, and the simplest of them: this process itself.

All of them give `each(function, items)`: `function(state, item)` for every item, with a
state that every worker got once. However many items there are, only a few are under way.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator
from typing import Any, NamedTuple, Self, TypeVar

from vstatics.core.errors import CaseError

Item = TypeVar("Item")
Result = TypeVar("Result")
Describe = Callable[[Any], str]
Work = Callable[[Any, Item], Result]
"""What is done with a state and an item."""


class Workers(ABC):
    """They take the items, as long as the context lasts.

    Parameters
    ----------
    state : object
        What each of them gets once.
    describe : callable
        Names an item in words, for errors.
    """

    remote = False
    """Whether they may be on other machines, so that they see no files of this one."""

    def __init__(self, state: object, describe: Describe) -> None:
        self.state = state
        self.describe = describe

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:  # noqa: B027 (there may be nobody to end)
        """End; at once if there was an error."""

    @abstractmethod
    def each(
        self, function: Work[Item, Result], items: Iterable[Item], *, ordered: bool = False
    ) -> Iterator[tuple[Item, Result]]:
        """Give each item with its result, in order if that is asked for.

        Raises
        ------
        CaseError
            If an item cannot be done; it names the item.
        OSError
            As the function raised it.
        """


class Rules(NamedTuple):
    """What processes do with items that are not all alike, and where one of them dies."""

    ahead: int = 2
    """So many results for each process may wait for one that takes long."""
    tries: int = 3
    """An item at which so many processes died is given up."""
    lost: Callable[[Any], Any] | None = None
    """The result of an item that is given up; without it that is an error."""
    here: Callable[[Any], bool] = lambda item: False  # noqa: ARG005
    """Whether only this process can do an item."""


def call(function: Work[Item, Result], state: object, item: Item, describe: Describe) -> Result:
    """The result of an item.

    Raises
    ------
    CaseError
        Of the function, or in place of any other exception; then it names the item.
    OSError
        As the function raised it.
    """
    try:
        return function(state, item)
    except (OSError, CaseError):
        raise
    except Exception as error:
        raise failure(describe, item, error) from error


def failure(describe: Describe, item: object, error: BaseException) -> CaseError:
    """The program has a fault, which an item shows."""
    told = f"an error of vstatics, please report it: {type(error).__name__}: {error}"
    return CaseError("E002", f"{describe(item)}: {told}")


class Alone(Workers):
    """The process itself does everything."""

    def each(
        self,
        function: Work[Item, Result],
        items: Iterable[Item],
        *,
        ordered: bool = False,  # noqa: ARG002
    ) -> Iterator[tuple[Item, Result]]:
        """See `Workers`."""
        for item in items:
            yield item, call(function, self.state, item, self.describe)
