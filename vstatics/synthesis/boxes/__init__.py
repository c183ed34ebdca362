"""Whole gearboxes for wanted ratios: schemes, shift elements, gears and ratios at once.

`box` says what is asked for. `schemes` has the schemes, `engaged` their shift elements and, as
polynomials, the speeds of links in gears; `ranges` tells which targets a gear can have, `elements`
which sets of elements may give all (`joining` what comes into one next, `matching` which target is
whose, `shifts` whether one element may change at a time), `solving` with which ratios
(`set_ratios` nearest to the targets), all of it compiled and put together in `kernel`, in
`pieces`, which `work` hands out and keeps. A found box has a case and `figures` (with its
`chosen_gears`), and a `least_form`; `choice` puts boxes in order, by `grouping`, and is the whole
search in Python. `grids` and `listing` tell of them; `reading` reads a listing back.
"""
