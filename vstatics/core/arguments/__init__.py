"""What public functions are given: what they do not take is refused before anything is done.

What a function takes is told once, by the types of its arguments; `refusing` holds it to them, in
one wording (`decorators`, `types`, `words`). Which numbers and names are right is the function's
own matter. By `naming` its problems speak of arguments where those of the command line speak of
options.
"""

from vstatics.core.arguments.decorators import naming, refuse_fields, refusing
from vstatics.core.arguments.words import type_and_value

__all__ = ["naming", "refuse_fields", "refusing", "type_and_value"]
