"""What is tried, and what is saved: the numbers, in their places, and nothing else of a file."""

import json
import re
import shutil
from functools import partial
from pathlib import Path
from typing import Any

import pytest

import vstatics
from tests.chance import count, seeded
from tests.commands import CASES
from tests.page.serve.served import BOX, TOKEN, ServedCase, serving
from tests.processes import wait_for
from vstatics.core.cli.shared.cases import CaseOptions
from vstatics.page.cli.serve import calculated
from vstatics.page.serve.document_fields import Texts, documents_of
from vstatics.page.serve.states import MOST_KEPT, Calculated, ChangedMeanwhileError, ShownStates

until = partial(wait_for, seconds=10)
"""Wait, for 10 s at most, until the page follows its file."""


def shows(served: ServedCase, state: str) -> None:
    """Wait until the page shows a state of its file."""
    until(lambda: served.ask("shown").told["state"] == state)


def write(folder: Path, text: str = BOX) -> Path:
    file = folder / "box.yaml"
    file.write_bytes(text.encode())
    return file


def numbers_of(told: dict[str, Any], name: str) -> dict[str, str]:
    """The marked numbers of a result in a section, by gears."""
    cells = told["sections"]["gears"].split("<td")
    return {
        one.split('data-gear="')[1].split('"')[0]: one.split('data-number="')[1].split('"')[0]
        for one in cells
        if f'data-result="{name}"' in one
    }


def test_what_is_tried_is_what_the_program_calculates_of_such_a_file(tmp_path: Path) -> None:
    """Without being written: `run` of a file with that number gives the ratios of the page."""
    with serving(write(tmp_path)) as served:
        told = served.ask("try", {"changes": {"P1.ratio": -3.0, "load.torque": 100}}).told
    expected = vstatics.solve(vstatics.loads(BOX.replace("-78/30", "-3"))).ratio
    assert [float(one) for one in numbers_of(told, "ratio").values()] == list(expected)
    assert served.file.read_text("utf-8") == BOX


def test_only_the_numbers_of_a_file_change(tmp_path: Path) -> None:
    with serving(write(tmp_path, BOX.replace("\n", "\r\n"))) as served:
        told = served.save({"P1.ratio": -2.5, "load.speed": 2800, "P1.efficiency": 0.97}).told
    new = BOX.replace("-78/30", "-2.5").replace("3000 rpm", "2800 rpm").replace("\n", "\r\n")
    assert served.file.read_bytes() == new.encode()
    assert told["fields"]["load.speed"] == 2800
    assert told["state"] == "good"


def test_numbers_go_into_a_newer_file_only_if_somebody_says_so(tmp_path: Path) -> None:
    with serving(write(tmp_path)) as served:
        digest = served.ask("shown").told["digest"]
        newer = BOX.replace("0.97", "0.95") + "# by somebody else\n"
        served.file.write_text(newer, "utf-8")
        refused = served.save({"P1.ratio": -3}, **{"If-Match": f'"{digest}"'})
        assert refused.status == 412
        assert served.file.read_text("utf-8") == newer
        assert served.save({"P1.ratio": -3}).status == 200
    assert served.file.read_text("utf-8") == newer.replace("-78/30", "-3")


def test_a_file_in_error_is_reported_with_its_place_and_takes_no_numbers(tmp_path: Path) -> None:
    with serving(write(tmp_path)) as served:
        wrong = BOX.replace("carrier, ratio", "carier, ratio")
        served.file.write_text(wrong, "utf-8")
        shows(served, "error")
        told = served.ask("shown").told
        line = wrong.split("\n")[4]
        assert told["errors"].startswith(f"{served.file}:5:{line.index('carier') + 1}: error: ")
        shown, caret = told["errors"].split("\n")[1:]
        assert shown[caret.index("^") :].startswith("carier")
        assert "sections" not in told
        assert b"<h1>box</h1>" in served.ask("").body  # the last good page
        assert served.save({"P1.ratio": -3}).status == 422
        assert served.file.read_text("utf-8") == wrong
    (tmp_path / "box.yaml").unlink()
    with serving(tmp_path / "box.yaml") as served:
        assert b'data-state="error"' in served.ask("").body
        write(tmp_path)
        shows(served, "good")


def test_a_deck_is_shown_and_stays(tmp_path: Path) -> None:
    file = Path(shutil.copy(CASES / "mzkt7922.dat", tmp_path))
    with serving(file) as served:
        page = served.ask("").body.decode()
        assert page.count('class="field"') == len(re.findall("<input[^>]* disabled", page)) / 2 > 0
        assert served.save({"D1.ratio": -3}).status == 422
    assert file.read_bytes() == (CASES / file.name).read_bytes()


def test_a_scenario_and_its_case_both_take_their_numbers(tmp_path: Path) -> None:
    text = (CASES / "scenarios/tarasik-set-lock.yaml").read_text("utf-8")
    scenario = write(tmp_path, text.replace("../", ""))
    case = Path(shutil.copy(CASES / "tarasik-set.yaml", tmp_path))
    with serving(scenario) as served:
        fields = served.ask("shown").told["fields"]
        heavy = next(path for path in fields if path.endswith(".inertia"))
        changes = {"duration": fields["duration"] / 2, heavy: 7.5}
        assert served.save(changes).status == 200
        assert served.ask("shown").told["fields"] == {**fields, **changes}
    assert "duration: 0.5\n" in scenario.read_text("utf-8")
    assert "7.5" in case.read_text("utf-8")


