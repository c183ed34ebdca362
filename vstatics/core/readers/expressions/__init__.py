"""The language of formulas, for sweeps and scenarios: text -> tree, which knows no names.

`excerpt` is the text with its place, `grammar` makes a tree of it, whose leaves are `operands`;
`evaluation` has its values on arrays.

>>> from vstatics.core.readers.expressions.excerpt import Excerpt
>>> from vstatics.core.readers.expressions.grammar import Language, parse
>>> parse(Excerpt("1 + 2*t", "--where"), Language(["abs"], "a number or t", "t")).name
'+'
"""
