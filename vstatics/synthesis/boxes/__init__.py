"""Whole gearboxes for wanted ratios: schemes, shift elements, gears and ratios at once.

`box` says what is asked for. `schemes` has the schemes, `search` finds the boxes in them, in
`batches` that can be done apart. A found box has a case and `figures` (with its `chosen_gears`),
and a `least_form`; `choice` puts boxes in order, by `grouping`, and is the whole search in
Python. `tables` and `listing` tell of them; `reading` reads a listing back.
"""
