"""Whole gearboxes for wanted ratios: schemes, shift elements, gears and ratios at once.

`box` says what is asked for, after `checks`. `schemes` has the schemes, `engaged` their shift
elements. Speeds in gears are polynomials (`minors`); `ranges` tells which targets a gear can
have, `elements` which sets of elements may give all, `solving` with which ratios (`cells` of the
bounds, `set_ratios` nearest to the targets). `kernel` does all this compiled, in `pieces`, which
`work` hands out and keeps. A found box has `figures` (with its `chosen_gears`), a `least_form`
and a `case`; `choice` puts boxes in order. `grids`, `listing` and `reading` tell of
them; `search` is the whole search in Python.
"""
