"""Labels along an edge: near to what they belong to, none over another."""

from itertools import pairwise

import matplotlib as mpl
import pytest

from vstatics.pictures.drawing.labels import shortened, spread, width


def test_labels_move_as_little_as_they_can() -> None:
    """Two labels of size 2 wanted at one place go one to each side; a third, far off, stays."""
    assert spread([4, 4, 20], [2, 2, 2]) == pytest.approx([3, 5, 20])
    assert spread([0, 0], [2, 2], low=0, high=10) == pytest.approx([1, 3])
    assert spread([10, 10], [2, 2], low=0, high=10) == pytest.approx([7, 9])
    assert spread([], []) == []


def test_labels_keep_their_order_and_their_distance() -> None:
    wanted, sizes = [3.0, 1.0, 2.9, 9.0, 3.1], [1.0, 4.0, 2.0, 1.0, 3.0]
    places = spread(wanted, sizes)
    order = sorted(range(5), key=wanted.__getitem__)
    for one, other in pairwise(order):
        assert places[other] - places[one] >= (sizes[one] + sizes[other]) / 2 - 1e-9


def test_a_text_is_cut_where_one_more_letter_would_not_fit() -> None:
    """Even a name of 100,000 letters is cut at once."""
    for text in ("low and reverse brake", "a b  c d e f g h i j k l m n", "ab " * 33_334):
        for room in (3, 20, 45.5, 70):
            end = next(
                end for end in range(len(text)) if width(f"{text[: end + 1].rstrip()}…") > room
            )
            assert shortened(text, room) == f"{text[:end].rstrip()}…"


def test_a_text_is_as_wide_under_any_settings_of_the_user() -> None:
    texts = ["input", "carrier and second ring", "E"]
    widths = [width(text) for text in texts]
    width.cache_clear()
    with mpl.rc_context({"text.hinting": "force_autohint"}):
        assert [width(text) for text in texts] == widths
