"""Several cases at once: to a directory, to a stream, from a list, and what is refused."""

import json
from pathlib import Path
from typing import Any

import pytest

from tests.chance import count
from tests.commands import BAD, MZKT, NEUTRAL, TIED_UP, json_answer, vstatics
from tests.processes import names
from vstatics.core.cli.shared import case_work
from vstatics.core.model.transmission import Transmission
from vstatics.core.statics.results import Results
from vstatics.core.statics.solution import solution

GOOD = ("in/mzkt.dat", "in/neutral.yaml")
ALL = (*GOOD, "in/bad.yaml", "in/tied.yaml")


@pytest.fixture(autouse=True)
def cases(folder: Path) -> Path:
    """The current folder, with three good cases of different kinds and a bad one."""
    (folder / "in").mkdir()
    (folder / "in" / "mzkt.dat").write_bytes(MZKT.read_bytes())
    for name, text in {"neutral": NEUTRAL, "tied": TIED_UP, "bad": BAD}.items():
        (folder / "in" / f"{name}.yaml").write_text(text, "utf-8")
    return folder


def shown(path: str) -> list[str]:
    """What is in a folder, hidden files aside."""
    return [name for name in names(Path(path)) if not name.startswith(".")]


@pytest.mark.parametrize("form", ["listing", "json", "csv"])
def test_each_case_gives_the_file_that_it_gives_alone(form: str) -> None:
    suffix = form.replace("listing", "lst")
    for jobs in (1, 2):
        said = vstatics("run", *GOOD, "-f", form, "-o", f"new/{jobs}", "--jobs", jobs)
        assert (said.status, said.out) == (0, "")
        assert said.err.splitlines()[-1] == "2 of 2 cases calculated"
        assert shown(f"new/{jobs}") == [f"mzkt.{suffix}", f"neutral.{suffix}"]
        for case in GOOD:
            written = Path(f"new/{jobs}", f"{Path(case).stem}.{suffix}")
            assert written.read_text("utf-8") == vstatics("run", case, "-f", form).out


