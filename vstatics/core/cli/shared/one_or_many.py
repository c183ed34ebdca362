"""Run of a command for a single case or, with the module `many`, for several cases."""

from __future__ import annotations

from collections.abc import Sequence

from vstatics.core.cli.shared import files, texts
from vstatics.core.cli.shared.cases import calculate, check_streams, show_problems
from vstatics.core.cli.shared.exit_status import DONE, FAILED
from vstatics.core.cli.shared.formats import STREAMS
from vstatics.core.cli.shared.texts import Job


def carry_out(
    job: Job,
    cases: Sequence[str],
    *,
    others: Sequence[str] = (),
    a_list: bool = False,
    jobs: int = 1,
    resume: bool = False,
) -> int:
    """Calculate cases, write the output for each, and return the exit status.

    Parameters
    ----------
    others : sequence of str
        Further input files, which no output may overwrite.
    a_list : bool
        True to treat a single case like several cases.

    Raises
    ------
    UsageError
        If an input would be overwritten.
    ReadError
        If the output cannot be written.
    """
    check_streams([*cases, *others])
    to = job.to
    if len(cases) > 1 or a_list or to.is_folder or to.form in STREAMS:
        from vstatics.core.cli.shared import many

        if not to.is_folder:
            return many.to_stream(cases, to.output, job, jobs=jobs, resume=resume)
        named_files = [file for file in others if file != files.STDIN]
        return many.to_directory(
            cases, str(to.output), job, jobs=jobs, resume=resume, others=named_files
        )
    [outcome] = calculate(cases, job.options)
    if outcome.results is not None:
        shown = job.show(outcome, outcome.results)
        policy = job.options.telling._replace(notes=True)
        show_problems(shown.problems, policy, outcome.file)
        outcome = outcome.with_told(shown.problems)
        pages = texts.alone(outcome.file, shown, to)
        files.write_pages(pages, to.output, quiet=policy.quiet)
    return FAILED if outcome.failed else DONE
