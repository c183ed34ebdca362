"""Complete gearboxes for wanted ratios: schemes, shift elements, gears and ratios at once.

`box` describes the request and a found gearbox. `schemes` generates the schemes, and `search` finds
the gearboxes of a scheme; `batches` divides the work. `figures` are the characteristic numbers of a
gearbox with its `chosen_gears`, and `least_form` identifies equal gearboxes. `choice` filters and
sorts gearboxes with `grouping`, and contains the Python function for the whole search. `tables` and
`listing` present the results, and `reading` reads them from a document.
"""
