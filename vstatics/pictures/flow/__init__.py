"""Where the power goes in a gear, and what of it is lost.

`picture` draws it: `graph` has runs of nodes, bands and what goes back; `order` and `columns` put
runs beside each other, `depths` below each other, `back` what returns; `layout` gives their
`places`, `signs` draws them with `texts` and `titles`. `efficiency` is the picture of losses by
gear.
"""
