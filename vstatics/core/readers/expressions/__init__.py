"""Formulas of sweeps and scenarios: text -> tree -> values.

`excerpt` is a part of a text with its place. `grammar` parses it to a tree whose leaves are
`operands`, with names as written. `evaluation` calculates the values of the tree on arrays.

>>> from vstatics.core.readers.expressions.excerpt import Excerpt
>>> from vstatics.core.readers.expressions.grammar import Language, parse
>>> parse(Excerpt("1 + 2*t", "--where"), Language(["abs"], "a number or t", "t")).name
'+'
"""
