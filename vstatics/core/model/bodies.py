"""Groups of links that rotate together as one body."""

from __future__ import annotations

Bodies = list[int]
"""Body of each link, housing first, identified by the smallest link number in the body."""


def join(bodies: Bodies, *links: int) -> None:
    """Merge the bodies of several links, in place."""
    joined = {bodies[link] for link in links}
    if len(joined) > 1:
        least = min(joined)
        bodies[:] = [least if body in joined else body for body in bodies]
