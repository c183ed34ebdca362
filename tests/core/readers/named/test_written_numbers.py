"""Other numbers in the text of a document: the reader finds them, and nothing else changed."""

import codecs
import math
from collections.abc import Iterable

import pytest

from tests.commands import CASES
from vstatics.core.readers.named.nodes import decode, encoding_of
from vstatics.core.readers.named.written_numbers import NumberSpot, number_spots, with_written
from vstatics.core.readers.named.yaml_nodes import yaml_tree


@pytest.mark.parametrize("ends", ["\n", "\r\n"])
@pytest.mark.parametrize("name", ["ford-10r80", "mzkt7922", "power-split", "driveline-8hp70"])
def test_all_numbers_of_a_shipped_case_can_be_others(name: str, ends: str) -> None:
    """Each is found again with its new value and its own unit; what stands between stays."""
    text = (CASES / f"{name}.yaml").read_text("utf-8").replace("\n", ends)
    root = yaml_tree(decode(text.encode(), "a.yaml"))
    spots = number_spots(text, root)
    assert len(spots) >= 8
    values = {keys: one.value + 1 for keys, one in spots.items()}
    made = with_written(text.encode(), spots, values).decode()
    again = number_spots(made, yaml_tree(decode(made.encode(), "a.yaml")))
    assert {keys: (one.value, one.unit) for keys, one in again.items()} == {
        keys: (values[keys], one.unit) for keys, one in spots.items()
    }
    assert _without(made, again.values()) == _without(text, spots.values())


def _without(text: str, spots: Iterable[NumberSpot]) -> str:
    for one in sorted(spots, key=lambda one: -one.start):
        text = text[: one.start] + text[one.end :]
    return text


def test_a_number_keeps_quotes_anchors_and_what_stands_beside_it() -> None:
    text = 'a: &one  -78/30 # ring\nb: \'3000  1/min\'\nc: [*one, "5 Nm"]\nd: "\\x35"\n'
    spots = number_spots(text, yaml_tree(decode(text.encode(), "a.yaml")))
    assert ("d",) not in spots  # by an escape: it is not written as it is read
    values = {("a",): -2.5, ("b",): 100.0, ("c", "2"): 0.1}
    made = with_written(text.encode(), spots, values).decode()
    assert made == 'a: &one  -2.5 # ring\nb: \'100  1/min\'\nc: [*one, "0.1 Nm"]\nd: "\\x35"\n'
    with pytest.raises(ValueError, match="another number"):
        with_written(text.encode(), spots, {("a",): 1.0, ("c", "1"): 2.0})


@pytest.mark.parametrize("mark", [codecs.BOM_UTF8, codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE])
def test_the_encoding_of_a_file_stays(mark: bytes) -> None:
    order = {codecs.BOM_UTF16_BE: "utf-16-be", codecs.BOM_UTF16_LE: "utf-16-le"}.get(mark, "utf-8")
    data = mark + "größe: 1.5 # é\r\n".encode(order)
    text = data.decode(encoding_of(data))
    spots = number_spots(text, yaml_tree(decode(data, "a.yaml")))
    made = with_written(data, spots, {("größe",): math.pi})
    assert made == mark + f"größe: {math.pi!r} # é\r\n".encode(order)