def test_who_listens_hears_of_a_change_of_the_case_and_of_what_it_names(tmp_path: Path) -> None:
    points = tmp_path / "drag.csv"
    points.write_text("speed [rad/s],torque [N*m]\n0,0\n300,3\n", "utf-8")
    text = BOX + "drag: {ring: {file: drag.csv}}\n"
    with serving(write(tmp_path, text)) as served, served.connect() as line:
        line.sendall(f"GET /{TOKEN}/events HTTP/1.1\r\nHost: {served.host}\r\n\r\n".encode())
        with line.makefile("rb") as heard:

            def next_one() -> dict[str, Any]:
                return next(json.loads(one[5:]) for one in heard if one.startswith(b"data:"))

            first = next_one()
            assert first["state"] == "good"
            points.write_text("speed [rad/s],torque [N*m]\n0,0\n300,4\n", "utf-8")
            second = next_one()
            assert second["number"] > first["number"]
            assert second["digest"] == first["digest"]
            write(tmp_path, text.replace("0.97", "0.96"))
            assert next_one()["digest"] != first["digest"]


def test_who_writes_in_the_moment_of_a_save_loses_nothing(tmp_path: Path) -> None:
    """An editor saves while the numbers that are to be saved are calculated."""
    file = write(tmp_path)
    newer = BOX.replace("0.97", "0.95")

    def meanwhile(texts: Texts) -> Calculated:
        made = calculated(str(file), CaseOptions(), texts)
        if texts:
            write(tmp_path, newer)
        return made

    states = ShownStates(meanwhile, str(file))
    with pytest.raises(ChangedMeanwhileError):
        states.saved({"P1.ratio": -3})
    assert file.read_text("utf-8") == newer
    assert states.look_again()


def test_a_file_that_is_still_being_written_shows_no_error(tmp_path: Path) -> None:
    """An editor empties it and writes the rest a moment later; what stays in error is told."""
    file = write(tmp_path)
    rest = [BOX.replace("-78/30", "-3")]

    def meanwhile(texts: Texts) -> Calculated:
        made = calculated(str(file), CaseOptions(), texts)
        if made.results is None and rest:
            write(tmp_path, rest.pop())
        return made

    states = ShownStates(meanwhile, str(file))
    write(tmp_path, "")
    assert not states.look_again()
    assert not states.shown.errors
    assert states.look_again()
    assert not states.shown.errors
    write(tmp_path, "")
    assert states.look_again()
    assert states.shown.errors


def states_of(file: Path) -> ShownStates:
    return ShownStates(partial(calculated, str(file), CaseOptions()), str(file))


@pytest.mark.parametrize("encoding", ["utf-16-le", "utf-16-be", "utf-32-le", "utf-32-be"])
def test_the_mark_and_the_order_of_bytes_of_a_text_stay(tmp_path: Path, encoding: str) -> None:
    file = tmp_path / "box.yaml"
    file.write_bytes(f"\ufeff{BOX}".encode(encoding))
    states_of(file).saved({"P1.ratio": -3})
    assert file.read_bytes().decode(encoding) == f"\ufeff{BOX}".replace("-78/30", "-3")


def test_pictures_of_the_file_can_be_asked_for_whatever_other_windows_try(tmp_path: Path) -> None:
    states = states_of(write(tmp_path))
    number = states.shown.number
    for step in range(MOST_KEPT + 1):
        states.tried({"P1.ratio": -3 - step})
    assert states.kept(str(number)) is states.shown


def test_a_file_behind_a_link_that_others_replace_is_followed(tmp_path: Path) -> None:
    """Editors write beside it and rename; it may be away for a moment, and come back."""
    (tmp_path / "real").mkdir()
    real = write(tmp_path / "real")
    link = tmp_path / "box.yaml"
    link.symlink_to(real)
    with serving(link) as served:
        other = real.with_name("other")
        other.write_text(BOX.replace("-78/30", "-2"), "utf-8")
        other.replace(real)
        until(lambda: served.ask("shown").told["fields"]["P1.ratio"] == -2)
        assert served.save({"P1.ratio": -3}).status == 200
        assert link.is_symlink()
        kept = real.read_bytes()
        assert b"ratio: -3," in kept
        real.unlink()
        shows(served, "error")
        assert served.save({"P1.ratio": -4}).status == 422
        real.write_bytes(kept)
        shows(served, "good")


def test_no_room_for_a_file_is_reported(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(_file: str, **_: object) -> Any:
        raise OSError(28, "No space left on device")

    with serving(write(tmp_path)) as served:
        monkeypatch.setattr("vstatics.page.serve.states.replacing", full)
        answer = served.save({"P1.ratio": -3})
        assert (answer.status, b"No space left" in answer.body) == (422, True)
    assert served.file.read_text("utf-8") == BOX


def test_numbers_on_one_anchor_say_so(tmp_path: Path) -> None:
    rng = seeded(13)
    for _ in range(count(4, 40)):
        names = [f"P{number}" for number in range(1, rng.randint(2, 5) + 1)]
        anchored = [name for name in names if rng.random() < 0.6] or names[:1]
        ratios = {name: "*u" if name in anchored[1:] else "-2.5" for name in names}
        ratios[anchored[0]] = "&u -2.5"
        joined = "{{first: sun, second: ring, third: carrier, ratio: {}}}"
        lines = [f"  {name}: {joined.format(ratio)}\n" for name, ratio in ratios.items()]
        text = f"{BOX[: BOX.index('  P1:')]}{''.join(lines)}gears: {{low: [B1]}}\n"
        numbers = documents_of({"a.yaml": text.encode()}, vstatics.loads(text)).numbers
        for name in names:
            others = [f"{one}.ratio" for one in anchored if one != name and name in anchored]
            assert list(numbers[f"{name}.ratio"].field.same) == others
        with serving(write(tmp_path, text)) as served:
            said = served.ask("").body.decode().count("same number as")
        assert said == len(anchored) * (len(anchored) - 1)
