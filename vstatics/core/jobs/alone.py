"""Interface of workers of every kind, and the simplest kind: the process itself.

All workers provide `each(function, items)`, which calls `function(state, item)` for every item,
with a state that each worker receives once. Only a few items are in progress at any time.
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
"""Function that processes an item with the state of the workers, and returns the result."""


class Workers(ABC):
    """Workers that process items as long as the context lasts.

    Parameters
    ----------
    state : object
        State that each worker receives once.
    describe : callable
        Function that names an item in words, for errors.
    """

    remote = False
    """True if workers can be on other machines, which do not see local files."""

    def __init__(self, state: object, describe: Describe) -> None:
        self.state = state
        self.describe = describe

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:  # noqa: B027 (not every kind has workers to end)
        """End the workers, at once after an error."""

    @abstractmethod
    def each(
        self, function: Work[Item, Result], items: Iterable[Item], *, ordered: bool = False
    ) -> Iterator[tuple[Item, Result]]:
        """Yield each item with its result, in the order of the items if `ordered`.

        Raises
        ------
        CaseError
            If an item fails; the message names the item.
        OSError
            If the function raises an OSError.
        """


class Rules(NamedTuple):
    """Limits of waiting results and of retries, and the treatment of special items."""

    ahead: int = 2
    """Largest number of unfinished items and waiting results per process, when one item is slow."""
    tries: int = 3
    """Number of processes that can die at an item before the item is abandoned."""
    lost: Callable[[Any], Any] | None = None
    """Function that returns a result for an abandoned item; by default an error is raised."""
    here: Callable[[Any], bool] = lambda item: False  # noqa: ARG005
    """Function that returns True for an item that only the main process can process."""


def call(function: Work[Item, Result], state: object, item: Item, describe: Describe) -> Result:
    """Return the result of an item.

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
    """Return the error that reports a fault in the program, with the name of the item."""
    message = f"an error in vstatics, please report it: {type(error).__name__}: {error}"
    return CaseError("E002", f"{describe(item)}: {message}")


class Alone(Workers):
    """Workers that consist of the process itself."""

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
