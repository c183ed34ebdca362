"""Pictures of the power flow in a gear, and of its losses.

`picture` draws the power flow. `graph` contains runs of nodes and bands. `order` and `columns`
place runs side by side, `depths` vertically, `back` returning bands; `layout` combines the
`places`. `rows` splits gears that are wider than the page, and `signs` draws them with `texts` and
`titles`. `sheets` arranges several gears on pages, where a `chain` is a line of text. `efficiency`
is the picture of losses by gear.
"""
