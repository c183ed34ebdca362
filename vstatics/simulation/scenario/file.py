"""A scenario in YAML or JSON: bytes -> `ScenarioDocument` -> with its case `ScenarioFile`.

A scenario names the file of its case, which whoever opens files reads in between: the document
says which one (`case_file`), and takes the case (`with_case`).
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
from vstatics.core.readers.kinds import is_foreign, kind_of
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
    what,
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
EXPECTED = "a scenario: a mapping with `case`, `duration`, `start` and what happens"
_OTHERS = {
    "case": f"this is a case, expected {EXPECTED}",
    "sweep file": f"this is a sweep file, expected {EXPECTED}; `vstatics sweep --file` takes it",
}


class ScenarioFile(NamedTuple):
    """A scenario that was read, and where its parts stand."""

    scenario: Scenario
    name: str
    """As it says itself; else empty."""
    description: str
    samples: AnyMapping[str, Distribution]
    """By the paths of numbers."""
    reading: Reading
    """Of the case."""
    spots: Spots

    def allowing(self, ids: Sequence[str]) -> ScenarioFile:
        """The same with more messages that are not told."""
        reading = self.reading.allowing(ids)
        return self._replace(reading=reading, scenario=self.scenario._replace(case=reading.case))

    def locate(self, problem: Problem) -> Problem:
        """Give a problem of the scenario, or of its case, its place."""
        return located(problem, self.spots, self.reading)

    @property
    def input_speeds(self) -> tuple[float, ...]:
        """Speeds of the input at the start, and of torques over its speed [rpm]."""
        entry, start = self.scenario.case.input, self.scenario.start
        found = [start.speed, start.speeds.get(entry, 0.0)]
        for link, law in self.scenario.torques:
            if link == entry and getattr(law, "over", "") == "speed":
                found += law.x  # type: ignore[union-attr]
        return tuple(abs(speed) / RAD_PER_RPM for speed in found if speed)


class ScenarioDocument(NamedTuple):
    """A scenario as a tree of nodes, before its case is known."""

    root: Mapping
    found: DocumentText

    @property
    def case_file(self) -> str:
        """The file of the case, by the folder of the scenario; empty if it names none."""
        node = self._case_node
        if not isinstance(node, Scalar) or is_null(node) or not node.text:
            return ""
        folder = os.path.dirname(self.found.source.file)  # noqa: PTH120 (pathlib costs time)
        return os.path.join(folder, node.text)  # noqa: PTH118

    @property
    def _case_node(self) -> Node | None:
        return next((value for key, value in self.root.entries if key.text == "case"), None)

    def no_case(self, why: str) -> ReadError:
        """The error that the file of the case cannot be read, at the place where it is named."""
        node = self._case_node or self.root
        place = self.found.source.place(node.line, node.column)
        return ReadError([Problem("E660", why, ("case",), place)])

    def refuse_foreign(self, data: bytes, name: str) -> None:
        """Refuse what the file it names holds if that is no case; it may be anybody's.

        Raises
        ------
        ReadError
            That tells nothing of the file.
        """
        if is_foreign(data, name):
            raise self.no_case(f"{name} is no case: it has none of its keys")

    def with_case(self, reading: Reading) -> ScenarioFile:
        """The scenario of a case.

        Raises
        ------
        ReadError
            With every problem and its place.
        """
        spots = Spots(self.found)
        walk = Walk(spots)
        case = reading.case
        walk.references.set_link_names(case.link_names[: case.own_links])
        walk.references.set_numbers(
            "shift element", (element.name for element in case.shift_elements)
        )
        walk.references.set_numbers("mechanism", (one.name for one in case.mechanisms))
        walk.references.set_numbers("spring", (one.name for one in case.springs))
        walk.references.set_numbers("elastic device", elastic_names(case))
        words = self._words(case)
        values = walk.read(Spot((), "", self.root), scenario_shape(words))
        made = ScenarioValues(case, spots)
        scenario, samples = made.scenario(values), made.samples(values)
        problems = list(scenario_problems(scenario))
        tables, numbers = dict(made.tables(values.get("tables", {}))), values.get("numbers", {})
        named = [*scenario.settings, *(state.name for state in scenario.states)]
        problems += name_problems("numbers", [*numbers], named)
        problems += name_problems("tables", [*tables], [*named, *numbers])
        problems += table_problems(tables)
        for number, one in enumerate(samples.values(), 1):
            problems += distribution_problems(one, ("samples", number))
        is_certain = certain(spots.unreadable)
        found = [
            *self.found.problems,
            *(
                located(one, spots, reading)
                for one in problems
                if is_certain(_own_path(one.path, case, spots))
            ),
        ]
        if found:
            raise ReadError(sorted(found, key=lambda one: one.place[1:3] if one.place else ()))
        return ScenarioFile(
            scenario, values.get("name", ""), values.get("description", ""), samples, reading, spots
        )

    def _words(self, case: Transmission) -> Vocabulary:
        """What its formulas may speak of, as far as it can be read: faults are told later."""
        quiet = DocumentText(self.found.source)
        walk = Walk(Spots(quiet))
        nodes = {key.text: value for key, value in self.root.entries}

        def names(key: str) -> list[str]:
            node = nodes.get(key)
            return [one.text for one, _ in node.entries] if isinstance(node, Mapping) else []

        read = {
            key.name: walk.read(Spot((key.name,), key.name, nodes[key.name]), key.shape)
            for key in named_numbers()
            if isinstance(nodes.get(key.name), Mapping)
        }
        made = ScenarioValues(case, walk.spots)
        return vocabulary(
            case,
            numbers={name: float(one) for name, one in read.get("numbers", {}).items()},
            values=[*names("set"), *names("states")],
            tables=dict(made.tables(read.get("tables", {}))),
            converters=names("converters") or [one.name for one in case.converters],
        )


def read_scenario(data: bytes, file: str) -> ScenarioDocument:
    """Read a scenario as far as can be without its case.

    Parameters
    ----------
    data : bytes
        YAML, or JSON.
    file : str
        Its name, for messages, and for the file of its case.

    Raises
    ------
    ReadError
        If it is no document, or a case.

    Examples
    --------
    >>> read_scenario(b"{case: box.yaml, duration: 6}", "shifts/up.yaml").case_file
    'shifts/box.yaml'
    """
    from vstatics.core.readers.named.yaml_nodes import yaml_tree  # yaml costs start-up time

    found = decode(data, file, "a scenario")
    root = yaml_tree(found)
    if not isinstance(root, Mapping):
        found.stop(f"read {what(root)}, expected {EXPECTED}", root.line, root.column)
    if told := _OTHERS.get(kind_of(root) or ""):
        found.stop(told, root.line, root.column)
    return ScenarioDocument(root, found)


def load_scenario_file(source: FileOrStream, case: FileOrStream | None = None) -> ScenarioFile:
    """Read the file of a scenario and that of its case.

    Parameters
    ----------
    source : path-like or stream
    case : path-like or stream, optional
        A case in place of that which the scenario names.

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
    """The case that a scenario names, or another that is given, and its name.

    Raises
    ------
    ReadError
        If the scenario names none, or one that cannot be opened, with the place.
    OSError
        If the one that is given cannot be opened.
    """
    name = case or document.case_file
    if not name:
        raise document.no_case("`case` is missing: the file of the case")
    if not (case or are_read()):
        raise document.no_case("files that a text names are not read: give the case itself")
    try:
        data = read_file(name, regular=not case)
    except OSError as error:
        if case:
            raise
        raise document.no_case(f"{name} can't be read: {error.strerror}") from None
    if not case:
        document.refuse_foreign(data, name)
    return data, name


