"""The generalised kinematic plan: speeds of all links over the output speed.

`conditions` has the constraints of a gear, `rays` calculates plans, `panel` draws a plan, `course`
the run of a case in a plan, `key` explains the signs, and `picture` arranges plans on pages.
"""
