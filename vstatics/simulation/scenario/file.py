"""Reading of a scenario in YAML or JSON.

The bytes of a scenario become a `ScenarioDocument`, which names the file of the case (`case_file`).
The caller opens and reads this file; with the case, the document becomes a `ScenarioFile`
(`with_case`).
"""

from __future__ import annotations

import os
from collections.abc import Mapping as AnyMapping
from collections.abc import Sequence
from typing import Any, NamedTuple

from vstatics.core import readers
from vstatics.core.arguments import refusing
from vstatics.core.errors import Path, Problem, ReadError, not_allowed
from vstatics.core.jobs.input_files import read_file
from vstatics.core.model.parts import RAD_PER_RPM
from vstatics.core.model.transmission import Transmission
from vstatics.core.readers import Stream
from vstatics.core.readers.kinds import KEYS, is_foreign, is_of_kind, kind_of
from vstatics.core.readers.named.csv_files import are_read
from vstatics.core.readers.named.nodes import (
    DocumentText,
    Mapping,
    Node,
    Scalar,
    Spot,
    Spots,
    decode,
    is_null,
)
from vstatics.core.readers.named.walk import Walk
from vstatics.core.readers.reading import Reading, certain
from vstatics.simulation.scenario.checks import scenario_doubts, scenario_problems
from vstatics.simulation.scenario.control_checks import table_problems
from vstatics.simulation.scenario.distribution import Distribution, distribution_problems
from vstatics.simulation.scenario.formula import Vocabulary
from vstatics.simulation.scenario.keys import named_numbers, scenario_shape
from vstatics.simulation.scenario.parts import Scenario
from vstatics.simulation.scenario.values import ScenarioValues
from vstatics.simulation.scenario.words import elastic_names, name_problems, vocabulary

FileOrStream = str | os.PathLike[str] | Stream
EXPECTED = "a scenario: a mapping with `case`, `duration`, `start`, and shifts, controls or torques"
_OTHERS = {
    "case": f"this is a case, expected {EXPECTED}",
    "sweep file": f"this is a sweep file, expected {EXPECTED}; `vstatics sweep --file` takes it",
}


class ScenarioFile(NamedTuple):
    """Scenario read from a document, with the position of every value in the document."""

    scenario: Scenario
    name: str
    """Value of the key `name`; empty without the key."""
    description: str
    samples: AnyMapping[str, Distribution]
    """Distributions of random numbers, by the path of each number in the scenario."""
    reading: Reading
    """Case as read, with its warnings."""
    spots: Spots
    text_doubts: Sequence[Problem] = ()
    """Warnings about texts that a comment cuts off, and notes about start speeds without a unit."""

    def allowing(self, ids: Sequence[str]) -> ScenarioFile:
        """Return the scenario with more messages suppressed."""
        reading = self.reading.allowing(ids)
        return self._replace(reading=reading, scenario=self.scenario._replace(case=reading.case))

    def locate(self, problem: Problem) -> Problem:
        """Return a problem of the scenario or the case with its position in the document."""
        return located(problem, self.spots, self.reading)

    @property
    def doubts(self) -> list[Problem]:
        """Warnings and notes about the scenario, with their positions in the document."""
        every = (*self.text_doubts, *scenario_doubts(self.scenario))
        doubts = not_allowed(every, self.scenario.case.untold)
        return [*map(self.locate, doubts)]

    @property
    def input_speeds(self) -> tuple[float, ...]:
        """Magnitudes of the input speeds at the start and in torque laws over speed [rpm]."""
        entry, start = self.scenario.case.input, self.scenario.start
        speeds = [start.speed, start.speeds.get(entry, 0.0)]
        for link, law in self.scenario.torques:
            if link == entry and getattr(law, "over", "") == "speed":
                speeds += law.x  # type: ignore[union-attr]
        return tuple(abs(speed) / RAD_PER_RPM for speed in speeds if speed)


_OF_VEHICLE = ("W202", "W891")
"""Ids of warnings about the key `vehicle` of a case, which a run does not use."""


