"""Where the power goes in a gear, and what of it is lost.

`picture` draws it: `graph` has runs of nodes, bands and what goes back; `order` and `columns` put
runs beside each other, `depths` below each other, `back` what returns; `layout` gives their
`places`, in `rows` where a gear is wider than the page, `signs` draws them with `texts` and
`titles`. `sheets` puts several gears on pages, of which
a `chain` is a line of text. `efficiency` is the picture of losses by gear.
"""
