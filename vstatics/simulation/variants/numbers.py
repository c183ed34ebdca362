"""Numbers of a scenario and its case that variants replace.

The reader of the documents reads each variant with replaced numbers. So every number in the
documents can vary, and the reader reports impossible numbers.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from functools import cached_property
from typing import TYPE_CHECKING, Any

from vstatics.core.errors import Place, Problem, ReadError, quoted
from vstatics.core.model.transmission import Transmission
from vstatics.core.readers.named.nodes import Mapping, Node, decode
from vstatics.sweep.variants.scenario_numbers import (
    NumberPath,
    Trees,
    in_si,
    number_path,
    sample_unit,
    with_numbers,
    written_number,
)
from vstatics.sweep.variants.subject import Document
from vstatics.sweep.variants.targets import OF_MECHANISM, Varied, refusal
from vstatics.sweep.variants.variation import Variation

if TYPE_CHECKING:
    from vstatics.core.readers import Format
    from vstatics.core.readers.documents import CaseDocument
    from vstatics.core.readers.reading import Reading
    from vstatics.simulation.record.row_names import Kind
    from vstatics.simulation.scenario.file import ScenarioFile


_PLAIN = (1.0, 0.5, 0.0, 100.0)
"""Trial values; wherever a number is allowed, at least one of them is valid."""


def number_paths(varied: Sequence[Varied]) -> list[NumberPath]:
    """Return only the varied numbers that are paths in documents."""
    return [path for path in varied if isinstance(path, NumberPath)]


@dataclass(frozen=True)
class ScenarioNumbers:
    """Scenario and case as documents in which numbers can be replaced.

    Parameters
    ----------
    scenario : Document
        Scenario in YAML or JSON.
    case : Document
        Case in any format; the numbers of a deck cannot vary.
    rtol : float
        Tolerance of the runs, like `rtol` of `simulate`. [-]
    limit : float, optional
        Wall-clock time after which a run ends and its variant is `stopped`. [s]
    case_format : {"deck", "yaml", "json"}, optional
        Format of the case; by default according to its suffix, or its content.
    """

    scenario: Document
    case: Document
    rtol: float = 1e-8
    limit: float | None = None
    case_format: Format | None = None

    def __getstate__(self) -> dict[str, Any]:
        """Return the fields for other processes, which read the documents again."""
        return {field.name: getattr(self, field.name) for field in fields(self)}

    @cached_property
    def trees(self) -> Trees:
        """Syntax trees of scenario and case.

        Raises
        ------
        ReadError
        """
        from vstatics.simulation.scenario.file import read_scenario

        case = self._document
        return Trees(read_scenario(*self.scenario).root, case.root if case else None)

    @cached_property
    def _document(self) -> CaseDocument | None:
        from vstatics.core.readers.documents import case_document

        return case_document(*self.case, self.case_format)

    @cached_property
    def own(self) -> ScenarioFile:
        """Scenario as written.

        Raises
        ------
        ReadError
            With every problem of both documents.
        """
        return self._read(self.trees.scenario, self._own_case)

    @cached_property
    def _own_case(self) -> Reading:
        from vstatics.core import readers

        return readers.read(*self.case, self.case_format)

    def variant(self, paths: Sequence[NumberPath], values: Sequence[float]) -> ScenarioFile:
        """Return the scenario with replaced numbers.

        Raises
        ------
        ReadError
            If the scenario cannot be read with the numbers.
        """
        trees = with_numbers(self.trees, paths, values)
        reading = self._own_case
        if self._document and trees.case and trees.case is not self.trees.case:
            reading = self._document.reading(trees.case)
        return self._read(trees.scenario, reading)

    def rows(self, kind: Kind) -> tuple[str, ...]:
        """Return the names of the rows of a kind."""
        from vstatics.simulation.record.row_names import rows_of_kind

        return rows_of_kind(kind, self.own.scenario)

    def target(self, text: str, place: Place | None = None) -> NumberPath:
        """Return the number that a text names; see `scenario_numbers.number_path`.

        Raises
        ------
        ReadError
        """
        return number_path(text, self.trees, place)

    @property
    def base_case(self) -> Transmission:
        """Case as written, without varied numbers."""
        return self.own.scenario.case

    def in_unit(self, varied: Varied, unit: str, place: Place | None) -> NumberPath:
        """Return a varied number with the unit in which its values are given.

        Raises
        ------
        ReadError
            If the values have two different units, or no unit although the document has a unit.
        """
        [path] = number_paths([varied])
        if unit and path.unit and unit != path.unit:
            raise refusal(f"read values in {unit}, expected them in {path.unit}", place)
        known = written_number(path, self.trees)
        path = path._replace(unit=unit or path.unit)
        if known and known.unit and not path.unit:
            raise refusal(
                f"{quoted(path.name)} is in {known.unit} in the document, so its values "
                f"need their unit, such as {known.value:g} {known.unit}",
                place,
            )
        return path

    def sampled(self, text: str) -> NumberPath:
        """Return the number that a distribution under `samples` varies, with its SI unit.

        The unit is empty if neither the number nor the distribution has a unit.

        Raises
        ------
        ReadError
        """
        path = self.target(text)
        known = written_number(path, self.trees)
        unit = sample_unit(self.trees.scenario, text) or (known.unit if known else "")
        return path._replace(unit=in_si(unit)) if unit else path

    def written_number(self, path: NumberPath, place: Place | None) -> float:
        """Return a number as written in the document, in its unit there.

        Raises
        ------
        ReadError
            If the document does not contain the number.
        """
        known = written_number(path, self.trees)
        if known is None:
            raise refusal(f"{quoted(path.name)} is not written in the document", place)
        return known.value

    def follows_teeth(self, path: NumberPath) -> bool:
        """Return whether a number is a ratio or efficiency that follows from tooth numbers."""
        of_element = path.of_case and path.keys[0] == "elements" and len(path.keys) == 3
        is_such = of_element and path.keys[2] in OF_MECHANISM
        return is_such and written_number(path, self.trees) is None

    def check_new(self, paths: Sequence[NumberPath], values: Sequence[float]) -> None:
        """Check that numbers missing from the documents are allowed at their paths.

        Parameters
        ----------
        paths : sequence of NumberPath
        values : sequence of float
            Values of a variant.

        Raises
        ------
        ReadError
            If no number is allowed at a path; the reader's error for the value of the variant.
        """
        for path, value in zip(paths, values, strict=True):
            if written_number(path, self.trees) is not None:
                continue
            first: ReadError | None = None
            for tried in (value, *_PLAIN):  # another value can be valid at this path
                try:
                    self.variant([path], [tried])
                except ReadError as error:
                    first = first or error
                else:
                    break
            else:
                assert first is not None  # noqa: S101 - every number was refused
                raise first

    def _read(self, root: Node, reading: Reading) -> ScenarioFile:
        from vstatics.simulation.scenario.file import ScenarioDocument

        assert isinstance(root, Mapping)  # noqa: S101 - as it was read
        return ScenarioDocument(root, decode(*self.scenario)).with_case(reading)


def sampled_numbers(subject: ScenarioNumbers) -> list[Variation]:
    """Return the numbers under `samples` in a scenario, each with its distribution.

    Raises
    ------
    ReadError
        If a number is unknown.
    """
    problems: list[Problem] = []
    variations: list[Variation] = []
    for number, (path, distribution) in enumerate(subject.own.samples.items(), 1):
        place = subject.own.spots.place(("samples", number))
        try:
            target = subject.sampled(path)
            subject.check_new([target], [1.0])
            variations.append(Variation(target, distribution, place))
        except ReadError as error:
            problems += [
                Problem(problem.id, f"samples: {problem.message}", ("samples", path), place)
                for problem in error.problems
            ]
    if problems:
        raise ReadError(problems)
    return variations