class ScenarioDocument(NamedTuple):
    """Scenario as a tree of YAML nodes, before the case is known."""

    root: Mapping
    decoded: DocumentText

    @property
    def case_file(self) -> str:
        """Path of the case file, including the folder of the scenario; empty if not named."""
        node = self._case_node
        if not isinstance(node, Scalar) or is_null(node) or not node.text:
            return ""
        folder = os.path.dirname(self.decoded.source.file)  # noqa: PTH120 (pathlib costs time)
        return os.path.join(folder, node.text)  # noqa: PTH118

    @property
    def _case_node(self) -> Node | None:
        return next((value for key, value in self.root.entries if key.text == "case"), None)

    def no_case(self, reason: str) -> ReadError:
        """Return an error about the case, located at the key `case`."""
        node = self._case_node or self.root
        place = self.decoded.source.place(node.line, node.column)
        return ReadError([Problem("E660", reason, ("case",), place)])

    def refuse_foreign(self, data: bytes, name: str) -> None:
        """Reject a file that is not a case, so that messages do not show its content.

        Raises
        ------
        ReadError
            If the file is not a case; it can be a private file of another program.
        """
        if is_foreign(data, name):
            kinds = (f"it is a {kind}" for kind in KEYS if is_of_kind(kind, data, name))
            reason = next(kinds, "it has no key of a case")
            raise self.no_case(f"{name} is not a case: {reason}")

    def with_case(self, reading: Reading) -> ScenarioFile:
        """Return the scenario for a case.

        Raises
        ------
        ReadError
            With every problem and its place.
        """
        spots = Spots(self.decoded)
        walk = Walk(spots)
        case = reading.case
        reading = reading._replace(warnings=not_allowed(reading.warnings, _OF_VEHICLE))
        walk.references.set_link_names(case.link_names[: case.own_links])
        elements = (element.name for element in case.shift_elements)
        walk.references.set_numbers("shift element", elements)
        walk.references.set_numbers("mechanism", (part.name for part in case.mechanisms))
        walk.references.set_numbers("spring", (spring.name for spring in case.springs))
        walk.references.set_numbers("elastic component", elastic_names(case))
        values = walk.read(Spot((), "", self.root), scenario_shape(self._words(case)))
        builder = ScenarioValues(case, spots)
        scenario, samples = builder.scenario(values), builder.samples(values)
        problems = list(scenario_problems(scenario))
        tables, numbers = dict(builder.tables(values.get("tables", {}))), values.get("numbers", {})
        named = scenario.value_names
        problems += name_problems("numbers", [*numbers], named)
        problems += name_problems("tables", [*tables], [*named, *numbers])
        problems += table_problems(tables)
        for number, distribution in enumerate(samples.values(), 1):
            problems += distribution_problems(distribution, ("samples", number))
        is_certain = certain(spots.unreadable)
        located_problems = [
            *self.decoded.problems,
            *(
                located(problem, spots, reading)
                for problem in problems
                if is_certain(_own_path(problem.path, case, spots))
            ),
        ]
        if located_problems:
            raise ReadError(
                sorted(
                    located_problems,
                    key=lambda problem: problem.place[1:3] if problem.place else (),
                )
            )
        name, description = values.get("name", ""), values.get("description", "")
        doubts = [*self.decoded.warnings, *builder.doubts]
        return ScenarioFile(scenario, name, description, samples, reading, spots, doubts)

    def _words(self, case: Transmission) -> Vocabulary:
        """Return the names that formulas can use; `with_case` reports faults later."""
        walk = Walk(Spots(DocumentText(self.decoded.source)))
        nodes = {key.text: value for key, value in self.root.entries}

        def names(key: str) -> list[str]:
            node = nodes.get(key)
            return [entry.text for entry, _ in node.entries] if isinstance(node, Mapping) else []

        read = {
            key.name: walk.read(Spot((key.name,), key.name, nodes[key.name]), key.shape)
            for key in named_numbers()
            if isinstance(nodes.get(key.name), Mapping)
        }
        return vocabulary(
            case,
            numbers={name: float(entry) for name, entry in read.get("numbers", {}).items()},
            values=[*names("set"), *names("states")],
            tables=dict(ScenarioValues(case, walk.spots).tables(read.get("tables", {}))),
            converters=names("converters") or [entry.name for entry in case.converters],
        )


def read_scenario(data: bytes, file: str) -> ScenarioDocument:
    """Read a scenario document, as far as possible without the case.

    Parameters
    ----------
    data : bytes
        Content of the document, YAML or JSON.
    file : str
        Name of the document, for messages and for the path of its case.

    Raises
    ------
    ReadError
        If the data are not YAML or JSON with keys, or if they are a document of another kind.

    Examples
    --------
    >>> read_scenario(b"{case: box.yaml, duration: 6}", "shifts/up.yaml").case_file
    'shifts/box.yaml'
    """
    from vstatics.core.readers.named.yaml_nodes import yaml_tree  # import is slow

    decoded = decode(data, file, "a scenario")
    root = decoded.mapping(yaml_tree(decoded), EXPECTED)
    if message := _OTHERS.get(kind_of(root) or ""):
        decoded.stop(message, root.line, root.column)
    return ScenarioDocument(root, decoded)


def load_scenario_file(source: FileOrStream, case: FileOrStream | None = None) -> ScenarioFile:
    """Read the files of a scenario and a case.

    Parameters
    ----------
    source : path-like or stream
    case : path-like or stream, optional
        Case to use instead of the case that the scenario names.

    Raises
    ------
    ReadError
        With every problem and its place.
    OSError
        If the scenario, or a case that is given, cannot be opened.
    """
    given = None
    if case is not None:
        with readers.content(case) as (data, name):
            given = readers.read(data, name)
    with readers.content(source) as (data, name):
        document = read_scenario(data, name)
        return document.with_case(given or readers.read(*case_bytes(document)))


