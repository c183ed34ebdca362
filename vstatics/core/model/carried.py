"""Data of annexes in a case, under keys that the annexes declare; the core does not use them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

from vstatics.core.annexes import KEYS, module, module_of_key

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
    """True if the data refer to members of gear sets; not checked if a gear set has errors."""


def as_type(data: object, kind: type[Data]) -> Data | None:
    """Return data of an annex, checked to have the type that the annex declares.

    Raises
    ------
    TypeError
        If the data are of another type.
    """
    if data is None or isinstance(data, kind):
        return data
    raise TypeError(f"read {data!r}, expected a {kind.__name__}")


def installed_keys(names: Iterable[str] = KEYS) -> list[CaseKey]:
    """Return the named keys of installed annexes."""
    return [module(declaring).KEY for name in names if (declaring := module_of_key(name))]
