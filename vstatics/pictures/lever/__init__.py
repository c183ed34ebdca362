"""Lever diagrams: gear sets as levers, connected at common links, in each gear.

`points` computes the levers of a case, `gear` the state in a gear, and `order` the order of the
levers. `routes` leads connections between levers, `places` positions everything in rows of a given
width, and `joined` continues connections in the next row. `cell` draws a lever and `view` draws a
lever in a gear, with `marks` and the `head` of the gear. `key` explains symbols, `picture` makes
the figures.
"""
