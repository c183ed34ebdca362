"""Drawing of pictures and slow sections in another process, so that numbers do not wait."""

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
"""Niceness (low priority) of the drawing process."""


class Studio:
    """Drawing of sections and pictures from texts of documents, with a cache of the last case.

    Parameters
    ----------
    calculate : callable
        Function of `states` that calculates a case; it is sent to another process.
    digits : int, optional
        Number of decimals.
    language : str
        Language of the page.
    """

    def __init__(self, calculate: Calculate, digits: int | None, language: Language = "en") -> None:
        """Store the settings. Nothing is calculated yet."""
        self._calculate = calculate
        self._digits = digits
        self._language = language
        self._texts: Texts | None = None
        self._case: tuple[Calculated, Material] | None = None

    def part(self, texts: Texts, name: str) -> str | None:
        """Return the picture or section called `name` as HTML, None if it does not exist."""
        with speaking(self._language):
            return self._part(texts, name)

    def _part(self, texts: Texts, name: str) -> str | None:
        if texts != self._texts:
            self._texts, self._case = texts, None
            calculated = self._calculate(texts)
            if calculated.results is not None:
                material = material_of(
                    calculated.results, calculated.problems, self._digits, calculated.naming
                )
                self._case = calculated, material
        if self._case is None:
            return None
        calculated, material = self._case
        shown = awaited_part(name, material, calculated.run)
        return None if shown is None else shown_alone(Part(name, [shown]), material.document)


class StudioProcess:
    """Studio in another process, which the first request starts.

    All methods except `stop` must be called in the same thread.
    """

    def __init__(self, studio: Studio) -> None:
        """Store the studio. The process is not started yet."""
        self._processes = Processes(studio, str, 1, Rules(tries=1))

    def part(self, texts: Texts, name: str) -> str | None:
        """Return the picture or section called `name` as HTML, None if it cannot be drawn."""
        try:
            [(_, part_html)] = self._processes.each(_part_of, [(dict(texts), name)])
        except CaseError:  # the process ended, or raised an error
            return None
        return part_html

    def stop(self) -> None:
        """Terminate the process, even during drawing."""
        for process in multiprocessing.active_children():
            process.terminate()

    def close(self) -> None:
        """End the process."""
        self._processes.__exit__(None)


def _part_of(studio: Studio, item: tuple[Texts, str]) -> str | None:
    _lower_priority()
    return studio.part(*item)


@cache
def _lower_priority() -> None:
    if hasattr(os, "nice"):
        os.nice(GENTLE)
