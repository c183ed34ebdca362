"""Cases made of elements as texts, and what is made and said of them."""

import pytest

import vstatics as library
from tests.commands import CASES
from vstatics.core.errors import ReadError
from vstatics.core.readers import read
from vstatics.core.tables.quantities import Table
from vstatics.core.tables.values import tables

SET = """
input: sun
output: carrier
elements:
  P1: {kind: planetary, sun: sun, ring: ring, carrier: carrier, teeth: {sun: 30, ring: 75}}
shift_elements:
  B: [ring, housing]
  C: [sun, carrier]
gears:
  low: {engaged: [B]}
  direct: {engaged: [C]}
"""


AOD = (CASES / "ravigneaux-aod.yaml").read_text("utf-8")


def changed(before: str, after: str, text: str = SET) -> str:
    assert before in text
    return text.replace(before, after)


def loaded(text: str) -> library.Transmission:
    return read(text.encode(), "case.yaml").case


def shown(text: str) -> dict[str, Table]:
    return {table.quantity.name: table for table in tables(library.solve(loaded(text)))}


def problems(text: str) -> list[str]:
    with pytest.raises(ReadError) as refused:
        read(text.encode(), "case.yaml")
    return [str(problem) for problem in refused.value.problems]
