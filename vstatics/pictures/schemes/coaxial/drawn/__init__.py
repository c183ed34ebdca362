"""Half-sections on paper: `ink` is what they are drawn with, `lines` the wires of links.

`links`, `devices` and `ports` draw those; `chain` is what stands one behind the other.
"""
