"""Half-sections of what turns about one axis, in which no two links cross where none need.

`train` is what is joined, `sweep` finds in which order from left to right it stands and what lies
inside what (`moves`, `remainder`), `layout` gives it places. These know nothing of matplotlib;
`drawing` draws.
"""
