"""Lever diagrams: sets as levers, joined at common links, gear by gear.

`points` has the levers of a case, `gear` what they show of a gear, `order` and `places` where they
stand and how joins run. `cell` draws a lever by its `marks`, `key` explains them; `picture` is the
whole.
"""
