"""Stick diagrams of gearboxes with several parallel axes.

Each axis is a horizontal row. A station is anything on the axes with a position from left to right:
a gear pair, a gear set, a shift element, or a half-section of several. `recognition` assigns the
links to axes, `row_sections` combines gear sets of an axis to a half-section, `stations` lists the
stations, `rows` places the axes, and `board` contains the input of the search for an order of
stations. `contacts` are the points where links meet stations, `places` the positions that follow
from an order, and `wires` the lines of links. `search` improves the order from `starts`. `letters`
places the names, `fitting` fits the diagram into a width, `drawn` draws it, and `picture` returns
the pages.
"""
