"""Pictures of the power flow in a gear, and of its losses.

`picture` draws the power flow. Its `graph` consists of nodes (links and components) joined by bands
of power; nodes in series form a run. `order` and `columns` place runs horizontally, `depths`
vertically, and `back` places bands that return to the left; `layout` combines these `places`.
`rows` splits gears that are wider than the page, and `signs` draws gears with `texts` and `titles`.
`sheets` arranges several gears on pages; a gear without branches is a `chain`, drawn as a line of
text. `efficiency` draws the losses of each gear.
"""
