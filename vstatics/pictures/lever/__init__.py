"""Lever diagrams: each gear set is a lever, and levers are connected at common links.

`points` calculates the levers of a case, `gear` their state in a gear, and `order` their order from
left to right. `routes` finds the lines of connections between levers, `places` divides the levers
into rows as wide as the page, and `joined` continues connections in the next row. `view` represents
a lever in the state of a gear, and `cell` draws it with `marks` below the `head` of the gear. `key`
explains the symbols, and `picture` combines everything on pages.
"""
