"""Trees of nodes from YAML and JSON: what is in them, where, and what is refused."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator

import pytest
import yaml

from vstatics.errors import ReadError
from vstatics.readers.json_nodes import json_tree
from vstatics.readers.nodes import Found, Listing, Mapping, Node, Scalar, decode, is_null
from vstatics.readers.reading import Source
from vstatics.readers.yaml_nodes import yaml_tree


@pytest.fixture(params=["libyaml", "python"])
def parser(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    """Both parsers of PyYAML, the C one and its own."""
    if request.param == "python":
        monkeypatch.delattr(yaml, "CSafeLoader", raising=False)
    elif not hasattr(yaml, "CSafeLoader"):
        pytest.skip("PyYAML has no libyaml here")
    yield request.param


def of_yaml(text: str) -> Node:
    return yaml_tree(Found(Source("f", text)))


def of_json(text: str) -> Node:
    return json_tree(Found(Source("f", text)))


def plain(node: Node) -> object:
    """A tree without its places."""
    match node:
        case Mapping():
            return {key.text: plain(value) for key, value in node.entries}
        case Listing():
            return [plain(item) for item in node.items]
    return node.text


def refusal(text: str, kind: str = "yaml") -> tuple[int, int, str]:
    with pytest.raises(ReadError) as caught:
        (of_yaml if kind == "yaml" else of_json)(text)
    problem = caught.value.problems[-1]
    assert problem.place is not None
    return problem.place.line, problem.place.column, problem.message


@pytest.mark.usefixtures("parser")
def test_yaml_keeps_texts_and_places() -> None:
    assert of_yaml("a: [on, '1', ж x]\n1e3: {b: }\n") == Mapping(
        [
            (
                Scalar("a", 1, 1),
                Listing(
                    [Scalar("on", 1, 5), Scalar("1", 1, 9, plain=False), Scalar("ж x", 1, 14)], 1, 4
                ),
            ),
            (Scalar("1e3", 2, 1), Mapping([(Scalar("b", 2, 7), Scalar("", 2, 9))], 2, 6)),
        ],
        1,
        1,
    )


def test_json_keeps_texts_and_places() -> None:
    assert of_json('{"a": [1e3, "1",\n\ttrue], "б": {}, "\\u0431\\/": [\n]}') == Mapping(
        [
            (
                Scalar("a", 1, 2, plain=False),
                Listing(
                    [Scalar("1e3", 1, 8), Scalar("1", 1, 13, plain=False), Scalar("true", 2, 2)],
                    1,
                    7,
                ),
            ),
            (Scalar("б", 2, 9, plain=False), Mapping([], 2, 14)),
            (Scalar("б/", 2, 18, plain=False), Listing([], 2, 30)),
        ],
        1,
        1,
    )


def test_columns_count_characters_outside_the_basic_plane_once() -> None:
    assert refusal('{"🚜": x}', "json")[:2] == (1, 7)
    tree = of_yaml("{🚜🚜: x}")
    assert isinstance(tree, Mapping)
    assert tree.entries[0][1][1:3] == (1, 6)


@pytest.mark.usefixtures("parser")
def test_yaml_aliases_share_nodes() -> None:
    tree = of_yaml("a: &x [1]\nb: *x\nc: &x 2\nd: *x")
    assert isinstance(tree, Mapping)
    values = [value for _, value in tree.entries]
    assert values[1] is values[0]
    assert plain(tree) == {"a": ["1"], "b": ["1"], "c": "2", "d": "2"}


@pytest.mark.usefixtures("parser")
@pytest.mark.parametrize(
    ("text", "line", "column", "words"),
    [
        ("", 1, 1, "the file is empty"),
        ("# only words\n", 1, 1, "the file is empty"),
        ("a: 1\n---\nb: 2\n", 2, 1, "a second document starts here"),
        ("a: &x\n- *x\n", 2, 3, "alias *x stands inside what it repeats"),
        ("&x a: *x\nb: *y", 2, 4, "alias *y of no anchor before it"),
        ("a:\n ? {b: c}\n : d", 2, 4, "a key that is a list or a mapping"),
        ("a: b: c", 1, 5, "mapping values are not allowed"),
        ("a: [1, 2\nb: 3", 2, 2, "not YAML"),
        ("a: \x00", 1, 4, "U+0000"),
        ("a: \x85b\x7f", 1, 6, "U+007F"),
        ('a: "\\ud800"', 1, 4, ""),
        ('a: "\\U00110000"', 1, 1, "not YAML"),
    ],
)
def test_yaml_refuses(text: str, line: int, column: int, words: str) -> None:
    refused = refusal(text)
    if words != "not YAML":
        assert refused[:2][0] == line
    assert words in refused[2]
    assert column
