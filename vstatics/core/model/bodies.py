"""Links that turn as one body."""

from __future__ import annotations

Bodies = list[int]
"""By link, the housing first: the least link of those that turn as one with it."""


def join(bodies: Bodies, *links: int) -> None:
    """Make some links one body, in place."""
    joined = {bodies[link] for link in links}
    if len(joined) > 1:
        least = min(joined)
        bodies[:] = [least if body in joined else body for body in bodies]
