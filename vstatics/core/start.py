"""Settings for the command, imported by the package before anything else.

Ctrl-C ends the command without a traceback. Otherwise Python would raise `KeyboardInterrupt` in the
middle of an import, before any code can catch it. Garbage is collected less often, because imports
create many objects but little garbage. If the package is used as a library, this module changes no
settings.

`typing.NamedTuple` compiles the annotation of each field, which takes a tenth of the start-up time.
The class `NamedTuple` of this module leaves annotations as texts.
"""

from __future__ import annotations

import _signal  # type: ignore[import-not-found] # without the enums of `signal`: at once
import gc
import os
import sys

__all__ = ["NamedTuple"]

PROGRAM = "vstatics"
NEW_OBJECTS = 100_000
"""Number of new objects before garbage collection. Python's default, 700, is slower."""


def is_command(argument: str, command_line: list[str]) -> bool:
    """Return whether Python runs `vstatics`, from ``sys.argv[0]`` and ``sys.orig_argv``.

    >>> is_command("/usr/bin/vstatics", []), is_command("script.py", ["python", "script.py"])
    (True, False)
    >>> is_command("-m", ["python", "-m", "vstatics", "run"])
    True
    """
    if argument == "-m":  # this is the value while Python searches for the module
        return PROGRAM in command_line[command_line.index("-m") + 1 :][:1]
    return os.path.splitext(os.path.basename(argument))[0] == PROGRAM  # noqa: PTH119, PTH122


if is_command(sys.argv[0] if sys.argv else "", sys.orig_argv):
    if _signal.getsignal(_signal.SIGINT) is _signal.default_int_handler:
        # Ctrl-C ends the process at once, with the exit status of shells.
        _signal.signal(_signal.SIGINT, lambda number, _: os._exit(128 + number))
    gc.set_threshold(NEW_OBJECTS)

# These imports follow the settings, so that Ctrl-C is safe during them.
from collections import namedtuple  # noqa: E402
from typing import TYPE_CHECKING  # noqa: E402

if TYPE_CHECKING:
    from typing import NamedTuple
else:

    class _FromAnnotations(type):
        """Metaclass that replaces a class by the named tuple of its annotations."""

        def __new__(cls, name: str, bases: tuple[type, ...], namespace: dict[str, object]) -> type:
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