def case_bytes(document: ScenarioDocument, case: str | None = None) -> tuple[bytes, str]:
    """Return the bytes and the file name of the case of a scenario, or of a given case.

    Raises
    ------
    ReadError
        If the scenario names no case, or a file that cannot be opened, with the place.
    OSError
        If the given case cannot be opened.
    """
    name = case or document.case_file
    if not name:
        raise document.no_case("no file of a case is named: expected `case: FILE`")
    if not (case or are_read()):
        raise document.no_case("a scenario without a file cannot name a file: give the case itself")
    try:
        data = read_file(name, regular=not case)
    except OSError as error:
        if case:
            raise
        raise document.no_case(f"{name} cannot be read: {error.strerror}") from None
    if not case:
        document.refuse_foreign(data, name)
    return data, name


def load_document(file: str) -> Scenario:
    """Return a shipped scenario with its case."""
    return load_scenario_file(file).scenario


def document_problems(data: bytes, file: str) -> list[Problem]:
    """Return warnings and notes about a scenario and its case.

    Raises
    ------
    ReadError
        With every error and its place.
    """
    document = read_scenario(data, file)
    file_read = document.with_case(readers.read(*case_bytes(document)))
    return [*file_read.reading.warnings, *file_read.doubts]


@refusing()
def load_scenario(source: FileOrStream, case: FileOrStream | None = None) -> Scenario:
    """Read a scenario in YAML or JSON, and its case.

    Parameters
    ----------
    source : path-like or stream
        File or open stream. The case and tables that it names are opened, too, except from a stream
        without a name: then give the case.
    case : path-like or stream, optional
        Case to use instead of the case that the scenario names.

    Returns
    -------
    Scenario
        Scenario with its case; all numbers in SI.

    Raises
    ------
    ReadError
        With every problem and its place.
    OSError
        If a file cannot be opened.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = Path(folder, "box.yaml").write_text("{links: [wheel], inertias: {wheel: 2.0}}")
    ...     _ = Path(folder, "run.yaml").write_text(
    ...         "{case: box.yaml, duration: 2, start: {speeds: {wheel: 10}}}"
    ...     )
    ...     load_scenario(Path(folder, "run.yaml")).duration
    2.0
    """
    return load_scenario_file(source, case).scenario


def located(problem: Problem, spots: Spots, reading: Reading) -> Problem:
    """Return a problem with its position, in the case if its path begins with `case`."""
    if problem.place is not None:
        return problem
    whole = spots.place(())._replace(line=0, column=0, text="")
    if not problem.path:
        return problem._replace(place=whole)
    if problem.path[0] == "case":
        in_case = reading.locate(problem._replace(path=problem.path[1:]))
        if in_case.place is not None:
            return in_case
        place = spots.place(("case",)) if spots.has(("case",)) else whole
        return in_case._replace(place=place)
    path = _own_path(problem.path, reading.case, spots)
    return spots.locate(problem._replace(path=path))._replace(path=problem.path)


def _own_path(path: Path, case: Transmission, spots: Spots) -> Path:
    """Return a path with numbers instead of the names of links and components."""
    named = 2 if path[0] == "start" and path[1:2] != ("engaged",) else 1
    if len(path) <= named:
        return path
    names = _names(path[1] if path[:2] == ("start", "twists") else path[0], case, spots)
    start, name, remainder = path[:named], path[named], path[named + 1 :]
    converted = (*start, names.get(str(name), name))
    if path[0] == "sequences" and remainder:
        return _own_step((*converted, *remainder), spots)
    for part in remainder:
        between = spots.has((*converted, "points")) and isinstance(part, int)
        converted = (
            (*converted, "points", part)
            if between and not spots.has((*converted, part))
            else (*converted, part)
        )
    return converted


def _own_step(path: Path, spots: Spots) -> Path:
    """Return the path of a sequence step; the list of steps can be under the key `steps`."""
    step, remainder = path[:2], path[2:]
    step = (*step, "steps") if spots.has((*step, "steps")) else step
    step, remainder = (*step, remainder[0]), remainder[1:]
    if remainder[:1] == ("set",) and len(remainder) == 2:
        keys = spots.keys((*step, "set"))
        return (
            (*step, "set", keys.index(str(remainder[1])) + 1)
            if remainder[1] in keys
            else (*step, "set")
        )
    return (*step, *remainder)


def _names(key: Any, case: Transmission, spots: Spots) -> dict[str, int]:
    """Return the numbers, by name, of the links or components under a key of a scenario."""
    names = {
        "controls": [element.name for element in case.shift_elements],
        "speed_ratios": [mechanism.name for mechanism in case.mechanisms],
        "twists": elastic_names(case),
        "limits": [spring.name for spring in case.springs],
        **dict.fromkeys(("torques", "targets", "start", "speeds"), case.link_names),
    }
    if key in ("converters", "numbers", "tables", "set", "states", "sequences"):
        names[key] = spots.keys((str(key),))
    return {name: number for number, name in enumerate(names.get(key, ()), 1)}