@pytest.mark.parametrize("seconds", [0.0, 60.0])
def test_cases_of_a_group_give_the_messages_and_results_that_they_give_alone(
    seconds: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With 0 s for a group, cases are completed one after the other; with 60 s, step by step."""
    monkeypatch.setattr(case_work, "GROUP_SIZE", 3)
    monkeypatch.setattr(case_work, "GROUP_SECONDS", seconds)
    files = (*ALL, "nowhere.dat", *ALL[::-1])
    said = vstatics("run", *files, "-f", "jsonl")
    alone = [vstatics("run", file, "-f", "jsonl") for file in files]
    assert said == (1, "".join(one.out for one in alone), "".join(one.err for one in alone))


def test_a_slow_case_does_not_delay_earlier_results(monkeypatch: pytest.MonkeyPatch) -> None:
    """With 0 s for a group, the result of a case is written before the next case is solved."""
    monkeypatch.setattr(case_work, "GROUP_SECONDS", 0.0)
    seen: list[list[str]] = []

    def observed(case: Transmission, **options: Any) -> Results:
        seen.append(shown("out"))
        return solution(case, **options)

    monkeypatch.setattr("vstatics.core.statics.solution.solution", observed)
    assert vstatics("run", *GOOD, "-o", "out").status == 0
    assert seen == [[], ["mzkt.lst"]]


def test_names_of_directories_and_of_files_in_them() -> None:
    """A slash means a directory; a stem ends at the last dot, and stdin has a name."""
    Path("there").mkdir()
    for output in ("there", "new/"):
        assert vstatics("run", GOOD[0], "-o", output).all == ""
        assert shown(output) == ["mzkt.lst"]
    Path("in/mzkt.dat").rename("in/box.v2.dat")
    for output in ("out.csv/", "out.csv"):
        call = "run", "in/box.v2.dat", "-", "-o", output, "-f", "csv"
        assert vstatics(*call, stdin=NEUTRAL.encode()).status == 0
    assert shown("out.csv") == ["box.v2.csv", "stdin.csv"]


@pytest.mark.parametrize("jobs", [1, 2])
def test_failures_are_reported_where_they_occur_and_summed_up_at_the_end(jobs: int) -> None:
    Path("in/bad.yaml").write_text(BAD.replace("third: 3", "third: x"), "utf-8")
    said = vstatics("run", *ALL, "nowhere.dat", "-f", "json", "-o", "out", "-j", jobs)
    assert (said.status, shown("out")) == (1, ["mzkt.json", "neutral.json", "tied.json"])
    *before, summary, first, second, third = said.err.splitlines()
    apart = "".join(vstatics("run", case, "-f", "json").err for case in (*ALL, "nowhere.dat"))
    assert before == apart.splitlines()
    assert summary == "3 of 5 cases calculated, 1 with errors, 2 failed:"
    assert first.startswith("  in/bad.yaml:3:")
    assert first.endswith("a link number from 1 to 3 or `housing` [E126] ... and 1 more problem")
    assert second.startswith("  in/tied.yaml:4:")
    assert "tied up" in second
    assert third == "  nowhere.dat: error: cannot be read: No such file or directory"


def test_the_earlier_result_of_a_case_that_fails_now_is_set_aside() -> None:
    call = "run", *GOOD, "-f", "json", "-o", "out"
    vstatics(*call)
    old = Path("out/mzkt.json").read_bytes()
    Path("in/mzkt.dat").write_text("KJG= x", "utf-8")
    assert "(its earlier result is out/mzkt.json.old now)" in vstatics(*call).err
    assert shown("out") == ["mzkt.json.old", "neutral.json"]
    assert Path("out/mzkt.json.old").read_bytes() == old


def test_results_of_cases_that_are_no_more_are_named() -> None:
    """As long as they are there; of another format they are other results."""
    Path("in/old.yaml").write_text(NEUTRAL, "utf-8")
    call = "run", *GOOD, "-f", "json", "-o", "out"
    said = vstatics(*call, "in/old.yaml")
    assert said.err.splitlines()[-1] == "3 of 3 cases calculated"
    named = "out: 1 further result without a case in this run: old.json"
    for more in ((), ("--resume",)):
        said = vstatics(*call, *more)
        assert (said.status, said.err.splitlines()[-1]) == (0, named)
    assert named not in vstatics(*call, "-q").err
    assert "further" not in vstatics("run", *GOOD, "-o", "out").err


@pytest.mark.parametrize("jobs", [1, 2])
def test_an_error_of_the_program_in_one_case_harms_no_other(
    jobs: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    def faulty(case: Transmission, **options: Any) -> Results:
        if case.links == 3:
            raise ZeroDivisionError("by\nnothing")
        return solution(case, **options)

    monkeypatch.setattr("vstatics.core.statics.solution.solution", faulty)
    said = vstatics("run", *reversed(GOOD), "-o", "out", "--jobs", jobs)
    assert (said.status, shown("out")) == (1, ["mzkt.lst"])
    message = "an error in vstatics, please report it with this case: ZeroDivisionError: by nothing"
    assert said.err.startswith(f"in/neutral.yaml: error: {message} in test_many.py:")
    assert "\n1 of 2 cases calculated, 1 failed:\n" in said.err


def test_results_of_one_name_are_refused_and_all_pairs_named() -> None:
    Path("in/mzkt.yaml").write_text(NEUTRAL, "utf-8")
    Path("other").mkdir()
    Path("other/neutral.dat").write_bytes(MZKT.read_bytes())
    Path("link.dat").symlink_to("in/mzkt.dat")
    given = ["in/mzkt.dat", "in/mzkt.yaml", "in/neutral.yaml", "other/neutral.dat", "link.dat"]
    said = vstatics("run", *given, "in/../in/mzkt.dat", "in/mzkt.yaml", "-o", "out")
    assert (said.status, said.out, Path("out").exists()) == (2, "", False)
    assert said.err.splitlines()[3:] == [
        "Error: nothing was calculated:",
        "  link.dat is named twice (the same file as in/mzkt.dat)",
        "  in/../in/mzkt.dat is named twice (the same file as in/mzkt.dat)",
        "  in/mzkt.yaml is named twice",
        "  in/mzkt.dat and in/mzkt.yaml would both give out/mzkt.lst",
        "  in/neutral.yaml and other/neutral.dat would both give out/neutral.lst",
        "  cases with the same name need different folders: write all to one file, "
        "-o all.jsonl, where they keep their folders, or each folder to a directory of its own",
    ]


def test_a_result_that_would_overwrite_a_case_or_the_list_is_refused() -> None:
    vstatics("run", "in/mzkt.dat", "-o", "in/report.lst")
    Path("out").symlink_to("in")
    for output in ("in", "in/", "./in/../in", "out"):
        said = vstatics("run", "in/report.lst", "in/neutral.yaml", "-o", output)
        words = "the result of in/report.lst would overwrite the case in/report.lst"
        assert said.is_wrong_use(words)
    Path("in/mzkt.csv").write_text("in/mzkt.dat", "utf-8")
    said = vstatics("run", "--files-from", "in/mzkt.csv", "-f", "csv", "-o", "in")
    assert said.is_wrong_use("the result of in/mzkt.dat would overwrite in/mzkt.csv")
    assert ".vstatics-run-lst" not in names(Path("in"))


REFUSED = {
    "-o all.csv -f json": "-f json is not the format of all.csv: expected .json",
    "-o case.dat": "case.dat: no format has this suffix here: expected .lst",
    "-o v.2": "; a directory ends with /",
    "-o in/mzkt.dat/": "in/mzkt.dat/ is a file: expected a directory",
    "-o plain": "plain is a file: expected a directory",
    "-o in -f jsonl": "jsonl is one stream: expected -o FILE, not in",
    "-o new/ -f jsonl": "jsonl is one stream: expected -o FILE, not new/",
    "-f parquet -o out/": "parquet is one stream: expected -o FILE",
    "-o all.parquet --digits 3": "--digits does not apply to parquet",
    "--resume": "--resume needs the output of the stopped run",
    "--resume -f csv -o all.csv": "--resume needs the output of the stopped run",
    "--resume -f jsonl": "--resume needs the output of the stopped run",
    "--jobs 0": "x>=1",
    "--files-from -  -": "the list of cases (--files-from), so it cannot be a case",
    "- -": "standard input (-) can be read only once",
}


@pytest.mark.parametrize("options", REFUSED)
def test_what_cannot_be_meant_is_refused(options: str) -> None:
    Path("plain").touch()
    assert vstatics("run", *GOOD, *options.split()).is_wrong_use(REFUSED[options])
    assert names() == ["in", "plain"]


@pytest.mark.parametrize(
    "text",
    [
        "\ufeffin/neutral.yaml\r\n\r\n\r\nin/a name.dat\r\n",
        "in/neutral.yaml\n\nin/a name.dat",
        "in/neutral.yaml\0in/a name.dat\0",
    ],
    ids=["DOS", "no end", "NUL"],
)
def test_cases_come_from_a_list(text: str) -> None:
    Path("in/mzkt.dat").rename("in/a name.dat")
    Path("list").write_bytes(text.encode())
    for name in ("list", "-"):
        call = "run", "in/tied.yaml", "--files-from", name, "-f", "json"
        documents = vstatics(*call, stdin=text.encode()).json
        assert [len(document["gears"]) for document in documents] == [2, 2, 6]
        assert documents[1]["gears"] == ["N", "low"]


def test_a_list_of_one_is_a_list_and_of_none_too() -> None:
    """Of no case, as where all cases failed, a table has its headings: its readers find no rows."""
    listed = "run", "--files-from", "-", "-f"
    said = vstatics(*listed, "csv", "-o", "out", stdin=b"in/mzkt.dat\n")
    assert (said.status, shown("out")) == (0, ["mzkt.csv"])
    assert len(vstatics(*listed, "json", stdin=b"in/mzkt.dat").json) == 1
    said = vstatics(*listed, "csv", stdin=b"nowhere.dat\nin/mzkt.dat")
    assert (said.status, said.out.count("mzkt.dat,efficiency")) == (1, 6)
    assert vstatics("run", "--files-from", "nowhere").fails("nowhere: error: cannot be ")
    failed = vstatics("run", "in/bad.yaml", "in/bad.yaml", "-q", "-f", "csv")
    assert (failed.status, failed.out[:26]) == (1, "case,table,row,gear,value\n")
    for form, out in {"listing": "", "csv": failed.out, "json": "[]\n"}.items():
        said = vstatics(*listed, form, stdin=b"\n # none\n")
        assert said == (0, out, "<stdin>: names no file\n")


def test_jsonl_has_a_line_for_each_case_in_their_order() -> None:
    array, said = json_answer("run", *ALL), vstatics("run", *ALL, "-f", "jsonl")
    assert (said.status, said.out[-1]) == (1, "\n")
    assert [json.loads(line) for line in said.out.splitlines()] == array
    assert set(array[2]) == {"file", "case", "errors"}
    vstatics("run", *ALL, "-f", "jsonl", "--jobs", 3, "-o", "all.jsonl")
    assert Path("all.jsonl").read_text("utf-8") == said.out
    assert vstatics("run", GOOD[0], "-f", "jsonl").json == array[0]


@pytest.mark.parametrize("form", ["listing", "json", "csv", "jsonl"])
def test_processes_give_the_same_stream_and_the_same_messages(form: str) -> None:
    given = ("run", *ALL, "nowhere", *GOOD, "-f", form)
    assert vstatics(*given, "--jobs", 3) == vstatics(*given)


@pytest.mark.slow
def test_thousands_of_arguments(cases: Path) -> None:
    total = count(1000, 5000)
    given = [cases / f"{number}.dat" for number in range(total)]
    for path in given:
        path.hardlink_to(cases / "in" / "mzkt.dat")
    said = vstatics("run", *given, "-f", "json", "-o", cases / "out", "-j", 2)
    *_, last = said.err.splitlines()  # below lines of progress, which slow runs have
    assert (said.status, last) == (0, f"{total} of {total} cases calculated")
    assert len(shown("out")) == total
