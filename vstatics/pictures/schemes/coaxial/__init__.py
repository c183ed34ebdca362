"""Half-sections of what turns about one axis, in which no two links cross where none need.

`train` is what is joined, made of a scheme by `section`; `search` finds in which order from left to
right it stands and what lies inside what. `layout` makes bars and uprights of this, `places` gives
them places: of a `half_section`, with `rooms` for signs and letters, `fitting` into a width.
`chains` stand in rows of their own before it and behind it. `drawn` draws, `picture` is all of it.
"""
