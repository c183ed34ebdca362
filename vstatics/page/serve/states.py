"""States of a page: of the saved files, and with changed numbers that are not yet saved."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack
from typing import Any, NamedTuple

from vstatics.core.errors import Problem
from vstatics.core.jobs.files import ChangedFileError, replacing, unwritable
from vstatics.core.statics.results import Results
from vstatics.page.report.material import Material, Naming
from vstatics.page.serve.document_fields import CaseDocuments, Texts, documents_of
from vstatics.page.serve.number_fields import PageField
from vstatics.page.serve.page import (
    head_of,
    material_of,
    page_of,
    page_of_errors,
    parts_of,
    sections_of,
    told,
)
from vstatics.page.serve.watched_files import digest_of, signature_of
from vstatics.pictures.paged.parts import Part
from vstatics.pictures.runs import PicturedRun

WRITE_SECONDS = 0.1
"""Time after which an invalid file is read again, because it can be half-written. [s]"""
SETTLE_SECONDS = 0.005
"""Wait before the last comparison of files, for editors that react to a new file. [s]"""
MOST_KEPT = 32
"""Number of latest states with unsaved changes whose pictures can be drawn."""


class Calculated(NamedTuple):
    """Result of the calculation of a case from the documents."""

    results: Results | None
    problems: Sequence[Problem]
    """Problems, located in the documents."""
    naming: Naming
    texts: Texts
    """Contents of the readable files by name, with a scenario before its case."""
    files: Sequence[str] = ()
    """Names of all files on which the case depends, even missing files."""
    run: Callable[[], PicturedRun | None] = lambda: None
    """Function that returns the simulated run of a scenario, and can raise a `CaseError`."""
    is_run: bool = False


Calculate = Callable[[Texts], Calculated]
"""Function that calculates the case; its argument replaces the contents of files."""


class Shown(NamedTuple):
    """State of the page: the calculated case, with number and contents of the state."""

    number: int
    """Number of the state; later states have larger numbers."""
    calculated: Calculated
    material: Material | None
    """Contents of the page, None without results."""
    errors: str

    @property
    def state(self) -> str:
        """Word for the state of the page, as attribute of the HTML element `body`."""
        return "error" if self.errors else "good"


class ChangedMeanwhileError(Exception):
    """Refusal of a request because files have changed in the meantime."""


class RefusedChangeError(Exception):
    """Refusal of an impossible change, with the reason."""


class ShownStates:
    """All current states of the page of a case."""

    shown: Shown
    """Present state of the files."""
    good: Shown | None = None
    """Last state of the files that had results, if any."""
    _documents = CaseDocuments({}, {})
    """Documents of the last state that had results."""

    def __init__(self, calculate: Calculate, file: str, digits: int | None = None) -> None:
        """Calculate the case from the files."""
        self.file = file
        self._calculate = calculate
        self._digits = digits
        self._kept: dict[str, Shown] = {}
        self._number = 0
        self._answered: tuple[int, dict[str, Any]] = (0, {})
        self._files: Sequence[str] = [file]
        self._signature: Mapping[str, tuple[int, ...]] = {}
        while not self.look_again():
            pass

    def look_again(self) -> bool:
        """Calculate the case again if a file has changed; return whether it was calculated.

        Metadata of files are read before their contents, so that the next check notices a change in
        between. An invalid file is checked twice, because it can be half-written.
        """
        signature = signature_of(self._files)
        if signature == self._signature:
            return False
        shown = self._shown({})
        if shown.errors:
            time.sleep(WRITE_SECONDS)
            if signature_of(self._files) != signature:
                return False
        self._take(shown)
        found_files = [file for file in self._files if file not in signature]
        self._signature = {**signature, **signature_of(found_files)}
        return True

    def is_old(self) -> bool:
        """Return whether a file has changed since the last calculation."""
        return signature_of(self._files) != self._signature

    @property
    def digest(self) -> str:
        """Hash of the documents as last read."""
        return digest_of(self.shown.calculated.texts)

    def kept(self, number: str) -> Shown | None:
        """Return the stored state with a number (as text); None if it is no longer stored."""
        of_files = (
            state for state in (self.shown, self.good) if state and str(state.number) == number
        )
        return next(of_files, self._kept.get(number))

    def tried(self, changes: Mapping[str, float]) -> Shown:
        """Return the state of the page with changed numbers, without saving the changes.

        Raises
        ------
        RefusedChangeError
            If the numbers cannot be changed.
        """
        return self._shown(self._changed(changes)) if changes else self.shown

    def saved(self, changes: Mapping[str, float], digest: str = "") -> Shown:
        """Write changed numbers into the documents, and return the new state.

        Parameters
        ----------
        changes : mapping of str to float
            New values by path.
        digest : str, optional
            Hash of the documents on which the changes are based.

        Raises
        ------
        ChangedMeanwhileError
            If the documents have changed since.
        RefusedChangeError
            If a number cannot be changed or written, or the case would be invalid.
        """
        self.look_again()
        if digest and digest != self.digest:
            raise ChangedMeanwhileError
        texts = self._changed(changes)
        shown = self._shown(texts)
        if shown.material is None:
            raise RefusedChangeError(shown.errors)
        self._write(texts)
        self._take(shown)
        self._signature = signature_of(self._files)
        return shown

    def _write(self, texts: Texts) -> None:
        """Write new contents into all files, or leave all files unchanged.

        The files are compared again when the new files are ready, so that a simultaneous save by an
        editor is not lost.

        Raises
        ------
        ChangedMeanwhileError, RefusedChangeError
        """
        file = self.file
        try:
            with ExitStack() as stack:
                for file, data in texts.items():
                    old = self.shown.calculated.texts[file]
                    stack.enter_context(replacing(file, expected=old))(data)
                time.sleep(SETTLE_SECONDS)
        except ChangedFileError:
            self._signature = {}  # an empty signature forces a new calculation
            raise ChangedMeanwhileError from None
        except OSError as error:
            raise RefusedChangeError(str(unwritable(file, error))) from None

    def _changed(self, changes: Mapping[str, float]) -> dict[str, bytes]:
        if self.shown.material is None:
            raise RefusedChangeError(self.shown.errors)
        if not self._documents.numbers:
            raise RefusedChangeError("a deck is read only")
        try:
            return self._documents.with_changes(changes)
        except ValueError as error:
            raise RefusedChangeError(str(error)) from None

    def _shown(self, texts: Texts) -> Shown:
        """Calculate a state from the files. `texts` replace some of their contents."""
        calculated = self._calculate(texts)
        material = None
        if calculated.results is not None:
            material = material_of(
                calculated.results, calculated.problems, self._digits, calculated.naming
            )
        errors = told(problem for problem in calculated.problems if problem.severity == "error")
        self._number += 1
        shown = self._kept[str(self._number)] = Shown(self._number, calculated, material, errors)
        while len(self._kept) > MOST_KEPT:
            del self._kept[next(iter(self._kept))]
        return shown

    def _take(self, shown: Shown) -> None:
        self.shown = shown
        calculated = shown.calculated
        self._files = list(dict.fromkeys([self.file, *calculated.texts, *calculated.files]))
        if calculated.results is not None:
            self.good = shown
            self._documents = documents_of(calculated.texts, calculated.results.case)

    def page(self) -> str:
        """Return the page of the present state, or of the last state that had results."""
        state, good = self.told_of(self.shown), self.good
        if good is None or good.material is None:
            return page_of_errors(self.file, state)
        runs = good.calculated.is_run
        state["number"] = good.number
        return page_of(good.material, self._parts(good), runs=runs, state=state)

    def _parts(self, shown: Shown) -> list[Part]:
        assert shown.material is not None  # noqa: S101 - only called for states with results
        return parts_of(shown.material, self._fields, runs=shown.calculated.is_run)

    @property
    def _fields(self) -> list[PageField]:
        return self._documents.fields

    def answer(self, shown: Shown) -> dict[str, Any]:
        """Return a state as data for the script of the page, with sections if it has results."""
        number, answer = self._answered
        if (
            number == shown.number and shown is self.shown
        ):  # several open pages can request the same state
            return answer
        answer = self.told_of(shown)
        if shown.material is not None:
            parts = self._parts(shown)
            answer["sections"] = sections_of(shown.material, parts)
            answer["fields"] = {field.path: field.value for field in self._fields}
            answer["head"] = head_of(shown.material, runs=shown.calculated.is_run)
            answer["document"] = shown.material.document
        if shown is self.shown:
            self._answered = shown.number, answer
        return answer

    def told_of(self, shown: Shown) -> dict[str, Any]:
        """Return number, hash, condition and errors of a state, as data for the script."""
        return {
            "number": shown.number,
            "revision": shown.number,
            "digest": self.digest,
            "state": shown.state,
            "errors": shown.errors,
        }
