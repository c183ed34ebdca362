"""What a sweep is of: a case, or a document whose numbers vary, such as a scenario.

Which kinds of documents can vary is declared in the records of annexes.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import NamedTuple, TypeAlias

from vstatics.core.errors import Place, Problem, ReadError
from vstatics.core.model.paths import typed_by_name
from vstatics.core.model.transmission import Transmission
from vstatics.core.suggestions import nearest
from vstatics.sweep.variants.path_numbers import CasePath, case_path, known_paths, no_path
from vstatics.sweep.variants.targets import OF_MECHANISM, Target, Varied, refusal, target


class Document(NamedTuple):
    """What was read, and the name of its file."""

    data: bytes
    file: str


class VariedDocument(ABC):
    """A document that names a case; its numbers, and those of the case, vary."""

    @property
    @abstractmethod
    def base_case(self) -> Transmission:
        """The case as it is written."""

    @abstractmethod
    def target(self, text: str, place: Place | None = None) -> Varied:
        """Return the number that a text names.

        Raises
        ------
        ReadError
            If there is no such number.
        """

    @abstractmethod
    def in_unit(self, varied: Varied, unit: str, place: Place | None) -> Varied:
        """Return a number whose values are in a unit.

        Raises
        ------
        ReadError
            If the document has another unit.
        """

    @abstractmethod
    def check_targets(self, targets: Sequence[Varied], places: Sequence[Place | None]) -> None:
        """Make sure that numbers can vary together.

        Raises
        ------
        ReadError
        """

    @abstractmethod
    def check_runs(self, targets: Sequence[Varied], values: Sequence[float]) -> None:
        """Make sure that variants can be calculated.

        Raises
        ------
        ReadError
            If the document cannot have one of the numbers.
        CaseError
            If a package is missing.
        """


VariedSubject: TypeAlias = Transmission | VariedDocument


def target_of(text: str, subject: VariedSubject, place: Place | None = None) -> Varied:
    """The number that a text speaks of; parameters and errors as of `targets.target`."""
    if isinstance(subject, Transmission):
        return number_of_case(text, subject, place)
    return subject.target(text, place)


def number_of_case(text: str, case: Transmission, place: Place | None = None) -> Target | CasePath:
    """A number of a case: as `D1.ratio`, else by its path.

    Raises
    ------
    ReadError
        If there is no such number; it names the nearest.
    """
    path = case_path(text, case)
    if path is None:
        text = typed_by_name(text)
        path = case_path(text, case)
    if path is not None and path.quantity not in OF_MECHANISM:
        return path
    try:
        return target(text, case, place)
    except ReadError as error:
        if path is not None:
            return path
        if message := no_path(text.strip(), case):
            raise refusal(message, place, len(text) - len(text.lstrip())) from None
        hint = nearest(text.strip(), known_paths(case))
        raise ReadError(
            one if "did you mean" in one.message else one._replace(message=one.message + hint)
            for one in error.problems
        ) from None


def varied_beside_teeth(name: str, place: Place | None) -> ReadError:
    """Return the error that a ratio varies together with the teeth that it follows from."""
    message = f"{name} is varied beside teeth that it follows from, expected one of the two"
    return ReadError([Problem("E706", message, place=place)])
