"""A page whose numbers change.

`numbers` says of each what it is, `fields` change them.
`lowered` has a case as the script of a page calculates it, `packed` makes its sections small,
`page` is that page.
"""
