"""Checks of the arguments of public functions, before anything is calculated.

The annotations of a function declare the types of its arguments. The decorator `refusing` checks
these types (`decorators`, `types`), with uniform messages (`words`). Functions check numbers and
names themselves. The decorator `naming` replaces options in problems by the names of Python
arguments.
"""

from vstatics.core.arguments.decorators import naming, refuse_fields, refusing
from vstatics.core.arguments.words import type_and_value

__all__ = ["naming", "refuse_fields", "refusing", "type_and_value"]
