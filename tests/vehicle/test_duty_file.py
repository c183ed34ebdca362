"""Files of duty cycles: what they say and where they are wrong."""

from pathlib import Path

import pytest

from tests.commands import json_answer, vstatics
from tests.core.summary.capacities import CASE, LOW


@pytest.mark.parametrize(
    ("duty", "message"),
    [
        ('energy: {low: 1, "7": 2}', "2:3: error: gear 7: there is no such gear"),
        ("energy: {low: 1, N: 2}", "gear N: the gear has no efficiency"),
        ("energy: {low: 0}", "all shares are 0"),
        ("energy: {low: -1}", "read '-1', expected a share of 0 or more"),
        ("energy: {low: much}", "read 'much', expected a share"),
        ("energy: {low: 1, low: 2}", "gear low is given twice"),
        ("enrgy: {low: 1}", "did you mean `energy`?"),
        ("energy: [low]", "read a list, expected a share for each gear"),
        ("energy: {low: 1}\ntime: {low: 1}", "expected `energy` or `time`"),
        ("low", "expected `energy` or `time`"),
        ("", "the file is empty"),
    ],
)
def test_what_is_wrong_with_a_duty_cycle_is_told_with_its_place(
    duty: str, message: str, tmp_path: Path
) -> None:
    file = tmp_path / "duty.yaml"
    file.write_text(duty.replace(': {low: 1, "7": 2}', ':\n  "7": 2\n  low: 1'))
    said = vstatics("summary", "-", "--duty", file, stdin=CASE.encode())
    assert said.gives_nothing(message, str(file))


def test_shares_of_time_need_a_load(tmp_path: Path) -> None:
    file = tmp_path / "duty.yaml"
    file.write_text("time: {low: 1}")
    text = CASE.replace("load: {speed: 1000 rpm, torque: 200 N*m}\n", "").replace("300 N*m", "1.5")
    said = vstatics("summary", "-", "--duty", file, stdin=text.encode())
    assert said.fails("expected a load with speed and torque")


def test_a_duty_cycle_is_shown_alone_and_of_two_cases(tmp_path: Path) -> None:
    duty, file = tmp_path / "duty.yaml", tmp_path / "case.yaml"
    duty.write_text("energy: {low: 25, direct: 75}")
    file.write_text(CASE)
    said = vstatics("summary", file, "--duty", duty)
    assert "in all   1.000       0.993" in said.out
    both = vstatics("summary", file, file, "--duty", duty)
    assert "efficiency of the duty cycle" in both.out
    made = json_answer("summary", file, "--duty", duty)
    assert made["duty"]["efficiency"] == pytest.approx(0.25 * LOW + 0.75)


def test_standard_input_is_the_case_or_the_duty_cycle() -> None:
    said = vstatics("summary", "-", "--duty", "-", stdin=CASE.encode())
    assert said.status == 2
