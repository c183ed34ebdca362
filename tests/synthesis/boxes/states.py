"""Searches for gearboxes that leave a state, in small pieces."""

import math
from functools import partial

import pytest

from vstatics.synthesis.boxes.batches import work
from vstatics.synthesis.boxes.batches.found import FoundPiece
from vstatics.synthesis.boxes.box import HELD, BoxSearch, FoundBox
from vstatics.synthesis.cli.box import run as box_run
from vstatics.synthesis.structures.scheme import SetScheme


def found_in(pieces: int, _: BoxSearch, piece: int, count: int) -> FoundPiece:
    """Find a simple set with a brake at its ring, in each piece another one."""
    assert 0 <= piece < count == pieces
    p = 2 + piece / 1000
    error = max(math.log((1 + p) / 3), 1e-9)
    box = FoundBox(
        SetScheme.of_code("0-1-2"), None, 0, 1, ((2, HELD), (0, 1)), (-p,), ((0,), (1,)), error
    )
    return FoundPiece(100, (box,), 0)


def prepare_boxes(monkeypatch: pytest.MonkeyPatch, pieces: int) -> None:
    """Have a search find one box in each of its pieces, without pictures."""
    monkeypatch.setattr(box_run, "cut", lambda _: pieces)
    monkeypatch.setattr(box_run, "prepare", lambda _: None)
    monkeypatch.setattr(work, "found_in", partial(found_in, pieces))
    monkeypatch.setattr("vstatics.synthesis.pictures.stick.stick_diagram", lambda _: b"<svg/>")
    monkeypatch.setattr(
        "vstatics.synthesis.report.boxes.box_pages", lambda _: {"boxes.html": b"<html/>"}
    )