def load_document(file: str) -> Scenario:
    """Read a scenario that comes with the program, and its case."""
    return load_scenario_file(file).scenario


def document_problems(data: bytes, file: str) -> list[Problem]:
    """Return warnings and notes about a scenario and its case.

    Raises
    ------
    ReadError
        With every error and its place.
    """
    document = read_scenario(data, file)
    read = document.with_case(readers.read(*case_bytes(document)))
    found = not_allowed(scenario_doubts(read.scenario), read.scenario.case.untold)
    return [*read.reading.warnings, *map(read.locate, found)]


@refusing()
def load_scenario(source: FileOrStream, case: FileOrStream | None = None) -> Scenario:
    """Read a scenario in YAML or JSON, and its case.

    Parameters
    ----------
    source : path-like or stream
        A file, whose `case` and tables are files of their own and opened wherever they are; or
        something opened. Of a stream without a name no file is opened: give the case.
    case : path-like or stream, optional
        A case in place of that which the scenario names.

    Returns
    -------
    Scenario
        With its case; all numbers in SI.

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
    """A problem at its place: in the scenario, or, where its path begins with `case`, there."""
    if problem.place is not None:
        return problem
    whole = spots.place(())._replace(line=0, column=0, text="")
    if not problem.path:
        return problem._replace(place=whole)
    if problem.path[0] == "case":
        of_case = reading.locate(problem._replace(path=problem.path[1:]))
        if of_case.place is not None:
            return of_case
        place = spots.place(("case",)) if spots.has(("case",)) else whole
        return of_case._replace(place=place)
    path = _own_path(problem.path, reading.case, spots)
    return spots.locate(problem._replace(path=path))._replace(path=problem.path)


def _own_path(path: Path, case: Transmission, spots: Spots) -> Path:
    """A path with names of links, elements and converters -> that of the reader, with numbers."""
    named = 2 if path[0] == "start" and path[1:2] != ("engaged",) else 1
    if len(path) <= named:
        return path
    names = _names(path[1] if path[:2] == ("start", "twists") else path[0], case, spots)
    start, name, rest = path[:named], path[named], path[named + 1 :]
    own = (*start, names.get(str(name), name))
    if path[0] == "sequences" and rest:
        return _own_step((*own, *rest), spots)
    for number, part in enumerate(rest):
        between = spots.has((*own, "points")) and isinstance(part, int) and number < len(rest)
        own = (*own, "points", part) if between and not spots.has((*own, part)) else (*own, part)
    return own


def _own_step(path: Path, spots: Spots) -> Path:
    """A path in a step of a sequence, which may stand under `steps`; what it sets by numbers."""
    at, rest = path[:2], path[2:]
    at = (*at, "steps") if spots.has((*at, "steps")) else at
    at, rest = (*at, rest[0]), rest[1:]
    if rest[:1] == ("set",) and len(rest) == 2:
        keys = spots.keys((*at, "set"))
        return (*at, "set", keys.index(str(rest[1])) + 1) if rest[1] in keys else (*at, "set")
    return (*at, *rest)


def _names(key: Any, case: Transmission, spots: Spots) -> dict[str, int]:
    """Numbers by name of what a key of a scenario speaks of."""
    if key == "controls":
        listed = [element.name for element in case.shift_elements]
    elif key in ("torques", "targets", "start", "speeds"):
        listed = list(case.link_names)
    elif key == "speed_ratios":
        listed = [one.name for one in case.mechanisms]
    elif key == "twists":
        listed = list(elastic_names(case))
    elif key == "limits":
        listed = [one.name for one in case.springs]
    elif key in ("converters", "numbers", "tables", "set", "states", "sequences"):
        listed = spots.keys((str(key),))
    else:
        return {}
    return {name: number for number, name in enumerate(listed, 1)}
