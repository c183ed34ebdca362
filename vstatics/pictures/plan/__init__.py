"""The generalised kinematic plan: speeds of all links over that of the output.

`conditions` says what holds in a gear, `rays` calculates plans, `panel` draws one, `course` the
run of a case through it, `key` says what its signs are; `picture` puts panels together.
"""
