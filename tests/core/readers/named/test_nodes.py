"""Trees of nodes from YAML and JSON: what is in them, where, and what is refused."""

import json
import time

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from vstatics.core.errors import ReadError
from vstatics.core.readers.named.json_nodes import json_tree
from vstatics.core.readers.named.nodes import DocumentText, Listing, Mapping, Node, Scalar
from vstatics.core.readers.named.yaml_nodes import yaml_tree
from vstatics.core.readers.reading import Source

TEXTS = st.text(st.characters(codec="utf-8"))
FINITE = st.floats(allow_nan=False, allow_infinity=False)
LEAVES = st.none() | st.booleans() | st.integers() | FINITE | TEXTS


@pytest.fixture(params=["libyaml", "python"])
def parser(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Both parsers of PyYAML, the C one and its own."""
    if request.param == "python":
        monkeypatch.delattr(yaml, "CSafeLoader", raising=False)
    elif not hasattr(yaml, "CSafeLoader"):
        pytest.skip("PyYAML has no libyaml here")


NO_YAML = {
    ("", 1, 1): "the file is empty",
    ("# only words\n", 1, 1): "the file is empty",
    ("a: 1\n---\nb: 2\n", 2, 1): "a second document starts here",
    ("a: &x\n- *x\n", 2, 3): "alias *x is inside the part that it repeats",
    ("a: &x 1\nb: *y", 2, 4): "alias *y has no anchor before it",
    ("a:\n ? {b: c}\n : d", 2, 4): "a key that is a list or a mapping",
    ("a: b: c", 1, 5): "read a second `: `; write a text with a colon in quotes",
    ("a: 'b", 1, 6): "not YAML: the quotation mark on line 1, column 4 is not closed",
    ("a:\n  b: 1\n c: 2", 3, 2): "begins on line 1, column 1 continues with a key in column 1",
    ("a: [b, c\nd: e", 2, 2): "the list that begins on line 1, column 4 is not closed",
    # github.com/monarch-initiative/dismech/issues/12094: ` #` in a text begins a comment
    ("a: [b #1, c]\nd: e", 2, 1): "expected `,` or `]`; ` #` begins a comment, so write a text",
    # a name of a file as key: github.com/AlDanial/cloc/issues/312
    ("a: 1\nC #1: [b]\n", 2, 1): "such as `low: [C1, B1]`; ` #` begins a comment, so write a text",
    ("a: {b: 1; c: 2}", 1, 12): "the mapping that begins on line 1, column 4 is not closed",
    ("- 1\nb: 2", 2, 1): "the list that begins on line 1, column 1 continues with `- `",
    ("a: @b", 1, 4): "read `@`, with which no text begins",
    ("a: \x00", 1, 4): "U+0000",
    ("a: \x85b\x7f", 1, 6): "U+007F",
    ("# \u2028\n- [b", 2, 5): "not YAML",
    ("a: !x b", 1, 4): "tag !x is not accepted",
    ("a: !!map b", 1, 4): "tag !!map is not accepted",
    ("a: !!set {b}", 1, 4): "tag !!set is not accepted",
}
"""By text, line and column of the fault: what is said of it."""


def of_yaml(text: str) -> Node:
    return yaml_tree(DocumentText(Source("f", text)))


def of_json(text: str) -> Node:
    return json_tree(DocumentText(Source("f", text)))


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
    first: list[Node] = [Scalar("on", 1, 5), Scalar("1", 1, 9, plain=False), Scalar("ж x", 1, 14)]
    second = Mapping([(Scalar("b", 2, 7), Scalar("c", 2, 10))], 2, 6)
    entries: list[tuple[Scalar, Node]] = [
        (Scalar("a", 1, 1), Listing(first, 1, 4)),
        (Scalar("1e3", 2, 1), second),
    ]
    assert of_yaml("a: [on, '1', ж x]\n1e3: {b: c}\n") == Mapping(entries, 1, 1)


def test_json_keeps_texts_and_places() -> None:
    first: list[Node] = [Scalar("1e3", 1, 8), Scalar("1", 1, 13, plain=False), Scalar("true", 2, 2)]
    entries: list[tuple[Scalar, Node]] = [
        (Scalar("a", 1, 2, plain=False), Listing(first, 1, 7)),
        (Scalar("б", 2, 9, plain=False), Mapping([], 2, 14)),
        (Scalar("б/", 2, 18, plain=False), Listing([], 2, 30)),
    ]
    text = '{"a": [1e3, "1",\n\ttrue], "б": {}, "\\u0431\\/": [\n]}'
    assert of_json(text) == Mapping(entries, 1, 1)


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
def test_merge_keys_bring_what_pyyaml_brings() -> None:
    """Sources: github.com/coreos/butane/issues/507 and gitlabform/gitlabform/issues/340."""
    text = "a: &a {x: p, y: q}\nb: &b {<<: *a, z: s}\n"
    for last in (
        "c: {<<: *a, x: t}",
        "c: {x: t, <<: *b}",
        "c: {<<: [*a, *b], u: v}",
        "c: {<<: [*b, {w: w, z: z}]}",
        "c: {<<: *b, d: {<<: {x: y}}}",
        "c: {<<: {}, '<<': n}",
    ):
        assert plain(of_yaml(text + last)) == yaml.safe_load(text + last), last
    # yaml.org/type/merge.html: keys of the mapping itself win, then those of earlier mappings
    tree = plain(of_yaml(text + "c: &c {<<: *b, y: r}\nd: {<<: [*c, *a], x: t}"))
    assert isinstance(tree, dict)
    assert tree["d"] == {"x": "t", "y": "r", "z": "s"}


@pytest.mark.usefixtures("parser")
def test_yaml_refuses() -> None:
    for (text, line, column), words in NO_YAML.items():
        found = DocumentText(Source("f", text))
        try:
            yaml_tree(found)
        except ReadError as error:
            problems = error.problems
        else:
            problems = found.problems  # tags are told, and the rest is read
        assert problems[-1].place is not None
        assert problems[-1].place[1:3] == (line, column), text
        assert words in problems[-1].message
    version = f"%YAML {'1' * 10_000}.1\n---\na"
    for text in ('"\\ud800"', '"\\U00110000"', '"\\UFFFFFFFF"', version, "\ta"):
        assert refusal(text)[2]  # with a message of the parser


@pytest.mark.usefixtures("parser")
def test_standard_tags_are_taken_and_quote() -> None:
    found = DocumentText(
        Source("f", "{a: !!str true, b: !!int 1, c: ! x, d: !!seq [], e: !!map {}}")
    )
    tree = yaml_tree(found)
    assert isinstance(tree, Mapping)
    quoted = [isinstance(value, Scalar) and not value.plain for _, value in tree.entries]
    assert (found.problems, quoted) == ([], [True, False, True, False, False])


@pytest.mark.usefixtures("parser")
@pytest.mark.parametrize("opening", ["[", "{", "- ", "? ", "[{a: ", "&a [", "!!seq [", "{? "])
def test_yaml_nests_16_levels(opening: str) -> None:
    start = time.process_time()
    line, _, message = refusal(opening * 200_000)
    assert (line, message) == (1, "nested deeper than 16 levels, expected at most this depth")
    assert time.process_time() - start < 5


def test_16_levels_are_taken() -> None:
    text = "[" * 16 + "]" * 16
    assert plain(of_yaml(text)) == plain(of_json(text))
    assert refusal(f"[{text}]", "json") == refusal(f"[{text}]")


@pytest.mark.usefixtures("parser")
def test_yaml_aliases_do_not_blow_up() -> None:
    laughs = "".join(f"- &l{n} [{', '.join([f'*l{n - 1}'] * 9)}]\n" for n in range(1, 30))
    line, _, message = refusal("- &l0 [x]\n" + laughs)
    assert line == 7  # l5 on line 6 makes 9**5 * 2 + ... = 125,479 values, l6 nine times as many
    assert "makes more than 200000 values" in message


def test_json_refuses() -> None:
    for text, line, column, words in (
        ("", 1, 1, "read the end of the file, expected a value"),
        ("[1,\n 2 3]", 2, 4, "read '3', expected `,` or `]`"),
        ('{"a" 1}', 1, 6, "read '1', expected `:` after a key"),
        ('{"a": 1,}', 1, 9, "read '}', expected no `,` before it"),  # python/cpython#113149
        ("{a: 1}", 1, 2, "read 'a', expected a key in double quotes"),
        ("[1}", 1, 3, "read '}', expected `,` or `]`"),
        ('["a\nb"]', 1, 4, "Invalid control character"),
        ('["a', 1, 2, "Unterminated string"),
        ('["\\x"]', 1, 3, "Invalid \\escape"),
        ('["\\udc00"]', 1, 2, "half a character"),
        ("[+1]", 1, 2, "read '+1', expected a value"),
        ("[.5]", 1, 2, "read '.5', expected a value"),
        ("[1.]", 1, 2, "read '1.', expected a value"),
        ("[True]", 1, 2, "read 'True', expected a value"),
        ("[\u00a01]", 1, 2, "expected a value"),
    ):
        refused = refusal(text, "json")
        assert refused[:2] == (line, column)
        assert words in refused[2]


@given(st.recursive(LEAVES, lambda one: st.lists(one) | st.dictionaries(TEXTS, one)))
def test_json_gives_what_the_standard_library_gives(data: object) -> None:
    for text in (json.dumps(data), json.dumps(data, ensure_ascii=False, indent=1)):
        try:
            tree = of_json(text)
        except ReadError as error:
            assert "nested" in str(error)  # noqa: PT017
        else:
            assert plain(tree) == plain_json(json.loads(text, parse_int=str, parse_float=str))


def plain_json(data: object) -> object:
    match data:
        case dict():
            return {key: plain_json(value) for key, value in data.items()}
        case list():
            return [plain_json(item) for item in data]
        case str():
            return data
    return json.dumps(data)
