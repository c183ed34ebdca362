"""Stick diagrams of boxes with several parallel axes: each axis a row, each pair one column.

`recognition` tells which links turn about which axis, `row_sections` which planetary sets of a row
are a half-section by themselves, `stations` what stands on the axes, `rows` how these lie; a
`board` is what is to be arranged. `contacts` are where links meet stations, `places` where all of
it stands in an order, `wires` the lines of links, their crossings; `search` finds the order, from
`starts`. `letters` has the names, `fitting` what fits into a width, `drawn` puts it on paper;
`picture` is the diagram.
"""
