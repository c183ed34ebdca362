"""Edges on cycles: an edge is on one where its ends stay joined without it."""

from itertools import combinations

from hypothesis import given
from hypothesis import strategies as st

from vstatics.core.flow.graph_cycles import edges_on_cycles

EVERY_EDGE = list(combinations(range(7), 2))


def joined(one: int, other: int, edges: set[tuple[int, int]]) -> bool:
    """Whether a way leads from a node to another."""
    reached, size = {one}, 0
    while len(reached) > size:
        size = len(reached)
        reached |= {node for edge in edges for node in edge if reached & set(edge)}
    return other in reached


@given(edges=st.sets(st.sampled_from(EVERY_EDGE)))
def test_an_edge_is_on_a_cycle_if_its_ends_stay_joined_without_it(
    edges: set[tuple[int, int]],
) -> None:
    expected = {edge for edge in edges if joined(*edge, edges - {edge})}
    assert edges_on_cycles(edges) == expected


def test_a_long_chain_needs_no_recursion() -> None:
    """It may be closed or open."""
    chain = [(number, number + 1) for number in range(20_000)]
    assert edges_on_cycles(chain) == set()
    assert len(edges_on_cycles([*chain, (20_000, 0)])) == 20_001
