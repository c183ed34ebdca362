"""Stick diagrams of gearboxes with several parallel axes: axes are rows, gear pairs are columns.

`recognition` assigns the links to axes, `row_sections` draws gear sets of a row as a half-section,
`stations` lists what is on the axes, `rows` places the axes, and `board` combines the input of the
search. `contacts` are the points where links meet stations, `places` the positions of everything
in an order, `wires` the lines of links with crossings. `search` optimizes the order from `starts`.
`letters` places the names, `fitting` fits the diagram into a width, `drawn` draws, and `picture`
makes the figures.
"""
