"""Half-sections of components on a common axis, in which links cross only if necessary.

`section` converts the components to a `train`, a graph. `search` finds the order of components from
left to right and the nesting of links. `layout` converts the result to bars (horizontal lines of
links) and uprights (components). `places` computes the positions of a `half_section`, with `rooms`
for symbols and letters, and `fitting` reduces it to a width. `chains` of shafts before and after
the gearbox have separate rows. `drawn` draws the components and links, and `picture` returns the
pages.
"""
