"""Dotted paths into documents: what they find, what they say where they find nothing."""

import pytest

from vstatics.core.model.paths import NoValueError, split, written
from vstatics.core.readers.named.node_numbers import find_node, number_of, number_text, replaced
from vstatics.core.readers.named.nodes import Node, Scalar, decode
from vstatics.core.readers.named.yaml_nodes import yaml_tree

TEXT = b"""
start: {speed: 600 rpm}
controls:
  F.1: [[0, 3000], [2, 0]]
  C: "182*(1 - exp(-60*t))"
shifts:
  - {at: 2, overlap: 0.3}
  - {at: 4}
"""


def tree() -> Node:
    return yaml_tree(decode(TEXT, "scenario.yaml"))


def text_at(root: Node, path: str) -> str:
    node = find_node(root, split(path))
    return getattr(node, "text", repr(node))


def test_a_path_finds_what_the_document_says() -> None:
    for path, text in (
        ("start.speed", "600 rpm"),
        ("shifts.1.overlap", "0.3"),
        (' controls."F.1".2.1 ', "2"),
        ("controls.'F.1'.1.2", "3000"),
        ("shifts.2.overlap", "None"),  # may be put there,
    ):
        assert text_at(tree(), path) == text


def test_a_path_that_leads_nowhere_says_where_and_what_is_there() -> None:
    for path, said, marked in (
        ("shifts.3.at", "`3`, expected the number of an item, 1 to 2: `shifts` is a list", "3.at"),
        ("shift.1.at", "no `shift`, expected `start`, `controls` or `shifts`; did you", "shift.1"),
        ("start.speed.x", "`start.speed` is '600 rpm', with nothing below it", "x"),
        ("controls.D.1.2", "no `D` in `controls`, expected `F.1` or `C`", "D.1.2"),
        ("start..x", "read nothing, expected a name", ".x"),
        ('controls."F.1', "the quote is not closed", '"F.1'),
        ("a" + ".a" * 16, "expected at most 16 parts", ".a"),
    ):
        with pytest.raises(NoValueError) as caught:
            find_node(tree(), split(path))
        assert said in str(caught.value)
        assert path[caught.value.at :].startswith(marked)


def test_a_written_path_is_split_into_the_same_parts() -> None:
    for keys in (("a", "1"), ("F.1",), ("F 1", 'say "so"'), ("вал", "a-b")):
        assert tuple(part.name for part in split(written(keys))) == keys


def test_only_the_value_of_the_path_is_replaced() -> None:
    """The first tree stays as it was, too."""
    root = tree()
    other = replaced(root, ("shifts", "1", "overlap"), "0.1")
    other = replaced(other, ("shifts", "2", "overlap"), "0.2")
    assert [text_at(other, f"shifts.{n}.overlap") for n in (1, 2)] == ["0.1", "0.2"]
    assert [text_at(other, f"shifts.{n}.at") for n in (1, 2)] == ["2", "4"]
    assert root == tree()


def test_what_is_no_number_says_what_it_is() -> None:
    for path, said in (
        ("controls.C", "expected a number"),
        ("controls.'F.1'", "is a list: name a number in it"),
        ("start", "is a mapping: name a number in it"),
    ):
        node = find_node(tree(), split(path))
        assert node is not None
        with pytest.raises(ValueError, match=said):
            number_of(node)


def test_a_tonne_is_not_the_time_of_a_formula() -> None:
    """Its symbol is `t`: gentooboontoo/js-quantities/issues/117."""
    assert number_of(Scalar("1.2 t", 1, 1)) == (1.2, "t")
    with pytest.raises(ValueError, match="is a formula"):
        number_of(Scalar("1.2*t", 1, 1))


def test_a_written_number_is_read_as_the_same_number() -> None:
    for value in (0.0, -3.0, 1e-9, 0.1, 2.0**60, 1 / 3):
        assert float(number_text(value)) == value
    assert number_text(42.0) == "42"  # as counts of teeth are written
