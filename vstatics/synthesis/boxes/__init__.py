"""Complete gearboxes for wanted ratios: schemes, shift elements, gears and ratios at once.

`box` describes the request and a result. `schemes` generates the schemes, and `search` finds the
gearboxes of a scheme, in `batches` that can be searched separately. A found gearbox has a case and
`figures` (with its `chosen_gears`), and a `least_form`. `choice` orders gearboxes, by `grouping`,
and contains the whole search in Python. `tables` and `listing` present the results; `reading` reads
a listing back.
"""
