"""Checks of the arguments of public functions, before anything is calculated.

The annotated types declare the arguments that a function accepts; `refusing` enforces them with
uniform messages (`decorators`, `types`, `words`). Functions check numbers and names themselves.
`naming` replaces options in problems by the names of Python arguments.
"""

from vstatics.core.arguments.decorators import naming, refuse_fields, refusing
from vstatics.core.arguments.words import type_and_value

__all__ = ["naming", "refuse_fields", "refusing", "type_and_value"]
