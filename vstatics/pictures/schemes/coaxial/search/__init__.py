"""What stands along an axis, from left to right: a search that is the same every time.

`state` is what there is at a place, `moves` what may come next, of sets `set_moves`; `remainder`
tells when the remainder cannot be drawn any more, `sweep` searches, `stacked` is the arrangement
with crossings that always exists.
"""
