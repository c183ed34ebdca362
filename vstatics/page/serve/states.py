"""What is shown of a case: as its files are, and with numbers that are tried; numbers are saved."""

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
"""So long a file in error is left to whoever may still be writing it."""
SETTLE_SECONDS = 0.005
"""Time between a new file and the last comparison, for whoever writes when a file appears."""
MOST_KEPT = 32
"""So many tried states have their pictures drawn when they are looked at."""


class Calculated(NamedTuple):
    """What became of a case."""

    results: Results | None
    problems: Sequence[Problem]
    """With their places."""
    naming: Naming
    texts: Texts
    """A scenario, if there is one, and then the case; what could not be read is left out."""
    files: Sequence[str] = ()
    """All that were read, or would have been."""
    run: Callable[[], PicturedRun | None] = lambda: None
    """Of a scenario; raises a `CaseError` if it can't begin."""
    is_run: bool = False


Calculate = Callable[[Texts], Calculated]
"""Texts stand in place of what is in the files of their names."""


class Shown(NamedTuple):
    """A state of the page."""

    number: int
    """Grows from each to the next."""
    calculated: Calculated
    material: Material | None
    """None where there are no results."""
    errors: str

    @property
    def state(self) -> str:
        """How the body of the page tells it."""
        return "error" if self.errors else "good"


class ChangedMeanwhileError(Exception):
    """The files are no longer those on which somebody's numbers stand."""


class RefusedChangeError(Exception):
    """A change that can't be made, and why."""


class ShownStates:
    """What is shown of one case."""

    shown: Shown
    """Of the files as they are."""
    good: Shown | None = None
    """The last of them that had results."""
    _documents = CaseDocuments({}, {})
    """Of that one."""

    def __init__(self, calculate: Calculate, file: str, digits: int | None = None) -> None:
        """Calculate the case as its files are."""
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
        """Calculate the case anew if a file has changed; whether one has.

        Files are looked at before they are read: a change in between shows the next time. So
        does one of a file in error, which may be written only by half.
        """
        signature = signature_of(self._files)
        if signature == self._signature:
            return False
        made = self._shown({})
        if made.errors:
            time.sleep(WRITE_SECONDS)
            if signature_of(self._files) != signature:
                return False
        self._take(made)
        new = [file for file in self._files if file not in signature]
        self._signature = {**signature, **signature_of(new)}
        return True

    def is_old(self) -> bool:
        """Whether a file has changed since."""
        return signature_of(self._files) != self._signature

    @property
    def digest(self) -> str:
        """Of the documents as they were read last."""
        return digest_of(self.shown.calculated.texts)

    def kept(self, number: str) -> Shown | None:
        """A state of the files, or one tried not long ago, by its number as it is written."""
        of_files = (one for one in (self.shown, self.good) if one and str(one.number) == number)
        return next(of_files, self._kept.get(number))

    def tried(self, changes: Mapping[str, float]) -> Shown:
        """What would be shown if numbers were others; a file in error stays so.

        Raises
        ------
        RefusedChangeError
        """
        return self._shown(self._changed(changes)) if changes else self.shown

    def saved(self, changes: Mapping[str, float], digest: str = "") -> Shown:
        """Write other numbers into the documents, and show these.

        Parameters
        ----------
        changes : mapping of str to float
            By their paths.
        digest : str, optional
            Of the documents on which the changes stand; without it those that are there now.

        Raises
        ------
        ChangedMeanwhileError
        RefusedChangeError
            If they can't be made, no case could be read then, or nothing can be written.
        """
        self.look_again()
        if digest and digest != self.digest:
            raise ChangedMeanwhileError
        texts = self._changed(changes)
        made = self._shown(texts)
        if made.material is None:
            raise RefusedChangeError(made.errors)
        self._write(texts)
        self._take(made)
        self._signature = signature_of(self._files)
        return made

    def _write(self, texts: Texts) -> None:
        """Put new texts into their files, all of them or none.

        The files are compared once more when the new ones are ready beside them: an editor that
        writes as soon as it sees a new file loses nothing.

        Raises
        ------
        ChangedMeanwhileError, RefusedChangeError
        """
        file = self.file
        try:
            with ExitStack() as ready:
                for file, data in texts.items():
                    old = self.shown.calculated.texts[file]
                    ready.enter_context(replacing(file, expected=old))(data)
                time.sleep(SETTLE_SECONDS)
        except ChangedFileError:
            self._signature = {}  # read again, whatever its time says
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
        """A state of the files, some of them with other texts."""
        made = self._calculate(texts)
        material = None
        if made.results is not None:
            material = material_of(made.results, made.problems, self._digits, made.naming)
        errors = told(one for one in made.problems if one.severity == "error")
        self._number += 1
        shown = self._kept[str(self._number)] = Shown(self._number, made, material, errors)
        while len(self._kept) > MOST_KEPT:
            del self._kept[next(iter(self._kept))]
        return shown

    def _take(self, shown: Shown) -> None:
        """A state of the files is that which is shown."""
        self.shown = shown
        made = shown.calculated
        self._files = list(dict.fromkeys([self.file, *made.texts, *made.files]))
        if made.results is not None:
            self.good = shown
            self._documents = documents_of(made.texts, made.results.case)

    def page(self) -> str:
        """The page of the files as they are, or as they were before they were in error."""
        state, good = self.told_of(self.shown), self.good
        if good is None or good.material is None:
            return page_of_errors(self.file, state)
        runs = good.calculated.is_run
        state["number"] = good.number
        return page_of(good.material, self._parts(good), runs=runs, state=state)

    def _parts(self, shown: Shown) -> list[Part]:
        assert shown.material is not None  # noqa: S101 - asked of what has results
        return parts_of(shown.material, self._fields, runs=shown.calculated.is_run)

    @property
    def _fields(self) -> list[PageField]:
        return self._documents.fields

    def answer(self, shown: Shown) -> dict[str, Any]:
        """A state for the script of the page; without sections where nothing can be shown."""
        number, answer = self._answered
        if number == shown.number and shown is self.shown:  # several pages ask for it
            return answer
        answer = self.told_of(shown)
        if shown.material is not None:
            parts = self._parts(shown)
            answer["sections"] = sections_of(shown.material, parts)
            answer["fields"] = {one.path: one.value for one in self._fields}
            answer["head"] = head_of(shown.material, runs=shown.calculated.is_run)
            answer["document"] = shown.material.document
        if shown is self.shown:
            self._answered = shown.number, answer
        return answer

    def told_of(self, shown: Shown) -> dict[str, Any]:
        """Its number, and whether it is good."""
        return {
            "number": shown.number,
            "revision": shown.number,
            "digest": self.digest,
            "state": shown.state,
            "errors": shown.errors,
        }
