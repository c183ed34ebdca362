"""`vstatics check`: problems of cases and scenarios, degrees of freedom, constraints of gears."""

from __future__ import annotations

import contextlib
import os
import re
from collections.abc import Iterable, Iterator, Sequence
from typing import Annotated, NamedTuple, TypeAlias

import click

from vstatics.core import readers
from vstatics.core.annexes import module_of_method
from vstatics.core.checking import causes_first
from vstatics.core.cli.shared import cases as arguments
from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.cases import CaseOptions, calculate_one
from vstatics.core.cli.shared.exit_status import DONE, FAILED
from vstatics.core.cli.shared.formats import (
    WHOLE_OUTPUT,
    FormatChoice,
    OutputOptions,
    TextStyle,
)
from vstatics.core.cli.shared.options import MESSAGES, OUTPUT, command, completing, refuse, under
from vstatics.core.cli.shared.problems import Telling
from vstatics.core.cli.shared.values import FILE, separated
from vstatics.core.elements.drawing import drawing_of
from vstatics.core.errors import Problem, ReadError, Severity, count_of, quoted, spoken
from vstatics.core.extras import higher
from vstatics.core.readers.kinds import document_function
from vstatics.core.statics.diagnosis.freedom import freedom, given_constraints
from vstatics.core.statics.diagnosis.unknown_speeds import undriven_gears
from vstatics.core.statics.freewheels import with_engaged
from vstatics.core.statics.results import Results
from vstatics.core.statics.status import CONFLICT, TIED_UP
from vstatics.core.suggestions import nearest
from vstatics.core.tables.answer import Words, as_json, line, plain_data
from vstatics.core.tables.grid import Grid, grid_of
from vstatics.core.tables.text import broken, lines


class ProblemRecord(NamedTuple):
    """Problem as a record for JSON."""

    file: str
    """Name of the file as the user wrote it; `<stdin>` for standard input."""
    line: Annotated[int, Words(minimum=1)] | None
    """Line number, from 1; None if the message concerns the whole file."""
    column: Annotated[int, Words(minimum=1)] | None
    severity: Severity
    message: str
    id: str
    """Id of the cause: a letter for the severity and three digits."""


def problem_records(file: str, problems: Iterable[Problem]) -> Iterator[ProblemRecord]:
    """Yield the records of the problems of a file.

    >>> from vstatics.core.errors import Place
    >>> list(problem_records("a.yaml", [Problem("E107", "read 0", place=Place("a.yaml", 3, 7))]))
    [ProblemRecord(file='a.yaml', line=3, column=7, severity='error', message='read 0', id='E107')]
    """
    for problem in problems:
        name, row, column = problem.place[:3] if problem.place else (file, 0, 0)
        yield ProblemRecord(
            name,
            row or None,
            column if row else None,
            problem.severity,
            problem.message,
            problem.id,
        )


FORMATS = ("text", "json", "github", "sarif", "junit")


def constraints(file: str, results: Results) -> Grid:
    """Return a table with the numbers of parts of a case, and of constraints in each gear."""
    case = results.case
    free = freedom(case)
    counts = [
        count_of("link", case.links),
        count_of("shift element", len(case.shift_elements)),
        count_of("mechanism", len(case.mechanisms)),
        count_of("gear", len(case.gears)),
    ]
    if drawing := drawing_of(case):
        planets = case.links - drawing.links
        counts[0] = count_of("link", drawing.links)
        counts[2] = f"{count_of('gear set', len(drawing.elements))} as {counts[2]}"
        counts[2] += f" and {count_of('planet', planets)}" * bool(planets)
    if case.springs:
        counts.insert(3, count_of("spring", len(case.springs)))
    names = [element.name for element in case.shift_elements]
    rows = []
    states = zip(
        case.gears,
        results.holds,
        results.missing,
        results.excess,
        results.tied_up,
        results.conflict,
        strict=True,
    )
    for index, (gear, holds, missing, excess, tied_up, conflict) in enumerate(states):
        holding = [number for number in case.freewheels if holds[number - 1]]
        engaged = " ".join(names[number - 1] for number in (*gear.joining, *holding)) or "nothing"
        slipping = [names[number - 1] for number in gear.slipping]
        engaged += f"; slipping: {' '.join(slipping)}" * bool(slipping)
        unloaded = results.gear_at(index).unloaded if missing else ()
        faults = [f"{spoken(unloaded)} unloaded"] * bool(unloaded)
        faults += [f"{missing} missing"] * bool(missing and not unloaded)
        faults += ["neutral"] * bool(missing and gear.kind == "neutral")
        faults += [f"{excess} in excess"] * bool(excess)
        faults += [TIED_UP.english] * bool(tied_up)
        faults += [CONFLICT.english] * bool(conflict)
        count = given_constraints(gear) + len(holding)
        # Bypassed converters, and those parallel to a slipping clutch, do not constrain speeds.
        converters = case.unloaded_converters(with_engaged(gear, holding))
        needed = free + len(converters) + len(results.gear_at(index).gear.pump_torques)
        state = f"{count} of {needed} constraints: {', '.join(faults) or 'ok'} (engaged: {engaged})"
        rows.append((f"gear {gear.name}", state))
    title = f"{file}: {', '.join(counts)}; degrees of freedom: {free}"
    return grid_of(title, ["", ""], rows)


