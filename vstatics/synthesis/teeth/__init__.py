"""Integer teeth for wanted ratios of gears or sets.

`problem` checks what is asked, `layout` tells what of the case has teeth, `limits` between which
they lie. `rows` has all teeth of an element that fulfil the `conditions`, `table` the ratios that
these make. `targets` tells how far gears are from what is wanted, `search` finds the best teeth of
all elements together, `solutions` what these are, and the case with them. `finding` does all this,
`tables` are the tables.
"""
