"""The explanation as JSON."""

from __future__ import annotations

from tests.commands import CASES, vstatics


def test_json_tells_the_same() -> None:
    said = vstatics("explain", CASES / "mzkt7922.dat", "--gear", "1", "--gear", "2", "-f", "json")
    [first, second] = said.json["gears"]
    assert first["formula"]["text"] == "(1 - u_D1)(1 - u_D3)"
    assert second["matrix"][1][:2] == [1.0, 0.0]
    assert second["engaged"] == ["F2", "T4"]
