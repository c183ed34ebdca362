"""Lever diagrams: sets as levers, joined at common links, gear by gear.

`points` has the levers of a case, `gear` what they show of a gear, `order` in which order they
stand. `routes` says how joins run between them, `places` where all of it stands in rows of a
width, `joined` how joins go on there. `cell` draws a lever, a `view` in a gear, by its `marks`
under the `head` of its gear, `key` explains them; `picture` is the whole.
"""