_ALL = "all"
"""Value of `--explain` for all messages; also the default value."""


def _ids() -> list[str]:
    from vstatics.core.messages.catalogue import known_ids

    return [*known_ids(), _ALL]


@command
@arguments.optional_argument
@arguments.files_from
@under(
    MESSAGES,
    click.option(
        "--explain",
        metavar="ID,...",
        is_flag=False,
        flag_value=_ALL,
        shell_complete=completing(_ids),
        help="Print cause, remedy and example of messages, such as W201,E107, or of all messages "
        "if no ID is given.",
    ),
)
@under(
    OUTPUT,
    click.option(
        "-f",
        "--format",
        "output_format",
        type=FormatChoice(FORMATS),
        help="Format of the output.  [default: by the suffix of -o, else text]",
    ),
    click.option("-o", "--output", type=FILE, help=WHOLE_OUTPUT),
)
@arguments.input_format
@arguments.telling
def check_command(
    cases: tuple[str, ...],
    files_from: str | None,
    explain: str | None,
    output_format: str | None,
    output: str | None,
    input_format: readers.Format | None,
    telling: Telling,
) -> int:
    """Report errors, warnings and notes of each CASE, and the constraints of each gear.

    A CASE can also be a scenario, which is checked together with its case; `-` is standard input.
    Messages go to stderr with file, line and column. The number of constraints in each gear
    goes to stdout. With -q, it is printed only for a case that fails.

    The formats for editors and CI contain the messages of all cases and go to stdout, or to
    the file of -o: an array in JSON, annotations of GitHub, SARIF, or JUnit.

    \b
    Examples:
      vstatics check gearbox.yaml
      vstatics check gearbox.yaml --strict --allow N311
      vstatics check gearbox.yaml -f json | jq -r '.[].message'
      vstatics check *.yaml -f sarif -o problems.sarif
      git ls-files -z '*.yaml' | vstatics check --files-from - -f github
      vstatics check --explain W201

    Exit status 1: a case has an error, a gear is tied up, or a gear cannot drive and is not
    marked `kind: neutral`; with --strict also if there is a warning.
    """
    wanted = OutputOptions(FORMATS, output_format, output, TextStyle())
    has_case = bool(cases) or files_from is not None
    names = arguments.named(cases, files_from) if explain is None else []
    to = wanted.destination([*names, *filter(None, [files_from])])
    refuse(
        (has_case and explain is not None, "--explain takes no case"),
        (
            explain is not None and to.form not in ("text", "json"),
            f"--explain gives text or json, not {to.form}",
        ),
    )
    if to.is_folder:
        raise click.UsageError(f"all cases have one output: expected -o FILE, not {output}")
    if explain is not None:
        files.write_output(_explained(explain, to.form), output)
        return DONE
    as_text = to.form == "text"
    options = CaseOptions(input_format, telling=telling._replace(notes=True, each_gear=not as_text))
    text, failed = _as_text(names, options) if as_text else _for_programs(names, options, to.form)
    files.write_output(text, output)
    return FAILED if failed else DONE


def _explained(asked: str, form: str) -> str:
    """Return the explanations of messages. `asked` contains ids with commas, or `all`."""
    from vstatics.core.messages.catalogue import explained, known_ids, text

    names, known = separated([asked]), known_ids()
    ids = known if _ALL in names else list(dict.fromkeys(name.upper() for name in names))
    for identity in ids:
        if identity not in known:
            fault = f"there is no message {quoted(identity)}{nearest(identity, known)}"
            raise click.BadParameter(fault, param_hint="'--explain'")
    explanations = map(explained, ids)
    return _array(explanations) if form == "json" else "\n".join(map(text, explanations))


