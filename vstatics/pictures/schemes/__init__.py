"""Schemes of a case: the stick diagram of elements, the structure of any case as boxes.

`scheme` is what is shown, with its `titles`; `glyphs`, `signs`, `sets` are the drawings of parts,
`planetary` tells which devices are sets.
`stick` is the stick diagram: `coaxial` of one axis, `axes` of several, `bare` of sets without
teeth. `structure` shows each component as one of the `boxes`, arranged and drawn by `coaxial`.
"""
