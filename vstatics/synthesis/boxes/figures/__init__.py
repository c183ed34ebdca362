"""A found box as a case, and what is told of it: its figures, by gear and by box.

`by_box` says by what boxes are judged, `by_gear` what is told of a gear; `measured` has both from
the solver, with `shifting` (which shifts there are, which elements reverse, which may be one-way
clutches) and `planar`. `case` makes the case, `known` names a box that is built,
by a table that `shipped` writes.
"""