CheckedFile: TypeAlias = tuple[str, list[Problem], bool, Grid | None]
"""Name of a file, its problems, a flag for failure, and the table of constraints."""


def _calculated(cases: Sequence[str], options: CaseOptions) -> Iterator[CheckedFile]:
    for file in cases:
        texts, check_document = dict[str, bytes](), None
        with contextlib.suppress(ReadError):  # reported by `calculate_one`
            data, name = files.read_input(file)
            texts[name] = data
            check_document = document_function("check_document", data, name)
        if check_document:
            yield check_document(data, name, options)
            continue
        outcome = calculate_one(next(iter(texts), file), options, texts)
        problems, grid, failed = outcome.problems, None, outcome.failed
        if outcome.results is not None and outcome.locate is not None:
            undriven = [*map(outcome.locate, undriven_gears(outcome.results))]
            problems, failed = causes_first([*undriven, *problems]), failed or bool(undriven)
            grid = constraints(outcome.file, outcome.results)
            if module_of_method("read_fuel"):
                try:
                    higher("read_fuel")(outcome.results.case, outcome.file)
                except ReadError as error:
                    problems, failed = [*problems, *error.problems], True
        yield outcome.file, problems, failed, grid


def _printed(file: str, problems: Sequence[Problem], telling: Telling) -> list[Problem]:
    return [*telling.printed(problems), *telling.quiet_failure(problems, file)]


class _Once:
    """Record of reported problems.

    If several scenarios name a case, its problems are reported once.
    """

    def __init__(self) -> None:
        self._reported: set[tuple[str, str, str, int, int]] = set()

    def first(self, problems: Iterable[Problem]) -> list[Problem]:
        """Return problems that are new, whatever the spelling of the file name."""
        new = []
        for problem in problems:
            file, line, column = problem.place[:3] if problem.place else ("", 0, 0)
            key = (problem.id, problem.message, os.path.realpath(file), line, column)
            if not file or key not in self._reported:
                new.append(problem)
            self._reported.add(key)
        return new


def _as_text(cases: Sequence[str], options: CaseOptions) -> tuple[str, bool]:
    """Print the problems of all cases; return the tables and whether a case failed."""
    text, failed, once = list[str](), False, _Once()
    for file, problems, fails, grid in _calculated(cases, options):
        failed |= fails
        files.show(once.first(_printed(file, problems, options.telling)))
        if grid is not None and (fails or not options.telling.quiet):
            head, *gears = lines(grid, indent="  ")
            text += broken(re.split("(?<=[,;]) ", head))
            for gear in gears:
                text += broken(gear.split(" "))
    return "".join(f"{printed}\n" for printed in text), failed


def _for_programs(cases: Sequence[str], options: CaseOptions, form: str) -> tuple[str, bool]:
    """Return the problems of all cases in a format for programs, and whether a case failed."""
    by_file, failed = list[tuple[str, list[Problem]]](), False
    for file, problems, fails, _ in _calculated(cases, options):
        failed |= fails
        printed = _printed(file, problems, options.telling)
        by_file.append(
            (file, [problem if problem.place else problem.in_file(file) for problem in printed])
        )
    once = _Once()
    firsts = [(file, once.first(problems)) for file, problems in by_file]
    problems_of_all = [problem for _, problems in firsts for problem in problems]
    match form:
        case "github":
            from vstatics.core.writers.problems import github

            return github(problems_of_all), failed
        case "sarif":
            from vstatics.core.writers.problems import sarif

            return as_json(sarif(problems_of_all), None), failed
        case "junit":
            return _as_junit(by_file, options.telling), failed
    return _array(
        record for file, problems in firsts for record in problem_records(file, problems)
    ), failed


def _array(records: Iterable[tuple[object, ...]]) -> str:
    texts = [line(plain_data(record)).rstrip("\n") for record in records]
    return "[\n" + ",\n".join(texts) + "\n]\n" if texts else "[]\n"


def _as_junit(by_file: Sequence[tuple[str, Sequence[Problem]]], telling: Telling) -> str:
    """Return the outcome of each file as JUnit XML. Warnings are failures only with --strict."""
    from vstatics.core.writers.junit import CaseOutcome, junit

    outcomes = []
    for file, problems in by_file:
        fatal = [
            problem
            for problem in problems
            if problem.severity == "error" or (telling.strict and problem.severity == "warning")
        ]
        failure = (fatal[0].id, fatal[0].message) if fatal else ("", "")
        outcomes.append(CaseOutcome(file, *failure, "\n".join(map(str, fatal))))
    return junit("vstatics check", outcomes)
