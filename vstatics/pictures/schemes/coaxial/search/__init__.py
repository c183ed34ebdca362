"""Order of components along an axis from left to right, by a deterministic search.

`state` describes the bars (lines of links) at a position along the axis. `moves` yields the
components that can follow to the right, and `set_moves` yields gear sets. `remainder` detects dead
ends, `sweep` searches, and `stacked` returns an arrangement with crossings, which always exists.
"""
