"""Stick diagrams of boxes with several parallel axes: each axis a row, each pair one column.

`recognition` tells which links turn about which axis, `stations` what stands on the axes, `rows`
how these lie; a `board` is what is to be arranged. `contacts` are where links meet stations,
`places` where all of it stands in an order, `wires` the lines of links, their crossings; `search`
finds the order, from `starts`. `labels` and `link_names` place names clear of `obstacles`, `sheet`
draws links, `marks` what stands on one axis, `wheels` pairs; `picture` is the diagram.
"""
