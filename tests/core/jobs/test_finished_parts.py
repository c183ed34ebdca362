"""Parts of one output, after a run that was killed."""

from pathlib import Path

from vstatics.core.jobs.finished_cases import case_mark
from vstatics.core.jobs.finished_parts import FinishedParts


def test_a_first_part_that_was_cut_is_never_filled_by_the_next(tmp_path: Path) -> None:
    files = [str(tmp_path / name) for name in ("a", "b")]
    for file in files:
        Path(file).write_text("links: 2", "utf-8")
    first, second = files
    whole = b"of the first case\n"
    output = str(tmp_path / "all.jsonl")
    known = []
    for part in (whole, b"of the second case, which is longer\n", b""):
        run = FinishedParts(output, {"coast": True})
        run.open(resume=True)
        known.append((run.is_done(first), run.is_done(second)))
        run.put(second if known[1:] else first, case_mark(b"links: 2", []), part)
        run.__exit__(KeyboardInterrupt)
        if part == whole:  # as by a power failure
            with Path(run.path).open("r+b") as cut:
                cut.truncate(Path(run.path).stat().st_size - 5)
    assert known == [(False, False), (False, False), (False, True)]
