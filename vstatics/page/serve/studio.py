"""Pictures and slow sections, made in a process of their own: numbers do not wait for them."""

from __future__ import annotations

import multiprocessing
import os
from functools import cache
from typing import TYPE_CHECKING

from vstatics.core.errors import CaseError
from vstatics.core.jobs.alone import Rules
from vstatics.core.jobs.processes import Processes
from vstatics.core.texts import Language, speaking
from vstatics.page.report.html_page import shown_alone
from vstatics.page.serve.awaited import awaited_part
from vstatics.page.serve.document_fields import Texts
from vstatics.page.serve.page import material_of
from vstatics.pictures.paged.parts import Part

if TYPE_CHECKING:
    from vstatics.page.report.material import Material
    from vstatics.page.serve.states import Calculate, Calculated


GENTLE = 15
"""How far the process of pictures stands back."""


class Studio:
    """Makes parts of a page from the texts of its documents, and keeps the last case.

    Parameters
    ----------
    calculate : callable
        As of `vstatics.page.serve.states.ShownStates`; it goes to another process.
    digits : int, optional
        After the point.
    language : str
        In which the page speaks.
    """

    def __init__(self, calculate: Calculate, digits: int | None, language: Language = "en") -> None:
        """Nothing is calculated yet."""
        self._calculate = calculate
        self._digits = digits
        self._language = language
        self._texts: Texts | None = None
        self._made: tuple[Calculated, Material] | None = None

    def part(self, texts: Texts, name: str) -> str | None:
        """A part by its name, as HTML; None if there is no such part."""
        with speaking(self._language):
            return self._part(texts, name)

    def _part(self, texts: Texts, name: str) -> str | None:
        if texts != self._texts:
            self._texts, self._made = texts, None
            made = self._calculate(texts)
            if made.results is not None:
                material = material_of(made.results, made.problems, self._digits, made.naming)
                self._made = made, material
        if self._made is None:
            return None
        calculated, material = self._made
        shown = awaited_part(name, material, calculated.run)
        return None if shown is None else shown_alone(Part(name, [shown]), material.document)


class StudioProcess:
    """A studio in another process, which is started when something is asked of it.

    Its methods are called by one thread, but for `stop`.
    """

    def __init__(self, studio: Studio) -> None:
        """Nothing is started yet."""
        self._processes = Processes(studio, str, 1, Rules(tries=1))

    def part(self, texts: Texts, name: str) -> str | None:
        """As that of the studio; what can't be made is missing."""
        try:
            [(_, made)] = self._processes.each(_made, [(dict(texts), name)])
        except CaseError:  # the process died, or the program has a fault
            return None
        return made

    def stop(self) -> None:
        """End what the process is at, if it has started: it is missing then."""
        for process in multiprocessing.active_children():
            process.terminate()

    def close(self) -> None:
        """End the process."""
        self._processes.__exit__(None)


def _made(studio: Studio, item: tuple[Texts, str]) -> str | None:
    _give_way()
    return studio.part(*item)


@cache
def _give_way() -> None:
    """Let the process of a picture take what the numbers of a newer state leave."""
    if hasattr(os, "nice"):
        os.nice(GENTLE)
