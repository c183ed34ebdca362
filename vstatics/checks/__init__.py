"""What a transmission must fulfil before it can be calculated.

Each check yields `Problem`s with the path of the value in the model; the readers
turn a path into a place in their text. Messages say what was read and what was
expected; the reader puts the name of the field before them.
"""

from vstatics.checks.transmission import doubts, hints, problems

__all__ = ["doubts", "hints", "problems"]
