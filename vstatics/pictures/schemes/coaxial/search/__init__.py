"""Order of components along an axis from left to right, by a deterministic search.

`state` is the situation at a place, `moves` the possible next steps, with those of gear sets in
`set_moves`. `remainder` detects dead ends, `sweep` searches, and `stacked` is the arrangement with
crossings that always exists.
"""
