"""Subject of a sweep: a case, or another document with numbers to vary, such as a scenario.

The record of an annex declares such a kind of document.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import NamedTuple, TypeAlias

from vstatics.core.errors import Place, ReadError
from vstatics.core.model.paths import typed_by_name
from vstatics.core.model.transmission import Transmission
from vstatics.core.suggestions import nearest
from vstatics.sweep.variants.path_numbers import CasePath, case_path, known_paths, no_path
from vstatics.sweep.variants.targets import OF_MECHANISM, Target, Varied, refusal, target


class Document(NamedTuple):
    """Content of a file, with the name of the file."""

    data: bytes
    file: str


class VariedDocument(ABC):
    """Document that refers to a case, such as a scenario. Numbers of both can vary."""

    @property
    @abstractmethod
    def base_case(self) -> Transmission:
        """Case as read from the file, before any number varies."""

    @abstractmethod
    def target(self, text: str, place: Place | None = None) -> Varied:
        """Return the varied number with a given name.

        Raises
        ------
        ReadError
            If the number does not exist.
        """

    @abstractmethod
    def in_unit(self, varied: Varied, unit: str, place: Place | None) -> Varied:
        """Return a varied number whose values are typed in a unit.

        Raises
        ------
        ReadError
            If the document has no such unit for this number.
        """

    @abstractmethod
    def check_targets(self, targets: Sequence[Varied], places: Sequence[Place | None]) -> None:
        """Check that some numbers can vary together.

        Raises
        ------
        ReadError
        """

    @abstractmethod
    def check_runs(self, targets: Sequence[Varied], values: Sequence[float]) -> None:
        """Check that variants can be simulated, with the values of the first variant.

        Raises
        ------
        ReadError
            If the document cannot have one of the numbers.
        CaseError
            If a package is missing.
        """


VariedSubject: TypeAlias = Transmission | VariedDocument


def target_of(text: str, subject: VariedSubject, place: Place | None = None) -> Varied:
    """Return the number of a case or document with a given name; see `targets.target`."""
    if isinstance(subject, Transmission):
        return number_of_case(text, subject, place)
    return subject.target(text, place)


def number_of_case(text: str, case: Transmission, place: Place | None = None) -> Target | CasePath:
    """Return a number of a case, given as `D1.ratio` or by a path.

    Raises
    ------
    ReadError
        If the number does not exist; the message names the nearest.
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
            problem
            if "did you mean" in problem.message
            else problem._replace(message=problem.message + hint)
            for problem in error.problems
        ) from None


def varied_beside_teeth(name: str, place: Place | None) -> ReadError:
    """Return the error about a ratio that varies together with the determining teeth."""
    message = f"{name} is varied together with teeth that determine it, expected one of the two"
    return ReadError("E706", message, place=place)
