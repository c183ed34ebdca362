"""Checks of the arguments of public functions, before anything is calculated.

The types of the arguments declare what a function accepts; `refusing` enforces them with uniform
messages (`decorators`, `types`, `words`). Functions check numbers and names themselves. `naming`
replaces the options in problems by the arguments of Python.
"""

from vstatics.core.arguments.decorators import naming, refuse_fields, refusing
from vstatics.core.arguments.words import type_and_value

__all__ = ["naming", "refuse_fields", "refusing", "type_and_value"]
