"""Schemes of a case: the stick diagram of elements, the structure of any case.

`scheme` is what is shown, with its `titles`; `glyphs`, `signs`, `sets` are the drawings of parts,
`planetary` tells which devices are sets.
`stick` is the stick diagram: `coaxial` of one axis, `axes` of several, `bare` of sets without
teeth. `structure` is the other one: `channels` are a row of items with wires, a `board` what is to
be arranged, `search` the arrangement with few crossings, `placing` its places, `rows` its breaks,
`wires` its lines, `sheet` what draws.
"""
