"""Schemes of a case: the stick diagram of elements, the structure of any case.

`scheme` is what is shown, `glyphs`, `sets` and `pairs` the drawings of elements. `channels` is a
row of items with wires, a `board` what is to be arranged, `search` the arrangement with few
crossings, `placing` its places, `wires` the lines. `sheet` draws what is alike in all with `signs`
and `titles`; `stick` and `structure` are the pictures, `bare` the diagram of sets without teeth,
`axes` that of boxes with several axes.
"""
