"""Formulas of sweeps and scenarios: text -> tree -> values.

`excerpt` is a text with its place. `grammar` parses the text into a tree whose leaves are
`operands`, without resolving names. `evaluation` calculates the values of the tree on arrays.

>>> from vstatics.core.readers.expressions.excerpt import Excerpt
>>> from vstatics.core.readers.expressions.grammar import Language, parse
>>> parse(Excerpt("1 + 2*t", "--where"), Language(["abs"], "a number or t", "t")).name
'+'
"""
