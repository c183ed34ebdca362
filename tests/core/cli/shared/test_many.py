"""Several cases at once: to a directory, to a stream, from a list, and what is refused."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

import pytest

from tests.chance import count
from tests.commands import BAD, ID, MZKT, NEUTRAL, TIED_UP, json_answer, shell, vstatics
from vstatics import solve
from vstatics.core.model.transmission import Transmission
from vstatics.core.statics.results import Results

SUFFIXES = {"listing": ".lst", "json": ".json", "csv": ".csv"}


@pytest.fixture
def folder(folder: Path) -> Path:
    """A folder, the current one, with three good cases of different kinds and a bad one."""
    (folder / "in").mkdir()
    (folder / "in" / "mzkt.dat").write_bytes(MZKT.read_bytes())
    (folder / "in" / "neutral.yaml").write_text(NEUTRAL, encoding="utf-8")
    (folder / "in" / "tied.yaml").write_text(TIED_UP, encoding="utf-8")
    (folder / "in" / "bad.yaml").write_text(BAD, encoding="utf-8")
    return folder


def names(path: str) -> list[str]:
    """What is in a folder, hidden files aside."""
    return sorted(one.name for one in Path(path).iterdir() if not one.name.startswith("."))


GOOD = ("in/mzkt.dat", "in/neutral.yaml")
ALL = (*GOOD, "in/bad.yaml", "in/tied.yaml")


# a directory


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize("form", SUFFIXES)
@pytest.mark.parametrize("jobs", [1, 2])
def test_each_case_gives_the_file_that_it_gives_alone(form: str, jobs: int) -> None:
    said = vstatics("run", *GOOD, "-f", form, "-o", "new/results", "--jobs", jobs)
    assert (said.status, said.out) == (0, "")
    assert said.err.splitlines()[-1] == "2 of 2 cases calculated"
    assert names("new/results") == [f"mzkt{SUFFIXES[form]}", f"neutral{SUFFIXES[form]}"]
    for case in GOOD:
        written = Path("new/results", Path(case).stem + SUFFIXES[form])
        assert written.read_text(encoding="utf-8") == vstatics("run", case, "-f", form).out


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize("output", ["there", "there/", "new/"])
def test_one_case_goes_into_a_directory_that_is_there_or_is_meant(output: str) -> None:
    Path("there").mkdir()
    assert vstatics("run", GOOD[0], "-o", output).all == ""
    assert names(output) == ["mzkt.lst"]


@pytest.mark.usefixtures("folder")
def test_a_stem_ends_at_the_last_dot_and_stdin_has_a_name() -> None:
    Path("in/mzkt.dat").rename("in/box.v2.dat")
    said = vstatics("run", "in/box.v2.dat", "-", "-o", "out", stdin=NEUTRAL.encode())
    assert said.status == 0
    assert names("out") == ["box.v2.lst", "stdin.lst"]


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize("jobs", [1, 2])
def test_failures_are_told_where_they_occur_and_summed_up_at_the_end(jobs: int) -> None:
    Path("in/bad.yaml").write_text(BAD.replace("third: 3", "third: x"), encoding="utf-8")
    said = vstatics("run", *ALL, "nowhere.dat", "-f", "json", "-o", "out", "-j", jobs)
    assert said.status == 1
    assert names("out") == ["mzkt.json", "neutral.json", "tied.json"]
    *before, summary, first, second, third = said.err.splitlines()
    apart = "".join(vstatics("run", case, "-f", "json").err for case in (*ALL, "nowhere.dat"))
    assert before == apart.splitlines()
    assert summary == "3 of 5 cases calculated, 1 with errors, 2 failed:"
    assert first.startswith("  in/bad.yaml:3:")
    assert first.endswith(
        ", expected a link number from 1 to 3 or `housing` [E126] ... and 1 more problem"
    )
    assert second.startswith("  in/tied.yaml:4:")
    assert "tied up" in second
    assert third == "  nowhere.dat: error: cannot be read: No such file or directory"


@pytest.mark.usefixtures("folder")
def test_the_earlier_result_of_a_case_that_fails_now_is_set_aside() -> None:
    vstatics("run", *GOOD, "-f", "json", "-o", "out")
    old = Path("out/mzkt.json").read_bytes()
    Path("in/mzkt.dat").write_text("KJG= x", encoding="utf-8")
    said = vstatics("run", *GOOD, "-f", "json", "-o", "out")
    assert "(its earlier result is out/mzkt.json.old now)" in said.err
    assert names("out") == ["mzkt.json.old", "neutral.json"]
    assert Path("out/mzkt.json.old").read_bytes() == old


@pytest.mark.usefixtures("folder")
def test_results_of_cases_that_are_no_more_are_named() -> None:
    """As long as they are there; of another format they are other results."""
    Path("in/old.yaml").write_text(NEUTRAL, encoding="utf-8")
    said = vstatics("run", *GOOD, "in/old.yaml", "-f", "json", "-o", "out")
    assert said.err.splitlines()[-1] == "3 of 3 cases calculated"
    named = "out: 1 further result of no case of this run: old.json"
    for more in ((), ("--resume",)):
        said = vstatics("run", *GOOD, "-f", "json", "-o", "out", *more)
        assert (said.status, said.err.splitlines()[-1]) == (0, named)
    assert named not in vstatics("run", *GOOD, "-f", "json", "-o", "out", "-q").err
    assert "further" not in vstatics("run", *GOOD, "-o", "out").err


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize("jobs", [1, 2])
def test_an_error_of_the_program_in_one_case_harms_no_other(
    jobs: int, monkeypatch: pytest.MonkeyPatch
) -> None:

    def faulty(case: Transmission, **options: Any) -> Results:
        if case.links == 3:
            raise ZeroDivisionError("by\nnothing")
        return solve(case, **options)

    monkeypatch.setattr("vstatics.core.statics.solution.solution", faulty)
    said = vstatics("run", *reversed(GOOD), "-o", "out", "--jobs", jobs)
    assert (said.status, names("out")) == (1, ["mzkt.lst"])
    message = "an error in vstatics, please report it with this case: ZeroDivisionError: by nothing"
    assert said.err.startswith(f"in/neutral.yaml: error: {message} in test_many.py:")
    assert "\n1 of 2 cases calculated, 1 failed:\n" in said.err


# what is refused


@pytest.mark.usefixtures("folder")
def test_results_of_one_name_are_refused_and_all_pairs_named() -> None:
    Path("in/mzkt.yaml").write_text(NEUTRAL, encoding="utf-8")
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


@pytest.mark.usefixtures("folder")
def test_a_result_that_would_overwrite_a_case_or_the_list_is_refused() -> None:
    vstatics("run", "in/mzkt.dat", "-o", "in/report.lst")
    for output in ("in", "in/", "./in/../in"):
        said = vstatics("run", "in/report.lst", "in/neutral.yaml", "-o", output)
        assert said.is_wrong_use(
            "the result of in/report.lst would overwrite the case in/report.lst"
        )
    Path("out").symlink_to("in")
    assert vstatics("run", "in/report.lst", "in/neutral.yaml", "-o", "out").status == 2
    Path("in/mzkt.csv").write_text("in/mzkt.dat", encoding="utf-8")
    said = vstatics("run", "--files-from", "in/mzkt.csv", "-f", "csv", "-o", "in")
    assert "the result of in/mzkt.dat would overwrite in/mzkt.csv" in said.err
    assert ".vstatics-run-lst" not in os.listdir("in")  # noqa: PTH208


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ("-o all.csv -f json", "-f json is not the format of all.csv: expected .json"),
        ("-o case.dat", "case.dat: no format has this suffix here: expected .lst"),
        ("-o v.2", "; a directory ends with /"),
        ("-o in/mzkt.dat/", "in/mzkt.dat/ is a file: expected a directory"),
        ("-o plain", "plain is a file: expected a directory"),
        ("-o in -f jsonl", "jsonl is one stream: expected -o FILE, not in"),
        ("-o new/ -f jsonl", "jsonl is one stream: expected -o FILE, not new/"),
        ("--resume", "--resume needs a directory"),
        ("--resume -f csv -o all.csv", "--resume needs a directory"),
        ("--jobs 0", "x>=1"),
        ("--files-from -  -", "standard input (-) is the list of cases, and no case"),
        ("- -", "standard input (-) can be read once"),
    ],
)
def test_what_cannot_be_meant_is_refused(arguments: str, words: str) -> None:
    Path("plain").touch()
    said = vstatics("run", *GOOD, *arguments.split())
    assert said.is_wrong_use(words)
    assert names(".") == ["in", "plain"]


@pytest.mark.usefixtures("folder")
def test_a_folder_called_like_a_file_is_meant_with_a_slash() -> None:
    assert vstatics("run", *GOOD, "-o", "all.csv/", "-f", "csv").status == 0
    assert vstatics("run", *GOOD, "-o", "all.csv", "-f", "csv").status == 0
    assert names("all.csv") == ["mzkt.csv", "neutral.csv"]


# lists of files


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize(
    "text",
    [
        "in/neutral.yaml\nin/a name.dat\n",
        "\ufeffin/neutral.yaml\r\n\r\n\r\nin/a name.dat\r\n",
        "in/neutral.yaml\n\nin/a name.dat",
        "in/neutral.yaml\0in/a name.dat\0",
    ],
    ids=["lines", "DOS", "no end", "NUL"],
)
def test_cases_come_from_a_list(text: str) -> None:
    Path("in/mzkt.dat").rename("in/a name.dat")
    Path("list").write_bytes(text.encode())
    for given in (["--files-from", "list"], ["--files-from", "-"]):
        said = vstatics("run", "in/tied.yaml", *given, "-f", "json", stdin=text.encode())
        tied, neutral, mzkt = said.json
        assert (tied["gears"], neutral["gears"]) == (["both", "low"], ["N", "low"])
        assert len(mzkt["gears"]) == 6


@pytest.mark.usefixtures("folder")
def test_a_list_of_one_is_a_list_and_of_none_too() -> None:
    said = vstatics("run", "--files-from", "-", "-o", "out", "-f", "csv", stdin=b"in/mzkt.dat\n")
    assert (said.status, names("out")) == (0, ["mzkt.csv"])
    said = vstatics("run", "--files-from", "-", "-f", "json", stdin=b"in/mzkt.dat")
    assert len(said.json) == 1
    said = vstatics("run", "--files-from", "-", stdin=b"\n # none\n")
    assert (said.status, said.out, said.err) == (0, "", "<stdin>: names no file\n")
    said = vstatics("run", "--files-from", "nowhere")
    assert (said.status, said.err[:26]) == (1, "nowhere: error: cannot be ")
    said = vstatics("run", "--files-from", "-", "-f", "csv", stdin=b"nowhere.dat\nin/mzkt.dat")
    assert (said.status, said.out.count("mzkt.dat,efficiency")) == (1, 6)


def test_names_found_by_find_come_through_a_pipe(folder: Path) -> None:
    (folder / "in" / "a\nname.yaml").write_text(NEUTRAL, encoding="utf-8")
    command = f"cd {folder}; find in -name '*.yaml' -print0 | vstatics run --files-from - -o out"
    status, out, err = shell(command)
    assert (status, out) == (1, b"")
    assert b"3 of 4 cases calculated, 1 with errors, 1 failed:" in err
    assert names(str(folder / "out")) == ["a\nname.lst", "neutral.lst", "tied.lst"]


# streams


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize("jobs", [1, 3])
def test_jsonl_has_a_line_for_each_case_in_their_order(jobs: int) -> None:
    array = json_answer("run", *ALL)
    said = vstatics("run", *ALL, "-f", "jsonl", "--jobs", jobs)
    assert (said.status, said.out[-1]) == (1, "\n")
    assert [json.loads(line) for line in said.out.splitlines()] == array
    said = vstatics("run", *ALL, "-f", "jsonl", "--jobs", jobs, "-o", "all.jsonl")
    assert "\n3 of 4 cases calculated, 1 with errors, 1 failed:\n" in said.err
    lines = Path("all.jsonl").read_text(encoding="utf-8").splitlines()
    assert [json.loads(line) for line in lines] == array


@pytest.mark.usefixtures("folder")
def test_jsonl_of_one_case_is_one_line_and_that_of_a_bad_one_tells_it() -> None:
    alone = json_answer("run", GOOD[0])
    assert vstatics("run", GOOD[0], "-f", "jsonl").json == alone
    said = vstatics("run", "in/bad.yaml", "-f", "jsonl")
    assert (said.status, set(said.json)) == (1, {"file", "case", "errors"})


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize("form", ["listing", "json", "csv", "jsonl"])
def test_processes_give_the_same_stream_and_the_same_messages(form: str) -> None:
    given = ("run", *ALL, "nowhere", *GOOD, "-f", form)
    assert vstatics(*given, "--jobs", 3) == vstatics(*given)


@pytest.mark.usefixtures("folder")
def test_several_cases_go_to_a_device_as_to_stdout() -> None:
    expected = vstatics("run", *GOOD, "-f", "csv")
    line = f"cd {Path.cwd()}; vstatics run {' '.join(GOOD)} -f csv -o /dev/stdout | cat"
    status, out, err = shell(line)
    assert (status, out, ID.sub("", err.decode())) == (0, expected.out.encode(), expected.err)


@pytest.mark.slow
def test_thousands_of_arguments(folder: Path) -> None:
    total = count(1000, 5000)
    given = [folder / f"{number}.dat" for number in range(total)]
    for path in given:
        path.hardlink_to(folder / "in" / "mzkt.dat")
    said = vstatics("run", *given, "-f", "json", "-o", folder / "out", "-j", 2)
    assert (said.status, said.err) == (0, f"{total} of {total} cases calculated\n")
    assert len(names(str(folder / "out"))) == total
