"""Half-sections of components on a common axis, in which links cross only if necessary.

`train` is the graph of components, created from a scheme by `section`. `search` finds the order
from left to right and the nesting of links. `layout` converts the result to bars and uprights, and
`places` computes the positions of a `half_section`, with `rooms` for symbols and letters, and
`fitting` to a width. `chains` before and after the gearbox have separate rows. `drawn` draws the
parts, `picture` the whole.
"""
