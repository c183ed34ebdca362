"""What the commands of `vstatics torsion` write in JSON fits their schemas."""

from __future__ import annotations

import copy
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.commands import CASES, vstatics
from tests.core.cli.test_schemas import validator
from tests.torsion.cli.torsional import ASKED, BOX, CHAIN, GOOD, said
from vstatics import load

OF_COMMAND = {
    **{command: command for command in ("modes", "response", "damping")},
    "reduce": "reduction",
    "simplify": "simplification",
    "identify": "identification",
}
VALIDATORS = {command: validator(name) for command, name in OF_COMMAND.items()}
OPTIONS = {**ASKED, "simplify": ("--gear", "direct", "--links", "2")}
VIBRATING = [file for file in sorted(CASES.glob("*.yaml")) if load(file).inertias]


def complaints(command: str, document: Any) -> list[str]:
    return [
        f"{error.json_path}: {error.message[:200]}"
        for error in VALIDATORS[command].iter_errors(document)
    ]


@pytest.mark.parametrize("command", OF_COMMAND)
def test_every_document_fits(command: str) -> None:
    """Of gears without results, of links without values, of what may be left out."""
    lost = BOX.replace("casing]\noutput", "casing, lost]\noutput")
    for text in (BOX, GOOD, lost):
        for form in ("json", "jsonl"):
            answer = said(command, *OPTIONS[command], "-f", form, text=text)
            assert complaints(command, answer.json) == []


def test_what_is_asked_for_beside_fits() -> None:
    for command, *options in (
        ("response", "--at", "engine", "--orders", "2", "--speed", "0,600"),
        ("identify", "--gear", "direct", "--omega", "5", "--decrement", ".2"),
        ("simplify", "--gear", "direct", "--links", "4"),
        ("simplify", "--gear", "direct", "--links", "1", "--rule", "u"),
        ("modes", "--modes", "1", "--coast"),
    ):
        answer = said(command, *options, "-f", "json", text=GOOD)
        assert complaints(command, answer.json) == [], command
    answer = said("simplify", "--gear", "1", "--links", "1", "-f", "json", text=CHAIN)
    assert complaints("simplify", answer.json) == []


@pytest.mark.parametrize("file", VIBRATING, ids=lambda file: file.stem)
def test_what_is_written_of_shipped_cases_fits(file: Path) -> None:
    first = load(file).link_names[0]
    for command, *options in (
        ("modes",),
        ("reduce", "--to", first),
        ("response", "--at", first, "--orders", "2,4", "--speed", "600:2000:3", "--sum"),
    ):
        answer = vstatics("torsion", command, file, *options, "-f", "json")
        assert answer.status == 0, answer.err
        assert complaints(command, answer.json) == []


def _of_gear(change: dict[str, Any], gear: int = 0) -> Callable[[Any], None]:
    return lambda document: document["gears"][gear].update(change)


def _of_mode(change: dict[str, Any]) -> Callable[[Any], None]:
    return lambda document: document["gears"][0]["modes"][0].update(change)


@pytest.mark.parametrize(
    ("command", "spoil"),
    [
        ("modes", lambda document: document.update(version=1)),
        ("modes", lambda document: document.pop("gears")),
        ("modes", _of_gear({"more": 1})),
        ("modes", _of_gear({"rigid_modes": 1.5})),
        ("modes", _of_gear({"damped": [{"real": 1}]})),
        ("modes", _of_gear({"error": "tied up"})),
        ("modes", _of_mode({"omega": "1"})),
        ("modes", _of_mode({"shape": {"engine": "1"}})),
        ("modes", _of_mode({"sensitivity": {"stiffness": {}}})),
        ("reduce", _of_gear({"inertias": [1]})),
        ("reduce", lambda document: document.pop("to")),
        ("response", _of_gear({"speeds": [None, "1"]})),
        ("response", _of_gear({"resonances": [{"order": 1, "mode": 1}]})),
        ("response", _of_gear({"sum": {"amplitudes": {"a": {"largest": []}}, "torques": {}}})),
        ("simplify", lambda document: document["steps"][0].update(omegas=1)),
        ("simplify", lambda document: document.update(rule="x")),
        ("identify", lambda document: document.update(mode="1")),
        ("damping", lambda document: document.pop("decrement")),
    ],
)
def test_a_wrong_document_does_not_fit(command: str, spoil: Callable[[Any], None]) -> None:
    right = said(command, *OPTIONS[command], "-f", "json").json
    wrong = copy.deepcopy(right)
    spoil(wrong)
    assert complaints(command, right) == []
    assert complaints(command, wrong) != []
