"""Named tuples for the modules that most commands import.

`typing.NamedTuple` compiles the annotation of each field, which takes a tenth of the time in which
the program starts. The class here leaves annotations as texts.
"""

from __future__ import annotations

from collections import namedtuple
from typing import TYPE_CHECKING, Any

__all__ = ["NamedTuple"]

if TYPE_CHECKING:
    from typing import NamedTuple
else:

    class _FromAnnotations(type):
        """Metaclass that replaces a class by the named tuple of its annotations."""

        def __new__(cls, name: str, bases: tuple[type, ...], namespace: dict[str, Any]) -> type:
            if not bases:
                return super().__new__(cls, name, bases, namespace)
            fields = namespace.pop("__annotations__", {})
            defaults = [namespace.pop(field) for field in fields if field in namespace]
            module = namespace.pop("__module__")
            created = namedtuple(name, fields, defaults=defaults, module=module)  # noqa: PYI024
            created.__annotations__ = fields
            for attribute, value in namespace.items():
                setattr(created, attribute, value)
            return created

    class NamedTuple(metaclass=_FromAnnotations):
        """Base class with the same meaning as `typing.NamedTuple`."""
