"""Generalised kinematic plans: diagrams of the speeds of all links versus the output speed.

`conditions` contains the constraints of a gear, `rays` calculates plans, `panel` draws a plan,
`course` draws a simulated run in a plan, `key` explains the symbols, and `picture` arranges plans
on pages. `wanted` builds a case from given ratios only.
"""
