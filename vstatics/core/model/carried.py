"""Keys of a case that annexes (optional packages) declare; the core stores their data unread."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, Any, TypeVar

from vstatics.core.annexes import KEYS, module, module_of_key
from vstatics.core.named_tuple import NamedTuple

if TYPE_CHECKING:
    from vstatics.core.errors import Problem
    from vstatics.core.model.fields import TransmissionFields
    from vstatics.core.model.shape import KeyShape

Data = TypeVar("Data")


def _nothing(_: TransmissionFields) -> Iterator[Problem]:
    yield from ()


class CaseKey(NamedTuple):
    """Key of a case that an annex provides, defined as `KEY` in the module of the annex."""

    shape: KeyShape
    type: object
    """Type of the field of the case, for messages about wrong arguments."""
    record: Callable[[TransmissionFields], Any]
    """Function that returns the data of a case as written in a document."""
    problems: Callable[[TransmissionFields], Iterator[Problem]]
    doubts: Callable[[TransmissionFields], Iterator[Problem]] = _nothing
    left_out: Callable[[TransmissionFields], Iterator[Problem]] = _nothing
    """Function that yields notes about data that simulation and vibration ignore."""
    names_members: bool = False
    """True if the data refer to members of gear sets. Such data are not checked if a gear set has
    errors.
    """


def as_type(data: object, kind: type[Data]) -> Data | None:
    """Return `data` unchanged if it is None or of type `kind`.

    Raises
    ------
    TypeError
        If `data` is of another type.
    """
    if data is None or isinstance(data, kind):
        return data
    raise TypeError(f"read {data!r}, expected a {kind.__name__}")


def installed_keys(names: Iterable[str] = KEYS) -> list[CaseKey]:
    """Return the declarations of the keys in `names` whose annex is installed."""
    return [module(declaring).KEY for name in names if (declaring := module_of_key(name))]
