"""Diagrams of the structure of a case: stick diagram of gear sets, or boxes for any case.

`scheme` contains the diagram, with its `titles`; `gear_glyphs`, `sets` and `shift_element_symbols`
(also of springs and the housing) are the drawings of parts, `planetary` identifies planetary sets.
`stick` is the stick diagram: `coaxial` for one axis, `axes` for several, `bare` for sets without
teeth. `structure` shows each component as one of the `boxes`, arranged and drawn by `coaxial`.
"""
