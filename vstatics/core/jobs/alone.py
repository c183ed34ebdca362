"""Interface of all workers, and the simplest workers: the present process.

All workers provide `each(function, items)`, which calls `function(state, item)` for every item.
Each worker receives the state only once, and only a few items are in progress at any time.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator
from typing import Any, Self, TypeVar

from vstatics.core.errors import CaseError
from vstatics.core.named_tuple import NamedTuple

Item = TypeVar("Item")
Result = TypeVar("Result")
Describe = Callable[[Any], str]
Work = Callable[[Any, Item], Result]
"""Function that returns the result for an item, from the state of the workers and the item."""


class Workers(ABC):
    """Workers that process items within a `with` block.

    Parameters
    ----------
    state : object
        Data that every call needs. Each worker receives these data only once.
    describe : callable
        Function that returns the name of an item for error messages.
    """

    remote = False
    """True if workers can be on other machines, which cannot read local files."""

    def __init__(self, state: object, describe: Describe) -> None:
        self.state = state
        self.describe = describe

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:  # noqa: B027 (not every kind has workers to end)
        """End the workers; after an error, without waiting for items in progress."""

    @abstractmethod
    def each(
        self, function: Work[Item, Result], items: Iterable[Item], *, ordered: bool = False
    ) -> Iterator[tuple[Item, Result]]:
        """Yield each item with the result, in the order of the items if `ordered`.

        Raises
        ------
        CaseError
            If an item fails; the message names the item.
        OSError
            If the function raises an OSError.
        """


class Rules(NamedTuple):
    """Limits for retries and for results in memory, and functions for special items."""

    ahead: int = 2
    """Largest number, per process, of items in progress and of results that wait for a slow item.
    """
    tries: int = 3
    """Number of processes that can die at an item before the item is abandoned."""
    lost: Callable[[Any], Any] | None = None
    """Function that returns a result for an abandoned item; None to raise an error."""
    here: Callable[[Any], bool] = lambda item: False  # noqa: ARG005
    """Function that returns True for items that only the main process can process."""


def call(function: Work[Item, Result], state: object, item: Item, describe: Describe) -> Result:
    """Return the result of `function` for an item.

    Raises
    ------
    CaseError
        If the function raises a CaseError, or any other exception; the message names the item.
    OSError
        If the function raises an OSError.
    """
    try:
        return function(state, item)
    except (OSError, CaseError):
        raise
    except Exception as error:
        raise failure(describe, item, error) from error


def failure(describe: Describe, item: object, error: BaseException) -> CaseError:
    """Return the error for an unexpected exception at an item, which is a fault in the program."""
    message = f"an error in vstatics, please report it: {type(error).__name__}: {error}"
    return CaseError("E002", f"{describe(item)}: {message}")


class Alone(Workers):
    """The present process as the only worker."""

    def each(
        self,
        function: Work[Item, Result],
        items: Iterable[Item],
        *,
        ordered: bool = False,  # noqa: ARG002
    ) -> Iterator[tuple[Item, Result]]:
        """Process the items in sequence; see `Workers`."""
        for item in items:
            yield item, call(function, self.state, item, self.describe)
